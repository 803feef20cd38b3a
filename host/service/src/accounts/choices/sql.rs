//! What accounts have chosen, and the addresses that their mails go to.

use crate::Result;
use crate::audit::Note;
use crate::audit::append;
use crate::model::NewChoices;
use crate::store::{Store, now_us};

/// What an account has chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChoicesRow {
    /// Public runs may be measured again.
    pub agrees_to_reruns: bool,
    /// Notices come by mail.
    pub mail_notices: bool,
    /// Where mails go.
    pub address: Option<String>,
    /// When the link that went there was opened.
    pub confirmed_us: Option<i64>,
}

impl Store {
    /// What the account has chosen; nothing when there is no such account.
    pub async fn choices(&self, account: &str) -> Result<Option<ChoicesRow>> {
        let row: Option<(i64, i64, Option<String>, Option<i64>)> =
            sqlx::query_as("SELECT agrees_to_reruns, mail_notices, address, confirmed_us FROM accounts WHERE id = $1")
                .bind(account)
                .fetch_optional(&self.pool)
                .await?;
        Ok(row.map(|(agrees, mail, address, confirmed_us)| ChoicesRow {
            agrees_to_reruns: agrees != 0,
            mail_notices: mail != 0,
            address,
            confirmed_us,
        }))
    }

    /// Changes what is said; the rest stays.
    pub async fn choose(&self, account: &str, new: &NewChoices) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        let both = [
            ("UPDATE accounts SET agrees_to_reruns = $1 WHERE id = $2", new.agrees_to_reruns),
            ("UPDATE accounts SET mail_notices = $1 WHERE id = $2", new.mail_notices),
        ];
        for (text, chosen) in both {
            if let Some(chosen) = chosen {
                sqlx::query(text).bind(i64::from(chosen)).bind(account).execute(&mut *transaction).await?;
            }
        }
        transaction.commit().await?;
        Ok(())
    }

    /// Gives the account this address, unconfirmed unless it was confirmed before; links and mails for another one are forgotten.
    /// With `asking`, a mail waits then that asks whether it is right.
    pub async fn set_address(&self, account: &str, address: &str, asking: bool, note: Note<'_>) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        let now = now_us();
        sqlx::query(
            "UPDATE accounts SET confirmed_us = CASE WHEN address = $1 THEN confirmed_us ELSE NULL END, address = $1 \
             WHERE id = $2 AND deleted_us IS NULL",
        )
        .bind(address)
        .bind(account)
        .execute(&mut *transaction)
        .await?;
        for text in [
            "DELETE FROM confirmations WHERE account = $1 AND address <> $2",
            "DELETE FROM off_links WHERE account = $1 AND address <> $2",
            "DELETE FROM mails WHERE account = $1 AND (address <> $2 OR notice IS NULL)",
        ] {
            sqlx::query(text).bind(account).bind(address).execute(&mut *transaction).await?;
        }
        if asking {
            sqlx::query(
                "INSERT INTO mails (id, account, address, created_us, due_us, tries) \
                 SELECT $1, id, address, $2, $2, 0 FROM accounts WHERE id = $3 AND confirmed_us IS NULL",
            )
            .bind(uuid::Uuid::now_v7().to_string())
            .bind(now)
            .bind(account)
            .execute(&mut *transaction)
            .await?;
        }
        append(&mut transaction, note).await?;
        transaction.commit().await?;
        Ok(())
    }

    /// Forgets the account's address, with all that waits to go there.
    pub async fn forget_address(&self, account: &str, note: Note<'_>) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        for text in [
            "UPDATE accounts SET address = NULL, confirmed_us = NULL WHERE id = $1",
            "DELETE FROM confirmations WHERE account = $1",
            "DELETE FROM off_links WHERE account = $1",
            "DELETE FROM mails WHERE account = $1",
        ] {
            sqlx::query(text).bind(account).execute(&mut *transaction).await?;
        }
        append(&mut transaction, note).await?;
        transaction.commit().await?;
        Ok(())
    }

    /// Confirms the account's address by the link whose secret has this hash: once, in time, and as long as it is the address still.
    /// False when nothing was confirmed.
    pub async fn confirm_address(&self, sha256: &str, account: &str, now_us: i64, note: Note<'_>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let address: Option<String> = sqlx::query_scalar(
            "DELETE FROM confirmations WHERE sha256 = $1 AND account = $2 AND expires_us > $3 RETURNING address",
        )
        .bind(sha256)
        .bind(account)
        .bind(now_us)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(address) = address else { return Ok(false) };
        let done = sqlx::query("UPDATE accounts SET confirmed_us = $1 WHERE id = $2 AND address = $3")
            .bind(now_us)
            .bind(account)
            .bind(&address)
            .execute(&mut *transaction)
            .await?;
        if done.rows_affected() != 1 {
            return Ok(false);
        }
        for text in
            ["DELETE FROM confirmations WHERE account = $1", "DELETE FROM mails WHERE account = $1 AND notice IS NULL"]
        {
            sqlx::query(text).bind(account).execute(&mut *transaction).await?;
        }
        append(&mut transaction, note).await?;
        transaction.commit().await?;
        Ok(true)
    }
}
