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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Threshold {
    /// Configurations of this side that were answered.
    pub n: u32,
    /// Those answered wrongly, however narrow the decision.
    pub wrong: u32,
    /// When some are wrong: the largest distance or margin, divided by S, at which one is. When none is: the smallest
    /// that was tried, so that the resolution is at least as good as this. Absent when none was tried.
    pub at: Option<f64>,
    /// The same by powers of ten of the distance or margin, ascending; empty in results of older versions.
    #[serde(default)]
    pub decades: Vec<Decade>,
}

/// Configurations whose distance or margin, divided by S, is from `10^exponent` to ten times that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Decade {
    /// Which power of ten.
    pub exponent: i32,
    /// Configurations that were answered.
    pub n: u32,
    /// Those answered wrongly, however narrow the decision.
    pub wrong: u32,
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
        all.concluded()
    }

    /// Of both sets together.
    pub fn and(&self, other: &Self) -> Self {
        let worse = |a: Option<f64>, b: Option<f64>| a.into_iter().chain(b).reduce(f64::max);
        let distance = match (self.distance, other.distance) {
            (Some(a), Some(b)) => {
                Some(DistanceError { n: a.n + b.n, over: worse(a.over, b.over), under: worse(a.under, b.under) })
            }
            (one, another) => one.or(another),
        };
        let (false_hits, misses) = (self.false_hits.and(&other.false_hits), self.misses.and(&other.misses));
        Self { false_hits, misses, distance, ..Self::default() }.concluded()
    }

    /// eps* from both sides.
    fn concluded(mut self) -> Self {
        let sides = [&self.false_hits, &self.misses];
        self.seen = sides.iter().any(|side| side.wrong > 0);
        self.eps = sides.iter().filter(|side| !self.seen || side.wrong > 0).filter_map(|side| side.at).reduce(f64::max);
        self
    }
}

impl DistanceError {
    /// The most outside the certified interval on either side, in units of `u S`; 0 when none is.
    pub fn worst(&self) -> f64 {
        self.over.into_iter().chain(self.under).fold(0.0, f64::max)
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
        // A distance of 0 without a hit cannot be; what rounds to it belongs to the narrowest.
        let exponent = hi.max(f64::MIN_POSITIVE).log10().floor() as i32;
        self.count(Decade { exponent, n: 1, wrong: u32::from(wrong) });
    }

    fn count(&mut self, more: Decade) {
        match self.decades.binary_search_by_key(&more.exponent, |decade| decade.exponent) {
            Ok(place) => {
                self.decades[place].n += more.n;
                self.decades[place].wrong += more.wrong;
            }
            Err(place) => self.decades.insert(place, more),
        }
    }

    fn and(&self, other: &Self) -> Self {
        let at = match (self.wrong > 0, other.wrong > 0) {
            (true, false) => self.at,
            (false, true) => other.at,
            (true, true) => self.at.into_iter().chain(other.at).reduce(f64::max),
            (false, false) => self.at.into_iter().chain(other.at).reduce(f64::min),
        };
        let (n, wrong) = (self.n + other.n, self.wrong + other.wrong);
        let mut both = Self { n, wrong, at, decades: self.decades.clone() };
        other.decades.iter().for_each(|decade| both.count(*decade));
        both
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn side(all: &[(f64, bool)]) -> Threshold {
        let mut side = Threshold::default();
        all.iter().for_each(|(at, wrong)| side.add(*at, *at, *wrong));
        side
    }

    #[test]
    fn two_sets_together_are_as_one() {
        let halves = [&[(3e-4, true), (2e-2, false), (5e-5, false)][..], &[(7e-6, true), (4e-4, true), (1e-1, false)]];
        let of = |all: &[(f64, bool)]| Resolution { false_hits: side(all), ..Resolution::default() }.concluded();
        let (first, second) = (of(halves[0]), of(halves[1]));
        assert_eq!(first.and(&second), of(&halves.concat()));
        assert_eq!(first.and(&second).eps, Some(4e-4));
        let faultless = |at: f64| Resolution { misses: side(&[(at, false)]), ..Resolution::default() }.concluded();
        assert_eq!(faultless(1e-3).and(&faultless(1e-8)).eps, Some(1e-8), "finer was tried and nothing was wrong");
        assert_eq!(first.and(&faultless(1e-1)).eps, first.eps, "what is wrong counts before what is not");
    }

    #[test]
    fn decades_hold_everything_once() {
        let side = side(&[(3e-4, true), (9.9e-4, false), (1e-3, false), (0.5, false)]);
        let decade = |exponent, n, wrong| Decade { exponent, n, wrong };
        assert_eq!(side.decades, [decade(-4, 2, 1), decade(-3, 1, 0), decade(-1, 1, 0)]);
    }
}
