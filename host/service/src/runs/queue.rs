//! The queue: which run is next.

use std::ops::RangeInclusive;

use sqlx::AnyConnection;

use crate::Result;
use crate::attempts::sql::{at_rest, begin, end, withdraw};
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind, MOST_LOST, Outcome};
use crate::model::State;
use crate::runs::events::plain_event;
use crate::runs::events_sql::append_event;
use crate::runs::priority::{BACKGROUND, IDLE, INTERACTIVE};
use crate::runs::share::{OfClass, Since};
use crate::runs::sql::state_name;
use crate::store::{Store, now_us};

/// The queued and running work of an owner or an address.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Granted {
    /// Queued runs.
    pub waiting: u64,
    /// Measuring time of queued and running runs.
    pub seconds: f64,
}

/// This of the runs that wait, with these priorities and of this class, for which this holds.
/// The class comes third, the usual one fourth; where the first is null, any will do.
macro_rules! waiting {
    ($what:literal, $which:literal) => {
        concat!(
            "SELECT ",
            $what,
            " FROM runs r LEFT JOIN served s ON s.owner = r.turn ",
            "WHERE r.state = 'queued' AND r.priority BETWEEN $1 AND $2 ",
            "AND (CAST($3 AS TEXT) IS NULL OR COALESCE(r.hardware_class, $4) = $3) AND ",
            at_rest!("measure", "r.id"),
            " AND ",
            at_rest!("prepare", "r.id"),
            " AND ",
            $which
        )
    };
}

/// The next one of them.
macro_rules! next {
    ($which:literal) => {
        concat!(waiting!("r.id", $which), " ORDER BY r.priority, COALESCE(s.served_us, 0), r.created_us, r.id LIMIT 1")
    };
}

/// Is there one that is due before another job?
macro_rules! sooner {
    ($which:literal) => {
        concat!(waiting!("1", $which), " AND (COALESCE(s.served_us, 0), r.created_us, r.id) < ($5, $6, $7) LIMIT 1")
    };
}

macro_rules! granted {
    ($whose:literal) => {
        concat!(
            "SELECT CAST(COALESCE(SUM(CASE WHEN state = 'queued' THEN 1 ELSE 0 END), 0) AS BIGINT), ",
            "COALESCE(SUM(granted_seconds), 0.0) FROM runs ",
            "WHERE state IN ('queued', 'running') AND campaign IS NULL AND ",
            $whose,
            " = $1"
        )
    };
}

impl Store {
    /// Begins an attempt at the next run: smallest priority, then whose turn was longest ago, then the oldest. Idle work is not
    /// among them.
    pub async fn begin_run(&self, worker: &Worker) -> Result<Option<Attempt>> {
        let class = Some(worker.class.as_str());
        self.begin_next(worker, Kind::Measure, i64::MIN..=BACKGROUND, [class, class], next!("TRUE")).await
    }

    /// Begins an attempt at a run that the service queued for when it is idle.
    pub async fn begin_idle_run(&self, worker: &Worker) -> Result<Option<Attempt>> {
        let class = Some(worker.class.as_str());
        self.begin_next(worker, Kind::Measure, IDLE..=IDLE, [class, class], next!("TRUE")).await
    }

    /// Begins to prepare the next run for a measuring machine of whatever class. No visitor has more than a few prepared runs of one
    /// class, so that those of others are prepared in time for their turn.
    pub async fn begin_preparing(&self, worker: &Worker) -> Result<Option<Attempt>> {
        self.begin_to_prepare(worker, i64::MIN..=BACKGROUND).await
    }

    /// The same for idle work.
    pub async fn begin_preparing_idle(&self, worker: &Worker) -> Result<Option<Attempt>> {
        self.begin_to_prepare(worker, IDLE..=IDLE).await
    }

    async fn begin_to_prepare(&self, worker: &Worker, priorities: RangeInclusive<i64>) -> Result<Option<Attempt>> {
        let text = next!(
            "r.prepared = 0 AND 8 > (SELECT COUNT(*) FROM runs p WHERE p.turn = r.turn AND p.state = 'queued' AND p.prepared = 1 \
             AND COALESCE(p.hardware_class, '') = COALESCE(r.hardware_class, ''))"
        );
        self.begin_next(worker, Kind::Prepare, priorities, [None, None], text).await
    }

    /// Does a visitor's run wait that is due before this other job? For a measuring machine, with the usual hardware class, a
    /// prepared one.
    pub async fn run_is_due_before(&self, other: &Since, worker: &Worker, machine_of: Option<&str>) -> Result<bool> {
        let text = if machine_of.is_some() { sooner!("r.prepared = 1") } else { sooner!("TRUE") };
        let class = worker.class.as_str();
        let query = sqlx::query(text).bind(i64::MIN).bind(INTERACTIVE).bind(class).bind(machine_of.unwrap_or(class));
        let (served_us, created_us, id) = other;
        let query = query.bind(served_us).bind(created_us).bind(id);
        Ok(query.fetch_optional(&self.pool).await?.is_some())
    }

    /// Begins an attempt at the next prepared run of the worker's class, idle work last. Runs that name no class are of the usual one.
    pub async fn begin_prepared_run(&self, worker: &Worker, usual: &str) -> Result<Option<Attempt>> {
        let classes = [Some(worker.class.as_str()), Some(usual)];
        self.begin_next(worker, Kind::Measure, i64::MIN..=IDLE, classes, next!("r.prepared = 1")).await
    }

    /// Work that waits for a measuring machine of this class, without idle work. What is no run is for machines of the usual one.
    pub async fn waiting_for_machines(&self, of: &OfClass) -> Result<u64> {
        let text = concat!(
            "SELECT (SELECT COUNT(*) FROM runs WHERE state = 'queued' AND prepared = 1 AND priority <= $1 ",
            "AND COALESCE(hardware_class, $2) = $3) ",
            "+ (SELECT COUNT(*) FROM submissions s WHERE s.state = 'uploaded' AND s.attempts < $4 AND $2 = $3 AND ",
            at_rest!("check", "s.id"),
            ") + (SELECT COUNT(*) FROM stability_runs t WHERE t.state IN ('queued', 'running') AND t.priority = $5 AND $2 = $3 AND ",
            at_rest!("stability", "t.id"),
            ") + (SELECT COUNT(*) FROM workloads w WHERE w.state IN ('queued', 'running') AND $2 = $3 AND ",
            at_rest!("replay", "w.id"),
            ") + (SELECT COUNT(*) FROM advice v WHERE v.ended = 0 AND v.owner IS NOT NULL AND $2 = $3 AND ",
            at_rest!("advise", "v.id"),
            ")"
        );
        let query = sqlx::query_scalar::<_, i64>(text).bind(BACKGROUND).bind(&of.usual).bind(&of.class);
        Ok(query.bind(MOST_LOST).bind(INTERACTIVE).fetch_one(&self.pool).await? as u64)
    }

    /// Is this run idle work while something else waits for a machine of its class?
    pub async fn gives_way(&self, run: &str, usual: &str) -> Result<bool> {
        let text = "SELECT COALESCE(hardware_class, $3) FROM runs WHERE id = $1 AND priority = $2";
        let query = sqlx::query_scalar(text).bind(run).bind(IDLE).bind(usual);
        let Some(class) = query.fetch_optional(&self.pool).await? else { return Ok(false) };
        Ok(self.waiting_for_machines(&OfClass { class, usual: usual.to_owned() }).await? > 0)
    }

    /// Runs and stability runs of idle work that wait or are under way.
    pub async fn idle_runs(&self) -> Result<u64> {
        let text = "SELECT (SELECT COUNT(*) FROM runs WHERE priority = $1 AND state IN ('queued', 'running')) \
                    + (SELECT COUNT(*) FROM stability_runs WHERE priority = $1 AND state IN ('queued', 'running'))";
        Ok(sqlx::query_scalar::<_, i64>(text).bind(IDLE).fetch_one(&self.pool).await? as u64)
    }

    /// A run waits for a measuring machine from now on; false when the attempt is not the current one.
    pub async fn run_is_prepared(&self, attempt: &Attempt) -> Result<bool> {
        self.queue_anew(attempt, Outcome::Accepted, Some(true)).await
    }

    /// How long it took to prepare a run.
    pub async fn prepared_in_seconds(&self, run: &str) -> Result<f64> {
        let text = "SELECT ended_us - begun_us FROM attempts \
                    WHERE job = $1 AND kind = 'prepare' AND outcome = 'accepted' ORDER BY number DESC LIMIT 1";
        let took_us: Option<i64> = sqlx::query_scalar(text).bind(run).fetch_optional(&self.pool).await?;
        Ok(took_us.unwrap_or(0) as f64 / 1e6)
    }

    async fn begin_next(
        &self,
        worker: &Worker,
        kind: Kind,
        priorities: RangeInclusive<i64>,
        [class, usual]: [Option<&str>; 2],
        text: &'static str,
    ) -> Result<Option<Attempt>> {
        // Another worker may take what this one has chosen; then it chooses again.
        loop {
            let query =
                sqlx::query_scalar(text).bind(*priorities.start()).bind(*priorities.end()).bind(class).bind(usual);
            let Some(next): Option<String> = query.fetch_optional(&self.pool).await? else { return Ok(None) };
            let mut transaction = self.pool.begin().await?;
            let Some(attempt) = begin(&mut transaction, kind, &next, worker).await? else { continue };
            let turn: Option<String> = sqlx::query_scalar(
                "UPDATE runs SET state = 'running', attempts = attempts + 1, started_us = $1, message = NULL \
                 WHERE id = $2 AND state = 'queued' RETURNING turn",
            )
            .bind(now_us())
            .bind(&next)
            .fetch_optional(&mut *transaction)
            .await?;
            let Some(turn) = turn else { continue };
            if kind == Kind::Measure {
                served(&mut transaction, &turn).await?;
            }
            transaction.commit().await?;
            return Ok(Some(attempt));
        }
    }

    /// Puts a run under way back without counting the attempt: it was asked to stop, and not because of what it did. False when
    /// the attempt is not the current one.
    pub async fn put_back_run(&self, attempt: &Attempt) -> Result<bool> {
        self.queue_anew(attempt, Outcome::PutBack, None).await
    }

    /// The same for a run that must be prepared again.
    pub async fn prepare_again(&self, attempt: &Attempt) -> Result<bool> {
        self.queue_anew(attempt, Outcome::PutBack, Some(false)).await
    }

    /// Queues a run under way again without counting the attempt.
    async fn queue_anew(&self, attempt: &Attempt, outcome: Outcome, prepared: Option<bool>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, outcome).await? {
            return Ok(false);
        }
        let text = "UPDATE runs SET state = 'queued', attempts = attempts - 1, \
                    prepared = COALESCE($2, prepared) WHERE id = $1 AND state = 'running'";
        let query = sqlx::query(text).bind(&attempt.job).bind(prepared.map(i64::from));
        query.execute(&mut *transaction).await?;
        append_event(&mut transaction, &attempt.job, &mut plain_event(State::Queued, 0)).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Ends a run that another worker is at; false when none is.
    pub async fn withdraw_run(&self, id: &str, here: &Worker, to: State, message: Option<&str>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !withdraw(&mut transaction, Kind::Measure, id, here).await?
            && !withdraw(&mut transaction, Kind::Prepare, id, here).await?
        {
            return Ok(false);
        }
        let text = "UPDATE runs SET state = $1, message = $2, finished_us = $3 WHERE id = $4 AND state = 'running'";
        let query = sqlx::query(text).bind(state_name(to)).bind(message).bind(now_us()).bind(id);
        query.execute(&mut *transaction).await?;
        append_event(&mut transaction, id, &mut plain_event(to, 0)).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Of this owner, without runs of campaigns.
    pub async fn granted_to(&self, owner: &str) -> Result<Granted> {
        self.granted(granted!("owner"), owner).await
    }

    /// Of all visitors from this address.
    pub async fn granted_at(&self, address: &str) -> Result<Granted> {
        self.granted(granted!("address"), address).await
    }

    async fn granted(&self, text: &'static str, whose: &str) -> Result<Granted> {
        let (waiting, seconds): (i64, f64) = sqlx::query_as(text).bind(whose).fetch_one(&self.pool).await?;
        Ok(Granted { waiting: waiting as u64, seconds })
    }

    /// Runs of a class under way that others wait for: when they were started and what they were expected to take.
    pub async fn running(&self, of: &OfClass) -> Result<Vec<(i64, f64)>> {
        let text = "SELECT COALESCE(started_us, 0), expected_seconds FROM runs \
                    WHERE state = 'running' AND priority <= $1 AND COALESCE(hardware_class, $2) = $3";
        Ok(sqlx::query_as(text).bind(BACKGROUND).bind(&of.usual).bind(&of.class).fetch_all(&self.pool).await?)
    }

    /// How many runs are under way that others wait for, of whatever class.
    pub async fn running_in_all(&self) -> Result<u32> {
        let text = "SELECT COUNT(*) FROM runs WHERE state = 'running' AND priority <= $1";
        Ok(sqlx::query_scalar::<_, i64>(text).bind(BACKGROUND).fetch_one(&self.pool).await? as u32)
    }
}

/// Who has this turn was served now.
pub(crate) async fn served(connection: &mut AnyConnection, turn: &str) -> Result<()> {
    let text = "INSERT INTO served (owner, served_us) VALUES ($1, $2) \
                ON CONFLICT (owner) DO UPDATE SET served_us = excluded.served_us";
    sqlx::query(text).bind(turn).bind(now_us()).execute(connection).await?;
    Ok(())
}
