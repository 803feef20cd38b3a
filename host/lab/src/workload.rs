//! Replaying a recording: every query that a program asked is put to every algorithm that answers its kind, in the jail, and
//! judged by the oracle; so are the answers that the program got.
//!
//! Queries are replayed by pair of objects, because a process of a plugin holds one pair; those that can hold a whole scene are
//! asked so as well, as an order of its own (`scene.rs`): caches are warm otherwise there, so times of both are not comparable.
//! Algorithms know triangles only; a primitive is given to them as a polyhedron around it.

mod heatmap;
mod parts;
mod posed;
mod recorded;
mod scene;
mod shapes;
mod stretch;
mod table;
mod tally;
mod timeline;
mod whole;

use std::collections::HashSet;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use ocb_core::configuration::{ConfigurationSet, Method, Placed};
use ocb_core::query::Semantics;

use crate::algorithm::{Algorithm, Runner};
use crate::configurations::{Gauge, specks};
use crate::machine::Machine;
use crate::measure::{self, Part, Stop, Task};
use crate::model::{LeftOut, Track, TrackResult, WorkloadResult, order_gains};
use crate::pairing::Pairing;
use crate::recording::Recording;
use crate::truth::on_all_cpus;
use crate::{LabError, Result};
pub use heatmap::{HeatmapFile, HeatmapFormat, object_heatmap};
pub(crate) use parts::{Part as PairPart, parts};
pub use posed::{mesh_of, posed_group, posed_scene};
use recorded::Truths;
use scene::Scene;
use shapes::{Solid, solids};
pub use stretch::stretch;
pub use table::{WorkloadRow, workload_parquet};
use tally::{Answered, Tally};
use timeline::Parts;
pub use whole::{Asked, Far, Found, Site};

/// A part gets this time at least, however few queries it has.
const LEAST: Duration = Duration::from_secs(1);

/// How a recording is replayed.
pub struct Wanted<'a> {
    /// The algorithms.
    pub algorithms: &'a [Arc<Algorithm>],
    /// The orders.
    pub tracks: &'a [Track],
    /// Processes per algorithm, order and pair of objects.
    pub passes: u32,
    /// Measuring time per algorithm and order. Each pair gets a share by the number of its queries, and a second at least.
    pub budget: Duration,
    /// Seed of the orders and of the equivalent instances.
    pub seed: u64,
}

/// How far the replay is: first the whole scene is asked, if that is wanted, then pair by pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Progress {
    /// A process begins to be asked about the whole scene.
    Scene {
        /// Its algorithm.
        algorithm: String,
        /// Which of the algorithm's processes it is, counted from 1.
        process: u32,
        /// How many there are.
        of: u32,
    },
    /// Pairs are asked.
    Pairs {
        /// Queries of the pairs that are done.
        done: u64,
        /// All queries.
        of: u64,
    },
}

/// A replayed recording.
pub struct Replayed {
    /// What was found.
    pub result: WorkloadResult,
    /// The time and verdict of each query.
    pub rows: Vec<WorkloadRow>,
}

/// Replays a recording. The caller has the right to measure on this machine.
///
/// # Errors
/// `Stopped` when it was stopped; `Invalid` when no query can be replayed.
pub fn replay(
    recording: &Recording,
    wanted: &Wanted,
    runner: &Runner,
    machine: &Machine,
    stop: &Stop,
    tell: &dyn Fn(Progress),
) -> Result<Replayed> {
    let (parts, bent) = parts(&recording.queries);
    let solids = solids(&recording.scene)?;
    let mut judged = Truths::new(recording);
    let of: u64 = parts.iter().map(|part| part.rows.len() as u64).sum();
    tell(Progress::Pairs { done: 0, of });
    let scene = wanted.tracks.contains(&Track::Scene);
    let scene = scene.then(|| Scene::measure(&parts, &solids, wanted, runner, machine, stop, tell)).transpose()?;
    let tally = |i: usize| Tally::new(&wanted.algorithms[i], wanted.passes);
    let each = |track: &Track| match (track, &scene) {
        (Track::Scene, Some(scene)) => scene.algorithms().map(tally).collect(),
        _ => (0..wanted.algorithms.len()).map(tally).collect(),
    };
    let mut tallies: Vec<Vec<Tally>> = wanted.tracks.iter().map(each).collect();
    let (mut done, mut queries, mut far) = (0, 0, 0);
    for (number, part) in parts.iter().enumerate() {
        tell(Progress::Pairs { done, of });
        done += part.rows.len() as u64;
        let Some(certified) = Certified::of(part, &solids, stop)? else { continue };
        far += (part.rows.len() - certified.rows.len()) as u64;
        queries += certified.rows.len() as u64;
        judged.judge(&certified, part.objects, &solids);
        for (&track, tallies) in wanted.tracks.iter().zip(&mut tallies) {
            if let (Track::Scene, Some(scene)) = (track, &scene) {
                scene.judge(number, &certified, recording, tallies);
                continue;
            }
            let share = certified.rows.len() as f64 / of as f64;
            let measuring = Measuring { part, certified: &certified, wanted, track, share, runner, machine, stop };
            measuring.measure(recording, tallies)?;
        }
    }
    tell(Progress::Pairs { done, of });
    let whole = wanted.tracks.iter().zip(&mut tallies).find(|(track, _)| **track == Track::Scene);
    if let (Some(scene), Some((_, tallies))) = (scene, whole) {
        scene.conclude(tallies);
    }
    if queries == 0 {
        return Err(LabError::Invalid("None of the recorded queries can be replayed.".into()));
    }
    let mut left_out: Vec<LeftOut> =
        recording.about.dropped.iter().map(|it| LeftOut { reason: it.reason.clone(), count: it.count }).collect();
    left_out.extend(
        [("a pose is no rotation", bent), ("the objects are too far apart", far)]
            .into_iter()
            .filter(|&(_, count)| count > 0)
            .map(|(reason, count)| LeftOut { reason: reason.to_owned(), count }),
    );
    let names = recording.scene.scene.objects.iter().map(|object| &object.name);
    let measured: Vec<(Track, &[Tally])> =
        wanted.tracks.iter().zip(&tallies).map(|(track, tallies)| (*track, &tallies[..])).collect();
    let timeline = Parts::of(&recording.queries).timeline(&judged.hits, &measured);
    let mut rows = Vec::new();
    let mut tracks = Vec::new();
    // None may offer scenes.
    for (&track, tallies) in wanted.tracks.iter().zip(tallies).filter(|(_, tallies)| !tallies.is_empty()) {
        rows.extend(tallies.iter().flat_map(|tally| tally.rows(track, &judged)));
        let algorithms = tallies.into_iter().map(|tally| tally.result(&recording.queries)).collect();
        tracks.push(TrackResult { track, algorithms });
    }
    if tracks.is_empty() {
        let told = "None of these algorithms can load a whole scene; choose another order as well.";
        return Err(LabError::Invalid(told.into()));
    }
    let result = WorkloadResult {
        program: recording.about.program.clone(),
        libraries: recording.about.libraries.clone(),
        objects: solids.iter().zip(names).map(|(solid, name)| solid.describe(name)).collect(),
        seen: recording.about.seen,
        queries,
        left_out,
        groups: recording.queries.iter().map(|query| query.group).collect::<HashSet<u64>>().len() as u64,
        hits: judged.hits.iter().filter(|hit| **hit == Some(true)).count() as u64,
        recorded: judged.answers(),
        order_gains: order_gains(&tracks),
        reduced: None,
        tracks,
        timeline,
        passes: wanted.passes,
        seed: wanted.seed,
    };
    Ok(Replayed { result, rows })
}

/// A part with its truth.
struct Certified {
    pairing: Pairing,
    /// The places in the recording, and the truth about the outer polyhedra.
    rows: Vec<u32>,
    set: ConfigurationSet,
    /// The truth about the inner ones, where there are such.
    inner: Option<Vec<ocb_core::configuration::Truth>>,
}

impl Certified {
    /// Nothing where the objects are always specks to each other.
    fn of(part: &PairPart, solids: &[Solid], stop: &Stop) -> Result<Option<Self>> {
        let [a, b] = part.objects.map(|place| &solids[place as usize]);
        let pairing = paired(&a.outer, &b.outer);
        let speck = specks(&pairing.exact.a, &pairing.exact.b);
        let near = || part.rows.iter().zip(&part.configurations).filter(|(_, configuration)| !speck(configuration));
        let (rows, configurations): (Vec<u32>, Vec<_>) = near().map(|(row, it)| (*row, *it)).unzip();
        if rows.is_empty() {
            return Ok(None);
        }
        let gauge = Gauge::default();
        let certified = |pairing: &Pairing| {
            let certify = |i: usize| {
                if stop.asked() {
                    gauge.stop.store(true, Ordering::Relaxed);
                }
                let configuration = configurations[i];
                let truth = pairing.exact.pair().truth(&configuration);
                Placed { configuration, truth, rounded: None, root_index: 0, wanted: None }
            };
            on_all_cpus(configurations.len(), &gauge, certify).ok_or(LabError::Stopped)
        };
        let placed = certified(&pairing)?;
        let inner = if a.inner.is_some() || b.inner.is_some() {
            let inner = certified(&paired(a.inner(), b.inner()))?;
            Some(inner.into_iter().map(|placed| placed.truth).collect())
        } else {
            None
        };
        let set = ConfigurationSet {
            method: Method::File { sha256: String::new() },
            separation: None,
            longest_side: pairing.exact.mesh_a.longest_side(),
            placed: placed.into_iter().map(|placed| pairing.certified(placed)).collect(),
            missed_rays: 0,
            box_side: None,
            spacing: None,
        };
        Ok(Some(Self { pairing, rows, set, inner }))
    }
}

fn paired(a: &Arc<ocb_core::mesh::Mesh>, b: &Arc<ocb_core::mesh::Mesh>) -> Pairing {
    Pairing::new(a.clone(), (!Arc::ptr_eq(a, b)).then(|| b.clone()))
}

/// One part in one order.
struct Measuring<'a> {
    part: &'a PairPart,
    certified: &'a Certified,
    wanted: &'a Wanted<'a>,
    track: Track,
    /// Of all queries.
    share: f64,
    runner: &'a Runner,
    machine: &'a Machine,
    stop: &'a Stop,
}

impl Measuring<'_> {
    fn measure(&self, recording: &Recording, tallies: &mut [Tally]) -> Result<()> {
        let Self { part, certified, wanted, .. } = *self;
        let flat = |algorithm: &Algorithm| certified.pairing.flattened && algorithm.info.single_precision;
        let asked: Vec<usize> = (0..wanted.algorithms.len())
            .filter(|&i| wanted.algorithms[i].info.queries.contains(&part.query))
            .inspect(|&i| tallies[i].is_asked(&certified.rows, &recording.queries))
            .filter(|&i| !flat(&wanted.algorithms[i]))
            .collect();
        let algorithms: Vec<Arc<Algorithm>> = asked.iter().map(|&i| wanted.algorithms[i].clone()).collect();
        if algorithms.is_empty() {
            return Ok(());
        }
        let all = certified.rows.len();
        let task = Task {
            pairing: &certified.pairing,
            set: &certified.set,
            controls: &[],
            query: part.query,
            semantics: Semantics::Surface,
            passes: wanted.passes,
            budget: wanted.budget.mul_f64(self.share).max(LEAST),
            seed: wanted.seed,
            algorithms: &algorithms,
            reference: None,
            part: Part { precision: None, at_most: usize::MAX, of: all as u64 },
            watched: false,
            in_order: self.track == Track::Recorded,
            rounds_only: true,
        };
        let measured = measure::to_end(&task, self.runner, self.machine, self.stop)?.ok_or(LabError::Stopped)?;
        for (index, measured) in measured {
            let tally = &mut tallies[asked[index]];
            let answered = measured.records.iter().map(|record| {
                let i = record.configuration as usize;
                let hit = certified.set.placed[i].truth.hit;
                let (time_ns, times) = (record.time_ns, measured.times[i].clone());
                Answered { row: certified.rows[i], time_ns, times, verdict: record.verdict, hit }
            });
            tally.add(part.objects, &answered.collect::<Vec<_>>());
            tally.built(measured.set_ups.iter().map(|set_up| set_up.build_ns).collect());
            if let Some(outcome) = measured.outcome {
                tally.ended(Some(part.objects), outcome);
            }
        }
        Ok(())
    }
}
