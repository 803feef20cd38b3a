//! The table of machines, and whose an attempt is.

use crate::Result;
use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, Kind};
use crate::model::{MachineFacts, MachineInfo};
use crate::store::{Store, from_json, now_us, to_json};

/// Name, facts, when it was allowed, seen, revoked, and the run that it works on.
type MachineRow = (String, Option<String>, i64, Option<i64>, Option<i64>, Option<String>);

/// The name under which attempts of a machine are kept; those of services are names of data folders.
pub fn worker(machine: &str, class: &str) -> Worker {
    Worker { machine: format!("machine {machine}"), class: class.to_owned() }
}

impl Store {
    /// Allows a machine to measure, or gives it another token.
    pub async fn keep_machine(&self, name: &str, token_sha256: &str) -> Result<()> {
        let text = "INSERT INTO machines (name, token_sha256, created_us) VALUES ($1, $2, $3) \
                    ON CONFLICT (name) DO UPDATE SET token_sha256 = excluded.token_sha256, \
                    created_us = excluded.created_us, facts = NULL, seen_us = NULL, revoked_us = NULL";
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
        let text = "UPDATE machines SET facts = $1, seen_us = $2 WHERE name = $3";
        let query = sqlx::query(text).bind(to_json(facts)?).bind(now_us()).bind(name);
        query.execute(&self.pool).await?;
        Ok(None)
    }

    /// All machines by name.
    pub async fn machines(&self) -> Result<Vec<MachineInfo>> {
        let text = "SELECT name, facts, created_us, seen_us, revoked_us, \
                    (SELECT MAX(a.job) FROM attempts a WHERE a.machine = 'machine ' || m.name AND a.ended_us IS NULL) \
                    FROM machines m ORDER BY name";
        let rows: Vec<MachineRow> = sqlx::query_as(text).fetch_all(&self.pool).await?;
        let info = |(name, facts, created_us, seen_us, revoked_us, run): MachineRow| {
            let facts = facts.map(|facts| from_json(&facts)).transpose()?;
            Ok(MachineInfo { name, facts, created_us, seen_us, revoked_us, run })
        };
        rows.into_iter().map(info).collect()
    }

    /// The current attempt with this id, if it is of this machine.
    pub async fn attempt_of(&self, machine: &str, attempt: &str) -> Result<Option<Attempt>> {
        let text = "SELECT job, number FROM attempts WHERE id = $1 AND machine = $2 AND ended_us IS NULL";
        let worker = worker(machine, "");
        let row: Option<(String, i64)> =
            sqlx::query_as(text).bind(attempt).bind(&worker.machine).fetch_optional(&self.pool).await?;
        Ok(row.map(|(job, number)| Attempt { id: attempt.to_owned(), kind: Kind::Measure, job, number }))
    }
}
