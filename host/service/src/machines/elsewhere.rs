//! What was found of a run so far, kept for the other services on one database: one measures it, or its machine tells one of them.

use ocb_lab::worker::Seen;

use crate::Result;
use crate::attempts::Attempt;
use crate::attempts::worker::Worker;
use crate::store::{Store, to_json};

impl Store {
    /// Keeps what a machine has told this service, or what this service has found if it measures itself, where other services may want
    /// it. They are notified.
    pub(crate) async fn keep_seen(&self, attempt: &Attempt, seen: &Seen, told: Option<&Worker>) -> Result<()> {
        if !self.is_shared() {
            return Ok(());
        }
        // An attempt that ends at this moment waits for it, and takes it away.
        let text = "INSERT INTO seen (run_id, place, attempt, service, seen) \
                    SELECT job, $1, id, COALESCE($2, machine), $3 FROM attempts WHERE id = $4 AND ended_us IS NULL FOR SHARE \
                    ON CONFLICT (run_id, place) DO UPDATE SET attempt = excluded.attempt, \
                    service = excluded.service, seen = excluded.seen";
        let query =
            sqlx::query(text).bind(seen.place as i64).bind(told.map(|service| &service.machine)).bind(to_json(seen)?);
        query.bind(&attempt.id).execute(&self.pool).await?;
        Ok(())
    }
}
