//! What machines have found so far, kept for the other services on one database: a machine tells one of them.

use ocb_lab::worker::Seen;

use crate::Result;
use crate::attempts::Attempt;
use crate::attempts::worker::Worker;
use crate::store::{Store, to_json};

impl Store {
    /// Keeps what a machine has told this service, where other services may want it. They are notified.
    pub(super) async fn keep_seen(&self, attempt: &Attempt, seen: &Seen, service: &Worker) -> Result<()> {
        if !self.is_shared() {
            return Ok(());
        }
        let text = "INSERT INTO seen (run_id, place, attempt, service, seen) VALUES ($1, $2, $3, $4, $5) \
                    ON CONFLICT (run_id, place) DO UPDATE SET attempt = excluded.attempt, \
                    service = excluded.service, seen = excluded.seen";
        let query = sqlx::query(text).bind(&attempt.job).bind(seen.place as i64).bind(&attempt.id);
        query.bind(&service.machine).bind(to_json(seen)?).execute(&self.pool).await?;
        Ok(())
    }

    /// Drops what attempts that have ended had found.
    pub async fn forget_seen(&self) -> Result<()> {
        if self.is_shared() {
            let text = "DELETE FROM seen WHERE attempt IN (SELECT id FROM attempts WHERE ended_us IS NOT NULL)";
            sqlx::query(text).execute(&self.pool).await?;
        }
        Ok(())
    }
}
