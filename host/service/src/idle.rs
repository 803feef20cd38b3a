//! Idle work: a service without requests measures the examples of its start page and the missing results of the suite, and
//! tests its algorithms for stability.
//!
//! The service that keeps house queues one thing at a time, at the lowest priority, and idle work gives way to any request: the work is put back, and begins again
//! when the service is idle again. It is tried once, whatever its outcome: a failure would be repeated for ever.

pub mod sql;

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::advice::work::Advices;
use crate::classes::Classes;
use crate::examples::next_example;
use crate::house::House;
use crate::idle::sql::{Tried, TriedSet};
use crate::locks::Lock;
use crate::model::{AlgorithmInfo, ExampleWork, RunSpec, StabilitySpec, State};
use crate::plugins::registry::Registry;
use crate::runs::asking::{RunContext, Runs};
use crate::runs::benchmarks::Benchmarks;
use crate::runs::current::Work;
use crate::runs::priority::IDLE;
use crate::stability::runs_sql::StabilityRow;
use crate::stability::work::StabilityRuns;
use crate::store::{Store, now_us};
use crate::suite::known::SuiteRuns;
use crate::suite::planning::AT_ONCE;
use crate::{EngineError, Result};

/// When nothing was missing, or something failed, the next look is after so long.
const LOOK: Duration = Duration::from_secs(300);
/// Name of the stability test in the list of tried work.
const STABILITY: &str = "stability";

/// What is measured, tried and advised while nothing else is asked for.
pub struct IdleWork {
    pub store: Store,
    pub registry: Arc<Registry>,
    pub classes: Arc<Classes>,
    pub house: Arc<House>,
    pub work: Arc<Work>,
    pub suite_runs: Arc<SuiteRuns>,
    pub runs: Arc<Runs>,
    pub benchmarks: Arc<Benchmarks>,
    pub stability: Arc<StabilityRuns>,
    pub advices: Arc<Advices>,
    /// Whether there is any.
    pub wanted: bool,
    /// When to look again for missing results.
    pub next: Option<Instant>,
}

impl IdleWork {
    /// Carries out one piece of idle work; false when there is none, or none may be done now. `asked` is the number of requests
    /// when the queue was found empty.
    pub async fn work(&mut self, asked: u64) -> bool {
        if !self.wanted || self.work.closing() {
            return false;
        }
        self.go_on(asked).await.unwrap_or_else(|e| {
            tracing::error!("idle work: {e}");
            self.next = Some(Instant::now() + LOOK);
            false
        })
    }

    async fn go_on(&mut self, asked: u64) -> Result<bool> {
        // Advice is made beside the queue.
        if self.store.count_open_advice("").await?[0] > 0 {
            return Ok(false);
        }
        // What was queued last, or gave way before.
        if let Some(attempt) = self.benchmarks.next(true).await? {
            self.benchmarks.carry_out(&attempt, Some(asked)).await?;
            return Ok(true);
        }
        if self.stability.next(Some(asked)).await? || self.advices.next_own(asked).await? {
            return Ok(true);
        }
        // Enough for every machine until the next look.
        if self.benchmarks.elsewhere && self.store.idle_runs().await? >= 2 * self.classes.machines() {
            return Ok(false);
        }
        if !self.house.is_here() || self.next.is_some_and(|next| Instant::now() < next) {
            return Ok(false);
        }
        let queued = self.queue_next().await?;
        self.next = (!queued).then(|| Instant::now() + LOOK);
        Ok(queued)
    }

    /// Queues the next missing work: the examples first, then the suite, then stability. False when nothing is missing.
    async fn queue_next(&self) -> Result<bool> {
        // Another planner queues work, and then the service is not idle any more.
        let Some(_alone) = self.store.locks.try_alone(Lock::Planning).await? else { return Ok(false) };
        let tried = self.store.tried().await?;
        let (advisor, class) = (&self.advices.from.program, &self.work.worker.class);
        if let Some((work, what)) = next_example(&self.registry, advisor, class, &tried) {
            match work {
                ExampleWork::Run { spec, .. } => self.queue_run(*spec, &[what], None).await?,
                ExampleWork::Advice { spec } => note(&self.store, self.advices.ask_own(spec).await, &[what]).await?,
            }
            return Ok(true);
        }
        if let Some(spec) = self.suite_runs.next_missing(&self.registry.public(), &tried).await? {
            self.suite_runs.keep_suite().await?;
            let what = self.suite_runs.of_the_suite(&spec, &self.classes.waiting_for(&spec).class)?;
            let algorithms =
                self.registry.public().into_iter().filter(|algorithm| spec.algorithms.contains(&algorithm.id));
            let tried: Vec<Tried> = algorithms.map(|algorithm| Tried::of(&what, &algorithm)).collect();
            self.queue_run(spec, &tried, Some(&self.suite_runs.suite.sha256)).await?;
            return Ok(true);
        }
        match next_for_stability(&self.store, &self.registry, &tried).await? {
            Some(algorithm) => queue_stability(&self.store, algorithm).await.map(|()| true),
            None => Ok(false),
        }
    }

    async fn queue_run(&self, spec: RunSpec, tried: &[Tried], suite: Option<&str>) -> Result<()> {
        let context = RunContext { priority: IDLE, suite, ..RunContext::default() };
        note(&self.store, self.runs.enqueue(spec, context).await.map(|(run, _)| run), tried).await
    }
}

/// Notes what was tried and in which run or advice. What cannot be asked for is not asked for again.
async fn note(store: &Store, queued: Result<String>, tried: &[Tried]) -> Result<()> {
    let id = match queued {
        Ok(id) => id,
        Err(e @ EngineError::Fault(_)) => return Err(e),
        Err(e) => {
            tracing::warn!("idle work cannot be queued: {e}");
            String::new()
        }
    };
    for what in tried {
        store.note_tried(what, &id).await?;
    }
    Ok(())
}

async fn queue_stability(store: &Store, algorithm: AlgorithmInfo) -> Result<()> {
    let tried = Tried::of(STABILITY, &algorithm);
    let row = StabilityRow {
        id: uuid::Uuid::now_v7().to_string(),
        owner: None,
        turn: String::new(),
        priority: IDLE,
        state: State::Queued,
        attempts: 0,
        message: None,
        spec: StabilitySpec { algorithm: algorithm.id, parts: Vec::new(), seeds: None },
        name: algorithm.name,
        done: Vec::new(),
        spent_seconds: 0.0,
        created_us: now_us(),
        finished_us: None,
    };
    store.add_stability_run(&row).await?;
    store.note_tried(&tried, &row.id).await
}

/// Ends runs of the suite that wait for an idle service, where none comes: they are missing again.
pub async fn end_waiting(store: &Store) -> Result<()> {
    for run in store.end_idle_runs("Filling the suite while idle was turned off.").await? {
        store.forget_tried(&run).await?;
    }
    Ok(())
}

impl SuiteRuns {
    /// The next scenario with public algorithms that were not measured in it, and for which that was not tried.
    async fn next_missing(&self, public: &[AlgorithmInfo], tried: &TriedSet) -> Result<Option<RunSpec>> {
        for class in self.classes.names() {
            let known = self.known(&class).await?;
            for spec in self.suite.scenarios() {
                let what = self.of_the_suite(&spec, &class)?;
                let missing = public.iter().filter(|algorithm| {
                    algorithm.queries.contains(&spec.query)
                        && known.of(algorithm, &spec).is_none()
                        && !tried.contains(&Tried::of(&what, algorithm))
                });
                let algorithms: Vec<String> = missing.take(AT_ONCE).map(|algorithm| algorithm.id.clone()).collect();
                if !algorithms.is_empty() {
                    return Ok(Some(RunSpec { algorithms, hardware_class: self.classes.named(&class), ..spec }));
                }
            }
        }
        Ok(None)
    }
}

async fn next_for_stability(store: &Store, registry: &Registry, tried: &TriedSet) -> Result<Option<AlgorithmInfo>> {
    let found = store.stability().await?;
    let known = |algorithm: &AlgorithmInfo| {
        found.iter().any(|found| {
            found.complete && (&found.algorithm, &found.plugin_sha256) == (&algorithm.id, &algorithm.plugin_sha256)
        })
    };
    let missing = |algorithm: &AlgorithmInfo| !known(algorithm) && !tried.contains(&Tried::of(STABILITY, algorithm));
    Ok(registry.installed().into_iter().find(missing))
}
