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
use ocb_core::oracle::{Pair, Shape};
use ocb_core::sampling::controls::{self, Control};
use ocb_lab::contestant::Contestant;
use tokio::runtime::Handle;

use crate::columns::{RecordsOf, records_parquet, triangle_tests_parquet};
use crate::configurations::{self, ConfigurationFile, Gauge};
use crate::engine::Inner;
use crate::machine::{MakingWay, MeasuringRight};
use crate::measure::{self, Asked, Measured, News, Part, Stop, Task};
use crate::model::{AlgorithmResult, Environment, Preview, RunSpec, SetInfo, State};
use crate::results::sql::StoredResult;
use crate::runs::draw;
use crate::runs::log::RunLog;
use crate::runs::looking::Looking;
use crate::runs::pairing::Pairing;
use crate::runs::sql::RunRow;
use crate::suite::{Suite, drawn_anew};
use crate::{EngineError, Result};

/// How often the run's thread looks up from waiting.
const TICK: Duration = Duration::from_millis(200);
/// Lanes before the measuring ones.
const OBJECT: usize = 0;
const CONFIGURATIONS: usize = 1;
const FIRST_MEASURING: usize = 2;

/// How a run ended when nothing went wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// All stages are through.
    Done,
    /// It was stopped from outside.
    Stopped,
}

/// Carries out a claimed run. An error is the reason why the run failed.
pub fn run(inner: &Arc<Inner>, id: &str, stop: &Stop, handle: &Handle) -> Result<End> {
    let row =
        handle.block_on(inner.store.run(id))?.ok_or_else(|| EngineError::Fault(format!("The run {id} is gone.")))?;
    let told = (inner.store.clone(), inner.run_events.clone(), inner.under_way.clone());
    let log = RunLog::begin(id, &row.spec.algorithms, told, handle.clone())?;
    let lanes = row.spec.algorithms.len();
    // Where the reference is none of them, it takes turns, too.
    let apart = crate::runs::spec::reference(&row.spec, &inner.registry)
        .filter(|reference| !row.spec.algorithms.contains(&reference.info.id));
    let _shown = inner.under_way.begin(id, lanes + usize::from(apart.is_some()), row.expected_seconds);
    let mut bench = Bench { inner, row, stop, log };
    let ended = bench.stages().map_err(EngineError::for_visitors);
    match &ended {
        Ok(End::Done) => {}
        Ok(End::Stopped) if inner.closing() || stop.for_now() => {}
        Ok(End::Stopped) => bench.log.end_open(State::Cancelled, None)?,
        Err(e) => bench.log.end_open(State::Failed, Some(&e.to_string()))?,
    }
    ended
}

struct Bench<'a> {
    inner: &'a Arc<Inner>,
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
        if self.measuring(&pairing, &looking, &set, &info)? == End::Stopped {
            return Ok(End::Stopped);
        }
        self.heatmaps()?;
        Ok(End::Done)
    }

    /// For a suite without a seed: draws this run's configurations, from a secret that was fixed together with its plugins.
    fn draw_configurations(&mut self) -> Result<()> {
        let Suite { document, sha256, .. } = &self.inner.suite;
        if document.seed.is_some() || self.row.suite.as_ref() != Some(sha256) {
            return Ok(());
        }
        self.row.spec = drawn_anew(&self.row.spec, draw::configurations(&self.row, &self.contestants()?));
        self.log.wait(self.inner.store.spec_of_run(&self.row.id, &self.row.spec))
    }

    fn objects(&mut self) -> Result<Pairing> {
        let spec = self.row.spec.clone();
        let same = spec.object_b.is_none();
        self.log.start(OBJECT, if same { 1 } else { 2 })?;
        let mesh_a = self.log.wait(self.inner.objects.mesh(&spec.object_a))?;
        let mesh_b = match &spec.object_b {
            Some(id) => self.log.wait(self.inner.objects.mesh(id))?,
            None => mesh_a.clone(),
        };
        let (a, b) = (Shape::new(mesh_a.clone()), Shape::new(mesh_b.clone()));
        let done = if same { 1 } else { 2 };
        self.log.progress(OBJECT, done, done)?;
        self.log.end(OBJECT, State::Done, None, None)?;
        Ok(Pairing { mesh_a, mesh_b, a, b, same })
    }

    /// Stored positions when somebody found them before, else new ones; `None` when stopped.
    fn configurations(
        &mut self,
        pairing: &Pairing,
        looking: &Looking,
    ) -> Result<Option<(Arc<ConfigurationSet>, SetInfo)>> {
        let (a, b) = (&pairing.mesh_a, &pairing.mesh_b);
        let (sha_a, sha_b) = (a.sha256(), b.sha256());
        let key = configurations::set_key(&sha_a, &sha_b, &self.row.spec)?;
        let file = self.configuration_file()?;
        let straightened = file.as_ref().and_then(ConfigurationFile::note);
        let store = self.inner.store.clone();
        let keeping = self.log.wait(self.inner.blobs.keeping());
        if let Some(stored) = self.log.wait(store.set(&key))? {
            let n = u64::from(stored.info.configurations);
            self.log.start(CONFIGURATIONS, n)?;
            let set = self.log.wait(self.inner.set(&stored.blob))?;
            self.log.wait(store.set_of_run(&self.row.id, &stored.info, &stored.blob))?;
            self.log.progress(CONFIGURATIONS, n, n)?;
            let again = Some("Saved positions were reused.".to_owned());
            self.log.end(CONFIGURATIONS, State::Done, sentences([again, straightened]), None)?;
            return Ok(Some((set, stored.info)));
        }
        drop(keeping);
        let started = Instant::now();
        let poses = file.map(|file| file.poses);
        let Some(set) = self.find(pairing, looking, poses.as_deref())? else { return Ok(None) };
        let seconds = started.elapsed().as_secs_f64();
        let _keeping = self.log.wait(self.inner.blobs.keeping());
        let info = self.log.wait(self.inner.keep_set(&key, [a, b], &set, seconds))?;
        let blob = info.sha256.clone();
        self.log.wait(store.set_of_run(&self.row.id, &info, &blob))?;
        let missed = (info.missed_rays > 0)
            .then(|| format!("On {} rays the requested separation was not reached.", info.missed_rays));
        self.log.end(CONFIGURATIONS, State::Done, sentences([missed, straightened]), None)?;
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
        let (longest_side, begun) = (pairing.mesh_a.longest_side(), Instant::now());
        let gauge = &gauge;
        let beginning = &mut |set: &ConfigurationSet| looking.at_beginning(pairing, set, total);
        let set = thread::scope(|scope| -> Result<_> {
            let mut way = MakingWay::begin(&self.inner.machine);
            let worker = scope.spawn(move || {
                let (a, b) = (&pairing.a, &pairing.b);
                configurations::make(a, b, longest_side, spec, poses, gauge, Some(beginning))
            });
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
    ) -> Result<End> {
        let known = self.log.wait(self.inner.store.results(&self.row.id))?;
        let complete = self.row.spec.algorithms.iter().all(|a| known.iter().any(|k| k.result.algorithm == *a));
        if complete && !self.row.is_refined() {
            // An earlier attempt came as far as this.
            for (lane, stored) in known.into_iter().enumerate() {
                let n = u64::from(stored.result.n);
                self.log.progress(FIRST_MEASURING + lane, n, n)?;
                self.end_lane(lane, stored)?;
            }
            return Ok(End::Done);
        }
        let contestants = self.contestants()?;
        let reference = crate::runs::spec::reference(&self.row.spec, &self.inner.registry);
        let spec = self.row.spec.clone();
        let (seed, part) = (draw::seed(&self.row, &info.sha256, &contestants), Part::of(&spec, set));
        let controls = self.controls(pairing, set, seed, part.most(set))?;
        let Some(_right) = self.right_to_measure()? else { return Ok(End::Stopped) };
        let task = Task { controls: &controls, seed, ..looking.task(pairing, set, part) };
        let (of, asked_for) = (task.part.of, contestants.len());
        let name = reference.as_ref().map_or("", |reference| reference.info.name.as_str());
        let mut preview = None;
        let (sender, news) = mpsc::channel();
        let mut finished: Vec<(usize, Measured)> = Vec::new();
        // The reference has no lane of its own unless somebody asked for it; the first lane says that it is at work.
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
                    Ok(News::Progress { lane, done, total, worked }) if lane < asked_for => {
                        looking.progress(lane, done, total, worked);
                        if std::mem::take(&mut noted) {
                            self.log.note(FIRST_MEASURING, None)?;
                        }
                        self.log.progress_after(FIRST_MEASURING + lane, done, total, worked)?;
                    }
                    Ok(News::Progress { lane, done, total, worked }) => {
                        looking.progress(lane, done, total, worked);
                        self.log.note(FIRST_MEASURING, Some(&turn_of_reference(name, done, total)))?;
                        noted = true;
                    }
                    Ok(News::Preview(found)) => preview = Some(found),
                    Ok(News::Preliminary { lane, preliminary }) => looking.show(lane, *preliminary),
                    Ok(News::Finished { lane, measured }) => finished.push((lane, *measured)),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
            worker.join().map_err(|_| EngineError::Fault("The measuring thread failed.".into()))
        })?;
        if self.stop.asked() {
            return Ok(End::Stopped);
        }
        self.keep(pairing, set, info, All { finished, seed, controls, of, preview })
    }

    /// Draws the control questions on all CPUs; fewer when it is stopped meanwhile.
    fn controls(&self, pairing: &Pairing, set: &ConfigurationSet, seed: u64, most: usize) -> Result<Vec<Control>> {
        let RunSpec { query, semantics, .. } = self.row.spec;
        let stopped = || self.stop.asked();
        thread::scope(|scope| {
            let mut way = MakingWay::begin(&self.inner.machine);
            let worker = scope.spawn(|| {
                let plan = controls::Plan::new(Pair::new(&pairing.a, &pairing.b), set, query, semantics, seed);
                measure::draw_controls(&plan, set, most, &stopped)
            });
            while !worker.is_finished() {
                thread::sleep(TICK.min(Duration::from_millis(5)));
                way.look();
            }
            worker.join().map_err(|_| EngineError::Fault("Drawing the control questions failed.".into()))
        })
    }

    /// Stores what was measured; the run fails only when there is nothing to show at all.
    fn keep(
        &mut self,
        pairing: &Pairing,
        set: &ConfigurationSet,
        info: &SetInfo,
        All { finished, seed, controls, of, preview }: All,
    ) -> Result<End> {
        let asked = Asked {
            pair: Pair::new(&pairing.a, &pairing.b),
            placed: &set.placed,
            query: self.row.spec.query,
            semantics: self.row.spec.semantics,
            controls: &controls,
            coherent: measure::is_coherent(&set.method),
        };
        let algorithms = self.row.spec.algorithms.clone();
        let reference = crate::runs::spec::reference(&self.row.spec, &self.inner.registry).map(|c| c.info.clone());
        let of_reference =
            finished.iter().find(|(_, m)| Some(&m.contestant.info.id) == reference.as_ref().map(|r| &r.id));
        let compared: Vec<Option<Comparison>> = finished
            .iter()
            .map(|(_, m)| compare(&m.times, of_reference.map(|(_, r)| &r.times[..]), self.row.spec.passes, of))
            .collect();
        let all: Vec<&Measured> = finished.iter().map(|(_, measured)| measured).collect();
        let (machine, profile) = (&self.inner.machine, self.inner.registry.profile());
        let drawn = draw::drawn(&self.row, seed);
        let environment = measure::environment(machine, profile, &all, reference.as_ref(), drawn);
        if let Some(environment) = &environment {
            self.log.wait(self.inner.store.environment_of_run(&self.row.id, environment))?;
        }
        // It is marked as a preview before there are numbers, and no longer than these are a preview's.
        if preview.is_some() {
            self.log.wait(self.inner.store.preview_of_run(&self.row.id, preview.as_ref()))?;
        }
        let asked_for = || finished.iter().zip(&compared).filter(|((lane, _), _)| *lane < algorithms.len());
        let of_reference = of_reference.map(|(_, measured)| measured);
        let mut results: Vec<AlgorithmResult> = asked_for()
            .map(|((_, measured), compared)| measure::summarise(measured, asked, *compared, of_reference))
            .collect();
        measure::rank(&mut results, profile);
        let mut nothing = None;
        let mut any = false;
        for (((lane, measured), _), result) in asked_for().zip(results) {
            let stored = self.keep_one(*lane, asked, info, measured, result, environment.as_ref())?;
            any |= stored.result.n > 0;
            nothing.get_or_insert_with(|| stored.result.outcome.message.clone());
            self.end_lane(*lane, stored)?;
        }
        if preview.is_none() {
            self.log.wait(self.inner.store.preview_of_run(&self.row.id, None))?;
        }
        match nothing {
            // The outcomes are for the visitor and name no paths, so this is not a fault to be hidden.
            Some(cause) if !any => Err(EngineError::Invalid(format!("No algorithm could be measured. {cause}"))),
            _ => Ok(End::Done),
        }
    }

    fn keep_one(
        &mut self,
        lane: usize,
        asked: Asked,
        info: &SetInfo,
        measured: &Measured,
        result: AlgorithmResult,
        environment: Option<&Environment>,
    ) -> Result<StoredResult> {
        let algorithm = &measured.contestant.info;
        let of = RecordsOf {
            run: &self.row.id,
            algorithm: &algorithm.id,
            plugin_sha256: &algorithm.plugin_sha256,
            hardware_class: environment.map_or("", |e| &e.hardware_class),
            set_sha256: &info.sha256,
        };
        let _keeping = self.log.wait(self.inner.blobs.keeping());
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
        let stored = StoredResult {
            result,
            records,
            triangle_tests,
            plugin_sha256: algorithm.plugin_sha256.clone(),
            seconds_per_query: measured.seconds_per_query,
        };
        let triangles = (asked.pair.a().triangles().len() + asked.pair.b().triangles().len()) as u64;
        self.log.wait(self.inner.store.keep_result(&self.row.id, lane, &stored, triangles, self.row.spec.query))?;
        Ok(stored)
    }

    fn end_lane(&mut self, lane: usize, stored: StoredResult) -> Result<()> {
        let result = stored.result;
        let failed = !result.outcome.completed();
        let message = if failed {
            Some(result.outcome.message.clone())
        } else {
            result
                .budget_limited
                .then(|| format!("The time limit was reached after {} of {} configurations.", result.n, result.of))
        };
        let state = if failed { State::Failed } else { State::Done };
        self.inner.under_way.stored(lane);
        self.log.end(FIRST_MEASURING + lane, state, message, Some(result))
    }

    /// Everything that preliminary results of this run need.
    fn looking(&self) -> Result<Looking<'a>> {
        let reference = crate::runs::spec::reference(&self.row.spec, &self.inner.registry);
        Ok(Looking::new(self.inner, self.stop, &self.row, self.contestants()?, reference))
    }

    /// The algorithms may have changed since the run was asked for, by a restart with other plugins.
    fn contestants(&self) -> Result<Vec<Arc<Contestant>>> {
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

    /// Aggregates every algorithm onto the vertices once, so that the first look at the run is quick.
    fn heatmaps(&mut self) -> Result<()> {
        let lane = FIRST_MEASURING + self.row.spec.algorithms.len();
        let results = self.log.wait(self.inner.store.results(&self.row.id))?;
        let measured: Vec<_> = results.iter().filter(|r| r.records.is_some()).collect();
        let total = measured.len() as u64;
        self.log.start(lane, total)?;
        for (done, stored) in (1..).zip(measured) {
            let request = crate::results::first_look(&stored.result.algorithm);
            self.log.wait(self.inner.heatmap(&self.row.id, &request))?;
            self.log.progress(lane, done, total)?;
        }
        self.log.end(lane, State::Done, None, None)
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
