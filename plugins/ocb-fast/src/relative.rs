//! B as A sees it: what all kernels of a query share.

use ocb_triangles::Frame;
use ocb_triangles::vector::{Vector, add, cross, dot, norm_1, rotate, sub};

use crate::rounding::SLACK;
use crate::tree::{Node, Tree, Vectors};
use ocb_lanes::{Lanes, Points, three};

/// The placement of B in A's tree coordinates, in single precision, and what it may be off.
#[derive(Clone, Copy, Debug)]
pub struct Relative {
    rotation: [[f32; 3]; 3],
    /// The translation for each vector of an inner node, and of a leaf: directions do not move.
    shifts: [[[f32; 16]; 3]; 2],
    /// The scale for each of them.
    scales: [[f32; 16]; 2],
    /// B's unit in A's; a power of two.
    scale: f32,
    /// A's unit in the objects' lengths.
    pub unit: f64,
    /// By how much any point of B, seen from A, may be off; see [`crate::rounding`].
    pub slack: f32,
}

/// Units that differ by more than this factor have no placement in single precision: nothing is told apart then.
const MOST_RATIO: f64 = (1u64 << 40) as f64;

impl Relative {
    pub fn new(frame: &Frame, a: &Tree, b: &Tree) -> Self {
        let (columns_a, columns_b) = (transposed(&frame.rotation_a), transposed(&frame.rotation_b));
        let rotation = columns_a.map(|a| columns_b.map(|b| dot(a, b)));
        let (origin_a, origin_b) = (rotate(&frame.rotation_a, a.origin), rotate(&frame.rotation_b, b.origin));
        let between = sub(add(frame.offset, origin_b), origin_a);
        let translation = rotate(&columns_a, between).map(|x| x / a.unit);
        let scale = b.unit / a.unit;
        let lengths = a.radius + scale * b.radius + dot(translation, translation).sqrt();
        let double = (norm_1(frame.offset) + norm_1(a.origin) + norm_1(b.origin)) / a.unit;
        let skew = skew(&columns_a) + skew(&columns_b);
        let slack = lengths * (SLACK + 8.0 * skew) + double * (16.0 * f64::EPSILON + 8.0 * skew) + TINY;
        let in_range = scale < MOST_RATIO && scale > 1.0 / MOST_RATIO && lengths < MOST_RATIO && skew < 0.01;
        Self {
            rotation: rotation.map(|row| row.map(|x| x as f32)),
            shifts: MOVES.map(|moves| translation.map(|x| moves.map(|m| m * x as f32))),
            scales: MOVES.map(|moves| moves.map(|m| m * scale as f32 + (1.0 - m))),
            scale: scale as f32,
            unit: a.unit,
            // Infinite is larger than any gap, so that all pairs are left to the exact tests.
            slack: if in_range { (slack as f32).next_up() } else { f32::INFINITY },
        }
    }

    /// The vectors of a node of B in A's frame.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, node: &Node, leaf: bool) -> Vectors {
        let scale = L::load(&self.scales[usize::from(leaf)]);
        let shifts = &self.shifts[usize::from(leaf)];
        let from: Points<L> = three!(i => L::load(&node.vectors[i]) * scale);
        let mut placed = [[0.0; 16]; 3];
        for i in 0..3 {
            let [x, y, z] = three!(j => L::splat(self.rotation[i][j]));
            x.mul_add(from[0], y.mul_add(from[1], z.mul_add(from[2], L::load(&shifts[i])))).store(&mut placed[i]);
        }
        placed
    }

    /// Half sides of boxes of B in A's unit, larger by the slack.
    #[inline(always)]
    pub fn enlarge<L: Lanes>(&self, half: L) -> L {
        half.mul_add(L::splat(self.scale), L::splat(self.slack))
    }
}

/// More than products of numbers that are too small for single precision can lose.
const TINY: f64 = 1e-34;

/// Which vectors of an inner node, and of a leaf, are points and move with B; the others are directions.
const MOVES: [[f32; 16]; 2] = [
    [1., 1., 1., 1., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0.],
    [1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 0., 0., 0.],
];

fn transposed(m: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|j| [m[0][j], m[1][j], m[2][j]])
}

/// How far the columns of a matrix are from orthonormal.
fn skew(columns: &[Vector; 3]) -> f64 {
    let [x, y, z] = *columns;
    let length = |v: Vector| (dot(v, v) - 1.0).abs();
    let handed = (dot(cross(x, y), z) - 1.0).abs();
    length(x) + length(y) + length(z) + dot(x, y).abs() + dot(y, z).abs() + dot(z, x).abs() + handed
}
