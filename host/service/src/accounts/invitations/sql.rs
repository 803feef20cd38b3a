//! Invitations to be a developer.

use crate::Result;
use crate::audit::Note;
use crate::audit::append;
use crate::model::{Cursor, InvitationInfo, InvitationState, Role};
use crate::store::{Store, now_us};

/// Columns of an invitation: id, for whom, by whom, made, expires, revoked, accepted, by whom.
type InvitationRow = (String, String, Option<String>, i64, i64, Option<i64>, Option<i64>, Option<String>);

macro_rules! select_invitations {
    ($rest:literal) => {
        concat!(
            "SELECT i.id, i.recipient, inviter.name, i.created_us, i.expires_us, i.revoked_us, i.accepted_us, ",
            "accepter.name FROM invitations i LEFT JOIN accounts inviter ON inviter.id = i.invited_by ",
            "LEFT JOIN accounts accepter ON accepter.id = i.accepted_by ",
            $rest
        )
    };
}

fn invitation(row: InvitationRow, now_us: i64) -> InvitationInfo {
    let (id, recipient, invited_by, created_us, expires_us, revoked_us, accepted_us, accepted_by) = row;
    let state = match (accepted_us, revoked_us) {
        (Some(_), _) => InvitationState::Accepted,
        (None, Some(_)) => InvitationState::Revoked,
        (None, None) if expires_us <= now_us => InvitationState::Expired,
        (None, None) => InvitationState::Open,
    };
    InvitationInfo { id, recipient, invited_by, state, accepted_by, created_us, expires_us }
}

impl Store {
    /// Adds an invitation by the hash of its secret, made by this account or by nobody's, and notes it. One that is there under its
    /// id gets the new secret and the new time; false when that was accepted or withdrawn.
    pub async fn add_invitation(
        &self,
        sha256: &str,
        by: Option<&str>,
        invitation: &InvitationInfo,
        note: Note<'_>,
    ) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let added = sqlx::query(
            "INSERT INTO invitations (id, sha256, invited_by, recipient, created_us, expires_us) \
             VALUES ($1, $2, $3, $4, $5, $6) ON CONFLICT (id) DO UPDATE SET sha256 = excluded.sha256, \
             expires_us = excluded.expires_us WHERE invitations.accepted_us IS NULL AND invitations.revoked_us IS NULL",
        )
        .bind(&invitation.id)
        .bind(sha256)
        .bind(by)
        .bind(&invitation.recipient)
        .bind(invitation.created_us)
        .bind(invitation.expires_us)
        .execute(&mut *transaction)
        .await?;
        let added = added.rows_affected() == 1;
        if added {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(added)
    }

    /// Invitations from this place on, newest first, at most `limit`.
    pub async fn invitations(&self, from: &Cursor, limit: usize) -> Result<Vec<InvitationInfo>> {
        let rows: Vec<InvitationRow> = sqlx::query_as(select_invitations!(
            "WHERE (i.created_us, i.id) < ($1, $2) ORDER BY i.created_us DESC, i.id DESC LIMIT $3"
        ))
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        let now = now_us();
        Ok(rows.into_iter().map(|row| invitation(row, now)).collect())
    }

    /// One invitation.
    pub async fn invitation(&self, id: &str) -> Result<Option<InvitationInfo>> {
        let row: Option<InvitationRow> =
            sqlx::query_as(select_invitations!("WHERE i.id = $1")).bind(id).fetch_optional(&self.pool).await?;
        Ok(row.map(|row| invitation(row, now_us())))
    }

    /// How many can be accepted still.
    pub async fn open_invitations(&self) -> Result<u64> {
        let count: i64 = sqlx::query_scalar(
            "SELECT COUNT(*) FROM invitations WHERE accepted_us IS NULL AND revoked_us IS NULL AND expires_us > $1",
        )
        .bind(now_us())
        .fetch_one(&self.pool)
        .await?;
        Ok(count as u64)
    }

    /// Withdraws an invitation and notes it; false when it was accepted or withdrawn before.
    pub async fn revoke_invitation(&self, id: &str, note: Note<'_>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let done = sqlx::query(
            "UPDATE invitations SET revoked_us = $1 WHERE id = $2 AND accepted_us IS NULL AND revoked_us IS NULL",
        )
        .bind(now_us())
        .bind(id)
        .execute(&mut *transaction)
        .await?;
        let done = done.rows_affected() == 1;
        if done {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(done)
    }

    /// Makes the account a developer by the invitation whose secret has this hash, and notes it; once, in time, and as long as
    /// who invited may. Nothing when there is no such invitation; its id otherwise.
    pub async fn accept_invitation(&self, sha256: &str, account: &str, note: Note<'_>) -> Result<Option<String>> {
        let mut transaction = self.pool.begin().await?;
        let now = now_us();
        let accepted: Option<(String,)> = sqlx::query_as(
            "UPDATE invitations SET accepted_us = $1, accepted_by = $2 \
             WHERE sha256 = $3 AND accepted_us IS NULL AND revoked_us IS NULL AND expires_us > $1 \
             AND (invited_by IS NULL OR invited_by IN (SELECT id FROM accounts WHERE role IN ($4, $5))) RETURNING id",
        )
        .bind(now)
        .bind(account)
        .bind(sha256)
        .bind(Role::Curator.name())
        .bind(Role::Administrator.name())
        .fetch_optional(&mut *transaction)
        .await?;
        let Some((id,)) = accepted else { return Ok(None) };
        let made = sqlx::query("UPDATE accounts SET role = $1, wish = NULL WHERE id = $2 AND role = $3")
            .bind(Role::Developer.name())
            .bind(account)
            .bind(Role::User.name())
            .execute(&mut *transaction)
            .await?;
        // Who has become something else meanwhile does not use the invitation up.
        if made.rows_affected() != 1 {
            return Ok(None);
        }
        append(&mut transaction, note).await?;
        let subject = format!("invitation:{id}");
        append(&mut transaction, Note { action: "invitation accepted", subject: &subject, detail: "", ..note }).await?;
        transaction.commit().await?;
        Ok(Some(id))
    }
}
