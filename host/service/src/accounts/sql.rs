//! Accounts and the keys that open them: sessions of browsers, tokens of programs.

use crate::audit::Note;
use crate::audit::append;
use crate::model::{AccountInfo, Cursor, Role, Scope, TokenInfo};
use crate::store::{Store, from_json, now_us, to_json};
use crate::{EngineError, Result};

/// Columns of an account: id, name, role, wish, signing key, when it was made.
type AccountRow = (String, String, String, Option<String>, Option<String>, i64);

fn account((id, name, role, developer_request, signing_key, created_us): AccountRow) -> Result<AccountInfo> {
    let unknown = || EngineError::Fault(format!("The database holds an account of the unknown role {role:?}."));
    Ok(AccountInfo {
        id,
        name,
        role: Role::named(&role).ok_or_else(unknown)?,
        developer_request,
        signing_key,
        created_us,
    })
}

impl Store {
    /// Adds an account; false when the name is taken, or was before its account was deleted.
    pub async fn add_account(&self, account: &AccountInfo, password: &str) -> Result<bool> {
        let added = sqlx::query(
            "INSERT INTO accounts (id, name, folded, password, role, created_us) VALUES ($1, $2, $3, $4, $5, $6) \
             ON CONFLICT (folded) DO NOTHING",
        )
        .bind(&account.id)
        .bind(&account.name)
        .bind(account.name.to_lowercase())
        .bind(password)
        .bind(account.role.name())
        .bind(account.created_us)
        .execute(&self.pool)
        .await?;
        Ok(added.rows_affected() == 1)
    }

    /// Accounts from this place on, newest first, at most `limit`.
    pub async fn accounts(&self, from: &Cursor, limit: usize) -> Result<Vec<AccountInfo>> {
        let rows: Vec<AccountRow> = sqlx::query_as(
            "SELECT id, name, role, wish, signing_key, created_us FROM accounts \
             WHERE (created_us, id) < ($1, $2) AND deleted_us IS NULL ORDER BY created_us DESC, id DESC LIMIT $3",
        )
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        rows.into_iter().map(account).collect()
    }

    /// The account with this id.
    pub async fn account(&self, id: &str) -> Result<Option<AccountInfo>> {
        let text = "SELECT id, name, role, wish, signing_key, created_us FROM accounts \
                    WHERE id = $1 AND deleted_us IS NULL";
        let row: Option<AccountRow> = sqlx::query_as(text).bind(id).fetch_optional(&self.pool).await?;
        row.map(account).transpose()
    }

    /// Id and hashed password of the account with this name.
    pub async fn password_of(&self, name: &str) -> Result<Option<(String, String)>> {
        Ok(sqlx::query_as("SELECT id, password FROM accounts WHERE folded = $1 AND deleted_us IS NULL")
            .bind(name.to_lowercase())
            .fetch_optional(&self.pool)
            .await?)
    }

    /// Replaces the hashed password.
    pub async fn set_password(&self, id: &str, password: &str) -> Result<()> {
        sqlx::query("UPDATE accounts SET password = $1 WHERE id = $2")
            .bind(password)
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// Gives the account a role, settles its request for the developer role, and notes it; false when there is no such account.
    pub async fn set_role(&self, id: &str, role: Role, note: Note<'_>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let done = sqlx::query("UPDATE accounts SET role = $1, wish = NULL WHERE id = $2 AND deleted_us IS NULL")
            .bind(role.name())
            .bind(id)
            .execute(&mut *transaction)
            .await?;
        let there = done.rows_affected() == 1;
        if there {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(there)
    }

    /// Registers the key that the account signs with, or forgets it, and notes it.
    pub async fn set_signing_key(&self, id: &str, key: Option<&str>, note: Note<'_>) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        sqlx::query("UPDATE accounts SET signing_key = $1 WHERE id = $2")
            .bind(key)
            .bind(id)
            .execute(&mut *transaction)
            .await?;
        append(&mut transaction, note).await?;
        transaction.commit().await?;
        Ok(())
    }

    /// Notes why the account's owner wants to be a developer.
    pub async fn set_developer_request(&self, id: &str, reason: &str) -> Result<()> {
        sqlx::query("UPDATE accounts SET wish = $1 WHERE id = $2 AND deleted_us IS NULL")
            .bind(reason)
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// Adds a key by the hash of its secret. A session has no name.
    pub async fn add_key(&self, sha256: &str, account: &str, key: &TokenInfo, session: bool) -> Result<()> {
        sqlx::query(
            "INSERT INTO keys (sha256, id, account, name, scopes, created_us, expires_us) \
             SELECT $1, $2, id, $3, $4, $5, $6 FROM accounts WHERE id = $7 AND deleted_us IS NULL",
        )
        .bind(sha256)
        .bind(&key.id)
        .bind(Some(&key.name).filter(|_| !session))
        .bind(to_json(&key.scopes)?)
        .bind(key.created_us)
        .bind(key.expires_us)
        .bind(account)
        .execute(&self.pool)
        .await?;
        Ok(())
    }

    /// The account that a key opens and the scopes of the key; sessions and tokens do not stand for each other.
    pub async fn opened_by(&self, sha256: &str, session: bool) -> Result<Option<(AccountInfo, Vec<Scope>)>> {
        let row: Option<(String, String)> = sqlx::query_as(
            "SELECT account, scopes FROM keys WHERE sha256 = $1 AND expires_us > $2 \
             AND (CASE WHEN name IS NULL THEN 1 ELSE 0 END) = $3",
        )
        .bind(sha256)
        .bind(now_us())
        .bind(i64::from(session))
        .fetch_optional(&self.pool)
        .await?;
        let Some((id, scopes)) = row else { return Ok(None) };
        self.account(&id).await?.map(|account| Ok((account, from_json(&scopes)?))).transpose()
    }

    /// The account's tokens, newest first.
    pub async fn tokens(&self, account: &str) -> Result<Vec<TokenInfo>> {
        let rows: Vec<(String, String, String, i64, i64)> = sqlx::query_as(
            "SELECT id, name, scopes, created_us, expires_us FROM keys WHERE account = $1 AND name IS NOT NULL \
             ORDER BY created_us DESC, id",
        )
        .bind(account)
        .fetch_all(&self.pool)
        .await?;
        let token = |(id, name, scopes, created_us, expires_us): (String, String, String, i64, i64)| {
            Ok(TokenInfo { id, name, scopes: from_json(&scopes)?, created_us, expires_us })
        };
        rows.into_iter().map(token).collect()
    }

    /// Ends one token of the account; false when there is none of that id.
    pub async fn end_token(&self, account: &str, id: &str) -> Result<bool> {
        let done = sqlx::query("DELETE FROM keys WHERE account = $1 AND id = $2 AND name IS NOT NULL")
            .bind(account)
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(done.rows_affected() == 1)
    }

    /// Ends the session with this hash.
    pub async fn end_session(&self, sha256: &str) -> Result<()> {
        sqlx::query("DELETE FROM keys WHERE sha256 = $1").bind(sha256).execute(&self.pool).await?;
        Ok(())
    }

    /// Ends all sessions of the account.
    pub async fn end_sessions(&self, account: &str) -> Result<()> {
        sqlx::query("DELETE FROM keys WHERE account = $1 AND name IS NULL").bind(account).execute(&self.pool).await?;
        Ok(())
    }

    /// Forgets keys that have ended.
    pub async fn forget_ended_keys(&self) -> Result<()> {
        sqlx::query("DELETE FROM keys WHERE expires_us <= $1").bind(now_us()).execute(&self.pool).await?;
        Ok(())
    }

    /// Moves runs, objects, advice, stability runs and workloads from one owner to another. A key of a request that both have used stays that of the other's run.
    pub async fn move_things(&self, from: &str, to: &str) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        for text in [
            "UPDATE runs SET request_key = NULL WHERE request_key IN \
             (SELECT request_key FROM runs WHERE owner = $1) AND owner = $2",
            "UPDATE runs SET owner = $1 WHERE owner = $2",
            "UPDATE objects SET owner = $1 WHERE owner = $2",
            "UPDATE advice SET owner = $1 WHERE owner = $2",
            "UPDATE stability_runs SET owner = $1 WHERE owner = $2",
            "UPDATE workloads SET owner = $1 WHERE owner = $2",
            "UPDATE requests SET owner = $1 WHERE owner = $2 AND (resource, request_key) NOT IN \
             (SELECT resource, request_key FROM requests WHERE owner = $1)",
        ] {
            sqlx::query(text).bind(to).bind(from).execute(&mut *transaction).await?;
        }
        transaction.commit().await?;
        Ok(())
    }
}
