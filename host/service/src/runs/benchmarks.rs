//! The runs of the queue as jobs of this service.

use std::sync::Arc;

use crate::attempts::Attempt;
use crate::blobs::Blobs;
use crate::machine::Machine;
use crate::objects::Objects;
use crate::plugins::registry::Registry;
use crate::results::Results;
use crate::runs::current::Work;
use crate::runs::ends::RunEnds;
use crate::runs::live::LiveRuns;
use crate::sets::stored::Sets;
use crate::store::Store;
use crate::suite::Suite;
use crate::{Ceilings, Result};

/// The runs that this service measures, or prepares for measuring machines.
pub struct Benchmarks {
    pub store: Store,
    pub blobs: Blobs,
    pub objects: Arc<Objects>,
    pub registry: Arc<Registry>,
    pub sets: Arc<Sets>,
    pub results: Arc<Results>,
    pub suite: Arc<Suite>,
    pub live: Arc<LiveRuns>,
    pub run_ends: Arc<RunEnds>,
    pub work: Arc<Work>,
    pub machine: Machine,
    pub ceilings: Ceilings,
    /// Runs are only prepared here.
    pub elsewhere: bool,
}

impl Benchmarks {
    /// Begins an attempt at the next run: one that somebody asked for, or idle work.
    pub async fn next(&self, idle: bool) -> Result<Option<Attempt>> {
        let worker = &self.work.worker;
        match (self.elsewhere, idle) {
            (false, false) => self.store.begin_run(worker).await,
            (false, true) => self.store.begin_idle_run(worker).await,
            (true, false) => self.store.begin_preparing(worker).await,
            (true, true) => self.store.begin_preparing_idle(worker).await,
        }
    }
}
