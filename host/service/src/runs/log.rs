//! What a run tells while it is under way: its stages in the database, its events for whoever follows.

use std::sync::Arc;
use std::time::{Duration, Instant};

use ocb_lab::job::Step;
use ocb_lab::measure::Preliminary;
use ocb_lab::worker::Seen;
use tokio::runtime::Handle;

use crate::Result;
use crate::attempts::{Attempt, superseded};
use crate::model::{RunEvent, Stage, StageKind, State};
use crate::runs::events::plain_event;
use crate::runs::live::LiveRuns;

/// So often a page learns of progress.
const TELL_EVERY: Duration = Duration::from_millis(200);

/// The stage of the first algorithm: behind those of the objects and of the configurations.
pub const FIRST_MEASURING: usize = 2;

/// The stages of a run that waits for its turn.
pub fn fresh_stages(algorithms: &[String]) -> Vec<Stage> {
    let stage = |kind, algorithm: Option<&String>| Stage {
        kind,
        algorithm: algorithm.cloned(),
        state: State::Queued,
        done: 0,
        total: 0,
        rate: 0.0,
        seconds_left: None,
        message: None,
    };
    let mut stages = vec![stage(StageKind::Object, None), stage(StageKind::Configurations, None)];
    stages.extend(algorithms.iter().map(|a| stage(StageKind::Measuring, Some(a))));
    stages.push(stage(StageKind::Heatmap, None));
    stages
}

/// The run under way. Lives on the run's own thread, so its database calls may block. Each of them fails when another worker has
/// the run.
pub struct RunLog {
    attempt: Attempt,
    live: Arc<LiveRuns>,
    handle: Handle,
    stages: Vec<Stage>,
    meters: Vec<Meter>,
}

impl RunLog {
    /// All stages begin anew: what an earlier attempt left is found again in the store, quickly.
    pub fn begin(attempt: &Attempt, algorithms: &[String], live: &Arc<LiveRuns>, handle: Handle) -> Result<Self> {
        Self::with_stages(attempt, fresh_stages(algorithms), live, handle)
    }

    /// The log of a run that was prepared: the stages of its objects and configurations stay as they are.
    pub fn go_on(attempt: &Attempt, algorithms: &[String], live: &Arc<LiveRuns>, handle: Handle) -> Result<Self> {
        let mut stages = fresh_stages(algorithms);
        let known = handle.block_on(live.store.stages(&attempt.job))?;
        for (stage, known) in stages.iter_mut().zip(known).take(FIRST_MEASURING) {
            *stage = known;
        }
        Self::with_stages(attempt, stages, live, handle)
    }

    /// The log of an attempt that another process began, or this one before it was started again.
    pub fn resume(attempt: &Attempt, live: &Arc<LiveRuns>, handle: Handle) -> Result<Self> {
        let stages = handle.block_on(live.store.stages(&attempt.job))?;
        Ok(Self::of(attempt, stages, live, handle))
    }

    fn with_stages(attempt: &Attempt, stages: Vec<Stage>, live: &Arc<LiveRuns>, handle: Handle) -> Result<Self> {
        let log = Self::of(attempt, stages, live, handle);
        let stages: Vec<(usize, &Stage)> = log.stages.iter().enumerate().collect();
        log.send(&stages, plain_event(State::Running, 0))?;
        Ok(log)
    }

    fn of(attempt: &Attempt, stages: Vec<Stage>, live: &Arc<LiveRuns>, handle: Handle) -> Self {
        let meters = stages.iter().map(|_| Meter::new()).collect();
        Self { attempt: attempt.clone(), live: live.clone(), handle, stages, meters }
    }

    /// Has this stage ended?
    fn has_ended(&self, index: usize) -> bool {
        !matches!(self.stages[index].state, State::Queued | State::Running)
    }

    /// Number of algorithms that have a stage.
    fn algorithms(&self) -> usize {
        self.stages.len() - FIRST_MEASURING - 1
    }

    /// Is something said about this stage?
    fn has_note(&self, index: usize) -> bool {
        self.stages[index].message.is_some()
    }

    /// Waits for a database call.
    pub fn wait<T>(&self, call: impl Future<Output = T>) -> T {
        self.handle.block_on(call)
    }

    /// A stage starts to work.
    pub fn start(&mut self, index: usize, total: u64) -> Result<()> {
        self.meters[index] = Meter::new();
        let stage = &mut self.stages[index];
        (stage.state, stage.done, stage.total) = (State::Running, 0, total);
        self.tell(index)
    }

    /// A stage that has worked since its start has come further. The caller keeps it to about five times a second.
    pub fn progress(&mut self, index: usize, done: u64, total: u64) -> Result<()> {
        self.progress_after(index, done, total, self.meters[index].begun.elapsed())
    }

    /// A stage that works by turns has come further, after so much work of its own. A total of 0 is not known yet.
    pub fn progress_after(&mut self, index: usize, done: u64, total: u64, worked: Duration) -> Result<()> {
        let rate = self.meters[index].rate(done, worked);
        let stage = &mut self.stages[index];
        stage.state = State::Running;
        (stage.done, stage.total, stage.rate) = (done, total, rate);
        stage.seconds_left = (rate > 0.0 && total > 0).then(|| total.saturating_sub(done) as f64 / rate);
        self.tell(index)
    }

    /// As [`RunLog::progress`], but at most five times a second however often it is called.
    pub fn progress_slowly(&mut self, index: usize, done: u64, total: u64) -> Result<()> {
        if self.meters[index].told.elapsed() < TELL_EVERY {
            return Ok(());
        }
        self.meters[index].told = Instant::now();
        self.progress(index, done, total)
    }

    /// Says something about a stage.
    pub fn note(&mut self, index: usize, message: Option<&str>) -> Result<()> {
        self.stages[index].message = message.map(str::to_owned);
        self.tell(index)
    }

    /// Notes a step of measuring; `reference` is the name of the reference algorithm.
    pub fn step(&mut self, step: &Step, reference: &str) -> Result<()> {
        match *step {
            // It was told before, and arrives late.
            Step::Progress { place, .. } if self.has_ended(FIRST_MEASURING + place.min(self.algorithms() - 1)) => {
                Ok(())
            }
            Step::Waiting(_) if self.has_ended(FIRST_MEASURING) => Ok(()),
            Step::Waiting(waiting) => {
                self.note(FIRST_MEASURING, waiting.then_some("Waiting: another process is measuring on this machine."))
            }
            Step::Progress { place, done, total, worked } if place < self.algorithms() => {
                // The reference has no stage of its own unless it was requested; the first such stage says that it is at work.
                if self.has_note(FIRST_MEASURING) {
                    self.note(FIRST_MEASURING, None)?;
                }
                self.progress_after(FIRST_MEASURING + place, done, total, worked)
            }
            Step::Progress { done, total, .. } => {
                self.note(FIRST_MEASURING, Some(&turn_of_reference(reference, done, total)))
            }
            Step::Preliminary(place, ref seen) => {
                self.share(place, seen);
                Ok(())
            }
        }
    }

    /// Lets the other services on the database show it. What they cannot show is no reason to end the run.
    fn share(&self, place: usize, seen: &Preliminary) {
        let store = &self.live.store;
        if !store.is_shared() {
            return;
        }
        let seen = Seen { place, preliminary: seen.clone() };
        if let Err(e) = self.handle.block_on(store.keep_seen(&self.attempt, &seen, None)) {
            tracing::warn!("run {}: what was found so far is not shown by other services: {e}", self.attempt.job);
        }
    }

    /// A stage has ended.
    pub fn end(&mut self, index: usize, state: State, message: Option<String>) -> Result<()> {
        let stage = &mut self.stages[index];
        if state == State::Done {
            stage.total = stage.done;
        }
        (stage.state, stage.message, stage.seconds_left) = (state, message, None);
        self.tell(index)
    }

    /// Whatever was at work ends so.
    pub fn end_open(&mut self, state: State, message: Option<&str>) -> Result<()> {
        for index in 0..self.stages.len() {
            match self.stages[index].state {
                State::Running => self.end(index, state, message.map(str::to_owned))?,
                State::Queued if state == State::Cancelled => self.end(index, state, None)?,
                _ => {}
            }
        }
        Ok(())
    }

    fn tell(&self, index: usize) -> Result<()> {
        let stage = &self.stages[index];
        self.send(&[(index, stage)], RunEvent { stage: Some(stage.clone()), ..plain_event(State::Running, 0) })
    }

    fn send(&self, stages: &[(usize, &Stage)], event: RunEvent) -> Result<()> {
        let run = self.attempt.job.as_str();
        let mut event = RunEvent { seconds_left: self.live.under_way.seconds_left(run), ..event };
        self.kept(self.live.store.tell(&self.attempt, stages, &mut event))?;
        self.live.run_events.ring(run);
        Ok(())
    }

    /// Waits for a database call that tells whether this attempt is still the current one.
    pub fn kept(&self, call: impl Future<Output = Result<bool>>) -> Result<()> {
        if self.handle.block_on(call)? { Ok(()) } else { Err(superseded()) }
    }
}

/// What is said while the reference algorithm, for which nobody asked, has its turn.
fn turn_of_reference(name: &str, done: u64, total: u64) -> String {
    let of = if total > 0 { format!(" of {total}") } else { String::new() };
    format!("Now the reference algorithm, {name}: {done}{of} queries.")
}

/// Items per second lately.
struct Meter {
    begun: Instant,
    told: Instant,
    /// Time at work when `done` were done.
    worked: Duration,
    done: u64,
    rate: f64,
}

impl Meter {
    fn new() -> Self {
        Self { begun: Instant::now(), told: Instant::now(), worked: Duration::ZERO, done: 0, rate: 0.0 }
    }

    /// Smoothed over about two seconds of work. While others have their turn, it stays.
    fn rate(&mut self, done: u64, worked: Duration) -> f64 {
        if done < self.done || worked < self.worked {
            // A pass that is measured again does not count.
            (self.worked, self.done) = (worked, done);
        }
        let seconds = (worked - self.worked).as_secs_f64();
        if done > self.done && seconds > 0.05 {
            let now = (done - self.done) as f64 / seconds;
            let weight = if self.rate == 0.0 { 1.0 } else { 1.0 - (-seconds / 2.0).exp() };
            self.rate += weight * (now - self.rate);
            (self.worked, self.done) = (worked, done);
        }
        self.rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stages_rate_is_that_of_its_own_work() {
        let mut meter = Meter::new();
        let mut rate = |done, milliseconds| meter.rate(done, Duration::from_millis(milliseconds));
        assert_eq!(rate(0, 0), 0.0);
        assert_eq!(rate(200, 200), 1000.0);
        // The others had their turns, however long; its own went on where it was.
        assert_eq!(rate(400, 400), 1000.0);
        // The last pass is measured again.
        assert_eq!(rate(200, 200), 1000.0);
        let slower = rate(300, 400);
        assert!(500.0 < slower && slower < 1000.0, "{slower}");
    }
}
