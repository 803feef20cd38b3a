//! What a reduction did.

use ocb_advice::Watch;

use super::between::keep;
use super::choose::{Asked, Chosen, Problem};
use crate::model::{LaterQueries, ReducedObject, Reduction};
use crate::recording::Recording;
use crate::{LabError, Result};

/// Of the final choice, whose every query is certified again; nothing when it was stopped.
pub fn reduction(
    recording: &Recording,
    problem: &Problem,
    chosen: &Chosen,
    held_out: Option<LaterQueries>,
    left_out: u64,
    watch: &dyn Watch,
) -> Result<Option<Reduction>> {
    let terms = problem.terms();
    let mut queries = vec![0; chosen.len()];
    for asked in &problem.asked {
        let [a, b] = asked.objects;
        queries[a as usize] += 1;
        queries[b as usize] += u64::from(a != b);
    }
    let objects = recording.scene.scene.objects.iter().enumerate().map(|(at, object)| {
        let all = &problem.stand_ins[at];
        let [stand_in, own] = [&all[chosen[at]], &all[all.len() - 1]];
        ReducedObject {
            name: object.name.clone(),
            body: stand_in.kind,
            before: own.elements,
            after: stand_in.elements,
            queries: queries[at],
        }
    });
    let all: Vec<&Asked> = problem.asked.iter().collect();
    let Some(found) = problem.each(&all, watch, |asked| problem.reduced(asked, chosen)) else { return Ok(None) };
    let mut change = None;
    let (mut hits, mut grazing) = (0, 0);
    for (asked, reduced) in all.into_iter().zip(found) {
        hits += u64::from(asked.truth.hi == 0.0);
        grazing += u64::from(problem.misses(asked, reduced));
        if problem.is_unchanged(asked, chosen) {
            continue;
        }
        if !keep(&terms, asked.limit, asked.truth, reduced) {
            return Err(LabError::Fault("A reduced scene does not keep its answers.".into()));
        }
        if asked.limit.is_none() {
            let by = (reduced.hi - asked.truth.lo).max(asked.truth.hi - reduced.lo);
            change = Some(by.max(change.unwrap_or(0.0)));
        }
    }
    Ok(Some(Reduction {
        tolerance: terms.tolerance,
        near: terms.near,
        outside_only: terms.outside_only,
        objects: objects.collect(),
        queries: problem.asked.len() as u64,
        left_out,
        hits,
        grazing,
        largest_change: change,
        held_out,
    }))
}
