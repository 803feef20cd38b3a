//! One pass: each question of an order once, in one fresh process, on a machine that has other things to do.
//!
//! No question that counts comes a second time in a process, so that a plugin gains nothing by remembering, and none is left
//! out because something disturbed it, so that it gains nothing by being disturbed. What disturbs is met otherwise: time in
//! which the runner certainly waited for its CPU is taken off, as the kernel counts it (`session.rs`); and the time of a
//! question is the median over processes, in another order each.
//!
//! Questions come in stretches, each question alone (its *isolated latency*). Between two stretches the runner sleeps, and
//! what it computes meanwhile is seen. Behind the last one some questions come again, together: their *warm* time, which
//! ranks nothing. It may show a plugin that remembers (`integrity.rs`).

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use ocb_core::instance::Instance;
use ocb_core::numbers::Numbers;
use ocb_core::query::{Answer, Query};
use ocb_core::statistics::quantile;

use crate::clock::ClockKind;
use crate::exchange::{Poses, Resting};
use crate::outcome::Outcome;
use crate::protocol::MAX_BATCH;
use crate::question::Question;
use crate::session::{Sample, Session};
use crate::usage::Steal;

/// A stretch has so many questions, and ends after so long.
const STRETCH: usize = 256;
const STRETCH_TIME: Duration = Duration::from_millis(20);
/// A stretch is disturbed in which the runner waited for its CPU for more than this share of the time.
const WAITED: f64 = 0.002;
/// Questions of a batch: from, to.
const BATCH: [usize; 2] = [16, MAX_BATCH];
/// So many questions give one batch, up to so many batches.
const BATCH_EVERY: usize = 300;
const BATCHES: usize = 16;
/// A batch takes no longer than this, by what its questions took alone; one of fewer than eight is left out.
const BATCH_NS: f64 = 20e6;
const SMALLEST_BATCH: usize = 8;
/// A time is compared with that of a batch when it is so many times the clock's resolution.
const TOLD: f64 = 2.0;
/// The same for the sleeping clock, nanoseconds: waking a CPU that has nothing to do takes up to 40 us, which no null round trip
/// shows and a batch has only once.
const TOLD_ASLEEP_NS: f64 = 1e6;

/// What a pass asks.
#[derive(Clone, Copy, Debug)]
pub struct PassPlan<'a> {
    /// Numbers of the configurations.
    pub order: &'a [u32],
    /// The order is part of the question: what comes again does so in the order's own sequence.
    pub coherent: bool,
    /// Of everything that is random.
    pub seed: u64,
    /// No new stretch begins after so long.
    pub allowance: Duration,
}

/// One answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Number of the configuration.
    pub configuration: u32,
    /// Which instance of it was asked.
    pub instance: Instance,
    /// What the plugin answered.
    pub answer: Answer,
    /// Its official time; absent for what comes again.
    pub time: Option<Time>,
}

/// The official time of one question in one pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// Nanoseconds, null round trip subtracted.
    pub ns: f64,
    /// Only an upper bound: the clock's resolution.
    pub below_resolution: bool,
    /// The supervisor was kept from looking, so that it is longer than the plugin took.
    pub disturbed: bool,
}

/// One batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Batched {
    /// How many questions.
    pub questions: u32,
    /// The time that they took one by one, nanoseconds: as many times their median; 0 where the clock cannot tell that well.
    pub alone_ns: f64,
    /// The time that they took together.
    pub together_ns: f64,
}

/// What a pass shows beside the answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassFacts {
    /// The pass came so far in the order.
    pub reached: usize,
    /// Stretches asked, and those of them that were disturbed.
    pub blocks: [u32; 2],
    /// Times that are longer than the plugin took, because the supervisor was kept from looking.
    pub disturbed: u32,
    /// Time in which questions were open, and the part of it in which the runner waited for its CPU, nanoseconds.
    pub asked_ns: [f64; 2],
    /// Undisturbed batches.
    pub batches: Vec<Batched>,
    /// Time in which the runner was to sleep, nanoseconds.
    pub rested_ns: f64,
    /// What it computed while no question was open, then or before, nanoseconds.
    pub beside_ns: f64,
    /// Share of the time that the machine below took from the runner's CPU.
    pub steal: Option<f64>,
    /// The calibration loop on the runner's CPU, before the plugin was loaded, before its first question and after its last:
    /// shortest, middle, longest, nanoseconds.
    pub calibration_ns: [f64; 3],
}

impl Session {
    /// Asks all questions of the plan; `present` gives the question in an instance of a configuration. `each` gets every answer
    /// and may stop the pass. An error has ended the session, what was answered before stands.
    pub fn pass(
        &mut self,
        plan: &PassPlan<'_>,
        present: &dyn Fn(u32, Instance) -> Question,
        each: &mut dyn FnMut(Observation) -> ControlFlow<()>,
    ) -> (PassFacts, Result<(), Outcome>) {
        let steal = Steal::begin(self.policy.runner_cpu);
        let mut pass = Pass {
            speeds: vec![self.clock().calibration_ns],
            singles: Vec::new(),
            instances: 0,
            numbers: Numbers::new(plan.seed),
            facts: PassFacts::default(),
            session: self,
            plan,
            present,
            each,
        };
        let ended = pass.run().map(drop);
        let mut facts = pass.facts;
        let mut speeds = pass.speeds;
        speeds.sort_by(f64::total_cmp);
        facts.calibration_ns = [speeds[0], speeds[speeds.len() / 2], speeds[speeds.len() - 1]];
        facts.steal = steal.share();
        (facts, ended)
    }
}

struct Pass<'a, 's> {
    session: &'s mut Session,
    plan: &'a PassPlan<'a>,
    present: &'a dyn Fn(u32, Instance) -> Question,
    each: &'a mut dyn FnMut(Observation) -> ControlFlow<()>,
    numbers: Numbers,
    /// Calibrations so far.
    speeds: Vec<f64>,
    singles: Vec<Single>,
    instances: u32,
    facts: PassFacts,
}

/// What was asked for the time that counts.
#[derive(Clone, Copy)]
struct Single {
    /// Place in the order.
    place: usize,
    /// Official time.
    ns: f64,
    /// Questions that may come again together are of one kind, about the same objects.
    kind: (Query, [u32; 2]),
}

type Flow = Result<ControlFlow<()>, Outcome>;

impl Pass<'_, '_> {
    fn run(&mut self) -> Flow {
        let begun = Instant::now();
        self.session.rest()?;
        self.speeds.push(self.session.speed_ns()?);
        while self.facts.reached < self.plan.order.len() && begun.elapsed() < self.plan.allowance {
            if self.stretch()?.is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        self.speeds.push(self.session.speed_ns()?);
        self.resume();
        let asked = begun.elapsed();
        for _ in 0..(self.facts.reached / BATCH_EVERY).clamp(1, BATCHES) {
            // What ranks nothing may take a tenth as long again.
            if self.batch()?.is_break() || (begun.elapsed() - asked) * 10 > asked {
                break;
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Asks the next stretch of the order, or the beginning of it when that takes long.
    fn stretch(&mut self) -> Flow {
        let first = self.facts.reached;
        let places = first..self.plan.order.len().min(first + STRETCH);
        let instance = Instance::default();
        let ask = |place: usize| {
            let question = (self.present)(self.plan.order[place], instance);
            (question.query, Poses::from(&question))
        };
        let words: Vec<(Query, Poses)> = places.clone().map(ask).collect();
        let resumed = self.resume();
        let mut samples: Vec<Sample> = Vec::with_capacity(words.len());
        let (begun, waited_before) = (Instant::now(), self.session.waited_ns());
        let mut ended = Ok(());
        for (query, question) in &words {
            match self.session.put_words(*query, question) {
                Ok(sample) => samples.push(sample),
                Err(outcome) => ended = Err(outcome),
            }
            if ended.is_err() || begun.elapsed() > STRETCH_TIME {
                break;
            }
        }
        if ended.is_ok() {
            match self.session.rest() {
                Ok(now) => self.facts.beside_ns += self.beside(&resumed, &now, &samples),
                Err(outcome) => ended = Err(outcome),
            }
        }
        self.look(&samples, self.session.waited_ns() - waited_before);
        let mut flow = ControlFlow::Continue(());
        for ((place, sample), (query, Poses { objects, .. })) in places.zip(samples).zip(words) {
            self.facts.reached += 1;
            self.singles.push(Single { place, ns: sample.time_ns, kind: (query, objects) });
            let Sample { time_ns: ns, below_resolution, disturbed, answer, .. } = sample;
            let time = Some(Time { ns, below_resolution, disturbed });
            flow = (self.each)(Observation { configuration: self.plan.order[place], instance, answer, time });
            if flow.is_break() {
                break;
            }
        }
        ended.map(|()| flow)
    }

    /// How far was the stretch disturbed?
    fn look(&mut self, samples: &[Sample], waited_ns: f64) {
        let asked_ns: f64 = samples.iter().map(|sample| sample.raw_ns).sum();
        let missed = samples.iter().filter(|sample| sample.disturbed).count() as u32;
        self.facts.disturbed += missed;
        self.facts.blocks[0] += 1;
        self.facts.blocks[1] += u32::from(missed > 0 || waited_ns > WAITED * asked_ns);
        self.facts.asked_ns[0] += asked_ns;
        self.facts.asked_ns[1] += waited_ns;
    }

    /// Ends a rest and notes what the runner computed in it.
    fn resume(&mut self) -> Resting {
        let (now, [rested_ns, computed_ns]) = self.session.resume();
        self.facts.rested_ns += rested_ns;
        // Threads of a library may go on looking for work for a while.
        self.facts.beside_ns += if self.session.policy.threads == 1 { computed_ns } else { 0.0 };
        now
    }

    /// What the runner computed in a stretch while no question was open.
    fn beside(&self, resumed: &Resting, now: &Resting, samples: &[Sample]) -> f64 {
        if self.session.policy.threads > 1 {
            return 0.0;
        }
        let asked_ns = samples.iter().map(|sample| sample.raw_ns).sum();
        self.session.beside_ns(resumed, now, asked_ns, samples.len())
    }

    /// Some of the questions of one kind asked so far, together, as another instance.
    fn batch(&mut self) -> Flow {
        let Some(Single { kind, .. }) = self.singles.get(self.numbers.below(self.singles.len().max(1))).copied() else {
            return Ok(ControlFlow::Break(()));
        };
        if kind.0 == Query::CollisionAll {
            return Ok(ControlFlow::Continue(()));
        }
        let pool: Vec<Single> = self.singles.iter().copied().filter(|single| single.kind == kind).collect();
        let size = (BATCH[0] + self.numbers.below(BATCH[1] - BATCH[0] + 1)).min(pool.len());
        let first = self.numbers.below(pool.len() - size + 1);
        let mut members: Vec<Single> = match self.plan.coherent {
            true => pool[first..first + size].to_vec(),
            false => (0..size).map(|_| pool[self.numbers.below(pool.len())]).collect(),
        };
        let mut sum = 0.0;
        members.retain(|Single { ns, .. }| {
            let fits = sum + ns <= BATCH_NS;
            sum += if fits { *ns } else { 0.0 };
            fits
        });
        if members.len() < SMALLEST_BATCH {
            return Ok(ControlFlow::Continue(()));
        }
        // One that met a time slice of something else took a thousand times its own time.
        let mut alone: Vec<f64> = members.iter().map(|single| single.ns).collect();
        alone.sort_by(f64::total_cmp);
        let usual_ns = quantile(&alone, 0.5);
        let clock = self.session.clock();
        let told = match clock.kind {
            ClockKind::Spin => usual_ns >= TOLD * clock.resolution_ns(),
            ClockKind::Futex => usual_ns >= TOLD_ASLEEP_NS,
        };
        self.instances += 1;
        let instance = Instance { number: self.instances, aside: true };
        let configurations: Vec<u32> = members.iter().map(|single| self.plan.order[single.place]).collect();
        let asked: Vec<Poses> = configurations.iter().map(|&c| Poses::from(&(self.present)(c, instance))).collect();
        let before = self.session.usage();
        let batch = self.session.batch_words(kind.0, &asked)?;
        let waited_ns = self.session.usage().zip(before).map_or(0.0, |(now, before)| now.since(before).delay_ns);
        if waited_ns <= WAITED * batch.time_ns && !batch.disturbed {
            self.facts.batches.push(Batched {
                questions: members.len() as u32,
                alone_ns: if told { usual_ns * members.len() as f64 } else { 0.0 },
                together_ns: batch.time_ns,
            });
        }
        for (&configuration, answer) in configurations.iter().zip(batch.answers) {
            let flow = (self.each)(Observation { configuration, instance, answer, time: None });
            if flow.is_break() {
                return Ok(flow);
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}
