//! One answer against the truth.

use crate::configuration::Placed;
use crate::oracle::Pair;
use crate::query::{Answer, Query};
use crate::record::Verdict;

/// The arithmetic an algorithm declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// f32.
    Single,
    /// f64.
    Double,
}

/// Judges one answer.
pub fn judge(pair: &Pair, placed: &Placed, query: Query, answer: &Answer, precision: Precision) -> Verdict {
    let _ = (pair, query, precision);
    match answer {
        Answer::GaveUp => Verdict::GaveUp,
        Answer::Unsupported => Verdict::Unsupported,
        Answer::Collision { hit, .. } if *hit == placed.truth.hit => Verdict::Correct,
        Answer::Collision { hit: true, .. } => Verdict::FalsePositive,
        Answer::Collision { hit: false, .. } => Verdict::FalseNegative,
        _ => Verdict::Undecidable,
    }
}
