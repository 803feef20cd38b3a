//! B as A sees it: what all kernels of a query share.

use ocb_triangles::vector::{self, norm_1, rotate, transposed};
use ocb_triangles::{Frame, skew};

use super::rounding::SLACK;
use super::tree::{Node, Tree, Vectors};
use ocb_lanes::{Lanes, Numbers, Points, dot, three};

use crate::Between;

/// The placement of B in A's tree coordinates, in single precision, and what it may be off.

#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Relative {
    rotation: [[f32; 3]; 3],
    /// The translation for each vector of an inner node, and of a leaf: directions do not move.
    shifts: [[[f32; 16]; 3]; 2],
    /// The scale for each of them.
    scales: [[f32; 16]; 2],
    /// B's unit in A's; a power of two.
    scale: f32,
    /// By how much any point of B, seen from A, may be off; see [`super::rounding`].
    pub slack: f32,
}

impl Relative {
    #[inline(always)]
    pub fn new<L: Lanes>(frame: &Frame, a: &Tree, b: &Tree) -> Self {
        let (columns_a, columns_b) = (transposed(&frame.rotation_a), transposed(&frame.rotation_b));
        let rotation = three!(i => three!(j => vector::dot(columns_a[i], columns_b[j]) as f32));
        let between = Between::new(frame, &a.local, &b.local);
        let translation = rotate(&columns_a, between.middles);
        let scale = between.scale;
        let lengths = a.radius + scale * b.radius + norm_1(translation);
        let skew = skew(&columns_a) + skew(&columns_b);
        let slack = lengths * (SLACK + 8.0 * skew) + between.lengths * (16.0 * f64::EPSILON + 8.0 * skew) + TINY;
        let in_range = between.is_in_range(lengths) && skew < 0.01;
        let (mut shifts, mut scales) = ([[[0.0; 16]; 3]; 2], [[0.0; 16]; 2]);
        for leaf in 0..2 {
            let moves = L::load(&MOVES[leaf]);
            for i in 0..3 {
                (moves * L::splat(translation[i] as f32)).store(&mut shifts[leaf][i]);
            }
            (moves * L::splat(scale as f32) + (L::splat(1.0) - moves)).store(&mut scales[leaf]);
        }
        Self {
            rotation,
            shifts,
            scales,
            scale: scale as f32,
            // Infinite is larger than any gap, so that all pairs are left to the exact tests.
            slack: if in_range { (slack as f32).next_up() } else { f32::INFINITY },
        }
    }

    /// The vectors of a node of B in A's frame.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, node: &Node, leaf: bool) -> Points<L> {
        let scale = L::load(&self.scales[usize::from(leaf)]);
        let shifts = &self.shifts[usize::from(leaf)];
        let from: Points<L> = three!(i => L::load(&node.vectors[i]) * scale);
        three!(i => {
            let [x, y, z] = three!(j => L::splat(self.rotation[i][j]));
            x.mul_add(from[0], y.mul_add(from[1], z.mul_add(from[2], L::load(&shifts[i]))))
        })
    }

    /// Points of B in A's frame.
    #[inline(always)]
    pub fn place_points<N: Numbers>(&self, points: &Points<N>) -> Points<N> {
        let turned = self.turn(points);
        three!(i => turned[i].mul_add(N::splat(self.scale), N::splat(self.shifts[0][i][0])))
    }

    /// Directions of B in A's frame.
    #[inline(always)]
    pub fn turn<N: Numbers>(&self, directions: &Points<N>) -> Points<N> {
        three!(i => dot(&three!(j => N::splat(self.rotation[i][j])), directions))
    }

    /// Half sides of boxes of B in A's unit, larger by the slack.
    #[inline(always)]
    pub fn enlarge<L: Numbers>(&self, half: L) -> L {
        half.mul_add(L::splat(self.scale), L::splat(self.slack))
    }
}

/// Vectors into memory.
#[inline(always)]
pub fn stored<L: Lanes>(placed: &Points<L>) -> Vectors {
    let mut vectors = [[0.0; 16]; 3];
    for i in 0..3 {
        placed[i].store(&mut vectors[i]);
    }
    vectors
}

/// More than products of numbers that are too small for single precision can lose.
const TINY: f64 = 1e-34;

/// Which vectors of an inner node, and of a leaf, are points and move with B; the others are directions.
const MOVES: [[f32; 16]; 2] = [
    [1., 1., 1., 1., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0.],
    [1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 0., 0., 0.],
];
