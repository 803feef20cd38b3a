//! What the recorded program was answered, against the truth.

use ocb_core::configuration::Containment;
use ocb_core::oracle::U64;
use ocb_core::workload::{Bracket, Claim};

use super::Certified;
use super::shapes::Solid;
use crate::model::{ClaimCount, FalseAnswer, RecordedAnswers};
use crate::recording::Recording;

/// False answers that are listed.
const LISTED: usize = 100;

/// The recorded answers that were judged so far.
pub struct Truths<'a> {
    recording: &'a Recording,
    /// Of each query: do the objects certainly collide, as surfaces? Nothing for those that are not replayed.
    pub hits: Vec<Option<bool>>,
    /// Of each query: the triangle of each of its objects, in their order there, where these collide or are closest.
    pub triangles: Vec<Option<[u32; 2]>>,
    counts: [u64; Claim::NAMES.len()],
    largest_error: f64,
    false_answers: Vec<FalseAnswer>,
}

impl<'a> Truths<'a> {
    /// Nothing judged yet.
    pub fn new(recording: &'a Recording) -> Self {
        Self {
            recording,
            hits: vec![None; recording.queries.len()],
            triangles: vec![None; recording.queries.len()],
            counts: Default::default(),
            largest_error: 0.0,
            false_answers: Vec::new(),
        }
    }

    /// Judges the answers to the queries of a part.
    pub fn judge(&mut self, certified: &Certified, objects: [u32; 2], solids: &[Solid]) {
        let solid = objects.map(|place| solids[place as usize].inner.is_some());
        let pair = certified.pairing.exact.pair();
        for (i, (&row, placed)) in certified.rows.iter().zip(&certified.set.placed).enumerate() {
            self.hits[row as usize] = Some(placed.truth.hit);
            let recorded = &self.recording.queries[row as usize];
            let [first, second] = [placed.truth.witness.triangle_a, placed.truth.witness.triangle_b];
            let swapped = recorded.objects != objects;
            self.triangles[row as usize] = Some(if swapped { [second, first] } else { [first, second] });
            let (outer, tau) = (placed.truth, pair.tau(&placed.configuration, U64));
            let inner = certified.inner.as_ref().map_or(outer, |inner| inner[i]);
            let bracket = Bracket { outer, inner, solid, tau };
            let Some((claim, error)) = bracket.judge(recorded.kind, recorded.limit, recorded.answered) else {
                continue;
            };
            self.counts[claim as usize] += 1;
            self.largest_error = self.largest_error.max(error);
            if claim.is_wrong() {
                let inside = !matches!(outer.containment, None | Some(Containment::Apart));
                let lo = if inside { 0.0 } else { outer.distance_lo };
                self.false_answers.push(FalseAnswer {
                    sequence: recorded.sequence,
                    objects: recorded.objects,
                    claim,
                    answered: recorded.answered.distance,
                    distance: [lo, inner.distance_hi.max(lo)],
                });
            }
        }
        // So that a recording full of false answers does not fill the memory.
        if self.false_answers.len() > 100 * LISTED {
            self.shorten();
        }
    }

    fn shorten(&mut self) {
        self.false_answers.sort_by_key(|answer| (answer.claim, answer.sequence));
        self.false_answers.truncate(LISTED);
    }

    /// All of them.
    pub fn answers(mut self) -> RecordedAnswers {
        self.shorten();
        let counted = Claim::NAMES.into_iter().zip(self.counts).filter(|(_, count)| *count > 0);
        let seconds = self.recording.queries.iter().map(|query| query.seconds);
        RecordedAnswers {
            claims: counted.map(|((claim, _), count)| ClaimCount { claim, count }).collect(),
            largest_error: self.largest_error,
            false_answers: self.false_answers,
            seconds: seconds.sum(),
        }
    }
}
