//! One algorithm's pass in a fresh process.

use std::ops::ControlFlow;
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use ocb_core::instance::{Instance, Presentation};
use ocb_sandbox::{Killer, Objects, Observation, Outcome, PassPlan, Policy, Question, Session};

use super::pace::Pace;
use super::weave::{self, Piece, Reach};
use super::{MeasuringState, News, Stop, Task, look, order, outcome_info};
use crate::algorithm::Runner;
use crate::machine::Machine;
use crate::model::OutcomeInfo;

/// How often an algorithm may report, so that pages live and nothing else suffers.
const REPORT_EVERY: Duration = Duration::from_millis(200);

/// What a pass is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// The official times of this round, in the unit of the files.
    Official(u32),
    /// Times and answers in another unit.
    Elsewhere,
    /// Counters, without a clock.
    Counting,
    /// A first look, of which nothing counts: answers with times, and then the same with counters.
    Look,
}

/// One algorithm's pass in a fresh process.
pub struct ProcessPass<'a> {
    /// What is measured.
    pub task: &'a Task<'a>,
    /// Where plugins and the runner are.
    pub runner: &'a Runner,
    /// The machine's CPUs.
    pub machine: &'a Machine,
    /// Ends it from outside.
    pub stop: &'a Stop,
    /// Who wants to know.
    pub news: &'a Sender<News>,
    /// Index of the algorithm.
    pub index: usize,
    /// What the answers are for.
    pub purpose: Purpose,
    /// The run also asks in other units.
    pub elsewhere: bool,
    /// Number of the process: pieces of the order come one after the other, with all rounds each.
    pub process: u32,
    /// The set's order.
    pub base: &'a [u32],
    /// Where the piece of it lies, and of the controls.
    pub piece: Piece,
    /// How the process sees the objects.
    pub shown: &'a Presentation,
}

/// What a process may use whose passes have this budget together.
pub fn limits(budget: Duration) -> Policy {
    Policy {
        // A single question may take a whole pass (brute force on large objects), and no more.
        query_seconds: budget.as_secs_f64().max(Policy::default().query_seconds),
        // The pass ends by its allowance; this only catches a runner that never comes back.
        trial_seconds: 4.0 * budget.as_secs_f64() + Policy::default().trial_seconds,
        ..Policy::default()
    }
}

/// The same on the CPUs of this machine that measure.
pub fn allowed(machine: &Machine, threads: usize, limits: Policy) -> Policy {
    let (runner_cpu, supervisor_cpu) = (Some(machine.measuring_cpu()), Some(machine.supervisor_cpu()));
    Policy { runner_cpu, supervisor_cpu, threads, ..limits }
}

/// A pass that has begun.
struct UnderWay {
    begun: Instant,
    reported: Instant,
    /// What the algorithm had answered before.
    done: u64,
    allowance: Duration,
}

impl UnderWay {
    fn pace(&self, state: &MeasuringState) -> Pace {
        Pace { answered: state.done - self.done, worked: self.begun.elapsed(), allowance: self.allowance }
    }
}

impl ProcessPass<'_> {
    /// What of the piece this algorithm is asked; the first round finds out how far it comes.
    pub fn part(&self, state: &MeasuringState) -> Piece {
        match self.purpose {
            Purpose::Official(0) if !state.cut => self.piece.clone(),
            _ => self.piece.before(state.reach),
        }
    }

    /// The questions of a part, in the order in which this process is asked.
    pub fn order(&self, part: &Piece) -> Vec<u32> {
        let (task, process) = (self.task, self.process);
        let (own, n) = (&self.base[part.own.clone()], task.set.placed.len());
        let controls: Vec<u32> = part.controls.clone().map(|control| (n + control) as u32).collect();
        if task.coherent() {
            return weave::behind(own, &controls, |control| task.controls[control as usize - n].from);
        }
        // Both are drawn anew, so that no question always follows the same one.
        let seed = task.process_seed(process).rotate_left(2);
        if matches!(self.purpose, Purpose::Official(0) | Purpose::Look) {
            return weave::evenly(own, &controls, seed);
        }
        let again = |part: &[u32]| order::reshuffled(part, task.seed, process);
        weave::evenly(&again(own), &again(&controls), seed)
    }

    /// The share of the time that was taken from the runner's CPU.
    pub fn run(&self, state: &mut MeasuringState, part: &Piece) -> f64 {
        let order = self.order(part);
        self.report(state, None);
        // From before the start, so that a long build can be stopped as well.
        let killer = Killer::default();
        self.stop.watch(Some(killer.clone()));
        let mut session = match self.start(state, &killer) {
            Ok(session) => session,
            Err(outcome) => {
                state.end(outcome);
                return 0.0;
            }
        };
        state.begin_process(&session, self.purpose);
        let begun = Instant::now();
        let mut way = UnderWay { begun, reported: begun, done: state.done, allowance: self.allowance(state) };
        let (reached, steal) = if self.purpose == Purpose::Counting {
            let reached = self.count(&mut session, state, &order, &mut way);
            state.end_counting(reached, session.triangle_tests());
            (reached, 0.0)
        } else {
            self.time(&mut session, state, &order, &mut way)
        };
        if self.purpose == Purpose::Look && self.counts(state) {
            let mut way = UnderWay { begun: Instant::now(), ..way };
            self.count(&mut session, state, &order[..reached], &mut way);
        }
        state.spent += begun.elapsed();
        self.stop.watch(None);
        let ending = session.finish();
        if self.purpose == Purpose::Official(0) {
            let n = self.task.set.placed.len();
            let own = order[..reached].iter().filter(|number| (**number as usize) < n).count();
            let controls = self.piece.controls.start + reached - own;
            state.reach = Reach { own: self.piece.own.start + own, controls };
            state.cut |= reached < part.questions();
        }
        state.end_process(&ending);
        if ending.outcome != Outcome::Completed {
            state.end(outcome_info(&ending.outcome));
        }
        let placed = |number| self.task.placed(number);
        state.judge(self.task.pairing, placed, self.task.query, self.task.semantics);
        if self.purpose != Purpose::Counting {
            // Counting is an algorithm's last process, after which it is reported as it then is.
            self.report(state, None);
        }
        steal
    }

    /// A timed pass: how far it came, and the share of stolen time.
    fn time(
        &self,
        session: &mut Session,
        state: &mut MeasuringState,
        order: &[u32],
        way: &mut UnderWay,
    ) -> (usize, f64) {
        let plan = PassPlan {
            order,
            coherent: self.task.coherent(),
            seed: self.task.process_seed(self.process).rotate_left(1),
            allowance: way.allowance,
        };
        let present = |configuration: u32, instance: Instance| {
            let asked = &self.task.placed(configuration).configuration;
            Question::of_pair(self.task.query, self.shown.present(asked, configuration, instance))
        };
        let mut each = |seen: Observation| {
            let answer = self.shown.translate(seen.answer, seen.configuration, seen.instance);
            state.observe(self.purpose, self.process, Observation { answer, ..seen });
            self.go_on(state, way)
        };
        // What it died of is in the session's ending.
        let (facts, _) = session.pass(&plan, &present, &mut each);
        let found = (facts.reached, facts.steal.unwrap_or(0.0));
        if self.purpose != Purpose::Elsewhere {
            state.end_pass(facts);
        }
        found
    }

    /// The untimed pass with counters: how far it came.
    fn count(&self, session: &mut Session, state: &mut MeasuringState, order: &[u32], way: &mut UnderWay) -> usize {
        for (reached, &i) in order.iter().enumerate() {
            let configuration = &self.task.placed(i).configuration;
            match session.count(self.task.query, configuration) {
                Ok((answer, counters)) => state.count(i, answer, counters),
                Err(_) => return reached,
            }
            if self.go_on(state, way).is_break() || way.begun.elapsed() >= way.allowance {
                return reached + 1;
            }
        }
        order.len()
    }

    /// Reports now and then, and looks whether it shall stop.
    fn go_on(&self, state: &MeasuringState, way: &mut UnderWay) -> ControlFlow<()> {
        if way.reported.elapsed() >= REPORT_EVERY {
            way.reported = Instant::now();
            self.report(state, Some(way));
            if self.stop.asked() {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    fn start(&self, state: &MeasuringState, killer: &Killer) -> Result<Session, OutcomeInfo> {
        let algorithm = &state.algorithm;
        let limits = if self.purpose == Purpose::Look { look::limits() } else { limits(self.task.budget) };
        let policy = allowed(self.machine, algorithm.threads, limits);
        let objects = Objects::Pair(self.shown.first(), self.shown.second());
        let trial = algorithm.trial(objects, self.task.semantics);
        let launcher = self.runner.launcher(algorithm, policy);
        launcher.start_with(&trial, killer).map_err(|ending| outcome_info(&ending.outcome))
    }

    /// The first pass over a piece decides how far the algorithm gets; later ones may use what it left. Counting makes an
    /// algorithm slower and is not timed, so it gets the share of two passes, and what it does not reach has no counters. In each
    /// other unit two processes have half of a share each: however slow an algorithm is there, the run ends.
    fn allowance(&self, state: &MeasuringState) -> Duration {
        let share = self.task.budget / self.task.passes;
        let left = self.task.budget.saturating_sub(state.spent);
        match self.purpose {
            Purpose::Official(0) => left / self.task.passes,
            Purpose::Official(_) => left.max(share),
            Purpose::Elsewhere => share / 2,
            Purpose::Counting => share * 2,
            Purpose::Look => look::TIME,
        }
    }

    fn report(&self, state: &MeasuringState, way: Option<&UnderWay>) {
        let worked = state.spent + way.map_or(Duration::ZERO, |way| way.begun.elapsed());
        let total = self.expected(state, way.map(|way| way.pace(state))).max(state.done);
        let _ = self.news.send(News::Progress { index: self.index, done: state.done, total, worked });
    }

    /// Is its work counted? Nobody asked for that of the reference.
    fn counts(&self, state: &MeasuringState) -> bool {
        !self.task.rounds_only && state.algorithm.info.counters && self.index < self.task.algorithms.len()
    }

    /// Questions that the algorithm will have answered in the end; 0 while that cannot be told.
    fn expected(&self, state: &MeasuringState, pace: Option<Pace>) -> u64 {
        let all = self.task.piece(0, self.task.most());
        let (whole, own) = (all.questions() as u64, all.own.len() as u64);
        let counters = self.counts(state);
        let further = |own: u64| if self.elsewhere { self.task.elsewhere(own as usize) } else { 0 };
        let rounds =
            |round: u64, own: u64| round * u64::from(self.task.passes) + further(own) + if counters { own } else { 0 };
        if self.purpose == Purpose::Counting {
            let part = self.piece.own.len() as u64;
            let answered = pace.map_or(0, |pace| pace.answered);
            return state.done - answered + pace.and_then(|pace| pace.reach(part)).unwrap_or(part);
        }
        if self.purpose == Purpose::Official(0) && !state.cut {
            let (before, part) = (self.task.piece(0, self.piece.own.start), &self.piece);
            let round = pace.and_then(|pace| pace.round(before.questions() as u64, part.questions() as u64, whole));
            return match round {
                Some(round) => rounds(round, round * own / whole.max(1)),
                None if state.done == 0 => 0,
                None => rounds(whole, own),
            };
        }
        let reach = if state.cut { all.before(state.reach) } else { all };
        rounds(reach.questions() as u64, reach.own.len() as u64)
    }
}
