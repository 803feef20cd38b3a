//! How finely an algorithm tells apart from colliding: the decision resolution eps*.
//!
//! A verdict asks for a band of tolerance; this asks for none. Of all configurations that are apart, what is the largest
//! distance that the algorithm still calls a hit? Of all that cross, what is the largest margin that it still misses?
//! Both are divided by S, the size of the scene's coordinates, so that they compare across scenes: rounding alone explains
//! some 1e-16 in double precision and 1e-7 in single. And of all distances, how far is the worst outside the certified
//! interval, in units of `u S`, the size of one rounding at the algorithm's precision?

use serde::{Deserialize, Serialize};

use crate::configuration::Placed;
use crate::oracle::Pair;
use crate::query::Answer;
use crate::record::Record;
use crate::validation::Terms;

/// eps* of one algorithm on one set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Resolution {
    /// eps*: the largest distance or margin, divided by S, at which an answer is wrong. When none is, eps* is at most
    /// this: the larger of the smallest ones tried on either side. Absent when nothing was tried.
    pub eps: Option<f64>,
    /// Some answer is wrong, so that `eps` is a value and no bound.
    pub seen: bool,
    /// Configurations that are apart, by distance / S: which are called a hit?
    pub false_hits: Threshold,
    /// Configurations that cross, by margin / S: which are missed?
    pub misses: Threshold,
    /// Of a proximity query.
    pub distance: Option<DistanceError>,
}

/// One side of eps*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Threshold {
    /// Configurations of this side that were answered.
    pub n: u32,
    /// Those answered wrongly, however narrow the decision.
    pub wrong: u32,
    /// When some are wrong: the largest distance or margin, divided by S, at which one is. When none is: the smallest
    /// that was tried, so that the resolution is at least as good as this. Absent when none was tried.
    pub at: Option<f64>,
}

/// The worst errors of distances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct DistanceError {
    /// Distances that are numbers.
    pub n: u32,
    /// The most above the certified interval, in units of `u S`; absent when none is above it.
    pub over: Option<f64>,
    /// The most below it; absent when none is.
    pub under: Option<f64>,
}

impl Resolution {
    /// Of the records of one algorithm on a set.
    pub fn of(pair: &Pair, placed: &[Placed], records: &[Record], terms: Terms) -> Self {
        let mut all = Self::default();
        for record in records {
            let placed = &placed[record.configuration as usize];
            let size = pair.scene_size(&placed.configuration);
            let truth = pair.asked(&placed.configuration, &placed.truth, terms.semantics);
            let unit = terms.precision.unit_roundoff() * size;
            let (says_hit, says_apart) = match record.answer {
                Answer::Collision { hit, .. } => (hit, !hit),
                Answer::Contacts { total, .. } => (total > 0, total == 0),
                Answer::Distance { distance, .. } if distance.is_finite() && distance >= 0.0 => {
                    let error = all.distance.get_or_insert_default();
                    error.n += 1;
                    note(&mut error.over, (distance - truth.distance_hi) / unit);
                    note(&mut error.under, (truth.distance_lo - distance) / unit);
                    // Between 0 and tau a distance is an honest 0 or an honest little.
                    (distance == 0.0, distance > 32.0 * unit)
                }
                Answer::Distance { .. } | Answer::GaveUp | Answer::Unsupported => continue,
            };
            if !truth.hit {
                all.false_hits.add(truth.distance_lo / size, truth.distance_hi / size, says_hit);
            } else if truth.margin > 0.0 {
                all.misses.add(truth.margin / size, truth.margin / size, says_apart);
            }
        }
        let sides = [all.false_hits, all.misses];
        all.seen = sides.iter().any(|side| side.wrong > 0);
        all.eps = sides.iter().filter(|side| !all.seen || side.wrong > 0).filter_map(|side| side.at).reduce(f64::max);
        all
    }
}

/// Keeps the largest positive value.
fn note(worst: &mut Option<f64>, value: f64) {
    if value > worst.unwrap_or(0.0) {
        *worst = Some(value);
    }
}

impl Threshold {
    /// One configuration whose distance or margin is certainly within `[lo, hi]`.
    fn add(&mut self, lo: f64, hi: f64, wrong: bool) {
        self.n += 1;
        let better = match (wrong, self.wrong > 0) {
            (true, true) => self.at.is_none_or(|at| lo > at),
            (true, false) => true,
            (false, true) => false,
            (false, false) => self.at.is_none_or(|at| hi < at),
        };
        self.wrong += u32::from(wrong);
        if better {
            self.at = Some(if wrong { lo } else { hi });
        }
    }
}
