//! Finding or reading the configurations of a run, each with its certified truth, on all CPUs.

mod affordable;
mod coverage;
mod file;

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use ocb_core::configuration::{Class, Configuration, ConfigurationSet, Method, Placed, Sampling, Separation, Truth};
use ocb_core::oracle;
use ocb_core::sampling::{self, Found, Plan, SamplingError};
use rayon::prelude::*;

use crate::model::{ClassCount, RoundingEffect, RunSpec, SetInfo};
use crate::pairing::Pairing;
use crate::sha256_hex;
use crate::{LabError, Result};

pub(crate) use affordable::specks;
use coverage::Coverage;
pub use file::{ConfigurationFile, read_file, read_matrices, read_text};
pub(crate) use file::{Matrix, rotations};

/// What a set depends on beside the request. Stored sets of other versions stay readable but are not used again.
#[derive(Clone, Copy)]
struct Versions {
    sampling: u32,
    oracle: u32,
}

const VERSIONS: Versions = Versions { sampling: sampling::VERSION, oracle: oracle::VERSION };

/// What determines a set: the meshes, the method and the separation.
pub fn set_key(mesh_a: &str, mesh_b: &str, spec: &RunSpec) -> Result<String> {
    key(VERSIONS, mesh_a, mesh_b, spec)
}

fn key(Versions { sampling, oracle }: Versions, mesh_a: &str, mesh_b: &str, spec: &RunSpec) -> Result<String> {
    let determines = serde_json::to_string(&(spec.finding(), spec.separation()))
        .map_err(|e| LabError::fault("Encoding the method failed", e))?;
    // Sets from files of older versions may hold matrices that are no rotations; they are not reused.
    let rule = if matches!(spec.method, Method::File { .. }) { "|rotations" } else { "" };
    Ok(sha256_hex(format!("{sampling}|{oracle}|{mesh_a}|{mesh_b}|{determines}{rule}").as_bytes()))
}

/// How far the work is, and whether it is still wanted. Shared between the workers and whoever reports.
#[derive(Default)]
pub struct Gauge {
    /// Configurations done.
    pub done: AtomicU64,
    /// Nobody wants the rest.
    pub stop: AtomicBool,
}

/// Units of work whose configurations are a first look's, and how long the rest must take to be waited for less than that.
const BEGINNING: u64 = 300;
const LONG: Duration = Duration::from_secs(1);

/// Receives the beginning of a set whose rest takes long. Its configurations keep their numbers in the whole set.
pub type Beginning<'s> = &'s mut (dyn FnMut(&ConfigurationSet) + Send);

/// Finds the set, or certifies the given poses. `None` when it was stopped.
pub fn make(
    pairing: &Pairing,
    spec: &RunSpec,
    poses: Option<&[Configuration]>,
    gauge: &Gauge,
    beginning: Option<Beginning>,
) -> Result<Option<ConfigurationSet>> {
    let (a, b) = (&pairing.exact.a, &pairing.exact.b);
    let mut set = ConfigurationSet {
        method: spec.finding(),
        separation: spec.separation(),
        longest_side: pairing.exact.mesh_a.longest_side(),
        placed: Vec::new(),
        missed_rays: 0,
        box_side: None,
        spacing: None,
    };
    let found = if let Some(poses) = poses {
        affordable::check(a, b, poses)
            .map_err(|why| LabError::Invalid(format!("These configurations are too expensive: {why}.")))?;
        let pair = pairing.exact.pair();
        let place = |i: u64| {
            let configuration = poses[i as usize];
            let truth = pair.truth(&configuration);
            let placed = Placed { configuration, truth, rounded: None, root_index: 0, wanted: None };
            Found { placed: vec![pairing.certified(placed)], missed: 0 }
        };
        let units = from_the_beginning(poses.len() as u64, gauge, place, &set, beginning);
        Found { placed: units.into_iter().flat_map(|unit| unit.placed).collect(), missed: 0 }
    } else {
        let separation = set.separation.unwrap_or(Separation::Relative { distance: 0.0 });
        let plan = match Plan::unless_stopped(a, b, &set.method, separation, &|| gauge.stop.load(Ordering::Relaxed)) {
            Ok(plan) => plan,
            Err(SamplingError::Stopped) => return Ok(None),
            Err(e) => return Err(LabError::Invalid(format!("These configurations cannot be found: {e}."))),
        };
        (set.box_side, set.spacing) = (plan.box_side(), plan.spacing());
        // A grid is thinned at the end, and the paper's pattern begins on one side.
        let begins_evenly =
            !matches!(set.method, Method::Grid { .. } | Method::Sphere { sampling: Sampling::PaperCompat { .. }, .. });
        let beginning = beginning.filter(|_| begins_evenly);
        let place = |unit| {
            let Found { placed, missed } = plan.place(unit);
            Found { placed: placed.into_iter().map(|placed| pairing.certified(placed)).collect(), missed }
        };
        plan.gather(from_the_beginning(plan.units(), gauge, place, &set, beginning))
    };
    if gauge.stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    (set.placed, set.missed_rays) = (found.placed, found.missed);
    if set.placed.is_empty() {
        return Err(LabError::Invalid("The objects never come that close; choose another distance or step.".into()));
    }
    Ok(Some(set))
}

/// All units in their order. The first of them are shown where the others take long.
fn from_the_beginning(
    units: u64,
    gauge: &Gauge,
    place: impl Fn(u64) -> Found + Sync,
    set: &ConfigurationSet,
    beginning: Option<Beginning>,
) -> Vec<Found> {
    let Some(show) = beginning.filter(|_| units > BEGINNING) else { return on_all_cpus(0..units, gauge, place) };
    let begun = Instant::now();
    let mut all = on_all_cpus(0..BEGINNING, gauge, &place);
    if begun.elapsed() / BEGINNING as u32 * (units - BEGINNING) as u32 > LONG {
        let placed: Vec<Placed> = all.iter().flat_map(|unit| &unit.placed).copied().collect();
        if !placed.is_empty() && !gauge.stop.load(Ordering::Relaxed) {
            show(&ConfigurationSet { placed, ..set.clone() });
        }
    }
    all.extend(on_all_cpus(BEGINNING..units, gauge, place));
    all
}

fn on_all_cpus(units: Range<u64>, gauge: &Gauge, place: impl Fn(u64) -> Found + Sync) -> Vec<Found> {
    units
        .into_par_iter()
        .map(|unit| {
            if gauge.stop.load(Ordering::Relaxed) {
                return Found::default();
            }
            let found = place(unit);
            gauge.done.fetch_add(found.placed.len() as u64 + u64::from(found.missed), Ordering::Relaxed);
            found
        })
        .collect()
}

/// The numbers of a set that pages and tables show.
pub fn describe(set: &ConfigurationSet, sha256: &str, triangles: [usize; 2]) -> SetInfo {
    let classes = [Class::Clear, Class::Colliding, Class::Grazing].map(|class| ClassCount {
        class,
        count: set.placed.iter().filter(|p| p.truth.class64 == class).count() as u32,
    });
    let coverage = |of: fn(&Placed) -> u32, all: usize| Coverage::new(all, set.placed.iter().map(of));
    let coverage_a = coverage(|p| p.truth.witness.triangle_a, triangles[0]);
    let coverage_b = coverage(|p| p.truth.witness.triangle_b, triangles[1]);
    let count = |of: fn(&Placed) -> bool| set.placed.iter().filter(|p| of(p)).count() as u32;
    SetInfo {
        sha256: sha256.to_owned(),
        configurations: set.placed.len() as u32,
        missed_rays: set.missed_rays,
        longest_side: set.longest_side,
        classes: classes.into_iter().filter(|c| c.count > 0).collect(),
        exact: count(|p| p.truth.exact_used),
        further_roots: count(|p| p.root_index > 0),
        coverage_a: coverage_a.share,
        coverage_b: coverage_b.share,
        evenness_a: coverage_a.evenness,
        evenness_b: coverage_b.evenness,
        spacing: set.spacing,
        box_side: set.box_side,
        oracle: Some(ocb_core::oracle::VERSION),
        rounding: rounding_effect(&set.placed),
    }
}

/// What rounding the coordinates to single precision changes in the truths; absent where it changes no coordinate.
fn rounding_effect(placed: &[Placed]) -> Option<RoundingEffect> {
    let both: Vec<[&Truth; 2]> = placed.iter().filter_map(|p| Some([&p.truth, p.rounded.as_ref()?])).collect();
    let apart = both.iter().filter(|both| both.iter().all(|truth| !truth.hit));
    let change = |[exact, rounded]: &[&Truth; 2]| (exact.distance_hi - rounded.distance_hi).abs();
    (!both.is_empty()).then(|| RoundingEffect {
        other_answers: both.iter().filter(|[exact, rounded]| exact.hit != rounded.hit).count() as u32,
        largest_change: apart.map(change).fold(0.0, f64::max),
    })
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn the_key_changes_with_everything_that_changes_the_set() {
        let spec = |distance: f64, count: u32| -> RunSpec {
            serde_json::from_value(serde_json::json!({
                "object_a": "x", "query": "proximity", "separation": { "kind": "relative", "distance": distance },
                "method": {"kind": "sphere", "sampling": {"kind": "count", "count": count}},
            }))
            .unwrap()
        };
        let asked = |a: &str, distance, count| set_key(a, "b", &spec(distance, count)).unwrap();
        assert_eq!(asked("a", 0.0, 5), asked("a", 0.0, 5));
        let keys = HashSet::from([asked("a", 0.0, 5), asked("c", 0.0, 5), asked("a", 0.1, 5), asked("a", 0.0, 6)]);
        assert_eq!(keys.len(), 4);
        // A quick look finds the beginning of what the whole finds, and a set of that size is the same set.
        let quick = RunSpec { at_most: Some(5), ..spec(0.0, 900) };
        assert_eq!(set_key("a", "b", &quick).unwrap(), asked("a", 0.0, 5));
        assert_eq!(set_key("a", "b", &RunSpec { at_most: Some(5), ..spec(0.0, 4) }).unwrap(), asked("a", 0.0, 4));
        let versioned = |sampling, oracle| key(Versions { sampling, oracle }, "a", "b", &spec(0.0, 5)).unwrap();
        let keys =
            HashSet::from([versioned(1, 1), versioned(2, 1), versioned(1, 2), versioned(11, 1), versioned(1, 11)]);
        assert_eq!(keys.len(), 5);
    }
}
