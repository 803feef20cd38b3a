//! The audit log: rows are added and read, never changed.

use super::{Store, now_us};
use crate::Result;
use crate::blobs::sha256_hex;
use crate::model::AuditEntry;

type AuditRow = (i64, i64, String, String, String, String, String);

impl Store {
    /// Adds an entry at the end.
    pub async fn note(&self, actor: &str, action: &str, subject: &str, detail: &str) -> Result<()> {
        // Two writers at once want the same number; one of them finds it taken and looks again.
        loop {
            let last: Option<(i64, String)> = sqlx::query_as("SELECT seq, chain FROM audit ORDER BY seq DESC LIMIT 1")
                .fetch_optional(&self.pool)
                .await?;
            let (seq, before) = last.map_or_else(|| (1, String::new()), |(seq, chain)| (seq + 1, chain));
            let entry = AuditEntry {
                seq,
                at_us: now_us(),
                actor: actor.into(),
                action: action.into(),
                subject: subject.into(),
                detail: detail.into(),
            };
            let added = sqlx::query(
                "INSERT INTO audit (seq, at_us, actor, action, subject, detail, chain) \
                 VALUES ($1, $2, $3, $4, $5, $6, $7) ON CONFLICT (seq) DO NOTHING",
            )
            .bind(seq)
            .bind(entry.at_us)
            .bind(actor)
            .bind(action)
            .bind(subject)
            .bind(detail)
            .bind(chained(&before, &entry))
            .execute(&self.pool)
            .await?;
            if added.rows_affected() == 1 {
                return Ok(());
            }
        }
    }

    /// What was done to this subject, oldest first.
    pub async fn notes_on(&self, subject: &str) -> Result<Vec<AuditEntry>> {
        let rows: Vec<AuditRow> = sqlx::query_as(
            "SELECT seq, at_us, actor, action, subject, detail, chain FROM audit WHERE subject = $1 ORDER BY seq",
        )
        .bind(subject)
        .fetch_all(&self.pool)
        .await?;
        Ok(rows.into_iter().map(|row| entry(row).0).collect())
    }

    /// The number of the first entry that does not follow from those before it.
    pub async fn broken_note(&self) -> Result<Option<i64>> {
        let rows: Vec<AuditRow> =
            sqlx::query_as("SELECT seq, at_us, actor, action, subject, detail, chain FROM audit ORDER BY seq")
                .fetch_all(&self.pool)
                .await?;
        let mut before = String::new();
        for (expected, row) in (1..).zip(rows) {
            let (entry, chain) = entry(row);
            if entry.seq != expected || chained(&before, &entry) != chain {
                return Ok(Some(expected));
            }
            before = chain;
        }
        Ok(None)
    }
}

fn entry((seq, at_us, actor, action, subject, detail, chain): AuditRow) -> (AuditEntry, String) {
    (AuditEntry { seq, at_us, actor, action, subject, detail }, chain)
}

/// The hash of an entry and of all before it.
fn chained(before: &str, entry: &AuditEntry) -> String {
    let AuditEntry { seq, at_us, actor, action, subject, detail } = entry;
    // As JSON, so that no part can run into the next.
    sha256_hex(serde_json::json!([before, seq, at_us, actor, action, subject, detail]).to_string().as_bytes())
}
