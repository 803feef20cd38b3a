//! Pairs of triangles on their way to a closer look, gathered until they fill the lanes.

use ocb_lanes::Lanes;

use super::faces::Faces;
use super::tree::{FOUR, Vectors};

/// Up to sixteen pairs of triangles, those of B placed in A's frame.
#[derive(Debug, Default)]
#[repr(align(64))]
pub struct Waiting {
    of_a: [[[f32; 16]; 3]; 3],
    of_b: [[[f32; 16]; 3]; 3],
    /// Whose they are.
    pub ids: [[u32; 2]; 16],
    /// How many.
    pub count: usize,
}

impl Waiting {
    /// Puts in triangle `i` of a leaf of A and triangle `j` of a placed leaf of B; there must be room.
    #[inline(always)]
    pub fn push(&mut self, [leaf_a, leaf_b]: [&Vectors; 2], [i, j]: [usize; 2], ids: [u32; 2]) {
        let lane = self.count % 16;
        for axis in 0..3 {
            for corner in 0..3 {
                self.of_a[corner][axis][lane] = leaf_a[axis][FOUR * corner + i];
                self.of_b[corner][axis][lane] = leaf_b[axis][FOUR * corner + j];
            }
        }
        self.ids[lane] = ids;
        self.count += 1;
    }

    #[inline(always)]
    pub fn is_full(&self) -> bool {
        self.count == 16
    }

    #[inline(always)]
    pub fn faces<L: Lanes>(&self) -> (Faces<L>, Faces<L>) {
        (Faces::load(&self.of_a), Faces::load(&self.of_b))
    }
}
