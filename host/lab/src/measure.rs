//! Measuring: plain blocking code on one thread of its own.
//!
//! The algorithms take turns, one pass each per round, so that a slow drift of the machine meets all of them alike; the
//! reference algorithm takes part in every round, whether it was asked for or not. Every turn is a fresh jailed process
//! that sees an equivalent instance of the objects and of every question ([`Presentation`]). All share one shuffled
//! order; an algorithm whose budget ends measures a prefix of it. A trajectory keeps its own order: that each
//! configuration is near the one before is what it is for.
//!
//! The rounds see the unit of the files, and what is ranked comes from them alone: times, building, waiting, integrity. The
//! questions they reached, the first of them where they are many, are then asked in a smaller and a larger unit
//! ([`OTHER_UNITS`]). An answer that is wrong in any unit is wrong; how time and answers depend on the unit is told apart
//! (`by_unit.rs`).
//!
//! Control questions are mixed into every timed pass (`weave.rs`). Their numbers follow those of the set's configurations;
//! they are answered and judged like these, and nothing else is made of them.
//!
//! A run that asks for a precision takes the order piece by piece, all rounds of a piece before the next one, and looks
//! after each whether the comparison is settled ([`ocb_core::sequential`]).

mod by_unit;
mod contract;
mod controls;
mod lane;
mod look;
mod order;
mod pace;
mod preview;
mod summary;
mod surplus;
mod turn;
mod waiting;
mod weave;

use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use ocb_core::configuration::{Configuration, ConfigurationSet, Method, Placed};
use ocb_core::instance::{OTHER_UNITS, Presentation};
use ocb_core::mesh::Mesh;
use ocb_core::numbers::Numbers;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling::controls::Control;
use ocb_core::{sampling, sequential};
use ocb_sandbox::{Killer, Outcome};

use crate::contestant::{Contestant, Runner};
use crate::machine::Machine;
use crate::model::{OutcomeInfo, OutcomeName, Preview, RunSpec};

pub use by_unit::asked_in_another_unit;
pub use controls::draw as draw_controls;
pub use lane::{Lane, Measured, precision};
use look::Showing;
pub use look::{Preliminary, QUESTIONS, first_look, worth_a_look};
pub use pace::{Cost, cost};
pub use summary::{Asked, environment, rank, summarise};
use turn::{Pass, Turn};
use weave::Piece;

/// Ends the measuring from another thread.
#[derive(Clone, Default)]
pub struct Stop {
    inner: Arc<Mutex<Stopping>>,
}

#[derive(Default)]
struct Stopping {
    asked: bool,
    /// Shown to the owner of the run.
    reason: Option<String>,
    for_now: bool,
    killer: Option<Killer>,
}

impl Stop {
    /// No further question is asked, and the runner under way is killed.
    pub fn stop(&self) {
        self.stop_because(None);
    }

    /// The same, with a reason for the owner of the run; the first reason is kept.
    pub fn stop_because(&self, reason: Option<String>) {
        self.end(reason, false);
    }

    /// The same for work that gives way to other work and begins again later.
    pub fn stop_for_now(&self) {
        self.end(None, true);
    }

    fn end(&self, reason: Option<String>, for_now: bool) {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        if !inner.asked {
            inner.reason = reason;
        }
        // A final stop wins over one for now, in either order.
        inner.for_now = for_now && (inner.for_now || !inner.asked);
        inner.asked = true;
        if let Some(killer) = &inner.killer {
            killer.kill();
        }
    }

    /// It was asked for, and the work begins again later.
    pub fn for_now(&self) -> bool {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).for_now
    }

    /// Why it was asked for.
    pub fn reason(&self) -> Option<String> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).reason.clone()
    }

    /// Was it asked for?
    pub fn asked(&self) -> bool {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).asked
    }

    /// From now on a stop kills this runner.
    fn watch(&self, killer: Option<Killer>) {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        if let (true, Some(killer)) = (inner.asked, &killer) {
            killer.kill();
        }
        inner.killer = killer;
    }
}

/// What is measured.
pub struct Task<'a> {
    /// Object A as the algorithms get it.
    pub mesh_a: &'a Mesh,
    /// Object B.
    pub mesh_b: &'a Mesh,
    /// Object A as the oracle sees it.
    pub a: &'a Shape,
    /// Object B.
    pub b: &'a Shape,
    /// A and B are the same object.
    pub same: bool,
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
    pub contestants: &'a [Arc<Contestant>],
    /// What all of them are compared with; it may be one of them.
    pub reference: Option<&'a Arc<Contestant>>,
    /// Where to stop before all configurations are measured.
    pub part: Part,
    /// Somebody may look at it before it has ended.
    pub watched: bool,
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
    /// A lane has done so many of its expected questions.
    Progress {
        /// Which contestant; their number stands for a reference that is none of them.
        lane: usize,
        /// Questions answered.
        done: u64,
        /// Questions expected in all; 0 while that cannot be told.
        total: u64,
        /// How long it was asked.
        worked: Duration,
    },
    /// The run has ended before all configurations were measured.
    Preview(Preview),
    /// A lane has something to show that may still change.
    Preliminary {
        /// Which contestant.
        lane: usize,
        /// Its numbers and records so far.
        preliminary: Box<Preliminary>,
    },
    /// A lane will not change any more.
    Finished {
        /// Which contestant; their number stands for a reference that is none of them.
        lane: usize,
        /// All that was measured.
        measured: Box<Measured>,
    },
}

/// A pass that lost more than this share of its time to the machine below is measured again, once; when the second loses
/// as much, that is how this machine is, and no pass of the run is measured again. Nor is a first pass that the budget cut: it
/// says how far the algorithm comes, and another try may come nowhere.
const STEAL: f64 = 0.001;

impl Task<'_> {
    fn coherent(&self) -> bool {
        is_coherent(&self.set.method)
    }
}

/// Measures all contestants and sends what happens; returns early when stopped.
pub fn measure(task: &Task, runner: &Runner, machine: &Machine, stop: &Stop, news: &Sender<News>) {
    let _quiet = machine.keep_off();
    let n = task.set.placed.len();
    let mut lanes: Vec<Lane> = task.lanes().map(|c| Lane::new(c.clone(), &task.slack(c), n)).collect();
    let base = task.first(n);
    let mut showing = Showing::new(task, news, &base);
    let turns = Turns { task, runner, machine, stop, news, base: &base, elsewhere: task.instance(0).scale() != 1.0 };
    let mut steady = true;
    let (mut measured, mut looks) = (0, 0);
    for end in task.looks() {
        for round in 0..task.passes {
            let process = OTHER_UNITS.len() as u32 + looks * task.passes + round;
            let pass = Pass::Official(round);
            let shown = task.instance(process);
            for index in 0..lanes.len() {
                let lane = &mut lanes[index];
                let turn = turns.turn(index, pass, process, task.piece(measured, end), &shown);
                let part = turn.part(lane);
                if lane.ended() || part.is_empty() {
                    continue;
                }
                let spent = lane.spent;
                let steal = turn.play(lane, &part);
                let cut_now = round == 0 && lane.cut;
                if steal > STEAL && steady && !cut_now && !stop.asked() {
                    lane.forget(round, &turn.order(&part));
                    lane.spent = spent;
                    steady = turn.play(lane, &turn.part(lane)) <= STEAL;
                }
                if stop.asked() {
                    return;
                }
                showing.after_turn(&lanes, index);
            }
        }
        (measured, looks) = (end, looks + 1);
        if task.part.precision.is_some() && preview::preview(task, &lanes, measured, looks).settled {
            break;
        }
    }
    turns.elsewhere(&mut lanes);
    if stop.asked() {
        return;
    }
    let shown = task.as_it_is();
    for (index, lane) in lanes.iter_mut().enumerate().take(task.contestants.len()) {
        // What is counted is no time, and controls have no counters.
        let process = OTHER_UNITS.len() as u32 + looks * task.passes;
        let piece = Piece { own: 0..lane.reach.own, controls: 0..0 };
        let turn = turns.turn(index, Pass::Counting, process, piece, &shown);
        if !lane.ended() && lane.contestant.info.counters {
            turn.play(lane, &turn.piece);
        }
        if stop.asked() {
            return;
        }
        let _ = news.send(News::Progress { lane: index, done: lane.done, total: lane.done, worked: lane.spent });
    }
    if (measured as u64) < task.part.of {
        let _ = news.send(News::Preview(preview::preview(task, &lanes, measured, looks)));
    }
    for (lane, index) in lanes.into_iter().zip(0..) {
        // The receiver is gone only when nobody wants the run any more.
        let _ = news.send(News::Finished { lane: index, measured: Box::new(lane.into_measured()) });
    }
}

/// What all turns of a run share.
struct Turns<'a> {
    task: &'a Task<'a>,
    runner: &'a Runner,
    machine: &'a Machine,
    stop: &'a Stop,
    news: &'a Sender<News>,
    base: &'a [u32],
    /// The coordinates can be scaled, so other units are asked as well.
    elsewhere: bool,
}

impl Turns<'_> {
    fn turn<'t>(&'t self, index: usize, pass: Pass, process: u32, piece: Piece, shown: &'t Presentation) -> Turn<'t> {
        let Self { task, runner, machine, stop, news, base, elsewhere } = *self;
        Turn { task, runner, machine, stop, news, index, pass, elsewhere, process, base, piece, shown }
    }

    /// Asks in other units what the rounds asked in the unit of the files.
    fn elsewhere(&self, lanes: &mut [Lane]) {
        for process in (0..OTHER_UNITS.len() as u32).filter(|_| self.elsewhere) {
            let shown = self.task.instance(process);
            for (index, lane) in lanes.iter_mut().enumerate() {
                let piece = self.task.half(lane.reach.own, process as usize >= OTHER_UNITS.len() / 2);
                let turn = self.turn(index, Pass::Elsewhere, process, piece, &shown);
                let part = turn.part(lane);
                if !lane.ended() && !part.is_empty() {
                    turn.play(lane, &part);
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
    fn lanes(&self) -> impl Iterator<Item = &Arc<Contestant>> {
        let apart = self.reference.filter(|r| self.contestants.iter().all(|c| c.info.id != r.info.id));
        self.contestants.iter().chain(apart)
    }

    /// Two right distances may lie so far apart: both may miss the certified interval by tau.
    fn slack(&self, contestant: &Contestant) -> Vec<f64> {
        let (pair, unit) = (Pair::new(self.a, self.b), precision(&contestant.info).unit_roundoff());
        let of = |p: &Placed| 2.0 * pair.tau(&p.configuration, unit) + (p.truth.distance_hi - p.truth.distance_lo);
        self.set.placed.iter().chain(self.controls.iter().map(|control| &control.placed)).map(of).collect()
    }

    fn second(&self) -> Option<&Mesh> {
        (!self.same).then_some(self.mesh_b)
    }

    fn as_it_is(&self) -> Presentation {
        Presentation::original(self.mesh_a, self.second())
    }

    /// The same for all algorithms in their processes of this number. It depends on the set and not on the controls, so that a
    /// replay, which has only the set, sees the same.
    fn instance(&self, process: u32) -> Presentation {
        let configurations = self.set.placed.iter().map(|placed| &placed.configuration);
        shown(self.mesh_a, self.second(), configurations, self.coherent(), self.seed, process)
    }

    fn process_seed(&self, process: u32) -> u64 {
        process_seed(self.seed, process)
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

fn process_seed(seed: u64, process: u32) -> u64 {
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
