//! Measuring: plain blocking code on one thread of its own.
//!
//! The algorithms take turns, one pass each per round, so that a slow drift of the machine meets all of them alike; the
//! reference algorithm takes part in every round, whether it was asked for or not. Every pass is a fresh jailed process
//! that sees an equivalent instance of the objects and of every question ([`Presentation`]). All share one shuffled
//! order; an algorithm whose budget ends measures a prefix of it. A trajectory keeps its own order: that each
//! configuration is near the one before is what it is for.
//!
//! The rounds see the unit of the files, and what is ranked comes from them alone: times, building, waiting, integrity. The
//! questions they reached, the first of them where they are many, are then asked in a smaller and a larger unit
//! ([`OTHER_UNITS`]). An answer that is wrong in any unit is wrong; how time and answers depend on the unit is told apart
//! (`by_unit.rs`).
//!
//! Algorithms in single precision see the objects rounded to it, where that makes a difference, and are judged by the truth
//! about what they saw ([`Pairing`]).
//!
//! Control questions are mixed into every timed pass (`weave.rs`). Their numbers follow those of the set's configurations;
//! they are answered and judged like these, and nothing else is made of them.
//!
//! A run that asks for a precision takes the order piece by piece, all rounds of a piece before the next one, and looks
//! after each whether the comparison is settled ([`ocb_core::sequential`]).

mod by_unit;
mod contract;
mod controls;
mod look;
mod order;
mod pace;
mod preview;
mod process_pass;
mod state;
mod stop;
mod summary;
pub(crate) mod surplus;
mod waiting;
mod weave;

use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

use ocb_core::configuration::{Configuration, ConfigurationSet, Method, Placed};
use ocb_core::instance::{OTHER_UNITS, Presentation};
use ocb_core::mesh::Mesh;
use ocb_core::numbers::Numbers;
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling::controls::Control;
use ocb_core::validation::Precision;
use ocb_core::{sampling, sequential};
use ocb_sandbox::Outcome;

use crate::algorithm::{Algorithm, Runner};
use crate::machine::Machine;
use crate::model::{OutcomeInfo, OutcomeName, Preview, RunSpec};
use crate::pairing::{Pairing, Sides};
use crate::{LabError, Result};

pub use by_unit::asked_in_another_unit;
pub use controls::draw as draw_controls;
use look::Showing;
pub use look::{Preliminary, QUESTIONS, first_look, worth_a_look};
pub use pace::{Cost, cost};
use process_pass::{ProcessPass, Purpose};
pub(crate) use process_pass::{allowed, limits};
pub use state::{Measured, MeasuringState, precision};
pub use stop::Stop;
pub use summary::{Asked, environment, rank, summarise};
use weave::Piece;

/// What is measured.
pub struct Task<'a> {
    /// The objects.
    pub pairing: &'a Pairing,
    /// The configurations with their truth.
    pub set: &'a ConfigurationSet,
    /// Asked among them, in this order: questions whose answers the set does not give away.
    pub controls: &'a [Control],
    /// The question.
    pub query: Query,
    /// What counts as an object.
    pub semantics: Semantics,
    /// Timed passes.
    pub passes: u32,
    /// Measuring time allowed per algorithm.
    pub budget: Duration,
    /// Seed of everything that is drawn: orders, instances, blocks.
    pub seed: u64,
    /// The algorithms.
    pub algorithms: &'a [Arc<Algorithm>],
    /// What all of them are compared with; it may be one of them.
    pub reference: Option<&'a Arc<Algorithm>>,
    /// Where to stop before all configurations are measured.
    pub part: Part,
    /// Somebody may look at it before it has ended.
    pub watched: bool,
    /// The order of the set is kept.
    pub in_order: bool,
    /// Only the timed rounds: neither other units nor counters.
    pub rounds_only: bool,
}

/// What is wanted of a run that need not measure everything.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Stop when the comparison is settled, where differences below this share do not matter.
    pub precision: Option<f64>,
    /// Measure so many configurations at most.
    pub at_most: usize,
    /// Configurations of the whole run; the set may hold its beginning only.
    pub of: u64,
}

impl Part {
    /// What the request says of this set.
    pub fn of(spec: &RunSpec, set: &ConfigurationSet) -> Self {
        let found = set.placed.len() as u64;
        let whole = if spec.finding() == spec.method { Ok(found) } else { sampling::count(&spec.method) };
        let at_most = spec.at_most.map_or(usize::MAX, |at_most| at_most as usize);
        Self { precision: spec.precision, at_most, of: whole.unwrap_or(found) }
    }

    /// Configurations of this set that are measured at most.
    pub fn most(&self, set: &ConfigurationSet) -> usize {
        set.placed.len().min(self.at_most)
    }
}

/// News for whoever reports the progress.
pub enum News {
    /// An algorithm has answered so many of its expected questions.
    Progress {
        /// Which algorithm; their number stands for a reference that is none of them.
        index: usize,
        /// Questions answered.
        done: u64,
        /// Questions expected in all; 0 while that cannot be told.
        total: u64,
        /// How long it was asked.
        worked: Duration,
    },
    /// The run has ended before all configurations were measured.
    Preview(Preview),
    /// An algorithm has something to show that may still change.
    Preliminary {
        /// Which algorithm.
        index: usize,
        /// Its numbers and records so far.
        preliminary: Box<Preliminary>,
    },
    /// An algorithm will not change any more.
    Finished {
        /// Which algorithm; their number stands for a reference that is none of them.
        index: usize,
        /// All that was measured.
        measured: Box<Measured>,
    },
}

/// A pass that lost more than this share of its time to the machine below is measured again, once; when the second loses
/// as much, that is how this machine is, and no pass of the run is measured again. Nor is a first pass that the budget cut: it
/// says how far the algorithm comes, and another try may come nowhere.
pub(crate) const STEAL: f64 = 0.001;

impl<'a> Task<'a> {
    /// What a request asks for; seed and control questions come on top.
    pub fn of(
        spec: &RunSpec,
        (pairing, set, part): (&'a Pairing, &'a ConfigurationSet, Part),
        algorithms: &'a [Arc<Algorithm>],
        reference: Option<&'a Arc<Algorithm>>,
    ) -> Self {
        Self {
            pairing,
            set,
            controls: &[],
            query: spec.query,
            semantics: spec.semantics,
            passes: spec.passes,
            budget: Duration::from_secs_f64(spec.budget_seconds),
            seed: 0,
            algorithms,
            reference,
            part,
            watched: false,
            in_order: is_coherent(&set.method),
            rounds_only: false,
        }
    }
}

impl Task<'_> {
    fn coherent(&self) -> bool {
        self.in_order
    }
}

/// Measures all algorithms, with nobody who looks on; `None` when stopped.
///
/// # Errors
/// `Fault` when the measuring thread fails.
pub fn to_end(task: &Task, runner: &Runner, machine: &Machine, stop: &Stop) -> Result<Option<Vec<(usize, Measured)>>> {
    let (sender, news) = channel();
    let mut finished = Vec::new();
    thread::scope(|scope| {
        // A thread of its own: a jail ends with the thread that started it.
        let worker = scope.spawn(|| {
            let sender = sender;
            measure(task, runner, machine, stop, &sender);
        });
        while let Ok(news) = news.recv() {
            if let News::Finished { index, measured } = news {
                finished.push((index, *measured));
            }
        }
        worker.join().map_err(|_| LabError::Fault("The measuring thread failed.".into()))
    })?;
    Ok((!stop.asked()).then_some(finished))
}

/// Measures all algorithms and sends what happens; returns early when stopped.
pub fn measure(task: &Task, runner: &Runner, machine: &Machine, stop: &Stop, news: &Sender<News>) {
    let _quiet = machine.keep_off();
    let n = task.set.placed.len();
    let mut states: Vec<MeasuringState> =
        task.with_reference().map(|c| MeasuringState::new(c.clone(), &task.slack(c), n)).collect();
    let base = task.first(n);
    let mut showing = Showing::new(task, news, &base);
    let elsewhere = !task.rounds_only && task.instance(0).is_scaled();
    let passes = Passes { task, runner, machine, stop, news, base: &base, elsewhere };
    let mut steady = true;
    let (mut measured, mut looks) = (0, 0);
    for end in task.looks() {
        for round in 0..task.passes {
            let process = OTHER_UNITS.len() as u32 + looks * task.passes + round;
            let purpose = Purpose::Official(round);
            let shown = task.instance(process);
            for index in 0..states.len() {
                let state = &mut states[index];
                let shown = shown.to(state.precision());
                let pass = passes.pass(index, purpose, process, task.piece(measured, end), shown);
                let part = pass.part(state);
                if state.ended() || part.is_empty() {
                    continue;
                }
                let spent = state.spent;
                let steal = pass.run(state, &part);
                let cut_now = round == 0 && state.cut;
                if steal > STEAL && steady && !cut_now && !stop.asked() {
                    state.forget(round, &pass.order(&part));
                    state.spent = spent;
                    steady = pass.run(state, &pass.part(state)) <= STEAL;
                }
                if stop.asked() {
                    return;
                }
                showing.after_process(&states, index);
            }
        }
        (measured, looks) = (end, looks + 1);
        if task.part.precision.is_some() && preview::preview(task, &states, measured, looks).settled {
            break;
        }
    }
    passes.elsewhere(&mut states);
    if stop.asked() {
        return;
    }
    let shown = task.as_it_is();
    let counted = if task.rounds_only { 0 } else { task.algorithms.len() };
    for (index, state) in states.iter_mut().enumerate().take(counted) {
        // What is counted is no time, and controls have no counters.
        let process = OTHER_UNITS.len() as u32 + looks * task.passes;
        let piece = Piece { own: 0..state.reach.own, controls: 0..0 };
        let pass = passes.pass(index, Purpose::Counting, process, piece, shown.to(state.precision()));
        if !state.ended() && state.algorithm.info.counters {
            pass.run(state, &pass.piece);
        }
        if stop.asked() {
            return;
        }
        let _ = news.send(News::Progress { index, done: state.done, total: state.done, worked: state.spent });
    }
    if (measured as u64) < task.part.of {
        let _ = news.send(News::Preview(preview::preview(task, &states, measured, looks)));
    }
    for (state, index) in states.into_iter().zip(0..) {
        // The receiver is gone only when nobody wants the run any more.
        let _ = news.send(News::Finished { index, measured: Box::new(state.into_measured()) });
    }
}

/// What all passes of a run share.
struct Passes<'a> {
    task: &'a Task<'a>,
    runner: &'a Runner,
    machine: &'a Machine,
    stop: &'a Stop,
    news: &'a Sender<News>,
    base: &'a [u32],
    /// The coordinates can be scaled, so other units are asked as well.
    elsewhere: bool,
}

impl Passes<'_> {
    fn pass<'t>(
        &'t self,
        index: usize,
        purpose: Purpose,
        process: u32,
        piece: Piece,
        shown: &'t Presentation,
    ) -> ProcessPass<'t> {
        let Self { task, runner, machine, stop, news, base, elsewhere } = *self;
        ProcessPass { task, runner, machine, stop, news, index, purpose, elsewhere, process, base, piece, shown }
    }

    /// Asks in other units what the rounds asked in the unit of the files.
    fn elsewhere(&self, states: &mut [MeasuringState]) {
        for process in (0..OTHER_UNITS.len() as u32).filter(|_| self.elsewhere) {
            let shown = self.task.instance(process);
            for (index, state) in states.iter_mut().enumerate() {
                let piece = self.task.half(state.reach.own, process as usize >= OTHER_UNITS.len() / 2);
                let pass = self.pass(index, Purpose::Elsewhere, process, piece, shown.to(state.precision()));
                let part = pass.part(state);
                if !state.ended() && !part.is_empty() {
                    pass.run(state, &part);
                }
                if self.stop.asked() {
                    return;
                }
            }
        }
    }
}

impl Task<'_> {
    /// Configurations that are measured unless something ends it sooner.
    fn most(&self) -> usize {
        self.part.most(self.set)
    }

    /// This part of the set's order, and the controls that go with it.
    fn piece(&self, from: usize, to: usize) -> Piece {
        Piece { own: from..to, controls: self.controls_before(from)..self.controls_before(to) }
    }

    /// One half of what is asked in each other unit when `own` questions were asked in the unit of the files: two processes share
    /// it, so that one slow moment of the machine does not look like a slow unit.
    fn half(&self, own: usize, second: bool) -> Piece {
        let asked = asked_in_another_unit(own);
        let middle = asked.div_ceil(2);
        if second { self.piece(middle, asked) } else { self.piece(0, middle) }
    }

    /// Questions in all other units together when `own` were asked in the unit of the files.
    fn elsewhere(&self, own: usize) -> u64 {
        let questions = |process: usize| self.half(own, process >= OTHER_UNITS.len() / 2).questions() as u64;
        (0..OTHER_UNITS.len()).map(questions).sum()
    }

    fn controls_before(&self, own: usize) -> usize {
        if self.coherent() {
            return self.controls.partition_point(|control| (control.from as usize) < own);
        }
        (own * self.controls.len()).div_ceil(self.most().max(1))
    }

    /// A configuration of the set, or a control behind all of them.
    fn placed(&self, number: u32) -> &Placed {
        let number = number as usize;
        self.set.placed.get(number).unwrap_or_else(|| &self.controls[number - self.set.placed.len()].placed)
    }

    /// After how many configurations it is looked whether the comparison is settled.
    fn looks(&self) -> Vec<usize> {
        let most = self.most();
        self.part.precision.map_or_else(|| vec![most], |_| sequential::looks(most))
    }

    /// The first so many configurations of the order that all algorithms share.
    fn first(&self, most: usize) -> Vec<u32> {
        let n = self.set.placed.len();
        let mut order = match self.coherent() {
            true => (0..n as u32).collect(),
            false => order::stratified(&self.set.placed.iter().map(order::hardness).collect::<Vec<_>>(), self.seed),
        };
        order.truncate(most);
        order
    }

    /// The algorithms, and behind them the reference where it is none of them.
    fn with_reference(&self) -> impl Iterator<Item = &Arc<Algorithm>> {
        let apart = self.reference.filter(|r| self.algorithms.iter().all(|c| c.info.id != r.info.id));
        self.algorithms.iter().chain(apart)
    }

    /// Two right distances may lie so far apart: both may miss the certified interval by tau.
    fn slack(&self, algorithm: &Algorithm) -> Vec<f64> {
        let precision = precision(&algorithm.info);
        let (pair, unit) = (self.pairing.seen_in(precision).pair(), precision.unit_roundoff());
        let of = |p: &Placed| {
            let truth = p.seen_in(precision).truth;
            2.0 * pair.tau(&p.configuration, unit) + (truth.distance_hi - truth.distance_lo)
        };
        self.set.placed.iter().chain(self.controls.iter().map(|control| &control.placed)).map(of).collect()
    }

    fn as_it_is(&self) -> Shown {
        self.shown(Presentation::original)
    }

    /// The same for all algorithms in their processes of this number. It depends on the set and not on the controls, so that a
    /// replay, which has only the set, sees the same.
    fn instance(&self, process: u32) -> Shown {
        let configurations = || self.set.placed.iter().map(|placed| &placed.configuration);
        self.shown(|a, b| shown(a, b, configurations(), self.coherent(), self.seed, process))
    }

    fn shown(&self, present: impl Fn(&Mesh, Option<&Mesh>) -> Presentation) -> Shown {
        let of = |sides: &Sides| present(&sides.mesh_a, (!self.pairing.same).then_some(&*sides.mesh_b));
        let wanted = self.with_reference().any(|algorithm| algorithm.info.single_precision);
        let rounded = self.pairing.rounded.as_ref().filter(|_| wanted).map(of);
        Shown { exact: of(&self.pairing.exact), rounded }
    }

    fn process_seed(&self, process: u32) -> u64 {
        process_seed(self.seed, process)
    }
}

/// How the processes of one number see the objects: in the numbers of the files, and rounded where algorithms in single
/// precision get others.
struct Shown {
    exact: Presentation,
    rounded: Option<Presentation>,
}

impl Shown {
    fn to(&self, precision: Precision) -> &Presentation {
        self.rounded.as_ref().filter(|_| precision == Precision::Single).unwrap_or(&self.exact)
    }

    /// All are asked in another unit, or none is.
    fn is_scaled(&self) -> bool {
        [Some(&self.exact), self.rounded.as_ref()].into_iter().flatten().all(|it| it.scale() != 1.0)
    }
}

/// How the processes of this number in a run of this seed see the objects; `b` is absent when both are one.
pub fn shown<'c>(
    a: &Mesh,
    b: Option<&Mesh>,
    configurations: impl Iterator<Item = &'c Configuration>,
    coherent: bool,
    seed: u64,
    process: u32,
) -> Presentation {
    Presentation::drawn(a, b, configurations, coherent, process_seed(seed, process), process)
}

/// The seed of all that is drawn for the process of this number.
pub(crate) fn process_seed(seed: u64, process: u32) -> u64 {
    Numbers::new(seed ^ (u64::from(process) << 40)).bits()
}

/// The order of what this method finds is part of what is measured: each configuration is near the one before.
pub fn is_coherent(method: &Method) -> bool {
    matches!(method, Method::Trajectory { .. })
}

/// An outcome for the pages.
pub fn outcome_info(outcome: &Outcome) -> OutcomeInfo {
    let (mut signal, message) = (None, outcome.to_string());
    let name = match outcome {
        Outcome::Completed => OutcomeName::Completed,
        Outcome::Failed { .. } => OutcomeName::Failed,
        Outcome::LoadError { .. } => OutcomeName::LoadError,
        Outcome::FileReplaced { .. } => OutcomeName::FileReplaced,
        Outcome::Signaled { signal: number, .. } => {
            signal = Some(*number);
            OutcomeName::Signaled
        }
        Outcome::TimedOut { .. } => OutcomeName::TimedOut,
        Outcome::OutOfMemory { .. } => OutcomeName::OutOfMemory,
        Outcome::OutputLimit { .. } => OutcomeName::OutputLimit,
        Outcome::SyscallDenied { .. } => OutcomeName::SyscallDenied,
        Outcome::ProtocolViolation { .. } => OutcomeName::ProtocolViolation,
        Outcome::TimingIntegrity { .. } => OutcomeName::TimingIntegrity,
        Outcome::Cancelled => OutcomeName::Cancelled,
        Outcome::SandboxFault { .. } => OutcomeName::SandboxFault,
    };
    OutcomeInfo { name, signal, message, ours: outcome.ours() }
}
