//! The interval in which a certified value meets what is wanted, and the place in it that a ray aims at.
//!
//! Every ray has a place of its own, so that the answers of a set are as many different numbers as there are questions: one
//! number that is right for the first is not right for the next.

use crate::configuration::Separation;
use crate::oracle::{U32, U64};

/// How far the distance may be off its place when it is not a step: tau32 as a share of S.
const BAND: f64 = 32.0 * U32;
/// How far a wanted relative distance is met, as a share of it, where that is more than the band.
const SPREAD: f64 = 0.01;
/// How far a step may be off its place, as a share of the step, where rounding leaves that much.
const OFF: f64 = 0.05;
/// Certified intervals are some ten u S wide.
const CERTAIN: f64 = 16.0 * U64;

/// A [`Separation`] that is one distance or one step, for objects of a known size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub(super) separation: Separation,
    /// L, the longest side of A's bounding box.
    longest_side: f64,
    /// Where in the window: 0 is its lower end, 1 its upper one.
    place: f64,
}

impl Window {
    pub(super) fn new(separation: Separation, longest_side: f64) -> Self {
        Self { separation, longest_side, place: 0.5 }
    }

    /// The same with another place in it.
    pub(super) fn at(self, place: f64) -> Self {
        Self { place, ..self }
    }

    /// What is aimed at in a scene of this size S, and how far it may be missed. Below 0: a depth.
    pub(super) fn aim(&self, size: f64) -> (f64, f64) {
        let ([lo, hi], off) = self.ends(size);
        (lo + off + self.place * (hi - lo - 2.0 * off), off)
    }

    /// The largest distance in the window.
    pub(super) fn most(&self, size: f64) -> f64 {
        self.ends(size).0[1]
    }

    fn ends(&self, size: f64) -> ([f64; 2], f64) {
        let band = BAND * size;
        match self.separation {
            Separation::Relative { distance } if distance > 0.0 => {
                let distance = distance * self.longest_side;
                let reach = band.max(SPREAD * distance);
                ([distance - reach, distance + reach], band)
            }
            Separation::Relative { .. } => ([2.0 * band, 4.0 * band], 2.0 * OFF * band),
            Separation::Step { of_size: x } => {
                let off = (OFF * x.abs()).max(CERTAIN.min(0.25 * x.abs()));
                ([x.min(2.0 * x) * size, x.max(2.0 * x) * size], off * size)
            }
            Separation::Ladder => unreachable!("a configuration has one step of the ladder"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_in_the_window_and_the_places_fill_it() {
        let step = |of_size| Separation::Step { of_size };
        let relative = |distance| Separation::Relative { distance };
        for (separation, ends) in [
            (relative(0.5), [0.99, 1.01]),
            (relative(0.0), [6.0 * BAND, 12.0 * BAND]),
            // Closer than single precision tells: the band decides.
            (relative(1e-4), [2e-4 - 3.0 * BAND, 2e-4 + 3.0 * BAND]),
            (step(0.01), [0.03, 0.06]),
            (step(-0.01), [-0.06, -0.03]),
            (step(64.0 * U64), [192.0 * U64, 384.0 * U64]),
        ] {
            let window = Window::new(separation, 2.0);
            let aims = [0.0, 0.25, 1.0].map(|place| window.at(place).aim(3.0));
            for (aim, off) in aims {
                let slack = 1e-12 * ends[1].abs();
                assert!(aim - off >= ends[0] - slack && aim + off <= ends[1] + slack && off > 0.0, "{separation:?}");
            }
            assert!(window.most(3.0) >= aims[2].0);
            let filled = (aims[2].0 - aims[0].0) / (ends[1] - ends[0]);
            let expected = match separation {
                Separation::Relative { distance } if distance > 0.1 => 0.4,
                Separation::Relative { distance } if distance > 0.0 => 0.0,
                _ => 0.5 - 1e-9,
            };
            assert!(filled >= expected, "{separation:?}: {filled}");
        }
    }
}
