//! Which of the reported failures does a method have?

use ocb_core::query::{Query, Semantics};
use ocb_stability::{Rule, corpus};

use super::ask::Asker;
use super::judge::{Known, told};
use crate::Result;
use crate::model::{CellState, FailureResult, Tally};

/// Asks each, both ways round where the algorithm offers it.
pub fn failures(asker: &mut Asker) -> Result<Vec<FailureResult>> {
    corpus::all().iter().map(|reported| one(asker, reported)).collect()
}

fn one(asker: &mut Asker, reported: &corpus::Reported) -> Result<FailureResult> {
    let Ok(posed) = reported.posed() else {
        let (expected, got) = (String::new(), "refused by the host".to_owned());
        return Ok(FailureResult { id: reported.id.clone(), state: CellState::Refused, expected, got });
    };
    let known = Known::of(&posed);
    let queries = [Query::CollisionFirst, Query::Proximity].into_iter();
    let queries: Vec<_> = queries.filter(|query| asker.offers(*query, Semantics::Surface)).collect();
    let questions: Vec<_> = queries.iter().map(|query| (*query, posed.configuration)).collect();
    let (mut tally, mut said) = (Tally::default(), Vec::new());
    for (query, got) in queries.iter().zip(asker.ask(&posed.a, &posed.b, Semantics::Surface, &questions)?) {
        tally.add(&known.tally(&got, *query, false, Rule::Judged, asker.precision, None));
        said.push(told(&got));
    }
    let expected = known.expected(Semantics::Surface);
    Ok(FailureResult { id: reported.id.clone(), state: tally.state(), expected, got: said.join("; ") })
}
