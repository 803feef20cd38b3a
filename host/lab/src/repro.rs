//! The report of a wrong answer: the truth, and the answer that was given.

use ocb_core::configuration::Truth;
use ocb_core::query::Answer;

/// What the oracle says.
pub fn expected(truth: &Truth) -> String {
    if truth.hit {
        return format!("collision; every vertex may move by {:e}", truth.margin);
    }
    format!("no collision; distance from {:e} to {:e}", truth.distance_lo, truth.distance_hi)
}

/// An answer in the same words.
pub fn answered(answer: &Answer) -> String {
    let of = |pair: &Option<[u32; 2]>| pair.map_or_else(String::new, |[a, b]| format!(", triangles {a} and {b}"));
    match answer {
        Answer::Collision { hit: true, pair } => format!("collision{}", of(pair)),
        Answer::Collision { hit: false, .. } => "no collision".into(),
        Answer::Contacts { total, .. } => format!("{total} contacts"),
        Answer::Distance { distance, triangles, .. } => format!("distance {distance:e}{}", of(triangles)),
        Answer::GaveUp => "no decision".into(),
        Answer::Unsupported => "no support for this query".into(),
    }
}
