//! The one place where a request for a run is checked, for API and command line alike.

use std::sync::Arc;

use ocb_core::configuration::{Method, Separation};
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling;
use ocb_lab::algorithm::Algorithm;

use crate::blobs::Blobs;
use crate::configurations;
use crate::model::{AlgorithmInfo, ObjectInfo, RunSpec};
use crate::objects::Objects;
use crate::plugins::registry::Registry;
use crate::runs::sql::RunRow;
use crate::store::Store;
use crate::{EngineError, Result};

/// Timed passes at most: more shows nothing new and only takes the machine from others.
const MAX_PASSES: u32 = 99;
/// With fewer processes hardly any comparison can be settled.
const MIN_PASSES: u32 = 3;
/// Measuring time per algorithm at most: a day.
const MAX_BUDGET_SECONDS: f64 = 86_400.0;

/// A request that can be carried out.
pub struct Checked {
    /// With canonical ids and all algorithms named.
    pub spec: RunSpec,
    /// Object A.
    pub object_a: ObjectInfo,
    /// Object B.
    pub object_b: ObjectInfo,
    /// The algorithms in the order of the spec.
    pub algorithms: Vec<Arc<Algorithm>>,
    /// Number of configurations (rays, before any is missed).
    pub configurations: u64,
}

/// Seeds are below this, so that a reader with 64-bit floating-point numbers keeps them.
const MAX_SEED: u64 = 1 << 53;

/// Checks everything that can be known before any work.
pub async fn check(
    spec: &RunSpec,
    objects: &Objects,
    registry: &Registry,
    store: &Store,
    blobs: &Blobs,
    viewer: Option<&str>,
) -> Result<Checked> {
    let invalid = |sentence: String| Err(EngineError::Invalid(sentence));
    if !(1..=MAX_PASSES).contains(&spec.passes) {
        return invalid(format!("The number of passes must be from 1 to {MAX_PASSES}, not {}.", spec.passes));
    }
    if !(spec.budget_seconds > 0.0 && spec.budget_seconds <= MAX_BUDGET_SECONDS) {
        return invalid(format!(
            "The measuring time per algorithm must be more than 0 and at most {MAX_BUDGET_SECONDS} seconds, not {}.",
            spec.budget_seconds
        ));
    }
    if spec.seed.is_some_and(|seed| seed >= MAX_SEED) {
        return invalid(
            "The seed must be a whole number below 2^53 (9007199254740992); leave it out for a random seed.".into(),
        );
    }
    let configurations = set_size(spec, store, blobs).await?;
    let algorithms = algorithms(spec, registry, viewer).await?;
    let object_a = objects.info_for(&spec.object_a, viewer).await?;
    let object_b = match &spec.object_b {
        Some(id) => objects.info_for(id, viewer).await?,
        None => object_a.clone(),
    };
    if spec.semantics == Semantics::Solid {
        check_solid(&[&object_a, &object_b])?;
    }
    let flat = [&object_a, &object_b].iter().any(|object| object.rounding.is_some_and(|rounding| rounding.flattens));
    let single = algorithms.iter().find(|c| flat && c.info.single_precision);
    if let Some(algorithm) = single.filter(|_| names_algorithms(spec)) {
        return Err(flattened(&algorithm.info.id));
    }
    let algorithms: Vec<_> = algorithms.into_iter().filter(|c| !(flat && c.info.single_precision)).collect();
    if algorithms.is_empty() {
        return invalid(
            "Every algorithm that answers this computes in single precision, which flattens an object.".into(),
        );
    }
    check_partial(spec, algorithms.len())?;
    let mut spec = spec.clone();
    spec.object_a = object_a.id.clone();
    spec.object_b = Some(object_b.id.clone()).filter(|id| *id != object_a.id);
    spec.algorithms = algorithms.iter().map(|c| c.info.id.clone()).collect();
    Ok(Checked { spec, object_a, object_b, algorithms, configurations })
}

/// Are there algorithms asked for by name, rather than those that fit?
fn names_algorithms(spec: &RunSpec) -> bool {
    !spec.algorithms.is_empty() && spec.algorithms != [ALL]
}

/// An algorithm in single precision cannot be asked about such an object.
pub fn flattened(algorithm: &str) -> EngineError {
    EngineError::Invalid(format!(
        "{algorithm:?} computes in single precision, in which an object of this run has no triangle with area (it is small \
         and far from the origin); leave out the algorithm, or move the object to the origin."
    ))
}

/// Can a part of the configurations tell what is asked?
fn check_partial(spec: &RunSpec, algorithms: usize) -> Result<()> {
    let why_not = match (spec.precision, spec.at_most) {
        (Some(precision), _) if !(precision > 0.0 && precision < 1.0) => {
            format!("The precision must be more than 0 and less than 1 (0.05 is 5 %), not {precision}.")
        }
        (_, Some(0)) => "A quick look needs at least 1 configuration.".into(),
        (None, None) => return Ok(()),
        _ if matches!(spec.method, Method::Trajectory { .. }) => {
            "A trajectory is measured as a whole, because its order matters; leave out the precision and the quick \
             look."
                .into()
        }
        (Some(_), _) if algorithms < 2 => {
            "A precision requires a comparison; choose at least two algorithms, or leave it out.".into()
        }
        (Some(_), _) if spec.passes < MIN_PASSES => {
            format!("A precision requires several passes; choose at least {MIN_PASSES}, or leave out the precision.")
        }
        _ => return Ok(()),
    };
    Err(EngineError::Invalid(why_not))
}

/// Only a closed surface has an inside.
fn check_solid(objects: &[&ObjectInfo]) -> Result<()> {
    match objects.iter().find(|object| !object.closed) {
        Some(open) => Err(EngineError::Invalid(format!(
            "Solid bodies need closed objects, and {:?} is open (an edge of it does not belong to two triangles); \
             choose a closed object, or surfaces.",
            open.name
        ))),
        None => Ok(()),
    }
}

/// Checks what a request says about its configurations; the number of those to be found, before any is missed.
pub async fn set_size(spec: &RunSpec, store: &Store, blobs: &Blobs) -> Result<u64> {
    let invalid = |sentence: &str| Err(EngineError::Invalid(sentence.into()));
    if spec.separation().is_none() && !matches!(spec.separation, Separation::Relative { .. }) {
        return invalid("Steps and the ladder require the sphere or the grid method.");
    }
    sampling::check_separation(spec.separation)
        .map_err(|e| EngineError::Invalid(format!("These configurations are not possible: {e}.")))?;
    if let Method::File { sha256 } = &spec.method {
        // A stored file of another kind sounds like none: nobody learns which files others have stored.
        let none =
            || EngineError::Invalid(format!("There is no stored file of configurations {sha256:?}; add it first."));
        if store.blob_bytes(sha256).await?.is_none() {
            return Err(none());
        }
        let read = configurations::read_file(&blobs.get(sha256).await?);
        return Ok(read.map_err(|_| none())?.poses.len() as u64);
    }
    sampling::count(&spec.method)
        .and_then(|_| sampling::count(&spec.finding()))
        .map_err(|e| EngineError::Invalid(format!("These configurations are not possible: {e}.")))
}

/// Instead of names: every algorithm that answers the question.
const ALL: &str = "all";

/// The named algorithms, each once; without names the usual ones that answer the question.
async fn algorithms(spec: &RunSpec, registry: &Registry, viewer: Option<&str>) -> Result<Vec<Arc<Algorithm>>> {
    if spec.semantics == Semantics::Solid && spec.query == Query::CollisionAll {
        return Err(EngineError::Invalid(
            "All contacts are pairs of intersecting triangles, and an object inside another one has none; for solid \
             bodies, choose first contact or distance."
                .into(),
        ));
    }
    let question = question_name(spec.query, spec.semantics);
    let known = registry.algorithms(viewer);
    let fitting: Vec<&str> = known.iter().filter(|a| answers(a, spec)).map(|a| a.id.as_str()).collect();
    let mut names: Vec<&str> = spec.algorithms.iter().map(String::as_str).collect();
    if names == [ALL] {
        names.clone_from(&fitting);
    } else if names.is_empty() {
        names.extend(known.iter().filter(|a| a.usual && answers(a, spec)).map(|a| a.id.as_str()));
    }
    if names.is_empty() {
        return Err(EngineError::Invalid(format!("No installed algorithm answers {question}.")));
    }
    let mut chosen: Vec<(&str, Arc<Algorithm>)> = Vec::new();
    for name in names {
        let there_are = || fitting.join(", ");
        let algorithm = registry.choose(name, viewer)?.ok_or_else(|| {
            EngineError::Invalid(format!("There is no algorithm {name:?}; available for {question}: {}.", there_are()))
        })?;
        // With its settings it may answer less than without.
        if !answers(&algorithm.info, spec) || !registry.queries(&algorithm).await?.contains(&spec.query) {
            return Err(EngineError::Invalid(format!(
                "The algorithm {name:?} does not answer {question}; these do: {}.",
                there_are()
            )));
        }
        match chosen.iter().find(|(_, c)| c.info.id == algorithm.info.id) {
            Some((other, _)) if *other != name => {
                return Err(EngineError::Invalid(format!(
                    "{other:?} and {name:?} are the same algorithm: a setting at its default value makes no \
                     difference. List it once."
                )));
            }
            Some(_) => {}
            None => chosen.push((name, algorithm)),
        }
    }
    Ok(chosen.into_iter().map(|(_, algorithm)| algorithm).collect())
}

/// Our own algorithms that others are compared with, in the order of preference.
const REFERENCES: [&str; 2] = ["box-tree", "brute-force"];

/// The reference of a run: the first that answers its question and was built from our own sources.
pub fn reference(spec: &RunSpec, registry: &Registry) -> Option<Arc<Algorithm>> {
    let known = REFERENCES.iter().filter_map(|id| registry.algorithm(id));
    known.into_iter().find(|c| c.trusted && answers(&c.info, spec))
}

impl Registry {
    /// The algorithms of a run. They may have changed since it was asked for, by a restart with other plugins.
    pub fn algorithms_of(&self, row: &RunRow) -> Result<Vec<Arc<Algorithm>>> {
        let find = |id: &String| {
            self.choose(id, row.owner.as_deref())?.ok_or_else(|| {
                EngineError::Invalid(format!(
                    "The algorithm {id:?} is no longer installed; start the run again without it."
                ))
            })
        };
        row.spec.algorithms.iter().map(find).collect()
    }
}

fn answers(algorithm: &AlgorithmInfo, spec: &RunSpec) -> bool {
    algorithm.queries.contains(&spec.query) && (spec.semantics == Semantics::Surface || algorithm.solid)
}

fn question_name(query: Query, semantics: Semantics) -> String {
    let query = match query {
        Query::CollisionFirst => "the collision query (first contact)",
        Query::CollisionAll => "the collision query (all contacts)",
        Query::Proximity => "the proximity query",
    };
    let of = match semantics {
        Semantics::Surface => "",
        Semantics::Solid => " of solid bodies",
    };
    format!("{query}{of}")
}
