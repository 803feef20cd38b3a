//! Answers to what a scene asks that never rest on a level of detail that cannot know.

use ocb_advice::Question;
use ocb_core::configuration::Configuration;
use ocb_core::lod::{Answer, Interval, LodPair};
use ocb_core::oracle::Pair;

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Told {
    /// The distance is in here.
    Distance(Interval),
    /// Whether the distance is more than the clearance.
    Clear(bool),
}

/// Levels of detail that are asked one after the other, the whole objects last.
#[derive(Clone, Debug)]
pub struct Hybrid<'a> {
    /// The coarsest first.
    pub stages: Vec<LodPair<'a>>,
    /// Both objects themselves.
    pub whole: LodPair<'a>,
    /// The same for the oracle, which answers what f64 cannot.
    pub oracle: Pair<'a>,
}

impl Hybrid<'_> {
    /// The answer, and whether the whole objects had to be asked.
    pub fn answer(&self, question: Question, configuration: &Configuration) -> (Told, bool) {
        match question {
            Question::Distance { tolerance } => {
                let narrow = |found: &Interval| found.width() <= 2.0 * tolerance;
                let ask = |levels: &LodPair| levels.distance(configuration, 2.0 * tolerance);
                if let Some(found) = self.stages.iter().map(ask).find(narrow) {
                    return (Told::Distance(found), false);
                }
                let found = Some(ask(&self.whole)).filter(narrow).unwrap_or_else(|| {
                    let truth = self.oracle.truth(configuration);
                    Interval { lo: truth.distance_lo, hi: truth.distance_hi }
                });
                (Told::Distance(found), true)
            }
            Question::Clearance { clearance } => {
                let decide = |levels: &LodPair| match levels.clearance(configuration, clearance) {
                    Answer::Clear => Some(true),
                    Answer::Closer => Some(false),
                    Answer::Undecided => None,
                };
                if let Some(clear) = self.stages.iter().find_map(decide) {
                    return (Told::Clear(clear), false);
                }
                let clear = decide(&self.whole).unwrap_or_else(|| is_clear(&self.oracle, configuration, clearance));
                (Told::Clear(clear), true)
            }
        }
    }
}

/// The oracle's answer. Where even the neighbouring f64 numbers of its exact arithmetic are on both sides of the
/// clearance, the objects count as closer: a collision that is missed is the worst error.
fn is_clear(oracle: &Pair, configuration: &Configuration, clearance: f64) -> bool {
    let truth = oracle.truth(configuration);
    let certain = truth.distance_lo > clearance || truth.distance_hi <= clearance;
    let truth = if certain { truth } else { oracle.tightest_truth(configuration) };
    !truth.hit && truth.distance_lo > clearance
}
