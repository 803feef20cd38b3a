//! Mails that wait to be taken by the mail server, and the links in them.

use sqlx::Row;
use sqlx::any::AnyRow;

use crate::Result;
use crate::audit::Note;
use crate::audit::append;
use crate::store::{Store, now_us};

/// A mail that waits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WaitingMail {
    /// Its id.
    pub id: String,
    /// Id and name of the account that it is for.
    pub account: [String; 2],
    /// Where it goes.
    pub address: String,
    /// Subject, text and link of the notice in it; without one it asks whether the address is right.
    pub notice: Option<[String; 3]>,
    /// The account wants it still, at this address.
    pub wanted: bool,
    /// Since when it waits.
    pub created_us: i64,
    /// When it is to be tried.
    pub due_us: i64,
    /// How often it was tried.
    pub tries: u32,
}

/// A link in a mail: one that confirms its address, or one that turns mails off.
#[derive(Clone, Copy, Debug)]
pub struct MailLink<'a> {
    /// Over its secret.
    pub sha256: &'a str,
    /// For this account alone.
    pub account: &'a str,
    /// And this address of it.
    pub address: &'a str,
    /// Until when.
    pub expires_us: i64,
}

fn waiting(row: &AnyRow) -> Result<WaitingMail> {
    let subject: Option<String> = row.try_get("subject")?;
    let notice = match subject {
        Some(subject) => Some([subject, row.try_get("text")?, row.try_get("link")?]),
        None => None,
    };
    let (address, now): (String, Option<String>) = (row.try_get("address")?, row.try_get("address_now")?);
    let confirmed = row.try_get::<Option<i64>, _>("confirmed_us")?.is_some();
    let asked_for =
        if notice.is_some() { confirmed && row.try_get::<i64, _>("mail_notices")? != 0 } else { !confirmed };
    Ok(WaitingMail {
        id: row.try_get("id")?,
        account: [row.try_get("account")?, row.try_get("name")?],
        wanted: asked_for && now.as_deref() == Some(&address),
        address,
        notice,
        created_us: row.try_get("created_us")?,
        due_us: row.try_get("due_us")?,
        tries: row.try_get::<i64, _>("tries")? as u32,
    })
}

impl Store {
    /// The mail that is due longest by this moment.
    pub async fn due_mail(&self, now_us: i64) -> Result<Option<WaitingMail>> {
        let row = sqlx::query(
            "SELECT m.id, m.account, m.address, m.created_us, m.due_us, m.tries, a.name, a.address AS address_now, a.confirmed_us, \
             a.mail_notices, n.subject, n.text, n.link FROM mails m JOIN accounts a ON a.id = m.account \
             LEFT JOIN notices n ON n.id = m.notice WHERE m.due_us <= $1 ORDER BY m.due_us, m.id LIMIT 1",
        )
        .bind(now_us)
        .fetch_optional(&self.pool)
        .await?;
        row.as_ref().map(waiting).transpose()
    }

    /// Nobody else tries the mail until then; false when somebody tries it already.
    pub async fn hold_mail(&self, id: &str, due_us: i64, until_us: i64) -> Result<bool> {
        let text = "UPDATE mails SET due_us = $1 WHERE id = $2 AND due_us = $3";
        let done = sqlx::query(text).bind(until_us).bind(id).bind(due_us).execute(&self.pool).await?;
        Ok(done.rows_affected() == 1)
    }

    /// When the next mail is due.
    pub async fn next_mail_us(&self) -> Result<Option<i64>> {
        Ok(sqlx::query_scalar("SELECT MIN(due_us) FROM mails").fetch_one(&self.pool).await?)
    }

    /// A try was in vain: the mail waits until then.
    pub async fn postpone_mail(&self, id: &str, due_us: i64) -> Result<()> {
        sqlx::query("UPDATE mails SET tries = tries + 1, due_us = $1 WHERE id = $2")
            .bind(due_us)
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// The mail waits no more: the server has it, or it was given up.
    pub async fn forget_mail(&self, id: &str) -> Result<()> {
        sqlx::query("DELETE FROM mails WHERE id = $1").bind(id).execute(&self.pool).await?;
        Ok(())
    }

    /// Adds a link that confirms an address, and forgets those whose time is over.
    pub async fn add_confirmation(&self, new: MailLink<'_>) -> Result<()> {
        let over = "DELETE FROM confirmations WHERE expires_us <= $1";
        let add = "INSERT INTO confirmations (sha256, account, address, expires_us) \
                   SELECT $1, id, address, $2 FROM accounts WHERE id = $3 AND address = $4";
        self.add_link(over, add, new).await
    }

    /// Adds a link that turns mails off, and forgets those whose time is over.
    pub async fn add_off_link(&self, new: MailLink<'_>) -> Result<()> {
        let over = "DELETE FROM off_links WHERE expires_us <= $1";
        let add = "INSERT INTO off_links (sha256, account, address, expires_us) \
                   SELECT $1, id, address, $2 FROM accounts WHERE id = $3 AND address = $4";
        self.add_link(over, add, new).await
    }

    /// A link is for an account that still has the address.
    async fn add_link(&self, over: &'static str, add: &'static str, new: MailLink<'_>) -> Result<()> {
        sqlx::query(over).bind(now_us()).execute(&self.pool).await?;
        sqlx::query(add)
            .bind(new.sha256)
            .bind(new.expires_us)
            .bind(new.account)
            .bind(new.address)
            .execute(&self.pool)
            .await?;
        Ok(())
    }

    /// Id and name of the account whose mails the link with this hash turns off, and whether it wants any: in time, and as long as
    /// its mails go to the address that the link went to.
    pub async fn account_of_off_link(&self, sha256: &str, now_us: i64) -> Result<Option<([String; 2], bool)>> {
        let row: Option<(String, String, i64)> = sqlx::query_as(
            "SELECT a.id, a.name, a.mail_notices FROM off_links l JOIN accounts a ON a.id = l.account \
             WHERE l.sha256 = $1 AND l.expires_us > $2 AND a.address = l.address",
        )
        .bind(sha256)
        .bind(now_us)
        .fetch_optional(&self.pool)
        .await?;
        Ok(row.map(|(id, name, wanted)| ([id, name], wanted != 0)))
    }

    /// Turns the account's mails off: what waits is forgotten, and so are links that would confirm its address.
    pub async fn turn_mails_off(&self, account: &str, note: Option<Note<'_>>) -> Result<()> {
        let mut transaction = self.pool.begin().await?;
        for text in [
            "UPDATE accounts SET mail_notices = 0 WHERE id = $1",
            "DELETE FROM confirmations WHERE account = $1",
            "DELETE FROM mails WHERE account = $1",
        ] {
            sqlx::query(text).bind(account).execute(&mut *transaction).await?;
        }
        if let Some(note) = note {
            append(&mut transaction, note).await?;
        }
        transaction.commit().await?;
        Ok(())
    }
}
