//! The audit log: rows are added and read, never changed.

use sqlx::{Any, AnyConnection, Executor};

use crate::Result;
use crate::model::AuditEntry;
use crate::sha256_hex;
use crate::store::{Store, now_us};

/// Whose is what an account has left behind. No name: names have no spaces.
pub const A_FORMER_ACCOUNT: &str = "a former account";

type AuditRow = (i64, i64, String, String, String, String, String);

/// An entry to come. With what it tells of in one transaction, a crash leaves both or neither.
#[derive(Clone, Copy, Debug)]
pub struct Note<'a> {
    /// Who did it.
    pub actor: &'a str,
    /// What.
    pub action: &'a str,
    /// To what.
    pub subject: &'a str,
    /// Why.
    pub detail: &'a str,
}

/// Adds an entry at the end. In a transaction it comes last: whatever was changed before it holds the lock on writing that
/// SQLite would not give to a transaction that has read.
pub(crate) async fn append(connection: &mut AnyConnection, note: Note<'_>) -> Result<()> {
    // Two writers at once want the same number; one of them finds it taken and looks again.
    loop {
        let last: Option<(i64, String)> = sqlx::query_as("SELECT seq, chain FROM audit ORDER BY seq DESC LIMIT 1")
            .fetch_optional(&mut *connection)
            .await?;
        let (seq, before) = last.map_or_else(|| (1, String::new()), |(seq, chain)| (seq + 1, chain));
        let entry = AuditEntry {
            seq,
            at_us: now_us(),
            actor: note.actor.into(),
            action: note.action.into(),
            subject: note.subject.into(),
            detail: note.detail.into(),
        };
        let added = sqlx::query(
            "INSERT INTO audit (seq, at_us, actor, action, subject, detail, chain) \
             VALUES ($1, $2, $3, $4, $5, $6, $7) ON CONFLICT (seq) DO NOTHING",
        )
        .bind(seq)
        .bind(entry.at_us)
        .bind(note.actor)
        .bind(note.action)
        .bind(note.subject)
        .bind(note.detail)
        .bind(chained(&before, &entry))
        .execute(&mut *connection)
        .await?;
        if added.rows_affected() == 1 {
            return Ok(());
        }
    }
}

/// What was done to this subject, oldest first, without the names of accounts that were deleted.
pub(crate) async fn notes_on(from: impl Executor<'_, Database = Any>, subject: &str) -> Result<Vec<AuditEntry>> {
    let rows: Vec<AuditRow> = sqlx::query_as(
        "SELECT seq, at_us, CASE WHEN EXISTS (SELECT 1 FROM accounts \
         WHERE folded = LOWER(audit.actor) AND deleted_us IS NOT NULL) THEN $1 ELSE actor END, \
         action, subject, detail, chain FROM audit WHERE subject = $2 ORDER BY seq",
    )
    .bind(A_FORMER_ACCOUNT)
    .bind(subject)
    .fetch_all(from)
    .await?;
    Ok(rows.into_iter().map(|row| entry(row).0).collect())
}

impl Store {
    /// Adds an entry at the end.
    pub async fn note(&self, actor: &str, action: &str, subject: &str, detail: &str) -> Result<()> {
        let mut connection = self.pool.acquire().await?;
        append(&mut connection, Note { actor, action, subject, detail }).await
    }

    /// What was done to this subject, oldest first. The log keeps the names of accounts that were deleted; nobody is shown them.
    pub async fn notes_on(&self, subject: &str) -> Result<Vec<AuditEntry>> {
        notes_on(&self.pool, subject).await
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
