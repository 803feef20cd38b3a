//! Sixteen DOPs of A against one of B.

use ocb_lanes::{Bits, Lanes};

use super::tree::WIDTH;
use super::turn::Placed;

/// Of so many children, a bit each.
#[inline(always)]
pub fn first(count: usize) -> Bits {
    (1 << count) - 1
}

/// Which of sixteen DOPs overlap the one in lane `lane` of another sixteen, along all directions.
#[inline(always)]
pub fn overlap<L: Lanes>(rows: &[[f32; WIDTH]], placed: &Placed, lane: usize, live: Bits) -> Bits {
    let half = rows.len() / 2;
    let (mut before, mut behind) = (L::lanes(live), L::lanes(live));
    for i in 0..half {
        let [begin, end] = [&rows[i], &rows[half + i]];
        before = L::unless_above(before, L::splat(placed[i][lane]), L::load(end));
        behind = L::unless_above(behind, L::load(begin), L::splat(placed[half + i][lane]));
    }
    L::bits(before) & L::bits(behind)
}

/// Which of sixteen DOPs of B overlap one of A.
#[inline(always)]
pub fn overlap_one<L: Lanes>(own: &[f32], placed: &Placed, live: Bits) -> Bits {
    let half = own.len() / 2;
    let (mut before, mut behind) = (L::lanes(live), L::lanes(live));
    for i in 0..half {
        before = L::unless_above(before, L::load(&placed[i]), L::splat(own[half + i]));
        behind = L::unless_above(behind, L::splat(own[i]), L::load(&placed[half + i]));
    }
    L::bits(before) & L::bits(behind)
}

/// Squared gaps, before what is uncertain is taken off: along the three axes together, or along any other direction.
struct Gaps<L> {
    along_axes: L,
    widest: L,
}

impl<L: Lanes> Gaps<L> {
    #[inline(always)]
    fn none() -> Self {
        Self { along_axes: L::splat(0.0), widest: L::splat(0.0) }
    }

    #[inline(always)]
    fn add(&mut self, i: usize, [begin_a, end_a]: [L; 2], [begin_b, end_b]: [L; 2]) {
        let gap = (begin_b - end_a).max(begin_a - end_b).max(L::splat(0.0));
        if i < 3 {
            self.along_axes = gap.mul_add(gap, self.along_axes);
        } else {
            // The squared length of such a direction is 2 or 3; 3 is no more than right for both.
            self.widest = (gap * gap * L::splat(1.0 / 3.0)).max(self.widest);
        }
    }

    /// Never a NaN, whatever the poses are.
    #[inline(always)]
    fn squared(self, sure: f32) -> L {
        (self.along_axes.max(self.widest) * L::splat(sure)).max(L::splat(0.0))
    }
}

/// Lower bounds of the squared distances of sixteen DOPs and the one in lane `lane` of another sixteen.
#[inline(always)]
pub fn distances<L: Lanes>(rows: &[[f32; WIDTH]], placed: &Placed, lane: usize, sure: f32) -> L {
    let half = rows.len() / 2;
    let mut gaps = Gaps::<L>::none();
    for i in 0..half {
        let of_b = [L::splat(placed[i][lane]), L::splat(placed[half + i][lane])];
        gaps.add(i, [L::load(&rows[i]), L::load(&rows[half + i])], of_b);
    }
    gaps.squared(sure)
}

/// Lower bounds of the squared distances of sixteen DOPs of B and one of A.
#[inline(always)]
pub fn distances_one<L: Lanes>(own: &[f32], placed: &Placed, sure: f32) -> L {
    let half = own.len() / 2;
    let mut gaps = Gaps::<L>::none();
    for i in 0..half {
        let of_b = [L::load(&placed[i]), L::load(&placed[half + i])];
        gaps.add(i, [L::splat(own[i]), L::splat(own[half + i])], of_b);
    }
    gaps.squared(sure)
}
