//! A k-DOP, and how one of B is realigned to A's directions.

use ocb_hierarchy::{Relative, Volume, fit};
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, dot};

use crate::directions::{Directions, Term, extreme, lengths};

/// A discrete oriented polytope: the slabs across `N = k / 2` fixed directions.
///
/// Rounding, in units of 2^-53 times the lengths of a query (see `ocb_hierarchy::Relative`): a reach is the product of a corner
/// with a direction of entries 0 and 1, off by 4. A turned direction is off by 7; the three numbers that it is made of add
/// up to less than 3 and are off by 2, their products with reaches of at most `sqrt(3)` and the sum by less than 40; the shift
/// by 9, the gap by 6. Altogether less than 100.
#[derive(Clone, Copy, Debug)]
pub struct Dop<const N: usize> {
    /// How far it reaches in every direction, and in the opposite ones.
    reach: [[f64; N]; 2],
}

/// Longer than any direction.
const LONGEST: f64 = 1.75;

/// What a query knows of B's directions in A's frame.
#[derive(Clone, Copy, Debug)]
pub struct Alignment<const N: usize> {
    /// For each of A's directions, which three reaches of B's DOP bound it.
    terms: [[Term; 3]; N],
    /// How far B's origin lies in each.
    shift: [f64; N],
}

impl<const N: usize> Volume for Dop<N>
where
    Dop<N>: Directions<N>,
{
    type Shared = Alignment<N>;
    type Placed = Dop<N>;

    fn around(triangles: &[Triangle], _radius: f64) -> Self {
        let mut reach = [[f64::NEG_INFINITY; N]; 2];
        for corner in triangles.as_flattened() {
            for (i, direction) in Self::DIRECTIONS.iter().enumerate() {
                let at = dot(*direction, *corner);
                reach[0][i] = reach[0][i].max(at);
                reach[1][i] = reach[1][i].max(-at);
            }
        }
        Self { reach }
    }

    fn split_along(&self, triangles: &[Triangle]) -> Vector {
        fit::widest_axis(triangles)
    }

    /// The sum of the sides along the coordinate axes.
    #[inline(always)]
    fn size(&self) -> f64 {
        let [high, low] = &self.reach;
        high[0] + low[0] + high[1] + low[1] + high[2] + low[2]
    }

    fn share(relative: &Relative) -> Alignment<N> {
        let r = &relative.rotation;
        let in_b = |d: Vector| -> Vector { core::array::from_fn(|j| d[0] * r[0][j] + d[1] * r[1][j] + d[2] * r[2][j]) };
        Alignment {
            terms: Self::DIRECTIONS.map(|direction| extreme::<N>(in_b(direction))),
            shift: Self::DIRECTIONS.map(|direction| dot(direction, relative.translation)),
        }
    }

    /// Realigned: the DOP around a DOP of B, in A's directions.
    #[inline(always)]
    fn place(&self, alignment: &Alignment<N>) -> Dop<N> {
        let mut placed = *self;
        for i in 0..N {
            let terms = &alignment.terms[i];
            let sum = |other: usize| -> f64 {
                let term = |t: &Term| t.factor * self.reach[t.opposite ^ other][t.direction];
                term(&terms[0]) + term(&terms[1]) + term(&terms[2])
            };
            placed.reach[0][i] = sum(0) + alignment.shift[i];
            placed.reach[1][i] = sum(1) - alignment.shift[i];
        }
        placed
    }

    /// The gap in the box of the first three directions, or in any single one.
    #[inline(always)]
    fn gap(&self, b: &Dop<N>, _: &Alignment<N>) -> f64 {
        let axes = [0, 1, 2].map(|i| self.gap_in(b, i).max(0.0));
        let mut gap = dot(axes, axes).sqrt();
        for (i, length) in lengths::<N>().into_iter().enumerate().skip(3) {
            let single = self.gap_in(b, i) / length;
            gap = if single > gap { single } else { gap };
        }
        gap
    }

    #[inline(always)]
    fn apart(&self, b: &Dop<N>, _: &Alignment<N>, slack: f64) -> bool {
        (0..N).any(|i| self.gap_in(b, i) > LONGEST * slack)
    }
}

impl<const N: usize> Dop<N> {
    /// The gap of the slabs of one direction, times its length.
    #[inline(always)]
    fn gap_in(&self, b: &Self, i: usize) -> f64 {
        let (beyond, before) = (self.reach[0][i] + b.reach[1][i], self.reach[1][i] + b.reach[0][i]);
        if beyond < before { -beyond } else { -before }
    }
}
