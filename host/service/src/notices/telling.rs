//! Telling an account something.

use crate::Result;
use crate::boxed;
use crate::mail::one_line;
use crate::mail::outbox::Outbox;
use crate::model::NoticeInfo;
use crate::notices::sql::NewNotice;
use crate::store::now_us;

/// Notices of one account that are kept.
pub const MOST: usize = 500;
/// Letters of their parts.
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
