//! Two boxes that are turned against each other.

use ocb_triangles::vector::{Vector, dot};

/// A box of B as seen from a box of A, along whose sides the coordinates run.
#[derive(Clone, Copy, Debug)]
pub struct Boxes<'a> {
    /// Half sides of A's box.
    pub half_a: Vector,
    /// Half sides of B's box.
    pub half_b: Vector,
    /// From the middle of A's to that of B's.
    pub between: Vector,
    /// Its columns are the axes of B's box.
    pub turn: &'a [Vector; 3],
    /// Magnitudes of `turn`.
    pub reach: &'a [Vector; 3],
}

impl Boxes<'_> {
    /// A lower bound of the distance: in the directions of either box, the gap between it and the box around the other one.
    /// The nine products of axes would cost more than they save.
    #[inline(always)]
    pub fn gap(&self) -> f64 {
        let (mut in_a, mut in_b) = (0.0, 0.0);
        for k in 0..3 {
            let gap = self.gap_along_a(k).max(0.0);
            in_a += gap * gap;
            let gap = self.gap_along_b(k).max(0.0);
            in_b += gap * gap;
        }
        f64::sqrt(if in_a > in_b { in_a } else { in_b })
    }

    /// Whether there is a gap of more than `slack` along one of fifteen axes: those of A, those of B, and the products of one
    /// of either (S. Gottschalk, M. C. Lin, D. Manocha: OBBTree, SIGGRAPH 1996). A product is shorter than 1, and its gap with
    /// it, so that the slack is more than enough.
    #[inline(always)]
    pub fn apart(&self, slack: f64) -> bool {
        if (0..3).any(|k| self.gap_along_a(k) > slack) || (0..3).any(|k| self.gap_along_b(k) > slack) {
            return true;
        }
        // All nine: fewer mispredicted branches are worth more than fewer products.
        let mut apart = false;
        for i in 0..3 {
            for j in 0..3 {
                apart |= self.gap_along_product(i, j) > slack;
            }
        }
        apart
    }

    #[inline(always)]
    fn gap_along_a(&self, i: usize) -> f64 {
        self.between[i].abs() - self.half_a[i] - dot(self.reach[i], self.half_b)
    }

    #[inline(always)]
    fn gap_along_b(&self, j: usize) -> f64 {
        let column = |m: &[Vector; 3]| [m[0][j], m[1][j], m[2][j]];
        dot(self.between, column(self.turn)).abs() - self.half_b[j] - dot(column(self.reach), self.half_a)
    }

    #[inline(always)]
    fn gap_along_product(&self, i: usize, j: usize) -> f64 {
        let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        let between = self.between[i2] * self.turn[i1][j] - self.between[i1] * self.turn[i2][j];
        let reach_a = self.half_a[i1] * self.reach[i2][j] + self.half_a[i2] * self.reach[i1][j];
        let reach_b = self.half_b[j1] * self.reach[i][j2] + self.half_b[j2] * self.reach[i][j1];
        between.abs() - reach_a - reach_b
    }
}
