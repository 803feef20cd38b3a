//! One run, start to end: object, configurations, measuring, heatmap.
//!
//! Blocks on a thread of its own. Every stage first looks for what an earlier attempt has stored.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use ocb_core::comparison::{Comparison, compare};
use ocb_core::configuration::{Configuration, ConfigurationSet, Method};
use ocb_core::sampling::controls::{self, Control};
use ocb_lab::algorithm::Algorithm;
use ocb_lab::pairing::Pairing;
use tokio::runtime::Handle;

use crate::attempts::Attempt;
use crate::columns::{RecordsOf, records_parquet, triangle_tests_parquet};
use crate::configurations::{self, ConfigurationFile, Gauge};
use crate::engine::Inner;
use crate::locks::Keeping;
use crate::machine::{MakingWay, MeasuringRight};
use crate::measure::{self, Asked, Measured, News, Part, Stop, Task};
use crate::model::{AlgorithmResult, Environment, Preview, RunSpec, SetInfo, State};
use crate::results::sql::StoredResult;
use crate::runs::accept::Handed;
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
const FIRST_MEASURING: usize = 2;

/// How a run ended when nothing went wrong.
#[derive(Debug)]
pub enum End {
    /// All stages are through, or nothing could be measured. Its files stay although no row names them yet.
    Done { handed: Box<Handed>, _keeping: Keeping },
    /// It was stopped from outside.
    Stopped,
}

/// Carries out a run. An error is the reason why the run failed.
pub fn run(inner: &Arc<Inner>, attempt: &Attempt, stop: &Stop, handle: &Handle) -> Result<End> {
    let row = handle.block_on(inner.run_row(&attempt.job))?;
    let told = (inner.store.clone(), inner.run_events.clone(), inner.under_way.clone());
    let log = RunLog::begin(attempt, &row.spec.algorithms, told, handle.clone())?;
    let mut bench = Bench { inner, attempt, row, stop, log };
    let ended = bench.stages().map_err(EngineError::for_visitors);
    match &ended {
        Ok(End::Done { .. }) => {}
        Ok(End::Stopped) if inner.closing() || stop.for_now() => {}
        Ok(End::Stopped) => bench.log.end_open(State::Cancelled, None)?,
        Err(e) => bench.log.end_open(State::Failed, Some(&e.to_string()))?,
    }
    ended
}

struct Bench<'a> {
    inner: &'a Arc<Inner>,
    attempt: &'a Attempt,
    row: RunRow,
    stop: &'a Stop,
    log: RunLog,
}

/// All that was measured.
struct All {
    finished: Vec<(usize, Measured)>,
    seed: u64,
    controls: Vec<Control>,
    /// Configurations of the whole run.
    of: u64,
    preview: Option<Preview>,
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
        let Some((all, right)) = self.measuring(&pairing, &looking, &set, &info)? else { return Ok(End::Stopped) };
        let keeping = self.log.wait(self.inner.store.locks.keeping())?;
        let handed = self.summarised(&pairing, &set, &info, all)?;
        drop(right);
        if handed.failed.is_none() {
            self.heatmaps(&handed)?;
        }
        Ok(End::Done { handed: Box::new(handed), _keeping: keeping })
    }

    /// For a suite without a seed: draws this run's configurations, from a secret that was fixed together with its plugins.
    fn draw_configurations(&mut self) -> Result<()> {
        let Suite { document, sha256, .. } = &self.inner.suite;
        if document.seed.is_some() || self.row.suite.as_ref() != Some(sha256) {
            return Ok(());
        }
        self.row.spec = drawn_anew(&self.row.spec, draw::configurations(&self.row, &self.algorithms()?));
        self.log.kept(self.inner.store.spec_of_run(self.attempt, &self.row.spec))
    }

    fn objects(&mut self) -> Result<Pairing> {
        let spec = self.row.spec.clone();
        let same = spec.object_b.is_none();
        self.log.start(OBJECT, if same { 1 } else { 2 })?;
        let mesh_a = self.log.wait(self.inner.objects.mesh(&spec.object_a))?;
        let mesh_b = spec.object_b.as_ref().map(|id| self.log.wait(self.inner.objects.mesh(id))).transpose()?;
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
        let store = self.inner.store.clone();
        let keeping = self.log.wait(self.inner.store.locks.keeping())?;
        if let Some(stored) = self.log.wait(store.set(&key))? {
            let n = u64::from(stored.info.configurations);
            self.log.start(CONFIGURATIONS, n)?;
            let set = self.log.wait(self.inner.set(&stored.blob))?;
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
        let _keeping = self.log.wait(self.inner.store.locks.keeping())?;
        let info = self.log.wait(self.inner.keep_set(&key, [a, b], &set, seconds))?;
        let blob = info.sha256.clone();
        self.log.kept(store.set_of_run(self.attempt, &info, &blob))?;
        let missed = (info.missed_rays > 0)
            .then(|| format!("On {} rays the requested separation was not reached.", info.missed_rays));
        self.log.end(CONFIGURATIONS, State::Done, sentences([missed, straightened]))?;
        Ok(Some((self.inner.sets.put(&blob, set), info)))
    }

    /// The run's configuration file, if it has one.
    fn configuration_file(&self) -> Result<Option<ConfigurationFile>> {
        let Method::File { sha256 } = &self.row.spec.method else { return Ok(None) };
        Ok(Some(configurations::read_file(&self.log.wait(self.inner.blobs.get(sha256))?)?))
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
            let mut way = MakingWay::begin(&self.inner.machine);
            let worker = scope.spawn(move || configurations::make(pairing, spec, poses, gauge, Some(beginning)));
            while !worker.is_finished() {
                thread::sleep(TICK.min(Duration::from_millis(20)));
                way.look();
                if self.stop.asked() {
                    gauge.stop.store(true, Ordering::Relaxed);
                }
                // A grid looks for some more than wanted.
                let done = gauge.done.load(Ordering::Relaxed).min(total);
                self.inner.under_way.estimate(|it| it.finding(done, total, begun.elapsed().as_secs_f64()));
                self.log.progress_slowly(CONFIGURATIONS, done, total)?;
            }
            let found = worker.join();
            Ok(found.map_err(|_| EngineError::Fault("Finding the configurations failed.".into()))??)
        })?;
        self.inner.under_way.estimate(|it| it.finding(total, total, 0.0));
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
    ) -> Result<Option<(All, MeasuringRight)>> {
        let algorithms = self.algorithms()?;
        let reference = crate::runs::spec::reference(&self.row.spec, &self.inner.registry);
        let spec = self.row.spec.clone();
        let (seed, part) = (draw::seed(&self.row, &info.sha256, &algorithms), Part::of(&spec, set));
        let controls = self.controls(pairing, set, seed, part.most(set))?;
        let Some(right) = self.right_to_measure()? else { return Ok(None) };
        let task = Task { controls: &controls, seed, ..looking.task(pairing, set, part) };
        let (of, asked_for) = (task.part.of, algorithms.len());
        let name = reference.as_ref().map_or("", |reference| reference.info.name.as_str());
        let mut preview = None;
        let (sender, news) = mpsc::channel();
        let mut finished: Vec<(usize, Measured)> = Vec::new();
        // The reference has no stage of its own unless it was requested; the first such stage says that it is at work.
        let mut noted = false;
        thread::scope(|scope| -> Result<()> {
            let (runner, machine, stop) = (self.inner.registry.runner(), &self.inner.machine, self.stop);
            let worker = thread::Builder::new()
                .name("measuring".into())
                .spawn_scoped(scope, move || {
                    looking.before_the_rounds(pairing, set, part);
                    measure::measure(&task, runner, machine, stop, &sender);
                })
                .map_err(|e| EngineError::fault("Starting the measuring thread failed", e))?;
            loop {
                match news.recv_timeout(TICK) {
                    Ok(News::Progress { index, done, total, worked }) if index < asked_for => {
                        looking.progress(index, done, total, worked);
                        if std::mem::take(&mut noted) {
                            self.log.note(FIRST_MEASURING, None)?;
                        }
                        self.log.progress_after(FIRST_MEASURING + index, done, total, worked)?;
                    }
                    Ok(News::Progress { index, done, total, worked }) => {
                        looking.progress(index, done, total, worked);
                        self.log.note(FIRST_MEASURING, Some(&turn_of_reference(name, done, total)))?;
                        noted = true;
                    }
                    Ok(News::Preview(found)) => preview = Some(found),
                    Ok(News::Preliminary { index, preliminary }) => looking.show(index, *preliminary),
                    Ok(News::Finished { index, measured }) => finished.push((index, *measured)),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
            worker.join().map_err(|_| EngineError::Fault("The measuring thread failed.".into()))
        })?;
        if self.stop.asked() {
            return Ok(None);
        }
        Ok(Some((All { finished, seed, controls, of, preview }, right)))
    }

    /// Draws the control questions on all CPUs; fewer when it is stopped meanwhile.
    fn controls(&self, pairing: &Pairing, set: &ConfigurationSet, seed: u64, most: usize) -> Result<Vec<Control>> {
        let RunSpec { query, semantics, .. } = self.row.spec;
        let stopped = || self.stop.asked();
        thread::scope(|scope| {
            let mut way = MakingWay::begin(&self.inner.machine);
            let worker = scope.spawn(|| {
                let plan = controls::Plan::new(pairing.exact.pair(), set, query, semantics, seed);
                measure::draw_controls(&plan, pairing, set, most, &stopped)
            });
            while !worker.is_finished() {
                thread::sleep(TICK.min(Duration::from_millis(5)));
                way.look();
            }
            worker.join().map_err(|_| EngineError::Fault("Drawing the control questions failed.".into()))
        })
    }

    /// What is handed in of all that was measured; its files are stored before. The run fails only when there is nothing to show
    /// at all.
    fn summarised(
        &mut self,
        pairing: &Pairing,
        set: &ConfigurationSet,
        info: &SetInfo,
        All { finished, seed, controls, of, preview }: All,
    ) -> Result<Handed> {
        let asked = Asked {
            pairing,
            placed: &set.placed,
            query: self.row.spec.query,
            semantics: self.row.spec.semantics,
            controls: &controls,
            coherent: measure::is_coherent(&set.method),
        };
        let algorithms = self.row.spec.algorithms.clone();
        let reference = crate::runs::spec::reference(&self.row.spec, &self.inner.registry).map(|c| c.info.clone());
        let of_reference =
            finished.iter().find(|(_, m)| Some(&m.algorithm.info.id) == reference.as_ref().map(|r| &r.id));
        let compared: Vec<Option<Comparison>> = finished
            .iter()
            .map(|(_, m)| compare(&m.times, of_reference.map(|(_, r)| &r.times[..]), self.row.spec.passes, of))
            .collect();
        let all: Vec<&Measured> = finished.iter().map(|(_, measured)| measured).collect();
        let (machine, profile) = (&self.inner.machine, self.inner.registry.profile());
        let drawn = draw::drawn(&self.row, seed);
        let environment = measure::environment(machine, profile, &all, reference.as_ref(), drawn);
        let asked_for = || finished.iter().zip(&compared).filter(|((index, _), _)| *index < algorithms.len());
        let of_reference = of_reference.map(|(_, measured)| measured);
        let mut results: Vec<AlgorithmResult> = asked_for()
            .map(|((_, measured), compared)| measure::summarise(measured, asked, *compared, of_reference))
            .collect();
        measure::rank(&mut results, profile);
        let (mut nothing, mut any, mut kept) = (None, false, Vec::new());
        for (((index, measured), _), result) in asked_for().zip(results) {
            let stored = self.keep_files(info, measured, result, environment.as_ref())?;
            any |= stored.result.n > 0;
            nothing.get_or_insert_with(|| stored.result.outcome.message.clone());
            self.end_stage(*index, &stored.result)?;
            kept.push((*index, stored));
        }
        // The outcomes are for the visitor and name no paths.
        let failed = nothing.filter(|_| !any).map(|cause| format!("No algorithm could be measured. {cause}"));
        let exact = &pairing.exact;
        Ok(Handed {
            results: kept,
            triangles: (exact.mesh_a.triangles().len() + exact.mesh_b.triangles().len()) as u64,
            query: self.row.spec.query,
            environment,
            preview,
            failed,
        })
    }

    /// Stores records and tests per triangle of one algorithm.
    fn keep_files(
        &self,
        info: &SetInfo,
        measured: &Measured,
        result: AlgorithmResult,
        environment: Option<&Environment>,
    ) -> Result<StoredResult> {
        let algorithm = &measured.algorithm.info;
        let of = RecordsOf {
            run: &self.row.id,
            algorithm: &algorithm.id,
            plugin_sha256: &algorithm.plugin_sha256,
            hardware_class: environment.map_or("", |e| &e.hardware_class),
            set_sha256: &info.sha256,
            rounded: info.rounding.map(|_| result.rounded),
        };
        let keep = |bytes: Vec<u8>| -> Result<String> {
            let length = bytes.len();
            let blob = self.log.wait(self.inner.blobs.put(bytes))?;
            self.log.wait(self.inner.store.add_blob(&blob, length, "application/vnd.apache.parquet"))?;
            Ok(blob)
        };
        let measured_any = !measured.records.is_empty();
        let records = measured_any.then(|| keep(records_parquet(&of, &measured.records)?)).transpose()?;
        let counted = measured.triangle_tests.as_ref().filter(|_| measured_any);
        let triangle_tests = counted.map(|counted| keep(triangle_tests_parquet(&of, counted)?)).transpose()?;
        Ok(StoredResult {
            result,
            records,
            triangle_tests,
            plugin_sha256: algorithm.plugin_sha256.clone(),
            seconds_per_query: measured.seconds_per_query,
        })
    }

    fn end_stage(&mut self, index: usize, result: &AlgorithmResult) -> Result<()> {
        let failed = !result.outcome.completed();
        let message = if failed {
            Some(result.outcome.message.clone())
        } else {
            result
                .budget_limited
                .then(|| format!("The time limit was reached after {} of {} configurations.", result.n, result.of))
        };
        let state = if failed { State::Failed } else { State::Done };
        self.log.end(FIRST_MEASURING + index, state, message)
    }

    /// Everything that preliminary results of this run need.
    fn looking(&self) -> Result<Looking<'a>> {
        let reference = crate::runs::spec::reference(&self.row.spec, &self.inner.registry);
        Ok(Looking::new(self.inner, self.stop, &self.row, self.algorithms()?, reference))
    }

    /// The algorithms may have changed since the run was asked for, by a restart with other plugins.
    fn algorithms(&self) -> Result<Vec<Arc<Algorithm>>> {
        let find = |id: &String| {
            self.inner.registry.choose(id, self.row.owner.as_deref())?.ok_or_else(|| {
                EngineError::Invalid(format!(
                    "The algorithm {id:?} is no longer installed; start the run again without it."
                ))
            })
        };
        self.row.spec.algorithms.iter().map(find).collect()
    }

    /// Waits until no other process measures on this machine; `None` when stopped.
    fn right_to_measure(&mut self) -> Result<Option<MeasuringRight>> {
        let (stop, log, mut noted) = (&self.stop, &mut self.log, None);
        let waits = || {
            noted = Some(log.note(FIRST_MEASURING, Some("Waiting: another process is measuring on this machine.")));
        };
        let right = MeasuringRight::wait(|| stop.asked(), waits)?;
        if let Some(noted) = noted {
            noted?;
            self.log.note(FIRST_MEASURING, None)?;
        }
        Ok(right)
    }

    /// Prepares what the first look at the run needs, so that it is quick.
    fn heatmaps(&mut self, handed: &Handed) -> Result<()> {
        let stage = FIRST_MEASURING + self.row.spec.algorithms.len();
        let row = self.log.wait(self.inner.run_row(&self.row.id))?;
        let records: Vec<&String> = handed.results.iter().filter_map(|(_, stored)| stored.records.as_ref()).collect();
        let total = records.len() as u64;
        self.log.start(stage, total)?;
        self.log.wait(self.inner.prepare_maps(&row))?;
        for (done, records) in (1..).zip(records) {
            self.log.wait(self.inner.records_of(records))?;
            self.log.progress(stage, done, total)?;
        }
        self.log.end(stage, State::Done, None)
    }
}

/// One text from the sentences that there are.
fn sentences(all: [Option<String>; 2]) -> Option<String> {
    all.into_iter().flatten().reduce(|text, next| format!("{text} {next}"))
}

/// What is said while the reference algorithm, for which nobody asked, has its turn.
fn turn_of_reference(name: &str, done: u64, total: u64) -> String {
    let of = if total > 0 { format!(" of {total}") } else { String::new() };
    format!("Now the reference algorithm, {name}: {done}{of} queries.")
}
