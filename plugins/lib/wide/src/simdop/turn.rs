//! B's DOPs in A's directions: the same combination of rows for every node of B.
//!
//! Along A's direction `n`, which B sees as `m = R_b^T R_a n`, a DOP of B reaches no farther than three of its own directions
//! allow: for `m = sum c_i n_i`, the end is at most `sum |c_i| end(sign(c_i) n_i)`. Any three will do; those of the facet that
//! `m` goes through bound it best, and have the least weight `sum |c_i| |n_i|` of all.
//!
//! **What is off, and who pays.** `u` is a rounding of single precision, `P` and `Q` bound the vectors of A and B, in A's
//! unit. Rows are rounded outwards. Coefficients are used as they are, in single precision; what they leave of `m`, `rho = m -
//! sum c_i n_i`, is computed in double precision and costs at most `|rho| Q`. Rows are no longer than `sqrt(3) Q`; a term
//! passes at most five roundings, the slack's included, and the translation one before: `6 u (sqrt(3) Q sum |c_i| + |shift|)`,
//! for which 8 is taken. A's own projections suppose `R_a^T R_a = 1`; the magnitudes of the entries of the difference, summed,
//! cost `sqrt(3) P` times that sum, of which twice is taken. What was rounded in double precision, origins and translations
//! among it, is within 32 roundings of their lengths. All of it widens B's extents; it is infinite where units differ so much
//! that single precision has no numbers for it, and nothing is told apart then.

use ocb_lanes::{Lanes, three};
use ocb_triangles::vector::{Vector, dot, rotate, transposed};
use ocb_triangles::{Frame, skew};

use super::directions::MOST;
use super::tree::{Tree, WIDTH};
use crate::Between;

/// How rows of B become rows in A's frame.
#[derive(Debug)]
pub struct Turn {
    along: [Along; MOST],
    count: usize,
    /// Squared gaps are certain to this share.
    pub sure: f32,
}

/// One direction of A.
#[derive(Clone, Copy, Debug)]
struct Along {
    coefficients: [f32; 3],
    /// Which rows make the beginning; the opposite ones make the end.
    begins: [usize; 3],
    ends: [usize; 3],
    /// Translation less and plus the slack.
    shifts: [f32; 2],
}

const NOTHING: Along = Along { coefficients: [0.0; 3], begins: [0; 3], ends: [0; 3], shifts: [0.0; 2] };

const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;
const ROOT_3: f64 = 1.732_050_807_568_877_4;

impl Turn {
    #[inline(always)]
    pub fn new<L: Lanes>(frame: &Frame, a: &Tree, b: &Tree) -> Self {
        let between = Between::new(frame, &a.local, &b.local);
        let scale = between.scale;
        let columns_b = transposed(&frame.rotation_b);
        let normals = &a.directions.normals;
        let half = normals.len();
        let (mut seen, mut shifts) = ([[0.0; 3]; MOST], [0.0; MOST]);
        for (i, normal) in normals.iter().enumerate() {
            let world = rotate(&frame.rotation_a, *normal);
            seen[i] = rotate(&columns_b, world);
            shifts[i] = dot(world, between.middles);
        }
        let chosen = choose::<L>(a, &seen);
        let skew = skew(&transposed(&frame.rotation_a));
        let (reach_a, reach_b) = (ROOT_3 * a.radius, ROOT_3 * scale * b.radius);
        let double = between.lengths + a.radius + scale * b.radius;
        let fixed = 2.0 * skew * reach_a + 32.0 * f64::EPSILON * ROOT_3 * double + TINY;
        let in_range = between.is_in_range(double) && skew < 0.01;
        let mut along = [NOTHING; MOST];
        for i in 0..half {
            let (facet, coefficients) = &chosen[i];
            let directions = a.directions.facets[*facet].normals;
            let mut rest = seen[i];
            let mut weight = 0.0;
            for (t, &direction) in directions.iter().enumerate() {
                let c = f64::from(coefficients[t]);
                rest = core::array::from_fn(|k| rest[k] - c * normals[direction][k]);
                weight += c.abs();
            }
            let left = dot(rest, rest).sqrt() * scale * b.radius;
            let slack = left + 8.0 * ROUNDING * (reach_b * weight + shifts[i].abs()) + fixed;
            let slack = if in_range { slack } else { f64::INFINITY };
            let row = |t: usize, end: bool| directions[t] + if (coefficients[t] > 0.0) == end { half } else { 0 };
            along[i] = Along {
                coefficients: coefficients.map(|c| c * scale as f32),
                begins: [0, 1, 2].map(|t| row(t, false)),
                ends: [0, 1, 2].map(|t| row(t, true)),
                shifts: [((shifts[i] - slack) as f32).next_down(), ((shifts[i] + slack) as f32).next_up()],
            };
        }
        let stretch = (1.0 + skew) * (1.0 + skew);
        Self { along, count: half, sure: ((1.0 - 1.0 / 65_536.0) / stretch) as f32 }
    }

    /// Beginnings and ends of sixteen DOPs of B, in A's directions.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, rows: &[[f32; WIDTH]], placed: &mut Placed) {
        for (i, along) in self.along[..self.count].iter().enumerate() {
            let [x, y, z] = three!(t => L::splat(along.coefficients[t]));
            let [p, q, r] = three!(t => L::load(&rows[along.begins[t]]));
            x.mul_add(p, y.mul_add(q, z.mul_add(r, L::splat(along.shifts[0])))).store(&mut placed[i]);
            let [p, q, r] = three!(t => L::load(&rows[along.ends[t]]));
            let end = &mut placed[self.count + i];
            x.mul_add(p, y.mul_add(q, z.mul_add(r, L::splat(along.shifts[1])))).store(end);
        }
    }

    /// The same for one DOP, into the first lane.
    pub fn place_one(&self, own: &[f32], placed: &mut Placed) {
        for (i, along) in self.along[..self.count].iter().enumerate() {
            for (rows, shift, at) in [(along.begins, along.shifts[0], i), (along.ends, along.shifts[1], self.count + i)]
            {
                let [x, y, z] = along.coefficients;
                placed[at][0] = x * own[rows[0]] + (y * own[rows[1]] + (z * own[rows[2]] + shift));
            }
        }
    }
}

/// Rows of B in A's directions: beginnings, then ends.
pub type Placed = [[f32; WIDTH]; 2 * MOST];

/// More than products of numbers that are too small for single precision can lose.
const TINY: f64 = 1e-34;

/// For each direction, the facet of least weight and the coefficients.
#[inline(always)]
fn choose<L: Lanes>(a: &Tree, seen: &[Vector; MOST]) -> [(usize, [f32; 3]); MOST] {
    let mut coordinates = [[0.0; 16]; 3];
    for (i, direction) in seen.iter().enumerate() {
        for axis in 0..3 {
            coordinates[axis][i] = direction[axis] as f32;
        }
    }
    let [x, y, z] = three!(axis => L::load(&coordinates[axis]));
    let zero = L::splat(0.0);
    let (mut least, mut facet, mut best) = (L::splat(f32::MAX), zero, [zero; 3]);
    for (index, other) in a.directions.facets.iter().enumerate() {
        let c = three!(t => {
            let [p, q, r] = three!(k => L::splat(other.inverse[t][k]));
            p.mul_add(x, q.mul_add(y, r * z))
        });
        let [p, q, r] = three!(t => L::splat(other.lengths[t]));
        let weight = c[0].abs().mul_add(p, c[1].abs().mul_add(q, c[2].abs() * r));
        let better = least.above(weight);
        best = three!(t => c[t].or_else(better, best[t]));
        facet = L::splat(index as f32).or_else(better, facet);
        least = weight.min(least);
    }
    let (mut facets, mut coefficients) = ([0.0; 16], [[0.0; 16]; 3]);
    facet.store(&mut facets);
    for t in 0..3 {
        best[t].store(&mut coefficients[t]);
    }
    let mut chosen = [(0, [0.0; 3]); MOST];
    for (i, chosen) in chosen.iter_mut().enumerate() {
        *chosen = (facets[i] as usize, [coefficients[0][i], coefficients[1][i], coefficients[2][i]]);
    }
    chosen
}
