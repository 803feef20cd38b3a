//! The one handle for server and command line.

use std::fs::File;
use std::sync::Arc;

use crate::advice::work::Advices;
use crate::blobs::Blobs;
use crate::campaigns::course::Campaigns;
use crate::charts::Charts;
use crate::classes::Classes;
use crate::house::House;
use crate::machine::Machine;
use crate::machines::under_way::Orders;
use crate::mail::outbox::Outbox;
use crate::objects::Objects;
use crate::owned::items::Owned;
use crate::plugins::checks::Checks;
use crate::plugins::registry::Registry;
use crate::results::Results;
use crate::runs::asking::Runs;
use crate::runs::current::Work;
use crate::runs::ends::RunEnds;
use crate::runs::events::RunEvents;
use crate::runs::live::LiveRuns;
use crate::runs::preliminary::UnderWay;
use crate::sets::stored::Sets;
use crate::stability::work::StabilityRuns;
use crate::store::Store;
use crate::suite::Suite;
use crate::suite::known::SuiteRuns;
use crate::tasks::Tasks;
use crate::workloads::recordings::Recordings;
use crate::workloads::replay::Replays;
use crate::{EngineConfig, EngineError, Result};

/// Runs, objects, algorithms and results behind one cheap-to-clone handle.
///
/// `viewer`, `owner` and `caller` are the guest's id (or the name that the command line uses); `None` owns nothing. What a
/// viewer may look at is asked for with `run_is_for`, `object_is_for` and `advice_is_for`, once, at the service's door;
/// functions without a viewer answer every caller. Only its owner may change a run.
#[derive(Clone)]
pub struct Engine {
    pub(crate) inner: Arc<Inner>,
}

/// The parts of one engine; each holds those that it needs.
pub(crate) struct Inner {
    pub config: EngineConfig,
    pub store: Store,
    pub blobs: Blobs,
    pub objects: Arc<Objects>,
    pub registry: Arc<Registry>,
    pub machine: Machine,
    /// The hardware classes on which runs are measured.
    pub classes: Arc<Classes>,
    pub run_events: RunEvents,
    pub live: Arc<LiveRuns>,
    /// What the run at work can show.
    pub under_way: Arc<UnderWay>,
    pub orders: Arc<Orders>,
    /// What public plugins are measured on.
    pub suite: Arc<Suite>,
    pub suite_runs: Arc<SuiteRuns>,
    pub campaigns: Arc<Campaigns>,
    pub run_ends: Arc<RunEnds>,
    pub work: Arc<Work>,
    pub tasks: Arc<Tasks>,
    pub runs: Arc<Runs>,
    pub sets: Arc<Sets>,
    pub results: Arc<Results>,
    pub charts: Charts,
    pub recordings: Arc<Recordings>,
    pub replays: Arc<Replays>,
    pub checks: Arc<Checks>,
    pub stability: Arc<StabilityRuns>,
    pub advices: Arc<Advices>,
    /// Whether this service does the work that one service does for all on the database.
    pub house: Arc<House>,
    pub outbox: Arc<Outbox>,
    pub owned: Owned,
}

impl Engine {
    /// An unnamed temporary file in the data folder.
    pub fn temporary_file(&self) -> Result<File> {
        tempfile::tempfile_in(&self.inner.config.data)
            .map_err(|e| EngineError::fault("Making a temporary file failed", e))
    }
}
