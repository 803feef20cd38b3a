//! Measuring: plain blocking code on one thread of its own.
//!
//! The algorithms take turns, one pass each per round, so that a slow drift of the machine meets all of them alike; the
//! reference algorithm takes part in every round, whether it was asked for or not. Every turn is a fresh jailed process
//! that sees an equivalent instance of the objects and of every question ([`Presentation`]). All share one shuffled
//! order; an algorithm whose budget ends measures a prefix of it. A trajectory keeps its own order: that each
//! configuration is near the one before is what it is for.

mod contract;
mod lane;
mod order;
mod summary;

use std::ops::ControlFlow;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use ocb_core::configuration::{ConfigurationSet, Method, Placed};
use ocb_core::instance::{Instance, Presentation};
use ocb_core::mesh::Mesh;
use ocb_core::numbers::Numbers;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::query::{Query, Semantics};
use ocb_sandbox::{Killer, Observation, Outcome, PassPlan, Policy, Session, Trial};

use crate::machine::Machine;
use crate::model::OutcomeInfo;
use crate::registry::{Contestant, Registry, plugin_hash};

pub use lane::{Lane, Measured, precision};
pub use summary::{Asked, environment, rank, summarise};

/// How often a lane may report, so that pages live and nothing else suffers.
const REPORT_EVERY: Duration = Duration::from_millis(200);

/// Ends the measuring from another thread.
#[derive(Clone, Default)]
pub struct Stop {
    inner: Arc<Mutex<(bool, Option<Killer>)>>,
}

impl Stop {
    /// No further question is asked, and the runner under way is killed.
    pub fn stop(&self) {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        inner.0 = true;
        if let Some(killer) = &inner.1 {
            killer.kill();
        }
    }

    /// Was it asked for?
    pub fn asked(&self) -> bool {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner).0
    }

    /// From now on a stop kills this runner.
    fn watch(&self, killer: Option<Killer>) {
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        if let (true, Some(killer)) = (inner.0, &killer) {
            killer.kill();
        }
        inner.1 = killer;
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
}

/// News for whoever reports the progress.
pub enum News {
    /// A lane has done so many of its expected questions.
    Progress {
        /// Which contestant.
        lane: usize,
        /// Questions answered.
        done: u64,
        /// Questions expected in all, as far as is known now.
        total: u64,
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
/// as much, that is how this machine is, and no pass of the run is measured again.
const STEAL: f64 = 0.001;

impl Task<'_> {
    /// The order is part of what is measured: each configuration is near the one before.
    fn coherent(&self) -> bool {
        matches!(self.set.method, Method::Trajectory { .. })
    }
}

/// Measures all contestants and sends what happens; returns early when stopped.
pub fn measure(task: &Task, registry: &Registry, machine: &Machine, stop: &Stop, news: &Sender<News>) {
    let _quiet = machine.keep_off();
    let apart = task.reference.filter(|r| task.contestants.iter().all(|c| c.info.id != r.info.id));
    let all = task.contestants.iter().chain(apart);
    let mut lanes: Vec<Lane> = all.map(|c| Lane::new(c.clone(), &task.slack(c))).collect();
    let n = task.set.placed.len() as u32;
    let base = if task.coherent() { (0..n).collect() } else { order::shuffled(n, task.seed) };
    let mut steady = true;
    // Round `passes` is the untimed one, in which the counters are asked for.
    for round in 0..=task.passes {
        let counting = round == task.passes;
        let shown = if counting { task.as_it_is() } else { task.instance(round) };
        for (index, lane) in lanes.iter_mut().enumerate() {
            let mine = index < task.contestants.len();
            if lane.ended() || (counting && !(mine && lane.contestant.info.counters)) {
                continue;
            }
            let turn = Turn { task, registry, machine, stop, news, index, round, shown: &shown };
            if turn.play(lane, &base) > STEAL && steady && !stop.asked() {
                lane.forget(round);
                steady = turn.play(lane, &base) <= STEAL;
            }
            if stop.asked() {
                return;
            }
        }
    }
    for (lane, index) in lanes.into_iter().zip(0..) {
        // The receiver is gone only when nobody wants the run any more.
        let _ = news.send(News::Finished { lane: index, measured: Box::new(lane.into_measured()) });
    }
}

impl Task<'_> {
    /// Two right distances may lie so far apart: both may miss the certified interval by tau.
    fn slack(&self, contestant: &Contestant) -> Vec<f64> {
        let (pair, unit) = (Pair::new(self.a, self.b), precision(&contestant.info).unit_roundoff());
        let of = |p: &Placed| 2.0 * pair.tau(&p.configuration, unit) + (p.truth.distance_hi - p.truth.distance_lo);
        self.set.placed.iter().map(of).collect()
    }

    fn second(&self) -> Option<&Mesh> {
        (!self.same).then_some(self.mesh_b)
    }

    fn as_it_is(&self) -> Presentation {
        Presentation::original(self.mesh_a, self.second())
    }

    /// The same for all algorithms of a round.
    fn instance(&self, round: u32) -> Presentation {
        let configurations = self.set.placed.iter().map(|placed| &placed.configuration);
        let seed = self.round_seed(round);
        Presentation::drawn(self.mesh_a, self.second(), configurations, self.coherent(), seed)
    }

    fn round_seed(&self, round: u32) -> u64 {
        Numbers::new(self.seed ^ (u64::from(round) << 40)).bits()
    }
}

/// One algorithm's pass in a fresh process.
struct Turn<'a> {
    task: &'a Task<'a>,
    registry: &'a Registry,
    machine: &'a Machine,
    stop: &'a Stop,
    news: &'a Sender<News>,
    index: usize,
    round: u32,
    shown: &'a Presentation,
}

impl Turn<'_> {
    /// The share of the time that was taken from the runner's CPU.
    fn play(&self, lane: &mut Lane, base: &[u32]) -> f64 {
        let prefix = &base[..lane.reach.unwrap_or(base.len())];
        let order = if self.round == 0 || self.task.coherent() {
            prefix.to_vec()
        } else {
            order::reshuffled(prefix, self.task.seed, self.round)
        };
        self.report(lane);
        // From before the start, so that a long build can be stopped as well.
        let killer = Killer::default();
        self.stop.watch(Some(killer.clone()));
        let mut session = match self.start(lane, &killer) {
            Ok(session) => session,
            Err(outcome) => {
                lane.end(outcome);
                return 0.0;
            }
        };
        lane.begin_turn(&session);
        let started = Instant::now();
        let (reached, steal) = if self.counting() {
            (self.count(&mut session, lane, &order), 0.0)
        } else {
            self.time(&mut session, lane, &order)
        };
        lane.spent += started.elapsed();
        self.stop.watch(None);
        let ending = session.finish();
        if self.round == 0 {
            lane.reach = Some(reached);
        }
        lane.end_turn(&ending);
        if ending.outcome != Outcome::Completed {
            lane.end(outcome_info(&ending.outcome));
        }
        let placed = &self.task.set.placed;
        lane.judge(&Pair::new(self.task.a, self.task.b), placed, self.task.query, self.task.semantics);
        self.report(lane);
        steal
    }

    /// A timed pass: how far it came, and the share of stolen time.
    fn time(&self, session: &mut Session, lane: &mut Lane, order: &[u32]) -> (usize, f64) {
        let placed = &self.task.set.placed;
        let plan = PassPlan {
            query: self.task.query,
            order,
            coherent: self.task.coherent(),
            seed: self.task.round_seed(self.round).rotate_left(1),
            allowance: self.allowance(lane),
        };
        let present = |configuration: u32, instance: Instance| {
            self.shown.present(&placed[configuration as usize].configuration, configuration, instance)
        };
        let mut reported = Instant::now();
        let mut each = |seen: Observation| {
            let answer = self.shown.translate(seen.answer, seen.configuration, seen.instance);
            lane.observe(self.round, Observation { answer, ..seen });
            self.go_on(lane, &mut reported)
        };
        // What it died of is in the session's ending.
        let (facts, _) = session.pass(&plan, &present, &mut each);
        let found = (facts.reached, facts.steal.unwrap_or(0.0));
        lane.end_pass(facts);
        found
    }

    /// The untimed pass with counters: how far it came.
    fn count(&self, session: &mut Session, lane: &mut Lane, order: &[u32]) -> usize {
        let (begun, mut reported, allowed) = (Instant::now(), Instant::now(), self.allowance(lane));
        for (reached, &i) in order.iter().enumerate() {
            let configuration = &self.task.set.placed[i as usize].configuration;
            match session.count(self.task.query, configuration) {
                Ok((answer, counters)) => lane.count(i, answer, counters),
                Err(_) => return reached,
            }
            if self.go_on(lane, &mut reported).is_break() || begun.elapsed() >= allowed {
                return reached + 1;
            }
        }
        order.len()
    }

    /// Reports now and then, and looks whether it shall stop.
    fn go_on(&self, lane: &Lane, reported: &mut Instant) -> ControlFlow<()> {
        if reported.elapsed() >= REPORT_EVERY {
            *reported = Instant::now();
            self.report(lane);
            if self.stop.asked() {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    fn start(&self, lane: &Lane, killer: &Killer) -> Result<Session, OutcomeInfo> {
        let contestant = &lane.contestant;
        let ours = |message: String| OutcomeInfo { name: "SandboxFault".into(), message, ours: true };
        match plugin_hash(&contestant.file) {
            Ok(hash) if hash == contestant.info.plugin_sha256 => {}
            Ok(_) => {
                return Err(ours("The plugin file was replaced after the service had read it; start it again.".into()));
            }
            Err(e) => return Err(ours(e.to_string())),
        }
        let policy = Policy {
            runner_cpu: Some(self.machine.measuring_cpu()),
            supervisor_cpu: Some(self.machine.supervisor_cpu()),
            threads: contestant.threads,
            // A single question may take a whole turn (brute force on large objects), and no more.
            query_seconds: self.task.budget.as_secs_f64().max(Policy::default().query_seconds),
            // The turn ends by its allowance; this only catches a runner that never comes back.
            trial_seconds: 4.0 * self.task.budget.as_secs_f64() + Policy::default().trial_seconds,
            ..Policy::default()
        };
        let trial = Trial {
            plugin: &contestant.file,
            algorithm: &contestant.algorithm,
            mesh_a: self.shown.first(),
            mesh_b: self.shown.second(),
            parameters: &contestant.settings,
            semantics: self.task.semantics,
        };
        let launcher = self.registry.launcher(contestant, policy);
        launcher.start_with(&trial, killer).map_err(|ending| outcome_info(&ending.outcome))
    }

    fn counting(&self) -> bool {
        self.round == self.task.passes
    }

    /// The first pass decides how far the algorithm gets; later ones may use what it left. Counting makes an algorithm
    /// slower and is not timed, so it gets the share of two passes, and what it does not reach has no counters.
    fn allowance(&self, lane: &Lane) -> Duration {
        let share = self.task.budget / self.task.passes;
        match self.round {
            0 => share,
            _ if self.counting() => share * 2,
            _ => self.task.budget.saturating_sub(lane.spent).max(share),
        }
    }

    fn report(&self, lane: &Lane) {
        // Nobody asked for the reference; it has no lane of its own on any page.
        if self.index >= self.task.contestants.len() {
            return;
        }
        let rounds = u64::from(self.task.passes) + u64::from(lane.contestant.info.counters);
        let reach = lane.reach.unwrap_or(self.task.set.placed.len()) as u64;
        let total = (reach * rounds).max(lane.done);
        let _ = self.news.send(News::Progress { lane: self.index, done: lane.done, total });
    }
}

/// An outcome for the pages.
pub fn outcome_info(outcome: &Outcome) -> OutcomeInfo {
    OutcomeInfo { name: outcome.name().into(), message: outcome.to_string(), ours: outcome.ours() }
}
