//! One run, start to end: object, configurations, measuring, heatmap.
//!
//! Blocks on a thread of its own. Every stage first looks for what an earlier attempt has stored.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

use ocb_core::configuration::{Configuration, ConfigurationSet, Method};
use ocb_lab::algorithm::Algorithm;
use ocb_lab::job::{self, Job, Place, Results, Step};
use ocb_lab::pairing::Pairing;
use tokio::runtime::Handle;

use crate::attempts::{Attempt, Kind};
use crate::configurations::{self, ConfigurationFile, Gauge};
use crate::machine::MakingWay;
use crate::measure::{Part, Preliminary, Stop, Task};
use crate::model::{RunSpec, SetInfo, State};
use crate::runs::accept::End;
use crate::runs::benchmarks::Benchmarks;
use crate::runs::draw;
use crate::runs::log::RunLog;
use crate::runs::looking::Looking;
use crate::runs::sql::RunRow;
use crate::suite::{Suite, drawn_anew};
use crate::{EngineError, Result};

/// How often the run's thread looks up from waiting.
const TICK: Duration = Duration::from_millis(200);
/// Stages before the measuring ones.
const OBJECT: usize = 0;
const CONFIGURATIONS: usize = 1;

/// Carries out a run, or prepares it for a measuring machine. An error is the reason why the run failed.
pub fn run(benchmarks: &Benchmarks, attempt: &Attempt, stop: &Stop, handle: &Handle) -> Result<End> {
    let row = handle.block_on(benchmarks.store.run_row(&attempt.job))?;
    let log = RunLog::begin(attempt, &row.spec.algorithms, &benchmarks.live, handle.clone())?;
    let mut bench = Bench { benchmarks, attempt, row, stop, log };
    let ended = bench.stages().map_err(EngineError::for_visitors);
    match &ended {
        Ok(End::Done { .. } | End::Prepared) => {}
        Ok(End::Stopped) if benchmarks.work.closing() || stop.for_now() => {}
        Ok(End::Stopped) => bench.log.end_open(State::Cancelled, None)?,
        Err(e) => bench.log.end_open(State::Failed, Some(&e.to_string()))?,
    }
    ended
}

struct Bench<'a> {
    benchmarks: &'a Benchmarks,
    attempt: &'a Attempt,
    row: RunRow,
    stop: &'a Stop,
    log: RunLog,
}

impl<'a> Bench<'a> {
    fn stages(&mut self) -> Result<End> {
        self.draw_configurations()?;
        let pairing = self.objects()?;
        if self.stop.asked() {
            return Ok(End::Stopped);
        }
        let looking = self.looking()?;
        let Some((set, info)) = self.configurations(&pairing, &looking)? else { return Ok(End::Stopped) };
        if self.attempt.kind == Kind::Prepare {
            return Ok(if self.stop.asked() { End::Stopped } else { End::Prepared });
        }
        let Some(results) = self.measuring(&pairing, &looking, &set, &info)? else { return Ok(End::Stopped) };
        self.benchmarks.results.hand_in(&mut self.log, &self.row, results)
    }

    /// For a suite without a seed: draws this run's configurations, from a secret that was fixed together with its plugins.
    fn draw_configurations(&mut self) -> Result<()> {
        let Suite { document, sha256, .. } = &*self.benchmarks.suite;
        if document.seed.is_some() || self.row.suite.as_ref() != Some(sha256) {
            return Ok(());
        }
        self.row.spec = drawn_anew(&self.row.spec, draw::configurations(&self.row, &self.algorithms()?));
        self.log.kept(self.benchmarks.store.spec_of_run(self.attempt, &self.row.spec))
    }

    fn objects(&mut self) -> Result<Pairing> {
        let spec = self.row.spec.clone();
        let same = spec.object_b.is_none();
        self.log.start(OBJECT, if same { 1 } else { 2 })?;
        let mesh_a = self.log.wait(self.benchmarks.objects.mesh(&spec.object_a))?;
        let mesh_b = spec.object_b.as_ref().map(|id| self.log.wait(self.benchmarks.objects.mesh(id))).transpose()?;
        let pairing = Pairing::new(mesh_a, mesh_b);
        let single = self.algorithms()?.into_iter().find(|c| pairing.flattened && c.info.single_precision);
        if let Some(algorithm) = single {
            return Err(crate::runs::spec::flattened(&algorithm.info.id));
        }
        let done = if same { 1 } else { 2 };
        self.log.progress(OBJECT, done, done)?;
        self.log.end(OBJECT, State::Done, None)?;
        Ok(pairing)
    }

    /// Stored positions when somebody found them before, else new ones; `None` when stopped.
    fn configurations(
        &mut self,
        pairing: &Pairing,
        looking: &Looking,
    ) -> Result<Option<(Arc<ConfigurationSet>, SetInfo)>> {
        let (a, b) = (&pairing.exact.mesh_a, &pairing.exact.mesh_b);
        let (sha_a, sha_b) = (a.sha256(), b.sha256());
        let key = configurations::set_key(&sha_a, &sha_b, &self.row.spec)?;
        let file = self.configuration_file()?;
        let straightened = file.as_ref().and_then(ConfigurationFile::note);
        let store = self.benchmarks.store.clone();
        let keeping = self.log.wait(self.benchmarks.store.locks.keeping())?;
        if let Some(stored) = self.log.wait(store.set(&key))? {
            let n = u64::from(stored.info.configurations);
            self.log.start(CONFIGURATIONS, n)?;
            let set = self.log.wait(self.benchmarks.sets.get(&stored.blob))?;
            self.log.kept(store.set_of_run(self.attempt, &stored.info, &stored.blob))?;
            self.log.progress(CONFIGURATIONS, n, n)?;
            let again = Some("Saved positions were reused.".to_owned());
            self.log.end(CONFIGURATIONS, State::Done, sentences([again, straightened]))?;
            return Ok(Some((set, stored.info)));
        }
        drop(keeping);
        let started = Instant::now();
        let poses = file.map(|file| file.poses);
        let Some(set) = self.find(pairing, looking, poses.as_deref())? else { return Ok(None) };
        let seconds = started.elapsed().as_secs_f64();
        let _keeping = self.log.wait(self.benchmarks.store.locks.keeping())?;
        let info = self.log.wait(self.benchmarks.sets.keep(&key, [a, b], &set, seconds))?;
        let blob = info.sha256.clone();
        self.log.kept(store.set_of_run(self.attempt, &info, &blob))?;
        let missed = (info.missed_rays > 0)
            .then(|| format!("On {} rays the requested separation was not reached.", info.missed_rays));
        self.log.end(CONFIGURATIONS, State::Done, sentences([missed, straightened]))?;
        Ok(Some((self.benchmarks.sets.remember(&blob, set), info)))
    }

    /// The run's configuration file, if it has one.
    fn configuration_file(&self) -> Result<Option<ConfigurationFile>> {
        let Method::File { sha256 } = &self.row.spec.method else { return Ok(None) };
        Ok(Some(configurations::read_file(&self.log.wait(self.benchmarks.blobs.get(sha256))?)?))
    }

    /// Finds the set on all CPUs while this thread reports.
    fn find(
        &mut self,
        pairing: &Pairing,
        looking: &Looking,
        poses: Option<&[Configuration]>,
    ) -> Result<Option<ConfigurationSet>> {
        let spec: &RunSpec = &self.row.spec.clone();
        let total = match poses {
            Some(poses) => poses.len() as u64,
            None => ocb_core::sampling::count(&spec.finding())
                .map_err(|e| EngineError::Invalid(format!("These configurations are not possible: {e}.")))?,
        };
        self.log.start(CONFIGURATIONS, total)?;
        let gauge = Gauge::default();
        let begun = Instant::now();
        let gauge = &gauge;
        let beginning = &mut |set: &ConfigurationSet| looking.at_beginning(pairing, set, total);
        let set = thread::scope(|scope| -> Result<_> {
            let mut way = MakingWay::begin(&self.benchmarks.machine);
            let worker = scope.spawn(move || configurations::make(pairing, spec, poses, gauge, Some(beginning)));
            while !worker.is_finished() {
                thread::sleep(TICK.min(Duration::from_millis(20)));
                way.look();
                if self.stop.asked() {
                    gauge.stop.store(true, Ordering::Relaxed);
                }
                // A grid looks for some more than wanted.
                let done = gauge.done.load(Ordering::Relaxed).min(total);
                let seconds = begun.elapsed().as_secs_f64();
                self.benchmarks.live.under_way.estimate(&self.row.id, |it| it.finding(done, total, seconds));
                self.log.progress_slowly(CONFIGURATIONS, done, total)?;
            }
            let found = worker.join();
            Ok(found.map_err(|_| EngineError::Fault("Finding the configurations failed.".into()))??)
        })?;
        self.benchmarks.live.under_way.estimate(&self.row.id, |it| it.finding(total, total, 0.0));
        if set.is_some() {
            self.log.progress(CONFIGURATIONS, total, total)?;
        }
        Ok(set)
    }

    fn measuring(
        &mut self,
        pairing: &Pairing,
        looking: &Looking,
        set: &ConfigurationSet,
        info: &SetInfo,
    ) -> Result<Option<Results>> {
        let algorithms = self.algorithms()?;
        let reference = crate::runs::spec::reference(&self.row.spec, &self.benchmarks.registry);
        let (seed, part) = (draw::seed(&self.row, &info.sha256, &algorithms), Part::of(&self.row.spec, set));
        let task = Task { seed, ..looking.task(pairing, set, part) };
        let (look, draw) = (looking.to_come(), draw::drawn(&self.row, seed));
        let job = Job { task, look, set: info, run: &self.row.id, draw };
        let place =
            Place { runner: self.benchmarks.registry.runner(), machine: &self.benchmarks.machine, stop: self.stop };
        let name = reference.as_ref().map_or("", |reference| reference.info.name.as_str());
        let log = &mut self.log;
        job::measure(job, &place, &mut |step| {
            match &step {
                Step::Progress { place, done, total, worked } => looking.progress(*place, *done, *total, *worked),
                Step::Preliminary(place, seen) => looking.show(*place, Preliminary::clone(seen)),
                Step::Waiting(_) => {}
            }
            log.step(&step, name)
        })
    }

    /// Everything that preliminary results of this run need.
    fn looking(&self) -> Result<Looking<'a>> {
        let reference = crate::runs::spec::reference(&self.row.spec, &self.benchmarks.registry);
        Ok(Looking::new(self.benchmarks, self.stop, &self.row, self.algorithms()?, reference))
    }

    fn algorithms(&self) -> Result<Vec<Arc<Algorithm>>> {
        self.benchmarks.registry.algorithms_of(&self.row)
    }
}

/// One text from the sentences that there are.
fn sentences(all: [Option<String>; 2]) -> Option<String> {
    all.into_iter().flatten().reduce(|text, next| format!("{text} {next}"))
}
