//! Answers that are none. The sandbox passes numbers on as they are; what they are worth, the oracle says.

use ocb_core::record::Verdict::{Correct, DistanceOver, DistanceUnder, Invalid, WrongWitness};

use crate::Attack;
use crate::Expected::{self, Judged};
use crate::Form::Distances;

/// A distance in place of the right one.
macro_rules! instead {
    ($title:literal, $define:expr, $verdict:expr) => {
        attack!("I6", concat!("answer ", $title), "nothing_more" ["WIDTH=1", $define], Distances, $verdict)
    };
}

const INVALID: Expected = Judged(&[Invalid, Invalid]);
const UNDER: Expected = Judged(&[DistanceUnder, DistanceUnder]);

pub const ALL: &[Attack] = &[
    instead!("the truth, for comparison", "TRUTH", Judged(&[Correct, Correct])),
    instead!("NaN", "DISTANCE=NAN", INVALID),
    instead!("infinity", "DISTANCE=INFINITY", INVALID),
    instead!("minus infinity", "DISTANCE=-INFINITY", INVALID),
    instead!("a denormal number", "DISTANCE=5e-324", UNDER),
    instead!("minus zero", "DISTANCE=-0.0", UNDER),
    instead!("1e308", "DISTANCE=1e308", Judged(&[DistanceOver, DistanceOver])),
    instead!("nothing at all", "UNSET", UNDER),
    instead!("the right distance at a point that is no number", "POINT=NAN", INVALID),
    instead!("the right distance at a point far away", "POINT=1e300", Judged(&[WrongWitness, WrongWitness])),
    attack!(
        "I7",
        "repeat the previous answer",
        "nothing_more" ["WIDTH=1", "COPY_PREVIOUS"],
        Distances,
        Judged(&[Correct, DistanceUnder])
    ),
];
