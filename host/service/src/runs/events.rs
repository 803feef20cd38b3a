//! Events of runs, and who is woken by them.

use std::sync::Arc;

use tokio::sync::broadcast;

use crate::Result;
use crate::model::{RunEvent, State};
use crate::store::Store;

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
        store.add_event(run, &mut event).await?;
        // Nobody listening is no error.
        self.ring(run);
        Ok(())
    }
}

/// An event without stage and result.
pub fn plain_event(state: State, runs_ahead: u32) -> RunEvent {
    RunEvent { seq: 0, at_us: 0, state, runs_ahead, stage: None, result: None, seconds_left: None }
}
