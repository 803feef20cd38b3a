//! Preliminary results of a run: a first look at every algorithm before the rounds, and then the results of the rounds so
//! far. None of it is stored, ranked or used again.
//!
//! A first look asks a fresh process of its own, in a state that is thrown away, so that no process of the rounds has seen a
//! question before and no number of theirs has an answer of it. It gives an algorithm a moment and no more: one that builds
//! or answers slowly is seen later, and does not keep the others from being seen.
//!
//! The rounds are shown between two processes, when nothing is measured.

use std::sync::mpsc::{Sender, channel};
use std::time::{Duration, Instant};

use ocb_core::comparison::compare;
use ocb_core::configuration::ConfigurationSet;
use ocb_sandbox::Policy;
use serde::{Deserialize, Serialize};

use super::process_pass::{ProcessPass, Purpose};
use super::summary::preliminary;
use super::{Asked, Measured, MeasuringState, News, Part, Stop, Task, pace};
use crate::algorithm::{Algorithm, Runner};
use crate::columns::RecordColumns;
use crate::machine::Machine;
use crate::model::AlgorithmResult;

/// A first look asks so many questions at most: a few hundred colour an object.
pub const QUESTIONS: usize = 300;
/// It asks for so long at most.
pub const TIME: Duration = Duration::from_millis(150);
/// It gives an algorithm so long to load, to build, and to answer one question.
const PATIENCE: Duration = Duration::from_millis(700);
/// A run of fewer configurations than this is not looked at before it has ended.
const LEAST: usize = 100;

/// Results of the rounds so far are shown no more often than this, and never for more than a twentieth of the time.
const SHOW_EVERY: Duration = Duration::from_secs(1);
const SHARE: u32 = 20;
/// And so many configurations of it at most: the beginning of the shared order, which is a fair sample.
const MOST: usize = 10_000;

/// Seconds to begin a process beside what the plugin does.
const START: f64 = 0.2;

/// Number of the processes that only look. No round has it.
const PROCESS: u32 = u32::MAX;

/// Preliminary results of one algorithm.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Preliminary {
    /// Its numbers, without a rank.
    pub result: AlgorithmResult,
    /// Its records so far.
    pub records: RecordColumns,
    /// After a first look: seconds that all of its measuring will take.
    pub seconds: Option<f64>,
}

/// The limits of a process that only looks.
pub fn limits() -> Policy {
    let patience = PATIENCE.as_secs_f64();
    Policy {
        load_seconds: patience,
        build_seconds: patience,
        query_seconds: patience,
        trial_seconds: 4.0 * patience,
        ..Policy::default()
    }
}

/// Is there anything to see before a run of so many configurations has ended?
pub fn worth_a_look(configurations: u64) -> bool {
    configurations >= LEAST as u64
}

/// Shows what each algorithm answers to the first questions of the task's order. The task may have the beginning of its set
/// only. The algorithms that answered nothing in time are left out.
pub fn first_look(
    task: &Task,
    runner: &Runner,
    machine: &Machine,
    stop: &Stop,
    show: &mut dyn FnMut(usize, Preliminary),
) {
    let _quiet = machine.keep_off();
    let numbers = task.first(QUESTIONS);
    let placed = numbers.iter().map(|number| *task.placed(*number)).collect();
    let set = &ConfigurationSet { placed, ..empty(task.set) };
    let part = Part { precision: None, at_most: usize::MAX, of: task.part.of };
    let whole = task;
    let task = &Task { set, controls: &[], passes: 1, budget: TIME, part, ..*task };
    // As counting sees them.
    let (shown, base) = (task.as_it_is(), (0..set.placed.len() as u32).collect::<Vec<_>>());
    let mut of_reference: Option<Measured> = None;
    // Seen before the reference was.
    let mut earlier: Vec<(usize, Measured)> = Vec::new();
    let seen = |index: usize, measured: &Measured, of_reference: Option<&Measured>| {
        let mut seen = task.preliminary(measured, of_reference, &base);
        seen.records.configuration.iter_mut().for_each(|place| *place = numbers[*place as usize]);
        Preliminary { seconds: Some(whole.seconds(index, measured)), ..seen }
    };
    for (index, algorithm) in task.with_reference().enumerate() {
        let mut state = MeasuringState::new(algorithm.clone(), &task.slack(algorithm), base.len());
        // How far it is stays untold: it is not under way yet.
        let (news, _) = channel();
        let (piece, purpose) = (task.piece(0, base.len()), Purpose::Look);
        let (base, shown, process) = (&base, shown.to(state.precision()), PROCESS);
        let pass = ProcessPass {
            task,
            runner,
            machine,
            stop,
            news: &news,
            index,
            purpose,
            elsewhere: false,
            process,
            base,
            piece,
            shown,
        };
        pass.run(&mut state, &pass.piece);
        if stop.asked() {
            return;
        }
        if state.ended() || state.done == 0 {
            continue;
        }
        let measured = state.so_far(base);
        let is_reference = task.is_reference(algorithm);
        if is_reference {
            earlier.drain(..).for_each(|(index, before)| show(index, seen(index, &before, Some(&measured))));
        }
        let compared_with = if is_reference { Some(&measured) } else { of_reference.as_ref() };
        if index < task.algorithms.len() {
            show(index, seen(index, &measured, compared_with));
        }
        if is_reference {
            of_reference = Some(measured);
        } else if of_reference.is_none() {
            earlier.push((index, measured));
        }
    }
}

/// The same set without its configurations.
fn empty(set: &ConfigurationSet) -> ConfigurationSet {
    ConfigurationSet { method: set.method.clone(), placed: Vec::new(), ..*set }
}

/// Shows the results of the rounds so far now and then.
pub struct Showing<'a> {
    task: &'a Task<'a>,
    news: &'a Sender<News>,
    /// The configurations that are shown.
    numbers: &'a [u32],
    /// Indices of the algorithms with something new.
    waiting: Vec<usize>,
    shown: Instant,
    took: Duration,
}

impl<'a> Showing<'a> {
    /// In this order.
    pub fn new(task: &'a Task, news: &'a Sender<News>, base: &'a [u32]) -> Self {
        let numbers = &base[..task.most().min(MOST)];
        Self { task, news, numbers, waiting: Vec::new(), shown: Instant::now(), took: Duration::ZERO }
    }

    /// An algorithm has ended a process, and nothing is measured now.
    pub fn after_process(&mut self, states: &[MeasuringState], index: usize) {
        if !self.task.watched || !worth_a_look(self.numbers.len() as u64) {
            return;
        }
        if self.task.is_reference(&states[index].algorithm) {
            // All others are compared with it.
            self.waiting = (0..self.task.algorithms.len()).collect();
        } else if !self.waiting.contains(&index) {
            self.waiting.push(index);
        }
        if self.shown.elapsed() < SHOW_EVERY.max(SHARE * self.took) {
            return;
        }
        let begun = Instant::now();
        let reference = states.iter().find(|state| self.task.is_reference(&state.algorithm));
        let of_reference = reference.map(|state| state.so_far(self.numbers));
        for index in self.waiting.drain(..) {
            let measured = states[index].so_far(self.numbers);
            if !measured.records.is_empty() {
                let preliminary = self.task.preliminary(&measured, of_reference.as_ref(), self.numbers);
                let _ = self.news.send(News::Preliminary { index, preliminary: Box::new(preliminary) });
            }
        }
        (self.took, self.shown) = (begun.elapsed(), Instant::now());
    }
}

impl Task<'_> {
    fn is_reference(&self, algorithm: &Algorithm) -> bool {
        self.reference.is_some_and(|reference| reference.info.id == algorithm.info.id)
    }

    /// Seconds that the algorithm will take for everything, by what it took in a first look.
    fn seconds(&self, index: usize, seen: &Measured) -> f64 {
        let counted = seen.algorithm.info.counters && index < self.algorithms.len();
        let start: f64 = seen.set_ups.iter().map(|it| (it.load_ns + it.build_ns) / 1e9).sum::<f64>() + START;
        let query = seen.seconds_per_query.unwrap_or(f64::INFINITY);
        let configurations = self.part.of.min(self.part.at_most as u64);
        pace::cost(configurations, self.passes, self.budget.as_secs_f64(), counted, query, start).seconds
    }

    /// Preliminary results for these configurations; the records have their places in `numbers`.
    fn preliminary(&self, measured: &Measured, reference: Option<&Measured>, numbers: &[u32]) -> Preliminary {
        let compared = compare(&measured.times, reference.map(|r| &r.times[..]), self.passes, self.part.of);
        let placed: Vec<_> = numbers.iter().map(|number| *self.placed(*number)).collect();
        let asked = Asked {
            pairing: self.pairing,
            placed: &placed,
            query: self.query,
            semantics: self.semantics,
            controls: &[],
            coherent: self.coherent(),
        };
        let result = AlgorithmResult { of: self.part.of as u32, ..preliminary(measured, asked, compared) };
        let mut records = RecordColumns::of(&measured.records);
        records.configuration.iter_mut().for_each(|place| *place = numbers[*place as usize]);
        Preliminary { result, records, seconds: None }
    }
}
