//! Deleting an account, all at once.

use crate::Result;
use crate::audit::Note;
use crate::audit::{A_FORMER_ACCOUNT, append};
use crate::model::{AccountInfo, Role};
use crate::owned::sql::OwnedIds;
use crate::owned::sql::{Unused, take};
use crate::store::{Store, now_us};

impl Store {
    /// Deletes the account with what goes, leaves what stays as nobody's, and notes it. Gives the files that nobody uses any more;
    /// nothing, and nothing happens, when there is no such account or nobody else could decide in its place.
    pub async fn delete_account(
        &self,
        account: &AccountInfo,
        goes: &OwnedIds,
        stays: &OwnedIds,
        note: Note<'_>,
    ) -> Result<Option<Vec<Unused>>> {
        let (id, owner, now) = (account.id.as_str(), account.owner(), now_us());
        let (curator, administrator) = (Role::Curator.name(), Role::Administrator.name());
        let mut transaction = self.pool.begin().await?;
        // Of the last two that leave at once, one waits here for the other, and finds itself the last.
        sqlx::query("UPDATE accounts SET role = role WHERE role IN ($1, $2)")
            .bind(curator)
            .bind(administrator)
            .execute(&mut *transaction)
            .await?;
        // The row stays, with nothing but the folded name: public plugins refer to it, and the audit log contains the name. A new
        // account of that name would appear as the author of the deleted account's actions.
        let done = sqlx::query(
            "UPDATE accounts SET name = $1, password = '', role = $2, wish = NULL, signing_key = NULL, \
             agrees_to_reruns = 0, mail_notices = 0, address = NULL, confirmed_us = NULL, deleted_us = $3 \
             WHERE id = $4 AND deleted_us IS NULL AND (role NOT IN ($5, $6) OR EXISTS (SELECT 1 FROM accounts o \
             WHERE o.id <> $4 AND o.deleted_us IS NULL AND o.role IN (accounts.role, $6)))",
        )
        .bind(A_FORMER_ACCOUNT)
        .bind(Role::User.name())
        .bind(now)
        .bind(id)
        .bind(curator)
        .bind(administrator)
        .execute(&mut *transaction)
        .await?;
        if done.rows_affected() != 1 {
            return Ok(None);
        }
        for (text, whose) in [
            ("DELETE FROM keys WHERE account = $1", id),
            ("DELETE FROM devices WHERE account = $1", id),
            ("DELETE FROM mails WHERE account = $1", id),
            ("DELETE FROM confirmations WHERE account = $1", id),
            ("DELETE FROM off_links WHERE account = $1", id),
            ("DELETE FROM notices WHERE account = $1", id),
            ("DELETE FROM requests WHERE owner = $1", &owner),
            ("DELETE FROM kept WHERE owner = $1", &owner),
            ("DELETE FROM served WHERE owner = $1", &owner),
        ] {
            sqlx::query(text).bind(whose).execute(&mut *transaction).await?;
        }
        for (text, whose) in [
            ("UPDATE invitations SET recipient = $1 WHERE accepted_by = $2", id),
            ("UPDATE campaigns SET created_by = $1 WHERE created_by = $2", &account.name),
        ] {
            sqlx::query(text).bind(A_FORMER_ACCOUNT).bind(whose).execute(&mut *transaction).await?;
        }
        let open = "UPDATE invitations SET revoked_us = $1 WHERE invited_by = $2 AND accepted_us IS NULL AND revoked_us IS NULL";
        sqlx::query(open).bind(now).bind(id).execute(&mut *transaction).await?;
        // Public runs and objects get no owner. Whatever the account still owns later was being made during the deletion, and the
        // sweep deletes it.
        for run in &stays.runs {
            let text = "UPDATE runs SET owner = NULL, request_key = NULL WHERE id = $1";
            sqlx::query(text).bind(&run.id).execute(&mut *transaction).await?;
        }
        for object in &stays.objects {
            let text = "UPDATE objects SET owner = NULL WHERE id = $1";
            sqlx::query(text).bind(&object.id).execute(&mut *transaction).await?;
        }
        let unused = take(&mut transaction, goes).await?;
        append(&mut transaction, note).await?;
        transaction.commit().await?;
        Ok(Some(unused))
    }

    /// Is there somebody else who may do at least what this role may?
    pub async fn others_may(&self, role: Role, but: &str) -> Result<bool> {
        let text = "SELECT COUNT(*) FROM accounts WHERE id <> $1 AND deleted_us IS NULL AND role IN ($2, $3)";
        let others: i64 = sqlx::query_scalar(text)
            .bind(but)
            .bind(role.name())
            .bind(Role::Administrator.name())
            .fetch_one(&self.pool)
            .await?;
        Ok(others > 0)
    }

    /// Was there an account with this id, which is deleted?
    pub async fn is_former(&self, id: &str) -> Result<bool> {
        let text = "SELECT COUNT(*) FROM accounts WHERE id = $1 AND deleted_us IS NOT NULL";
        let count: i64 = sqlx::query_scalar(text).bind(id).fetch_one(&self.pool).await?;
        Ok(count > 0)
    }
}
