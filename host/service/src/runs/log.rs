//! What a run tells while it is under way: its lanes in the database, its events for whoever follows.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio::runtime::Handle;
use tokio::sync::broadcast;

use crate::Result;
use crate::model::{AlgorithmResult, RunEvent, Stage, StageKind, State};
use crate::runs::preliminary::UnderWay;
use crate::store::{Store, now_us};

/// So often a page learns of progress.
const TELL_EVERY: Duration = Duration::from_millis(200);

/// What is rung when the queue moves; no run has this id.
pub const QUEUE: &str = "";

/// Wakes those who follow runs: the id of a run that has a new event.
#[derive(Clone)]
pub struct RunEvents {
    sender: broadcast::Sender<Arc<str>>,
}

impl RunEvents {
    /// With room for a burst; whoever misses some rings reads the events from the database anyway.
    pub fn new() -> Self {
        Self { sender: broadcast::Sender::new(256) }
    }

    /// Hears of every run from now on.
    pub fn listen(&self) -> broadcast::Receiver<Arc<str>> {
        self.sender.subscribe()
    }

    /// The queue has moved: those who follow a waiting run look at its place anew.
    pub fn queue_moved(&self) {
        let _ = self.sender.send(QUEUE.into());
    }

    /// There is something new of a run that no event has.
    pub fn ring(&self, run: &str) {
        let _ = self.sender.send(run.into());
    }

    /// Writes an event and rings.
    pub async fn tell(&self, store: &Store, run: &str, mut event: RunEvent) -> Result<()> {
        event.at_us = now_us();
        store.add_event(run, &mut event).await?;
        // Nobody listening is no error.
        self.ring(run);
        Ok(())
    }
}

/// An event without lane and result.
pub fn plain_event(state: State, runs_ahead: u32) -> RunEvent {
    RunEvent { seq: 0, at_us: 0, state, runs_ahead, stage: None, result: None, seconds_left: None }
}

/// The lanes of a run that waits for its turn.
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

/// The run under way. Lives on the run's own thread, so its database calls may block.
pub struct RunLog {
    run: String,
    store: Store,
    run_events: RunEvents,
    under_way: Arc<UnderWay>,
    handle: Handle,
    stages: Vec<Stage>,
    meters: Vec<Meter>,
}

impl RunLog {
    /// All lanes begin anew: what an earlier attempt left is found again in the store, quickly.
    pub fn begin(
        run: &str,
        algorithms: &[String],
        (store, run_events, under_way): (Store, RunEvents, Arc<UnderWay>),
        handle: Handle,
    ) -> Result<Self> {
        let stages = fresh_stages(algorithms);
        let meters = stages.iter().map(|_| Meter::new()).collect();
        let log = Self { run: run.to_owned(), store, run_events, under_way, handle, stages, meters };
        for lane in 0..log.stages.len() {
            log.write(lane)?;
        }
        log.send(plain_event(State::Running, 0))?;
        Ok(log)
    }

    /// Waits for a database call.
    pub fn wait<T>(&self, call: impl Future<Output = T>) -> T {
        self.handle.block_on(call)
    }

    /// A lane starts to work.
    pub fn start(&mut self, lane: usize, total: u64) -> Result<()> {
        self.meters[lane] = Meter::new();
        let stage = &mut self.stages[lane];
        (stage.state, stage.done, stage.total) = (State::Running, 0, total);
        self.tell(lane, None)
    }

    /// A lane that has worked since its start has come further. The caller keeps it to about five times a second.
    pub fn progress(&mut self, lane: usize, done: u64, total: u64) -> Result<()> {
        self.progress_after(lane, done, total, self.meters[lane].begun.elapsed())
    }

    /// A lane that works by turns has come further, after so much work of its own. A total of 0 is not known yet.
    pub fn progress_after(&mut self, lane: usize, done: u64, total: u64, worked: Duration) -> Result<()> {
        let rate = self.meters[lane].rate(done, worked);
        let stage = &mut self.stages[lane];
        stage.state = State::Running;
        (stage.done, stage.total, stage.rate) = (done, total, rate);
        stage.seconds_left = (rate > 0.0 && total > 0).then(|| total.saturating_sub(done) as f64 / rate);
        self.tell(lane, None)
    }

    /// As [`RunLog::progress`], but at most five times a second however often it is called.
    pub fn progress_slowly(&mut self, lane: usize, done: u64, total: u64) -> Result<()> {
        if self.meters[lane].told.elapsed() < TELL_EVERY {
            return Ok(());
        }
        self.meters[lane].told = Instant::now();
        self.progress(lane, done, total)
    }

    /// Says something about a lane.
    pub fn note(&mut self, lane: usize, message: Option<&str>) -> Result<()> {
        self.stages[lane].message = message.map(str::to_owned);
        self.tell(lane, None)
    }

    /// A lane has ended.
    pub fn end(
        &mut self,
        lane: usize,
        state: State,
        message: Option<String>,
        result: Option<AlgorithmResult>,
    ) -> Result<()> {
        let stage = &mut self.stages[lane];
        if state == State::Done {
            stage.total = stage.done;
        }
        (stage.state, stage.message, stage.seconds_left) = (state, message, None);
        self.tell(lane, result)
    }

    /// Whatever was at work ends so.
    pub fn end_open(&mut self, state: State, message: Option<&str>) -> Result<()> {
        for lane in 0..self.stages.len() {
            match self.stages[lane].state {
                State::Running => self.end(lane, state, message.map(str::to_owned), None)?,
                State::Queued if state == State::Cancelled => self.end(lane, state, None, None)?,
                _ => {}
            }
        }
        Ok(())
    }

    fn tell(&self, lane: usize, result: Option<AlgorithmResult>) -> Result<()> {
        self.write(lane)?;
        let stage = Some(self.stages[lane].clone());
        self.send(RunEvent { stage, result, ..plain_event(State::Running, 0) })
    }

    fn send(&self, event: RunEvent) -> Result<()> {
        let event = RunEvent { seconds_left: self.under_way.seconds_left(&self.run), ..event };
        self.handle.block_on(self.run_events.tell(&self.store, &self.run, event))
    }

    fn write(&self, lane: usize) -> Result<()> {
        self.handle.block_on(self.store.put_stage(&self.run, lane, &self.stages[lane]))
    }
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
    fn a_lanes_rate_is_that_of_its_own_work() {
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
