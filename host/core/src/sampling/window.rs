//! The interval in which a certified value meets what is wanted.

use crate::configuration::Separation;
use crate::oracle::U32;

/// How far the distance may be off when it is not a step: tau32 as a share of S.
const BAND: f64 = 32.0 * U32;

/// A [`Separation`] that is one distance or one step, for objects of a known size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub(super) separation: Separation,
    /// L, the longest side of A's bounding box.
    longest_side: f64,
}

impl Window {
    pub(super) fn new(separation: Separation, longest_side: f64) -> Self {
        Self { separation, longest_side }
    }

    /// Middle and half-width of the window in a scene of this size S. Below 0: a depth.
    pub(super) fn middle(&self, size: f64) -> (f64, f64) {
        match self.separation {
            Separation::Relative { distance } if distance > 0.0 => (distance * self.longest_side, BAND * size),
            Separation::Relative { .. } => (3.0 * BAND * size, BAND * size),
            Separation::Step { of_size } => (1.5 * of_size * size, 0.5 * of_size.abs() * size),
            Separation::Ladder => unreachable!("a configuration has one step of the ladder"),
        }
    }

    /// The largest distance in the window.
    pub(super) fn most(&self, size: f64) -> f64 {
        let (middle, half) = self.middle(size);
        middle + half
    }
}
