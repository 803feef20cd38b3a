//! One pass: each question of an order once, in one fresh process, on a machine that has other things to do.
//!
//! Questions come in blocks of random size, each question alone (its *isolated latency*). Between blocks, at random, some
//! of the questions come again: together in a batch of random size (the *warm* time), and now and then alone and exactly
//! as before. Neither gives the official time of a question; they show whether the first answers were honest
//! (`integrity.rs`). Sometimes nothing is asked for a while, and the runner must not compute then.
//!
//! A block is disturbed when the runner had to wait for its CPU, when the CPU was not as fast as in the rest of the pass,
//! or when the supervisor missed an answer. Its times are not mended: its questions are asked again later, as other
//! instances, at most three times in all; what then stands is marked.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use ocb_core::instance::{Instance, Presented};
use ocb_core::numbers::Numbers;
use ocb_core::query::{Answer, Query};
use ocb_core::statistics::quantile;

use crate::outcome::Outcome;
use crate::protocol::MAX_BATCH;
use crate::session::{Sample, Session};
use crate::usage::{Steal, Usage};

/// Questions of a block, and of a batch: from, to.
const BLOCK: [usize; 2] = [16, MAX_BATCH];
/// A block of slow questions ends here, and so does the warm-up.
const BLOCK_TIME: Duration = Duration::from_millis(5);
/// A batch takes no longer than this, by what its questions took alone; one of fewer than eight is left out.
const BATCH_NS: f64 = 20e6;
const SMALLEST_BATCH: usize = 8;
/// After one block in so many comes a batch, and after one in so many some questions exactly as before.
const BATCH_EVERY: usize = 8;
const REPEAT_EVERY: usize = 8;
const REPEATS: usize = 8;
/// A repeat comes so many questions after the first time at least.
const REPEAT_AFTER: usize = 64;
/// So many times at most nothing is asked for so long.
const PAUSES: usize = 4;
const PAUSE: Duration = Duration::from_millis(4);
/// A question is timed so often at most.
const ATTEMPTS: u32 = 3;
/// A runner that waited longer than this, and than a five-hundredth of its block, was disturbed.
const WAITED_NS: f64 = 2000.0;
/// So was one whose CPU's speed differs by more than this from its median.
const SPEED: f64 = 0.01;

/// What a pass asks.
#[derive(Clone, Copy, Debug)]
pub struct PassPlan<'a> {
    /// The question.
    pub query: Query,
    /// Numbers of the configurations.
    pub order: &'a [u32],
    /// The order is part of the question: what is asked again comes in the order's own sequence.
    pub coherent: bool,
    /// Of everything that is random.
    pub seed: u64,
    /// No new block begins after so long.
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
    /// Its official time; absent for what only comes again, and for what will be asked again because it was disturbed.
    pub time: Option<Time>,
}

/// The official time of one question in one pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// Nanoseconds, null round trip subtracted.
    pub ns: f64,
    /// Only an upper bound: the clock's resolution.
    pub below_resolution: bool,
    /// Disturbed at every attempt.
    pub disturbed: bool,
}

/// One batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Batched {
    /// How many questions.
    pub questions: u32,
    /// The time that they took one by one, nanoseconds.
    pub alone_ns: f64,
    /// The time that they took together.
    pub together_ns: f64,
}

/// What a pass shows beside the answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassFacts {
    /// The pass came so far in the order.
    pub reached: usize,
    /// Questions with an undisturbed time.
    pub timed: usize,
    /// Blocks asked for the first time, and those of them that were disturbed.
    pub blocks: [u32; 2],
    /// Times that stand although disturbed.
    pub disturbed: u32,
    /// Undisturbed batches.
    pub batches: Vec<Batched>,
    /// Questions asked exactly as before: the first time and the second, nanoseconds.
    pub repeats: Vec<[f64; 2]>,
    /// Time in which nothing was asked, and what the runner computed in it, nanoseconds.
    pub pauses_ns: [f64; 2],
    /// The rest of the pass, and what the runner computed or waited for its CPU in it, nanoseconds; absent where the
    /// kernel does not count, and with several threads.
    pub busy_ns: Option<[f64; 2]>,
    /// Share of the time that the machine below took from the runner's CPU.
    pub steal: Option<f64>,
    /// Calibration loop on the runner's CPU: 5th percentile, median, 95th percentile, nanoseconds.
    pub calibration_ns: [f64; 3],
    /// 10th percentile, median and 90th percentile of the official times, nanoseconds.
    pub times_ns: [f64; 3],
}

impl Session {
    /// Asks all questions of the plan; `present` gives an instance of a configuration, `each` gets every answer and may
    /// stop the pass. An error has ended the session, what was answered before stands.
    pub fn pass(
        &mut self,
        plan: &PassPlan<'_>,
        present: &dyn Fn(u32, Instance) -> Presented,
        each: &mut dyn FnMut(Observation) -> ControlFlow<()>,
    ) -> (PassFacts, Result<(), Outcome>) {
        let cpu = self.policy.runner_cpu;
        let mut pass = Pass {
            speeds: vec![self.clock().calibration_ns],
            singles: Vec::new(),
            instances: 0,
            numbers: Numbers::new(plan.seed),
            facts: PassFacts::default(),
            pauses: 0,
            session: self,
            plan,
            present,
            each,
        };
        let (steal, begun, before) = (Steal::begin(cpu), Instant::now(), pass.session.usage());
        let ended = match pass.run() {
            Ok(_) => Ok(()),
            Err(outcome) => Err(outcome),
        };
        let facts = pass.close(steal.share(), begun.elapsed(), before);
        (facts, ended)
    }
}

struct Pass<'a, 's> {
    session: &'s mut Session,
    plan: &'a PassPlan<'a>,
    present: &'a dyn Fn(u32, Instance) -> Presented,
    each: &'a mut dyn FnMut(Observation) -> ControlFlow<()>,
    numbers: Numbers,
    /// Calibrations so far.
    speeds: Vec<f64>,
    /// Place in the order and official time of what was asked undisturbed, in the order of asking.
    singles: Vec<(usize, f64)>,
    instances: u32,
    pauses: usize,
    facts: PassFacts,
}

type Flow = Result<ControlFlow<()>, Outcome>;

impl Pass<'_, '_> {
    fn run(&mut self) -> Flow {
        let begun = Instant::now();
        let len = self.plan.order.len();
        if self.warm_up()?.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        let mut again: Vec<std::ops::Range<usize>> = Vec::new();
        while self.facts.reached < len && begun.elapsed() < self.plan.allowance {
            let from = self.facts.reached;
            let to = len.min(from + self.size());
            let (asked, disturbed, flow) = self.block(from..to, 0, false)?;
            self.facts.reached = from + asked;
            self.facts.blocks[0] += 1;
            if disturbed {
                self.facts.blocks[1] += 1;
                again.push(from..from + asked);
            }
            if flow.is_break() || self.aside()?.is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        for attempt in 1..ATTEMPTS {
            for range in std::mem::take(&mut again) {
                let mut from = range.start;
                while from < range.end {
                    let (asked, disturbed, flow) = self.block(from..range.end, attempt, attempt + 1 == ATTEMPTS)?;
                    if disturbed && attempt + 1 < ATTEMPTS {
                        again.push(from..from + asked);
                    }
                    from += asked;
                    if flow.is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Some questions from the end of the order, untimed: the first ones meet cold caches, and so do all plugins' first
    /// questions after another one's process.
    fn warm_up(&mut self) -> Flow {
        let begun = Instant::now();
        let instance = self.next_instance(true);
        for &configuration in self.plan.order.iter().rev().take(BLOCK[0]) {
            let sample = self.session.put(self.plan.query, (self.present)(configuration, instance))?;
            let seen = Observation { configuration, instance, answer: sample.answer, time: None };
            if (self.each)(seen).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            if begun.elapsed() > BLOCK_TIME {
                break;
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Asks a stretch of the order, or the beginning of it when that takes long: how many, whether they were disturbed.
    fn block(
        &mut self,
        places: std::ops::Range<usize>,
        attempt: u32,
        last: bool,
    ) -> Result<(usize, bool, ControlFlow<()>), Outcome> {
        let instance = if attempt == 0 { Instance::default() } else { self.next_instance(false) };
        let (begun, before) = (Instant::now(), self.session.usage());
        let mut samples: Vec<Sample> = Vec::with_capacity(places.len());
        for place in places.clone() {
            let question = (self.present)(self.plan.order[place], instance);
            samples.push(self.session.put(self.plan.query, question)?);
            if begun.elapsed() > BLOCK_TIME {
                break;
            }
        }
        let disturbed = self.gate(begun, before)? || samples.iter().any(|sample| sample.disturbed);
        let asked = samples.len();
        let mut flow = ControlFlow::Continue(());
        for (place, sample) in places.zip(samples) {
            let time = Time { ns: sample.time_ns, below_resolution: sample.below_resolution, disturbed };
            if !disturbed {
                self.singles.push((place, sample.time_ns));
            }
            self.facts.disturbed += u32::from(disturbed && last);
            let time = (!disturbed || last).then_some(time);
            let configuration = self.plan.order[place];
            flow = (self.each)(Observation { configuration, instance, answer: sample.answer, time });
            if flow.is_break() {
                break;
            }
        }
        Ok((asked, disturbed, flow))
    }

    /// Was the runner disturbed since then?
    fn gate(&mut self, begun: Instant, before: Option<Usage>) -> Result<bool, Outcome> {
        let passed_ns = begun.elapsed().as_nanos() as f64;
        let waited_ns = match (self.session.usage(), before) {
            (Some(now), Some(before)) => now.since(before).delay_ns,
            _ => 0.0,
        };
        let speed = self.session.calibrate()?;
        let mut usual = self.speeds.iter().rev().take(64).copied().collect::<Vec<_>>();
        usual.sort_by(f64::total_cmp);
        let usual = quantile(&usual, 0.5);
        self.speeds.push(speed);
        Ok(waited_ns > WAITED_NS.max(passed_ns / 500.0) || (speed / usual - 1.0).abs() > SPEED)
    }

    /// At random: a batch, some questions exactly as before, a pause.
    fn aside(&mut self) -> Flow {
        if self.below(BATCH_EVERY) == 0 && self.plan.query != Query::CollisionAll && self.batch()?.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        if self.below(REPEAT_EVERY) == 0 && self.repeat()?.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        // Threads of a library may go on looking for work for a while, which is nobody's answer.
        let alone = self.session.policy.threads == 1;
        if alone && self.pauses < PAUSES && self.below(REPEAT_EVERY) == 0 {
            self.pauses += 1;
            let begun = Instant::now();
            if let Some(usage) = self.session.idle(PAUSE) {
                self.facts.pauses_ns[0] += begun.elapsed().as_nanos() as f64;
                self.facts.pauses_ns[1] += usage.run_ns;
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Some of the questions asked so far, together, as another instance.
    fn batch(&mut self) -> Flow {
        let size = self.size().min(self.singles.len());
        let first = self.below(self.singles.len().saturating_sub(size) + 1);
        let mut members: Vec<(usize, f64)> = match self.plan.coherent {
            true => self.singles[first..first + size].to_vec(),
            false => (0..size).map(|_| self.any(self.singles.len())).collect(),
        };
        let mut sum = 0.0;
        members.retain(|(_, ns)| {
            sum += ns;
            sum <= BATCH_NS
        });
        if members.len() < SMALLEST_BATCH {
            return Ok(ControlFlow::Continue(()));
        }
        let instance = self.next_instance(true);
        let configurations: Vec<u32> = members.iter().map(|(place, _)| self.plan.order[*place]).collect();
        let asked: Vec<_> = configurations.iter().map(|&c| (self.present)(c, instance)).collect();
        let (begun, before) = (Instant::now(), self.session.usage());
        let batch = self.session.batch(self.plan.query, &asked)?;
        if !self.gate(begun, before)? && !batch.disturbed {
            self.facts.batches.push(Batched {
                questions: members.len() as u32,
                alone_ns: members.iter().map(|(_, ns)| ns).sum(),
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

    /// Some of the questions asked long enough ago, exactly as they were.
    fn repeat(&mut self) -> Flow {
        let old = self.singles.len().saturating_sub(REPEAT_AFTER);
        for _ in 0..REPEATS.min(old) {
            let (place, first_ns) = self.any(old);
            if first_ns > BATCH_NS {
                continue;
            }
            let configuration = self.plan.order[place];
            let (begun, before) = (Instant::now(), self.session.usage());
            let sample = self.session.put(self.plan.query, (self.present)(configuration, Instance::default()))?;
            if !self.gate(begun, before)? && !sample.disturbed {
                self.facts.repeats.push([first_ns, sample.time_ns]);
            }
            let instance = Instance::default();
            let flow = (self.each)(Observation { configuration, instance, answer: sample.answer, time: None });
            if flow.is_break() {
                return Ok(flow);
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    fn size(&mut self) -> usize {
        BLOCK[0] + self.below(BLOCK[1] - BLOCK[0] + 1)
    }

    fn below(&mut self, n: usize) -> usize {
        self.numbers.below(n)
    }

    /// One of the first so many questions that were asked undisturbed.
    fn any(&mut self, among: usize) -> (usize, f64) {
        let i = self.below(among);
        self.singles[i]
    }

    fn next_instance(&mut self, aside: bool) -> Instance {
        self.instances += 1;
        Instance { number: self.instances, aside }
    }

    fn close(mut self, steal: Option<f64>, passed: Duration, before: Option<Usage>) -> PassFacts {
        let three = |mut values: Vec<f64>, at: [f64; 3]| {
            values.sort_by(f64::total_cmp);
            if values.is_empty() { [0.0; 3] } else { at.map(|q| quantile(&values, q)) }
        };
        self.facts.steal = steal;
        self.facts.timed = self.singles.len();
        self.facts.calibration_ns = three(self.speeds, [0.05, 0.5, 0.95]);
        self.facts.times_ns = three(self.singles.iter().map(|(_, ns)| *ns).collect(), [0.1, 0.5, 0.9]);
        let used = self.session.usage().zip(before).map(|(now, before)| now.since(before));
        let used = used.filter(|_| self.session.policy.threads == 1);
        let [paused, computed] = self.facts.pauses_ns;
        let busy_ns = passed.as_nanos() as f64 - paused;
        self.facts.busy_ns = used.map(|used| [busy_ns, used.run_ns + used.delay_ns - computed]);
        self.facts
    }
}
