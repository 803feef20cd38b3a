//! One answer of a stability run, against the truth and the rule of its question.

use ocb_core::configuration::{Placed, Truth};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::validation::{Precision, Terms, judge};
use ocb_stability::{Posed, Rule};

use super::ask::Got;
use crate::model::Tally;
use crate::repro;

/// What is known of the scene of a question.
pub struct Known {
    a: Shape,
    b: Shape,
    placed: Option<Placed>,
}

impl Known {
    /// The truth; none where the pose has no numbers.
    pub fn of(posed: &Posed) -> Self {
        let (a, b) = (Shape::new(posed.a.clone()), Shape::new(posed.b.clone()));
        let c = &posed.configuration;
        let finite = [c.pose_a, c.pose_b].iter().all(|pose| pose.to_row_major().iter().all(|x| x.is_finite()));
        let placed = finite.then(|| Placed {
            configuration: *c,
            truth: Pair::new(&a, &b).truth(c),
            rounded: None,
            root_index: 0,
            wanted: None,
        });
        Self { a, b, placed }
    }

    /// As the question means it.
    pub fn truth(&self, semantics: Semantics) -> Option<Truth> {
        let placed = self.placed.as_ref()?;
        Some(Pair::new(&self.a, &self.b).asked(&placed.configuration, &placed.truth, semantics))
    }

    /// Half the width of the band of a precision.
    pub fn tau(&self, precision: Precision) -> f64 {
        let tau = |placed: &Placed| Pair::new(&self.a, &self.b).tau(&placed.configuration, precision.unit_roundoff());
        self.placed.as_ref().map_or(0.0, tau)
    }

    /// Counts one answer; `earlier` is the answer that it must be equal to.
    pub fn tally(
        &self,
        got: &Got,
        query: Query,
        solid: bool,
        rule: Rule,
        precision: Precision,
        earlier: Option<&Got>,
    ) -> Tally {
        let none = Tally::default();
        let answer = match got {
            Got::Broken(_) | Got::Hung(_) => return Tally { broken: 1, ..none },
            Got::Declined(_) => return Tally { unsupported: 1, ..none },
            Got::Answer(answer, _) => answer,
        };
        if let Some(Got::Answer(earlier, _)) = earlier
            && !same(earlier, answer)
        {
            return Tally { unsteady: 1, ..none };
        }
        let Some(placed) = self.placed.as_ref().filter(|_| rule != Rule::Lasting) else {
            return Tally { agrees: 1, ..none };
        };
        let semantics = if solid { Semantics::Solid } else { Semantics::Surface };
        let pair = Pair::new(&self.a, &self.b);
        let verdict = judge(&pair, placed, Terms { query, semantics, precision }, answer).verdict;
        if let (true, Rule::Within(slack), Some(truth)) = (verdict.is_wrong(), rule, self.truth(semantics))
            && excused(answer, &truth, slack)
        {
            return Tally { agrees: 1, ..none };
        }
        match verdict {
            Verdict::Correct => Tally { agrees: 1, ..none },
            Verdict::Undecidable => Tally { agrees: 1, grazing: 1, ..none },
            Verdict::FalseNegative => Tally { misses: 1, ..none },
            Verdict::FalsePositive => Tally { false_alarms: 1, ..none },
            Verdict::DistanceOver | Verdict::DistanceUnder | Verdict::WrongWitness => Tally { distances: 1, ..none },
            Verdict::Invalid => Tally { broken: 1, ..none },
            Verdict::GaveUp | Verdict::Unsupported => Tally { unsupported: 1, ..none },
        }
    }

    /// The truth as a sentence.
    pub fn expected(&self, semantics: Semantics) -> String {
        match self.truth(semantics) {
            None => "any answer within the time limit".into(),
            Some(truth) => repro::expected(&truth),
        }
    }
}

/// Right for a scene that differs by no more than this.
fn excused(answer: &Answer, truth: &Truth, slack: f64) -> bool {
    match answer {
        Answer::Collision { hit, .. } => match hit {
            true => truth.distance_lo <= slack,
            false => truth.margin <= slack,
        },
        Answer::Contacts { .. } => truth.hit && truth.margin <= slack || truth.distance_lo <= slack,
        Answer::Distance { distance, .. } => (truth.distance_lo - slack..=truth.distance_hi + slack).contains(distance),
        Answer::GaveUp | Answer::Unsupported => true,
    }
}

/// The same to the last bit, as far as it is the answer to the question: another nearest pair is as good.
fn same(one: &Answer, other: &Answer) -> bool {
    match (one, other) {
        (Answer::Collision { hit: one, .. }, Answer::Collision { hit: other, .. }) => one == other,
        (Answer::Contacts { total: one, .. }, Answer::Contacts { total: other, .. }) => one == other,
        (Answer::Distance { distance: one, .. }, Answer::Distance { distance: other, .. }) => {
            one.to_bits() == other.to_bits()
        }
        (one, other) => one == other,
    }
}

/// An answer as a sentence.
pub fn told(got: &Got) -> String {
    match got {
        Got::Broken(why) | Got::Hung(why) => why.clone(),
        Got::Declined(why) => format!("declined: {why}"),
        Got::Answer(answer, _) => repro::answered(answer),
    }
}
