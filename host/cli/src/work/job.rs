//! What a measuring machine is told to do, from its order to what it hands in.

use ocb_service::model::{Errand, WorkOrder};
use ocb_service::worker::{Fetch, Handed, Tell, Worker};
use ocb_service::{LabError, Stop};

/// Nothing is handed in when the work was stopped.
type Done = Result<Option<Handed>, LabError>;
type Doing = dyn FnOnce(&Worker, &Stop, &Fetch<'_>, Tell<'_>) -> Done + Send;

/// A run, or an errand.
pub struct Job {
    /// Id of its attempt.
    pub attempt: String,
    /// In words.
    pub name: String,
    /// It is stopped after so many seconds of work.
    pub most_seconds: Option<f64>,
    /// Does it; blocks.
    pub doing: Box<Doing>,
}

impl Job {
    /// To measure a run.
    pub fn run(order: WorkOrder) -> Self {
        let (attempt, name, most_seconds) =
            (order.attempt.clone(), format!("the run {}", order.run), order.most_seconds);
        let doing = move |worker: &Worker, stop: &Stop, fetch: &Fetch<'_>, tell: Tell<'_>| {
            worker.measure(&order, stop, fetch, tell)
        };
        Self { attempt, name, most_seconds, doing: Box::new(doing) }
    }

    /// Something else.
    pub fn errand(errand: Errand) -> Self {
        let (attempt, most_seconds) = (errand.attempt.clone(), errand.most_seconds);
        let name = format!("{} {}", errand.wanted.name(), errand.job);
        let doing = move |worker: &Worker, stop: &Stop, fetch: &Fetch<'_>, tell: Tell<'_>| {
            worker.run_errand(&errand, stop, fetch, tell)
        };
        Self { attempt, name, most_seconds, doing: Box::new(doing) }
    }
}
