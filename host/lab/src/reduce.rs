//! No more model than a scene needs: for each object of a recording the simplest body that changes no recorded answer by more than
//! a tolerance.
//!
//! What may stand for an object: a ball, a capsule, a box, its convex hull, a few hulls, a level of detail with fewer triangles. The
//! choice is made for all objects together, because the errors of both objects of a pair add up. Every recorded query is then certified by
//! the oracle, about the objects and about what stands for them. The same is done with the last fifth of the recording left out,
//! which shows what the choice is worth for queries that it has not seen.

mod between;
mod body;
mod choose;
mod cover;
mod grown;
mod report;
mod stand_in;
mod urdf;

use std::collections::HashMap;
use std::sync::Arc;

use ocb_advice::Watch;
use ocb_core::configuration::Configuration;
use ocb_core::lod::Interval;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_core::scene::Geometry;
use ocb_core::workload::{Answered, Kind, Recorded};

use crate::model::{FRONTIER, ReduceTerms, Reduction};
use crate::recording::{About, Recording};
use crate::scene_file::SceneFile;
use crate::workload::{PairPart, parts};
use crate::{LabError, Result};
use choose::{Asked, Problem};
pub use stand_in::StandIn;
pub use urdf::{Robot, Urdf};

/// What foreign libraries make of an object.
#[derive(Clone, Debug, Default)]
pub struct Simplified {
    /// Meshes with fewer and fewer triangles.
    pub levels: Vec<Arc<Mesh>>,
    /// The convex hull; absent for a flat object.
    pub hull: Option<Arc<Mesh>>,
    /// Convex hulls of parts, the object being cut in several ways.
    pub parts: Vec<Vec<Arc<Mesh>>>,
}

/// Makes levels and hull of an object with this name; nothing when it was stopped. Nothing of what it makes is believed.
pub type Make<'a, E> = &'a dyn Fn(&str, &Arc<Mesh>) -> Result<Option<Simplified>, E>;

/// A reduced scene.
pub struct Reduced {
    /// What was replaced, and what that does to answers.
    pub reduction: Reduction,
    /// The same queries about the reduced scene, without answers.
    pub recording: Recording,
    /// What stands for each object, in the order of the scene.
    pub stand_ins: Vec<StandIn>,
    /// Other tolerances with the same queries about their bodies, where they were asked for.
    pub others: Vec<(f64, Recording)>,
}

/// Reduces the scene of a recording; nothing when it was stopped.
///
/// # Errors
/// `Invalid` for terms that make no sense and for a recording of which no query can be used, and what `make` fails with.
pub fn reduce<E: From<LabError>>(
    recording: &Recording,
    terms: ReduceTerms,
    make: Make<E>,
    watch: &dyn Watch,
) -> Result<Option<Reduced>, E> {
    let bad = |why: String| E::from(LabError::Invalid(why));
    terms.check().map_err(bad)?;
    let Some(stand_ins) = stand_ins(recording, terms, make, watch)? else { return Ok(None) };
    let (asked, left_out) = asked(recording);
    if asked.is_empty() {
        return Err(bad("None of the recorded queries can be used.".into()));
    }
    let Some(problem) = Problem::certify(asked, stand_ins, terms, watch) else { return Ok(None) };
    let (seen, later) = problem.split();
    let held_out = match later.is_empty() {
        true => None,
        false => {
            let Some(chosen) = problem.choose(&seen, terms, watch) else { return Ok(None) };
            let Some(held_out) = problem.hold(&chosen, &later, watch) else { return Ok(None) };
            Some(held_out)
        }
    };
    let Some(chosen) = problem.choose(&problem.all(), terms, watch) else { return Ok(None) };
    let reduction = report::reduction(recording, &problem, &chosen, held_out, left_out, watch)?;
    let Some(reduction) = reduction else { return Ok(None) };
    let mut others = Vec::new();
    for factor in FRONTIER.into_iter().filter(|_| terms.frontier) {
        let terms = terms.times(factor);
        let Some(chosen) = problem.choose(&problem.all(), terms, watch) else { return Ok(None) };
        others.push((terms.tolerance, reduced(recording, &problem, &chosen)));
    }
    let recording = reduced(recording, &problem, &chosen);
    let stand_ins = problem.stand_ins.into_iter().zip(chosen).map(|(mut all, at)| all.swap_remove(at)).collect();
    Ok(Some(Reduced { reduction, recording, stand_ins, others }))
}

/// Of each object itself and what may stand for it, the simplest first.
fn stand_ins<E: From<LabError>>(
    recording: &Recording,
    terms: ReduceTerms,
    make: Make<E>,
    watch: &dyn Watch,
) -> Result<Option<Vec<Vec<StandIn>>>, E> {
    let SceneFile { scene, .. } = &recording.scene;
    let mut all: Vec<Vec<StandIn>> = Vec::new();
    let mut before: HashMap<(&str, bool), usize> = HashMap::new();
    for (done, object) in scene.objects.iter().enumerate() {
        watch.step("objects", done as u64, scene.objects.len() as u64);
        // Objects with the same mesh share its work.
        if let Geometry::Mesh { sha256, solid } = &object.geometry {
            if let Some(same) = before.get(&(sha256.as_str(), *solid)) {
                all.push(all[*same].clone());
                continue;
            }
            before.insert((sha256, *solid), done);
        }
        let own = stand_in::of(&recording.scene, &object.geometry, &object.name, terms, make, watch)?;
        let Some(own) = own.filter(|_| !watch.stopped()) else { return Ok(None) };
        all.push(own);
    }
    Ok(Some(all))
}

/// The queries that can be used, and how many cannot because a pose is no rotation.
fn asked(recording: &Recording) -> (Vec<Asked>, u64) {
    let (parts, bent) = parts(&recording.queries);
    let unknown = Interval { lo: 0.0, hi: f64::INFINITY };
    let of_part = |part: PairPart| {
        let objects = part.objects;
        part.rows.into_iter().zip(part.configurations).map(move |(row, configuration)| (objects, row, configuration))
    };
    let mut asked: Vec<Asked> = parts
        .into_iter()
        .flat_map(of_part)
        .map(|(objects, row, configuration)| {
            let Recorded { kind, limit, group, .. } = recording.queries[row as usize];
            let limit = match kind {
                Kind::Distance => None,
                Kind::Tolerance => Some(limit.max(0.0)),
                Kind::Collide | Kind::Contacts => Some(0.0),
            };
            Asked { objects, configuration, limit, group, row, truth: unknown }
        })
        .collect();
    asked.sort_by_key(|asked| asked.row);
    (asked, bent)
}

/// The recording with other objects: each query places what stands for an object where the object was.
fn reduced(recording: &Recording, problem: &Problem, chosen: &[usize]) -> Recording {
    let of = |object: usize| &problem.stand_ins[object][chosen[object]];
    let mut scene = recording.scene.clone();
    scene.meshes.clear();
    for (object, at) in scene.scene.objects.iter_mut().zip(0..) {
        let stand_in = of(at);
        object.geometry = stand_in.geometry.clone();
        object.pose = within(&object.pose, &stand_in.place);
        if let (Geometry::Mesh { sha256, .. }, Some(mesh)) = (&object.geometry, &stand_in.mesh) {
            scene.meshes.insert(sha256.clone(), mesh.clone());
        }
    }
    let query = |query: &Recorded| {
        let [a, b] = query.objects.map(|object| &of(object as usize).place);
        let Configuration { pose_a, pose_b } = &query.configuration;
        let configuration = Configuration { pose_a: within(pose_a, a), pose_b: within(pose_b, b) };
        Recorded { configuration, answered: Answered::default(), seconds: None, ..*query }
    };
    let about = About { recorder: "ocb scene reduce".into(), ..recording.about.clone() };
    Recording { scene, about, queries: recording.queries.iter().map(query).collect() }
}

/// A place in the frame of an object, seen from outside; the object's own frame leaves its numbers as they are.
fn within(pose: &Pose, place: &Pose) -> Pose {
    if *place == Pose::identity() {
        return *pose;
    }
    Pose { linear: pose.linear * place.linear, translation: pose.linear * place.translation + pose.translation }
}

#[cfg(test)]
mod tests;
