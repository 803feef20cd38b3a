//! What accounts are told.

use sqlx::AnyConnection;

use crate::Result;
use crate::model::{Cursor, NoticeInfo};
use crate::store::{Store, now_us};

/// Columns of a notice: id, subject, text, link, when it was written, when it was read.
type NoticeRow = (String, String, String, String, i64, Option<i64>);

fn notice((id, subject, text, link, created_us, read_us): NoticeRow) -> NoticeInfo {
    NoticeInfo { id, subject, text, link, created_us, read_us }
}

/// A notice to come. With what it tells of in one transaction, a crash leaves both or neither.
#[derive(Clone, Copy, Debug)]
pub struct NewNotice<'a> {
    /// Id of the account.
    pub account: &'a str,
    /// What it is told.
    pub notice: &'a NoticeInfo,
    /// How many it keeps: the oldest beyond them are forgotten.
    pub most: usize,
    /// Also a mail that waits, when the account wants such mails and its address is confirmed.
    pub mailing: bool,
}

/// Adds a notice; false when there is no such account.
pub(crate) async fn tell(connection: &mut AnyConnection, new_notice: NewNotice<'_>) -> Result<bool> {
    let NewNotice { account, notice, most, mailing } = new_notice;
    let added = sqlx::query(
        "INSERT INTO notices (id, account, subject, text, link, created_us) \
         SELECT $1, id, $2, $3, $4, $5 FROM accounts WHERE id = $6 AND deleted_us IS NULL",
    )
    .bind(&notice.id)
    .bind(&notice.subject)
    .bind(&notice.text)
    .bind(&notice.link)
    .bind(notice.created_us)
    .bind(account)
    .execute(&mut *connection)
    .await?;
    sqlx::query(
        "DELETE FROM notices WHERE account = $1 AND id NOT IN \
         (SELECT id FROM notices WHERE account = $1 ORDER BY created_us DESC, id DESC LIMIT $2)",
    )
    .bind(account)
    .bind(most as i64)
    .execute(&mut *connection)
    .await?;
    if mailing {
        sqlx::query(
            "INSERT INTO mails (id, account, address, notice, created_us, due_us, tries) \
             SELECT $1, id, address, $2, $3, $3, 0 FROM accounts \
             WHERE id = $4 AND mail_notices = 1 AND address IS NOT NULL AND confirmed_us IS NOT NULL",
        )
        .bind(uuid::Uuid::now_v7().to_string())
        .bind(&notice.id)
        .bind(notice.created_us)
        .bind(account)
        .execute(&mut *connection)
        .await?;
    }
    Ok(added.rows_affected() == 1)
}

impl Store {
    /// Adds a notice; false when there is no such account.
    pub async fn add_notice(&self, new_notice: NewNotice<'_>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        let told = tell(&mut transaction, new_notice).await?;
        transaction.commit().await?;
        Ok(told)
    }

    /// The account's notices from this place on, newest first, at most `limit`.
    pub async fn notices(&self, account: &str, from: &Cursor, limit: usize) -> Result<Vec<NoticeInfo>> {
        let rows: Vec<NoticeRow> = sqlx::query_as(
            "SELECT id, subject, text, link, created_us, read_us FROM notices \
             WHERE account = $1 AND (created_us, id) < ($2, $3) ORDER BY created_us DESC, id DESC LIMIT $4",
        )
        .bind(account)
        .bind(from.created_us)
        .bind(&from.id)
        .bind(limit as i64)
        .fetch_all(&self.pool)
        .await?;
        Ok(rows.into_iter().map(notice).collect())
    }

    /// Marks a notice of the account as read; the first time stands. Nothing when the account has none of that id.
    pub async fn read_notice(&self, account: &str, id: &str) -> Result<Option<NoticeInfo>> {
        let row: Option<NoticeRow> = sqlx::query_as(
            "UPDATE notices SET read_us = COALESCE(read_us, $1) WHERE account = $2 AND id = $3 \
             RETURNING id, subject, text, link, created_us, read_us",
        )
        .bind(now_us())
        .bind(account)
        .bind(id)
        .fetch_optional(&self.pool)
        .await?;
        Ok(row.map(notice))
    }

    /// Takes away a notice of the account, and the mail of it that waits; false when the account has none of that id.
    pub async fn remove_notice(&self, account: &str, id: &str) -> Result<bool> {
        let done = sqlx::query("DELETE FROM notices WHERE account = $1 AND id = $2")
            .bind(account)
            .bind(id)
            .execute(&self.pool)
            .await?;
        Ok(done.rows_affected() == 1)
    }
}
