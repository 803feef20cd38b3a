//! Beginning, renewing and ending attempts. What that means for a job is in the same transaction, beside the job's rows.

use sqlx::{Any, AnyConnection, Executor};

use super::worker::Worker;
use super::{Attempt, Kind, LEASE_US, Outcome};
use crate::Result;
use crate::store::Store;

/// Holds while the attempt with the id of this placeholder is the current one.
macro_rules! while_current {
    ($id:literal) => {
        concat!("EXISTS (SELECT 1 FROM attempts WHERE id = ", $id, " AND ended_us IS NULL)")
    };
}
/// Holds for a job without a current attempt.
macro_rules! at_rest {
    ($kind:literal, $job:literal) => {
        concat!(
            "NOT EXISTS (SELECT 1 FROM attempts at_work WHERE at_work.kind = '",
            $kind,
            "' AND at_work.job = ",
            $job,
            " AND at_work.ended_us IS NULL)"
        )
    };
}
pub(crate) use {at_rest, while_current};

/// Id, kind, job, number.
pub(crate) type Columns = (String, String, String, i64);

impl Store {
    /// Renews the lease; false when the attempt has ended.
    pub async fn beat(&self, attempt: &str) -> Result<bool> {
        let text = "UPDATE attempts SET lease_us = (SELECT now_us FROM database_clock) + $1 \
                    WHERE id = $2 AND ended_us IS NULL";
        let done = sqlx::query(text).bind(LEASE_US).bind(attempt).execute(&self.pool).await?;
        Ok(done.rows_affected() == 1)
    }

    /// Ends no lease later than one that begins now. When the database's clock was put back, a worker that died before would be
    /// waited for as long as it was put back.
    pub async fn shorten_leases(&self) -> Result<()> {
        let text = "UPDATE attempts SET lease_us = (SELECT now_us FROM database_clock) + $1 \
                    WHERE ended_us IS NULL AND lease_us > (SELECT now_us FROM database_clock) + $1";
        sqlx::query(text).bind(LEASE_US).execute(&self.pool).await?;
        Ok(())
    }

    /// Withdraws the attempt of another worker at a job that was ended here; false when there is none.
    pub async fn withdraw(&self, kind: Kind, job: &str, here: &Worker) -> Result<bool> {
        let mut connection = self.pool.acquire().await?;
        withdraw(&mut connection, kind, job, here).await
    }

    /// Current attempts whose lease is over, and all of this machine if it has just started.
    pub async fn silent_attempts(&self, just_started: Option<&Worker>) -> Result<Vec<Attempt>> {
        let text = "SELECT id, kind, job, number FROM attempts WHERE ended_us IS NULL \
                    AND (machine = $1 OR lease_us < (SELECT now_us FROM database_clock)) ORDER BY begun_us, id";
        let machine = just_started.map(|worker| worker.machine.as_str());
        let rows: Vec<Columns> = sqlx::query_as(text).bind(machine).fetch_all(&self.pool).await?;
        rows.into_iter().map(read).collect()
    }
}

/// Begins an attempt; nothing when another worker was quicker.
pub(crate) async fn begin(
    connection: &mut AnyConnection,
    kind: Kind,
    job: &str,
    worker: &Worker,
) -> Result<Option<Attempt>> {
    let id = uuid::Uuid::now_v7().to_string();
    let number: Option<i64> = sqlx::query_scalar(
        "INSERT INTO attempts (id, kind, job, number, class, machine, begun_us, lease_us) \
         SELECT $1, $2, $3, (SELECT COUNT(*) FROM attempts WHERE kind = $2 AND job = $3) + 1, $4, $5, now_us, now_us + $6 \
         FROM database_clock \
         WHERE NOT EXISTS (SELECT 1 FROM attempts WHERE kind = $2 AND job = $3 AND ended_us IS NULL) \
         ON CONFLICT DO NOTHING RETURNING number",
    )
    .bind(&id)
    .bind(kind.name())
    .bind(job)
    .bind(&worker.class)
    .bind(&worker.machine)
    .bind(LEASE_US)
    .fetch_optional(connection)
    .await?;
    Ok(number.map(|number| Attempt { id, kind, job: job.to_owned(), number }))
}

/// Ends an attempt; false when it had ended, and then nothing of it may be kept.
pub(crate) async fn end(connection: &mut AnyConnection, attempt: &Attempt, outcome: Outcome) -> Result<bool> {
    let text = "UPDATE attempts SET ended_us = (SELECT now_us FROM database_clock), outcome = $1 \
                WHERE id = $2 AND ended_us IS NULL";
    let done = sqlx::query(text).bind(outcome.name()).bind(&attempt.id).execute(connection).await?;
    Ok(done.rows_affected() == 1)
}

/// Ends an attempt whose worker is gone; false when it has renewed its lease meanwhile, unless that worker is given up.
pub(crate) async fn lose(connection: &mut AnyConnection, attempt: &Attempt, given_up: Option<&Worker>) -> Result<bool> {
    let text = "UPDATE attempts SET ended_us = (SELECT now_us FROM database_clock), outcome = $1 \
                WHERE id = $2 AND ended_us IS NULL \
                AND (machine = $3 OR lease_us < (SELECT now_us FROM database_clock))";
    let machine = given_up.map(|worker| worker.machine.as_str());
    let done = sqlx::query(text).bind(Outcome::Lost.name()).bind(&attempt.id).bind(machine);
    Ok(done.execute(connection).await?.rows_affected() == 1)
}

/// Withdraws the attempt of another worker at a job that is ended here, who learns it with the next beat; false when there is none.
pub(crate) async fn withdraw(connection: &mut AnyConnection, kind: Kind, job: &str, here: &Worker) -> Result<bool> {
    let text = "UPDATE attempts SET ended_us = (SELECT now_us FROM database_clock), outcome = $1 \
                WHERE kind = $2 AND job = $3 AND ended_us IS NULL AND machine <> $4";
    let done = sqlx::query(text).bind(Outcome::Withdrawn.name()).bind(kind.name()).bind(job).bind(&here.machine);
    Ok(done.execute(connection).await?.rows_affected() == 1)
}

/// Forgets all attempts at a job that is taken away.
pub(crate) async fn forget(connection: impl Executor<'_, Database = Any>, job: &str) -> Result<()> {
    sqlx::query("DELETE FROM attempts WHERE job = $1").bind(job).execute(connection).await?;
    Ok(())
}

pub(crate) fn read((id, kind, job, number): Columns) -> Result<Attempt> {
    Ok(Attempt { id, kind: Kind::named(&kind)?, job, number })
}
