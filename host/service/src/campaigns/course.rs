//! What the course of a campaign depends on.

use std::sync::Arc;

use crate::mail::outbox::Outbox;
use crate::objects::Objects;
use crate::plugins::registry::Registry;
use crate::runs::events::RunEvents;
use crate::store::Store;
use crate::suite::known::SuiteRuns;

/// The campaigns of one engine.
pub struct Campaigns {
    pub store: Store,
    pub objects: Arc<Objects>,
    pub registry: Arc<Registry>,
    pub suite_runs: Arc<SuiteRuns>,
    pub outbox: Arc<Outbox>,
    pub run_events: RunEvents,
}
