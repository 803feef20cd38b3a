//! A benchmark on whatever machine this is: from a configuration set to results and their files.
//!
//! It knows neither where its input comes from nor where its results go, so that the service and a measuring machine share it.

use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use ocb_core::comparison::{Comparison, compare};
use ocb_core::configuration::ConfigurationSet;
use ocb_core::sampling::controls::{self, Control};

use crate::algorithm::{Algorithm, Runner};
use crate::columns::{RecordsOf, records_parquet, triangle_tests_parquet};
use crate::machine::{Machine, MakingWay, MeasuringRight};
use crate::measure::{self, Asked, Measured, News, Preliminary, Stop, Task};
use crate::model::{AlgorithmResult, Draw, Environment, Preview, SetInfo};
use crate::{LabError, Result};

/// How often the waiting thread looks up.
const TICK: Duration = Duration::from_millis(200);

/// What is measured, and how its files are marked.
pub struct Job<'a> {
    /// The task; its control questions are drawn here.
    pub task: Task<'a>,
    /// The seed of the processes that look at the algorithms before the rounds, if that is wanted.
    pub look: Option<u64>,
    /// The configuration set as it is stored.
    pub set: &'a SetInfo,
    /// Id of the run.
    pub run: &'a str,
    /// How the seed came about.
    pub draw: Draw,
}

/// Where a job is measured, and how it is stopped.
pub struct Place<'a> {
    /// What loads plugins.
    pub runner: &'a Runner,
    /// This machine.
    pub machine: &'a Machine,
    /// Ends the job early.
    pub stop: &'a Stop,
}

/// What happens while a job is measured.
pub enum Step {
    /// Another process measures on this machine, and the job waits for it; or it does not wait any more.
    Waiting(bool),
    /// The algorithm at this place has answered so many of its expected queries, after so much work of its own. The place behind
    /// the last one is that of a reference algorithm that was not asked for. A total of 0 is not known yet.
    Progress {
        /// Place in the list of algorithms.
        place: usize,
        /// Queries answered.
        done: u64,
        /// Queries expected.
        total: u64,
        /// Time at work.
        worked: Duration,
    },
    /// The algorithm at this place has results that may still change.
    Preliminary(usize, Box<Preliminary>),
}

/// The result of one algorithm, with its files.
pub struct Found {
    /// Its numbers.
    pub result: AlgorithmResult,
    /// Its records as Parquet; absent when nothing was measured.
    pub records: Option<Vec<u8>>,
    /// Its tests per triangle as Parquet; absent when they were not counted.
    pub triangle_tests: Option<Vec<u8>>,
    /// SHA-256 of the plugin file that was measured.
    pub plugin_sha256: String,
    /// Wall seconds of one query with everything around it, for estimates.
    pub seconds_per_query: Option<f64>,
}

/// What a job found.
pub struct Results {
    /// Of each algorithm that was asked for, in their order.
    pub algorithms: Vec<Found>,
    /// The machine; absent when nothing was measured.
    pub environment: Option<Environment>,
    /// What the results are a preview of; absent when all configurations were measured.
    pub preview: Option<Preview>,
}

/// Measures the job; `None` when it was stopped. An error of `tell` ends the job with it, when its thread has ended.
pub fn measure<E: From<LabError>>(
    job: Job<'_>,
    place: &Place<'_>,
    tell: &mut dyn FnMut(Step) -> Result<(), E>,
) -> Result<Option<Results>, E> {
    let Place { runner, machine, stop } = *place;
    let controls = draw_controls(&job.task, place)?;
    let Some(_right) = right_to_measure(stop, tell)? else { return Ok(None) };
    let task = Task { controls: &controls, ..job.task };
    let (sender, news) = mpsc::channel();
    let (mut preview, mut finished) = (None, Vec::new());
    let told = thread::scope(|scope| -> Result<(), E> {
        let worker = thread::Builder::new().name("measuring".into());
        let task = &task;
        let worker = worker
            .spawn_scoped(scope, move || {
                if let Some(seed) = job.look.filter(|_| measure::worth_a_look(task.part.most(task.set) as u64)) {
                    let task = Task { seed, controls: &[], ..*task };
                    measure::first_look(&task, runner, machine, stop, &mut |index, seen| {
                        let _ = sender.send(News::Preliminary { index, preliminary: Box::new(seen) });
                    });
                }
                measure::measure(task, runner, machine, stop, &sender);
            })
            .map_err(|e| LabError::fault("Starting the measuring thread failed", e))?;
        let mut told = Ok(());
        loop {
            let step = match news.recv_timeout(TICK) {
                Ok(News::Progress { index, done, total, worked }) => {
                    Step::Progress { place: index, done, total, worked }
                }
                Ok(News::Preliminary { index, preliminary }) => Step::Preliminary(index, preliminary),
                Ok(News::Preview(found)) => {
                    preview = Some(found);
                    continue;
                }
                Ok(News::Finished { index, measured }) => {
                    finished.push((index, *measured));
                    continue;
                }
                Err(RecvTimeoutError::Timeout) => continue,
                Err(RecvTimeoutError::Disconnected) => break,
            };
            if told.is_ok() {
                told = tell(step);
                if told.is_err() {
                    stop.stop();
                }
            }
        }
        worker.join().map_err(|_| LabError::Fault("The measuring thread failed.".into()))?;
        told
    });
    told?;
    if stop.asked() {
        return Ok(None);
    }
    let marks = (job.run, job.set, job.draw);
    Ok(Some(Results { preview, ..results(&task, marks, place, finished)? }))
}

/// Draws the control questions on all CPUs; fewer when it is stopped meanwhile.
fn draw_controls(task: &Task<'_>, place: &Place<'_>) -> Result<Vec<Control>> {
    let Task { pairing, set, query, semantics, seed, part, .. } = *task;
    let set: &ConfigurationSet = set;
    let stopped = || place.stop.asked();
    thread::scope(|scope| {
        let mut way = MakingWay::begin(place.machine);
        let worker = scope.spawn(|| {
            let plan = controls::Plan::new(pairing.exact.pair(), set, query, semantics, seed);
            measure::draw_controls(&plan, pairing, set, part.most(set), &stopped)
        });
        while !worker.is_finished() {
            thread::sleep(TICK.min(Duration::from_millis(5)));
            way.look();
        }
        worker.join().map_err(|_| LabError::Fault("Drawing the control questions failed.".into()))
    })
}

/// Waits until no other process measures on this machine; `None` when stopped.
fn right_to_measure<E: From<LabError>>(
    stop: &Stop,
    tell: &mut dyn FnMut(Step) -> Result<(), E>,
) -> Result<Option<MeasuringRight>, E> {
    let mut noted = None;
    let right = stop.right_to_measure(|| noted = Some(tell(Step::Waiting(true))))?;
    if let Some(noted) = noted {
        noted?;
        tell(Step::Waiting(false))?;
    }
    Ok(right)
}

fn results(
    task: &Task<'_>,
    (run, set, draw): (&str, &SetInfo, Draw),
    place: &Place<'_>,
    finished: Vec<(usize, Measured)>,
) -> Result<Results> {
    let asked = Asked {
        pairing: task.pairing,
        placed: &task.set.placed,
        query: task.query,
        semantics: task.semantics,
        controls: task.controls,
        coherent: measure::is_coherent(&task.set.method),
    };
    let reference = task.reference.map(|reference| &reference.info);
    let of_reference = finished.iter().find(|(_, m)| Some(&m.algorithm.info.id) == reference.map(|r| &r.id));
    let of_reference = of_reference.map(|(_, measured)| measured);
    let times = of_reference.map(|measured| &measured.times[..]);
    let compared: Vec<Option<Comparison>> =
        finished.iter().map(|(_, m)| compare(&m.times, times, task.passes, task.part.of)).collect();
    let all: Vec<&Measured> = finished.iter().map(|(_, measured)| measured).collect();
    let environment = measure::environment(place.machine, place.runner.profile, &all, reference, draw);
    let is_asked_for = |index: &usize| *index < task.algorithms.len();
    let mut results: Vec<AlgorithmResult> = finished
        .iter()
        .zip(&compared)
        .filter(|((index, _), _)| is_asked_for(index))
        .map(|((_, measured), compared)| measure::summarise(measured, asked, *compared, of_reference))
        .collect();
    measure::rank(&mut results, place.runner.profile);
    let asked_for = finished.into_iter().filter(|(index, _)| is_asked_for(index)).map(|(_, measured)| measured);
    let marks = (run, set, environment.as_ref().map_or("", |e| &e.hardware_class));
    let algorithms =
        asked_for.zip(results).map(|(measured, result)| files(marks, measured, result)).collect::<Result<_>>()?;
    Ok(Results { algorithms, environment, preview: None })
}

/// The files of one algorithm; its records are no longer needed then.
fn files((run, set, class): (&str, &SetInfo, &str), measured: Measured, result: AlgorithmResult) -> Result<Found> {
    let algorithm: &Algorithm = &measured.algorithm;
    let of = RecordsOf {
        run,
        algorithm: &algorithm.info.id,
        plugin_sha256: &algorithm.info.plugin_sha256,
        hardware_class: class,
        set_sha256: &set.sha256,
        rounded: set.rounding.map(|_| result.rounded),
    };
    let any = !measured.records.is_empty();
    let counted = measured.triangle_tests.as_ref().filter(|_| any);
    Ok(Found {
        records: any.then(|| records_parquet(&of, &measured.records)).transpose()?,
        triangle_tests: counted.map(|counted| triangle_tests_parquet(&of, counted)).transpose()?,
        plugin_sha256: algorithm.info.plugin_sha256.clone(),
        seconds_per_query: measured.seconds_per_query,
        result,
    })
}
