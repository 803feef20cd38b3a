//! The table of machines, and whose an attempt is.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Result;
use crate::attempts::sql::{Columns, read};
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind, LEASE_US};
use crate::model::{MachineFacts, MachineInfo, WorkOrder};
use crate::store::{Store, from_json, now_us, to_json};

/// How long a machine that failed gets no run, so that others get the one at which it failed.
const REST_US: i64 = 600_000_000;

/// Name, facts, when it was allowed, seen, revoked, the run that it works on, and its trouble.
type MachineRow = (String, Option<String>, i64, Option<i64>, Option<i64>, Option<String>, Option<String>);

/// The name under which attempts of a machine are kept; those of services are names of data folders.
pub fn worker(machine: &str, class: &str) -> Worker {
    Worker { machine: format!("machine {machine}"), class: class.to_owned() }
}

impl Store {
    /// Allows a machine to measure, or gives it another token.
    pub async fn keep_machine(&self, name: &str, token_sha256: &str) -> Result<()> {
        let text = "INSERT INTO machines (name, token_sha256, created_us) VALUES ($1, $2, $3) \
                    ON CONFLICT (name) DO UPDATE SET token_sha256 = excluded.token_sha256, \
                    created_us = excluded.created_us, facts = NULL, trouble = NULL, rests_until_us = 0, seen_us = NULL, revoked_us = NULL";
        sqlx::query(text).bind(name).bind(token_sha256).bind(now_us()).execute(&self.pool).await?;
        Ok(())
    }

    /// Revokes its token; false when it has none.
    pub async fn revoke_machine(&self, name: &str) -> Result<bool> {
        let text = "UPDATE machines SET revoked_us = $1 WHERE name = $2 AND revoked_us IS NULL";
        let done = sqlx::query(text).bind(now_us()).bind(name).execute(&self.pool).await?;
        Ok(done.rows_affected() == 1)
    }

    /// The machine with this token, unless it was revoked.
    pub async fn machine_of(&self, token_sha256: &str) -> Result<Option<String>> {
        let text = "SELECT name FROM machines WHERE token_sha256 = $1 AND revoked_us IS NULL";
        Ok(sqlx::query_scalar(text).bind(token_sha256).fetch_optional(&self.pool).await?)
    }

    /// Notes what a machine says of itself, unless something has changed that changes its times: what that is.
    pub async fn machine_was_seen(&self, name: &str, facts: &MachineFacts) -> Result<Option<&'static str>> {
        let text = "SELECT facts FROM machines WHERE name = $1";
        let known: Option<Option<String>> = sqlx::query_scalar(text).bind(name).fetch_optional(&self.pool).await?;
        let before: Option<MachineFacts> = known.flatten().map(|facts| from_json(&facts)).transpose()?;
        if let Some(what) = before.and_then(|before| facts.changed_since(&before)) {
            return Ok(Some(what));
        }
        let text = "UPDATE machines SET facts = $1, seen_us = $2, trouble = NULL WHERE name = $3";
        let query = sqlx::query(text).bind(to_json(facts)?).bind(now_us()).bind(name);
        query.execute(&self.pool).await?;
        Ok(None)
    }

    /// All machines by name.
    pub async fn machines(&self) -> Result<Vec<MachineInfo>> {
        let text = "SELECT name, facts, created_us, seen_us, revoked_us, \
                    (SELECT MAX(a.job) FROM attempts a WHERE a.machine = 'machine ' || m.name AND a.ended_us IS NULL), trouble \
                    FROM machines m ORDER BY name";
        let rows: Vec<MachineRow> = sqlx::query_as(text).fetch_all(&self.pool).await?;
        let info = |(name, facts, created_us, seen_us, revoked_us, run, trouble): MachineRow| {
            let facts = facts.map(|facts| from_json(&facts)).transpose()?;
            Ok(MachineInfo { name, facts, created_us, seen_us, revoked_us, run, trouble, drift: None })
        };
        rows.into_iter().map(info).collect()
    }

    /// Notes why a machine gets no run at its next request.
    pub async fn machine_is_refused(&self, name: &str, why: &str) -> Result<()> {
        self.machine_has_trouble(name, why, 0).await
    }

    /// Notes why a machine gets no run for a while.
    pub async fn machine_failed(&self, name: &str, why: &str) -> Result<()> {
        self.machine_has_trouble(name, why, now_us() + REST_US).await
    }

    async fn machine_has_trouble(&self, name: &str, why: &str, rests_until_us: i64) -> Result<()> {
        let text = "UPDATE machines SET trouble = $1, rests_until_us = $2 WHERE name = $3";
        sqlx::query(text).bind(why).bind(rests_until_us).bind(name).execute(&self.pool).await?;
        Ok(())
    }

    /// Until when a machine gets no run.
    pub async fn machine_rests(&self, name: &str) -> Result<i64> {
        let text = "SELECT rests_until_us FROM machines WHERE name = $1";
        Ok(sqlx::query_scalar(text).bind(name).fetch_optional(&self.pool).await?.unwrap_or(0))
    }

    /// The current attempts of a machine.
    pub async fn attempts_of(&self, machine: &str) -> Result<Vec<Attempt>> {
        let text = "SELECT id, kind, job, number FROM attempts WHERE machine = $1 AND ended_us IS NULL";
        let rows: Vec<Columns> = sqlx::query_as(text).bind(worker(machine, "").machine).fetch_all(&self.pool).await?;
        rows.into_iter().map(read).collect()
    }

    /// Machines have a whole lease again: a service that starts was not there to hear their beats.
    pub async fn believe_machines(&self) -> Result<()> {
        let text = "UPDATE attempts SET lease_us = (SELECT now_us FROM database_clock) + $1 \
                    WHERE ended_us IS NULL AND machine LIKE 'machine %'";
        sqlx::query(text).bind(LEASE_US).execute(&self.pool).await?;
        Ok(())
    }

    /// What this machine began last.
    pub async fn last_kind_of(&self, worker: &Worker) -> Result<Option<Kind>> {
        let text =
            "SELECT id, kind, job, number FROM attempts WHERE machine = $1 ORDER BY begun_us DESC, id DESC LIMIT 1";
        let row: Option<Columns> = sqlx::query_as(text).bind(&worker.machine).fetch_optional(&self.pool).await?;
        Ok(row.map(read).transpose()?.map(|attempt| attempt.kind))
    }

    /// Keeps what the machine of this attempt is told to do: a [`WorkOrder`] for a run, an `Errand` otherwise.
    pub async fn keep_order<T: Serialize>(&self, attempt: &str, order: &T) -> Result<()> {
        let text = "UPDATE attempts SET work = $1 WHERE id = $2";
        sqlx::query(text).bind(to_json(order)?).bind(attempt).execute(&self.pool).await?;
        Ok(())
    }

    /// The current attempt with this id and its order, if it is of this machine, which measures a run.
    pub async fn order_of(&self, machine: &str, attempt: &str) -> Result<Option<(Attempt, WorkOrder)>> {
        let found = self.attempt_of(machine, attempt).await?.filter(|found| found.kind == Kind::Measure);
        self.with_order(found).await
    }

    /// What the machine of this current attempt was told to do.
    pub async fn with_order<T: DeserializeOwned>(&self, attempt: Option<Attempt>) -> Result<Option<(Attempt, T)>> {
        let Some(attempt) = attempt else { return Ok(None) };
        let text = "SELECT work FROM attempts WHERE id = $1";
        let work: Option<String> = sqlx::query_scalar(text).bind(&attempt.id).fetch_one(&self.pool).await?;
        work.map(|work| Ok((attempt, from_json(&work)?))).transpose()
    }

    /// The hardware class of who began this attempt.
    pub async fn class_of_attempt(&self, attempt: &str) -> Result<String> {
        let text = "SELECT class FROM attempts WHERE id = $1";
        Ok(sqlx::query_scalar(text).bind(attempt).fetch_one(&self.pool).await?)
    }

    /// The current attempt with this id, if it is of this machine.
    pub async fn attempt_of(&self, machine: &str, attempt: &str) -> Result<Option<Attempt>> {
        let text = "SELECT id, kind, job, number FROM attempts WHERE id = $1 AND machine = $2 AND ended_us IS NULL";
        let query = sqlx::query_as(text).bind(attempt).bind(worker(machine, "").machine);
        let row: Option<Columns> = query.fetch_optional(&self.pool).await?;
        row.map(read).transpose()
    }
}
