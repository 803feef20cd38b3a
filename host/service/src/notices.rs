//! Notices: what the service tells an account, on its page of runs and, if it wants, by mail.

pub mod sql;

use crate::boxed;
use crate::engine::Engine;
use crate::mail::one_line;
use crate::mail::outbox::Outbox;
use crate::model::{AccountInfo, Cursor, NoticeInfo, Page, Part};
use crate::notices::sql::NewNotice;
use crate::store::now_us;
use crate::{EngineError, Result};

/// Notices of one account that are kept, and letters of their parts.
const MOST: usize = 500;
const SUBJECT: usize = 160;
const TEXT: usize = 4000;

impl Outbox {
    /// Tells an account something: `account` is its id; of an account that is gone, nothing is kept.
    ///
    /// # Errors
    /// Only a fault of the database; whoever tells of something that is done already logs it and goes on.
    #[boxed]
    pub async fn notify(&self, account: &str, notice: &NoticeInfo) -> Result<()> {
        if self.store.add_notice(self.new_notice(account, notice)).await? {
            self.post_soon();
        }
        Ok(())
    }

    /// How an account is told something in the transaction of what it is told of; `post_soon` when that is through.
    pub fn new_notice<'a>(&self, account: &'a str, notice: &'a NoticeInfo) -> NewNotice<'a> {
        NewNotice { account, notice, most: MOST, mailing: self.server.is_some() }
    }
}

/// A notice; `link` is a path within the service such as `/r/<id>`. What is too long is cut.
pub(crate) fn notice(subject: &str, text: &str, link: &str) -> NoticeInfo {
    NoticeInfo {
        id: uuid::Uuid::now_v7().to_string(),
        subject: one_line(subject).chars().take(SUBJECT).collect(),
        text: text.trim().chars().filter(|c| *c == '\n' || !c.is_control()).take(TEXT).collect(),
        link: own_path(link),
        created_us: now_us(),
        read_us: None,
    }
}

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

/// A path within the service: anything else leads to the page of runs.
fn own_path(link: &str) -> String {
    let plain = |c: char| c.is_ascii_graphic() && !"\\\"<>".contains(c);
    let own = link.starts_with('/') && !link.starts_with("//") && link.chars().all(plain);
    if own { link.to_owned() } else { "/runs".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_subject_is_one_line_and_a_link_stays_within_the_service() {
        assert_eq!(one_line(" a\r\nBcc: b@c\u{85}d\te "), "a Bcc: b@c d e");
        assert_eq!(own_path("/p/1?x=2#y"), "/p/1?x=2#y");
        for odd in ["", "https://a.example", "//a.example", "/a b", "/a\r\nb", "/\\a.example", "javascript:x"] {
            assert_eq!(own_path(odd), "/runs", "{odd:?}");
        }
    }
}
