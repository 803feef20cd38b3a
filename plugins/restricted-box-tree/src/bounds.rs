//! A box along the object's axes.

use ocb_hierarchy::{Boxes, Relative, Volume};
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add, sub};

/// A box along the axes of its object.
///
/// Rounding, in units of 2^-53 times the lengths of a query (see `ocb_hierarchy::Relative`): sides are corners' coordinates, as
/// they are. Middle and half sides are off by 2; the middle placed by 8, the difference of two by 2. B's axes in A's frame are
/// the columns of the rotation, orthonormal up to 16, so that a point of B's box is off by 48 from a sum of them; a reach is
/// three products, off by 12. Altogether less than 120; along a product of two axes, where the identities of orthonormal
/// axes add `sqrt(3)` times 16 to the difference and to each entry, less than 250.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// The lower sides and the upper sides.
    pub sides: [Vector; 2],
}

/// Boxes with more empty space than this on one side, relative to the sum of the three sides, are cut once more.
const LOOSE: f64 = 0.02;

/// The rotation from B to A, and the magnitudes of its entries.
#[derive(Clone, Copy, Debug)]
pub struct Shared {
    relative: Relative,
    reach: [Vector; 3],
}

/// A box of B in A's frame.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    center: Vector,
    half: Vector,
}

impl Bounds {
    /// The surface of the box.
    fn area(&self) -> f64 {
        let [x, y, z] = sub(self.sides[1], self.sides[0]);
        x * y + y * z + z * x
    }

    /// Where a side lies: twice the axis, and 1 for the upper one.
    #[inline(always)]
    pub fn side(&self, side: u8) -> f64 {
        self.sides[usize::from(side & 1)][usize::from(side >> 1)]
    }

    /// The box with one side moved.
    #[inline(always)]
    pub fn cut(mut self, side: u8, at: f64) -> Self {
        self.sides[usize::from(side & 1)][usize::from(side >> 1)] = at;
        self
    }

    /// The side beyond which the box is emptiest, if that is much of it; `tight` is the box around what it holds.
    pub fn loosest_side(&self, tight: &Self) -> Option<u8> {
        let empty = |side: u8| (self.side(side) - tight.side(side)).abs();
        let loosest = (0..6).max_by(|&i, &j| empty(i).total_cmp(&empty(j)))?;
        (empty(loosest) > LOOSE * self.size()).then_some(loosest)
    }

    #[inline(always)]
    fn compare<'s>(&self, b: &Placed, shared: &'s Shared) -> Boxes<'s> {
        let (center, half) = self.center_and_half();
        let between = sub(b.center, center);
        Boxes { half_a: half, half_b: b.half, between, turn: &shared.relative.rotation, reach: &shared.reach }
    }

    #[inline(always)]
    fn center_and_half(&self) -> (Vector, Vector) {
        let [low, high] = &self.sides;
        (add(*low, *high).map(|x| 0.5 * x), sub(*high, *low).map(|x| 0.5 * x))
    }
}

impl Volume for Bounds {
    type Shared = Shared;
    type Placed = Placed;

    fn around(triangles: &[Triangle], _radius: f64) -> Self {
        let mut sides = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for corner in triangles.as_flattened() {
            for k in 0..3 {
                (sides[0][k], sides[1][k]) = (sides[0][k].min(corner[k]), sides[1][k].max(corner[k]));
            }
        }
        Self { sides }
    }

    /// The axis on which splitting at the mean leaves the least: the surfaces of both boxes, after one cut each, times how many
    /// triangles they hold.
    fn split_along(&self, triangles: &[Triangle]) -> Vector {
        let cost = |axis: usize| {
            let along = |t: &Triangle| t[0][axis] + t[1][axis] + t[2][axis];
            let mean = triangles.iter().map(along).sum::<f64>() / triangles.len() as f64;
            let (mut left, mut right) = ((0.0, f64::NEG_INFINITY), (0.0, f64::INFINITY));
            for t in triangles {
                let [p, q, r] = t.map(|corner| corner[axis]);
                if along(t) < mean {
                    left = (left.0 + 1.0, left.1.max(p).max(q).max(r));
                } else {
                    right = (right.0 + 1.0, right.1.min(p).min(q).min(r));
                }
            }
            if left.0 == 0.0 || right.0 == 0.0 {
                return f64::INFINITY;
            }
            left.0 * self.cut(2 * axis as u8 + 1, left.1).area() + right.0 * self.cut(2 * axis as u8, right.1).area()
        };
        let costs = [cost(0), cost(1), cost(2)];
        let least = (0..3).min_by(|&i, &j| costs[i].total_cmp(&costs[j])).unwrap_or(0);
        core::array::from_fn(|k| f64::from(u8::from(k == least)))
    }

    /// The sum of the sides: as good as the volume, and it does not vanish for flat boxes.
    #[inline(always)]
    fn size(&self) -> f64 {
        let [x, y, z] = sub(self.sides[1], self.sides[0]);
        x + y + z
    }

    fn share(relative: &Relative) -> Shared {
        Shared { relative: *relative, reach: relative.rotation.map(|row| row.map(f64::abs)) }
    }

    #[inline(always)]
    fn place(&self, shared: &Shared) -> Placed {
        let (center, half) = self.center_and_half();
        Placed { center: shared.relative.place(center), half }
    }

    #[inline(always)]
    fn gap(&self, b: &Placed, shared: &Shared) -> f64 {
        self.compare(b, shared).gap()
    }

    #[inline(always)]
    fn apart(&self, b: &Placed, shared: &Shared, slack: f64) -> bool {
        self.compare(b, shared).apart(slack)
    }
}
