//! Notices: what the service tells an account, on its page of runs and, if it wants, by mail.

pub mod sql;
pub mod telling;

use crate::boxed;
use crate::engine::Engine;
use crate::model::{AccountInfo, Cursor, NoticeInfo, Page, Part};
use crate::notices::telling::MOST;
use crate::{EngineError, Result};

impl Engine {
    /// What the account was told, newest first.
    #[boxed]
    pub async fn notices(&self, account: &AccountInfo, page: &Page) -> Result<Part<NoticeInfo>> {
        let (from, limit) = page.start()?;
        let all = self.inner.store.notices(&account.id, &from, limit + 1).await?;
        Ok(Part::of(all, limit, |one: &NoticeInfo| Cursor::behind(one.created_us, &one.id)))
    }

    /// All of it.
    pub(crate) async fn all_notices(&self, account: &AccountInfo) -> Result<Vec<NoticeInfo>> {
        self.inner.store.notices(&account.id, &Cursor::start(), MOST).await
    }

    /// Marks a notice as read.
    #[boxed]
    pub async fn read_notice(&self, account: &AccountInfo, id: &str) -> Result<NoticeInfo> {
        self.inner.store.read_notice(&account.id, id).await?.ok_or_else(|| missing(id))
    }

    /// Takes a notice away.
    #[boxed]
    pub async fn remove_notice(&self, account: &AccountInfo, id: &str) -> Result<()> {
        let there = self.inner.store.remove_notice(&account.id, id).await?;
        if there { Ok(()) } else { Err(missing(id)) }
    }
}

/// Somebody else's notice is not there either.
fn missing(id: &str) -> EngineError {
    EngineError::NotFound(format!("There is no notice {id:?}."))
}
