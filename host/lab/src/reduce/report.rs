//! What a reduction did, as it is written to files.

use ocb_advice::{Share, Watch};
use serde::Serialize;

use super::choose::{Asked, Chosen, Problem};
use super::stand_in::BodyKind;
use crate::recording::Recording;
use crate::{LabError, Result};

/// A reduced scene, certified for each recorded query.
#[derive(Clone, Debug, Serialize)]
pub struct Reduction {
    /// Largest change of a distance, in the unit of the scene; a yes-or-no answer is right for such a distance.
    pub tolerance: f64,
    /// The same holds where one object, with what stands for it, is moved relative to the other by less than this.
    pub near: f64,
    /// Does everything contain the object that it stands for?
    pub outside_only: bool,
    /// The objects, in the order of the scene.
    pub objects: Vec<ReducedObject>,
    /// Recorded queries that were certified, about the objects and about what stands for them.
    pub queries: u64,
    /// Queries that were left out because a pose is no rotation.
    pub left_out: u64,
    /// Queries in which the objects certainly collide.
    pub hits: u64,
    /// Those of them in which what stands for the objects is apart, by less than the tolerance.
    pub grazing: u64,
    /// The largest change of a distance that was asked for, as far as it is certain; absent where none was asked.
    pub largest_change: Option<f64>,
    /// The choice without the last fifth of the recording, asked about that fifth; absent for very short recordings.
    pub held_out: Option<HeldOut>,
}

/// What stands for an object.
#[derive(Clone, Debug, Serialize)]
pub struct ReducedObject {
    /// Its name.
    pub name: String,
    /// What stands for it.
    pub body: BodyKind,
    /// Elements of the object: triangles; 1 for a ball, 2 for a capsule, 6 for a box or a cylinder.
    pub before: u64,
    /// Elements of what stands for it.
    pub after: u64,
    /// Queries about it.
    pub queries: u64,
}

/// Later queries, which the choice had not seen.
#[derive(Clone, Debug, Serialize)]
pub struct HeldOut {
    /// How many.
    pub queries: u64,
    /// Those whose answer changed by more than the tolerance.
    pub changed: Share,
    /// Those of them in which a certain collision was missed.
    pub missed: u64,
    /// The worst of them.
    pub examples: Vec<Changed>,
}

/// A query whose answer changed by more than the tolerance.
#[derive(Clone, Debug, Serialize)]
pub struct Changed {
    /// Its place in the recording, from 0.
    pub row: u32,
    /// The objects.
    pub objects: [u32; 2],
    /// Their distance is in here.
    pub distance: [f64; 2],
    /// The distance of what stands for them is in here.
    pub reduced: [f64; 2],
    /// A certain collision was missed.
    pub missed: bool,
}

impl Changed {
    /// By how much the distance changed at most.
    pub fn off(&self) -> f64 {
        (self.reduced[1] - self.distance[0]).max(self.distance[1] - self.reduced[0])
    }
}

/// Of the final choice, whose every query is certified again; nothing when it was stopped.
pub fn reduction(
    recording: &Recording,
    problem: &Problem,
    chosen: &Chosen,
    held_out: Option<HeldOut>,
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
        if !terms.keep(asked.limit, asked.truth, reduced) {
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
