//! Notices, choices, addresses and waiting mails, on both databases.

use super::super::*;
use super::people::account;
use super::rows::*;
use crate::accounts::choices::sql::ChoicesRow;
use crate::model::{Cursor, NewChoices, NoticeInfo};

const NOTE: Note<'static> = Note { actor: "ada", action: "did", subject: "x", detail: "" };

fn notice(id: &str, created_us: i64) -> NoticeInfo {
    let (subject, text, link) = (format!("about {id}"), "text".into(), "/runs".into());
    NoticeInfo { id: id.into(), subject, text, link, created_us, read_us: None }
}

async fn two_accounts(store: &Store) {
    for (id, name) in [("1", "ada"), ("2", "bob")] {
        assert!(store.add_account(&account(id, name), "hash").await.unwrap());
    }
}

async fn tell(store: &Store, account: &str, notice: &NoticeInfo, most: usize, mailing: bool) -> bool {
    store.add_notice(NewNotice { account, notice, most, mailing }).await.unwrap()
}

async fn ids(store: &Store, account: &str) -> Vec<String> {
    let all = store.notices(account, &Cursor::start(), 9).await.unwrap();
    all.into_iter().map(|notice| notice.id).collect()
}

pub async fn notices_belong_to_their_account_and_go_with_it(store: Store) {
    two_accounts(&store).await;
    for (id, us) in [("a", 1), ("c", 2), ("b", 2), ("d", 3)] {
        assert!(tell(&store, "1", &notice(id, us), 3, true).await);
    }
    assert!(tell(&store, "2", &notice("e", 9), 3, true).await);
    assert!(!tell(&store, "9", &notice("f", 9), 3, true).await, "there is no such account");
    assert_eq!(ids(&store, "1").await, ["d", "c", "b"], "the oldest beyond three is forgotten");
    let from = Cursor::behind(2, "c");
    assert_eq!(store.notices("1", &from, 9).await.unwrap(), [notice("b", 2)]);

    assert_eq!(store.read_notice("2", "d").await.unwrap(), None, "somebody else's");
    let read = store.read_notice("1", "d").await.unwrap().unwrap();
    assert!(read.read_us.is_some() && store.read_notice("1", "d").await.unwrap().unwrap() == read);
    assert!(!store.remove_notice("2", "d").await.unwrap());
    assert!(store.remove_notice("1", "d").await.unwrap() && !store.remove_notice("1", "d").await.unwrap());
    sqlx::query("DELETE FROM accounts WHERE id = '1'").execute(&store.pool).await.unwrap();
    assert_eq!((ids(&store, "1").await, ids(&store, "2").await), (vec![], vec!["e".to_owned()]));
}

pub async fn mails_wait_for_those_who_want_them(store: Store) {
    two_accounts(&store).await;
    let both = NewChoices { mail_notices: Some(true), ..NewChoices::default() };
    for (account, id) in [("1", "a"), ("2", "b")] {
        store.choose(account, &both).await.unwrap();
        store.set_address(account, "ada@example.org", false, NOTE).await.unwrap();
        // Nobody has opened a link.
        tell(&store, account, &notice(id, 1), 9, true).await;
    }
    assert_eq!((store.due_mail(i64::MAX).await.unwrap(), store.next_mail_us().await.unwrap()), (None, None));
    confirmed(&store, "1", "ada@example.org").await;
    tell(&store, "1", &notice("c", 20), 9, false).await;
    assert_eq!(store.next_mail_us().await.unwrap(), None, "no mail is to be sent");
    tell(&store, "1", &notice("d", 30), 9, true).await;
    tell(&store, "1", &notice("e", 40), 9, true).await;
    assert_eq!(store.next_mail_us().await.unwrap(), Some(30));
    assert_eq!(store.due_mail(29).await.unwrap(), None);
    let due = store.due_mail(50).await.unwrap().unwrap();
    let expected = WaitingMail {
        id: due.id.clone(),
        account: ["1".into(), "ada".into()],
        address: "ada@example.org".into(),
        notice: Some(["about d".into(), "text".into(), "/runs".into()]),
        wanted: true,
        created_us: 30,
        due_us: 30,
        tries: 0,
    };
    assert_eq!(due, expected);
    // Of two services one tries it; it is due again when that did not end in time, or closed.
    assert!(store.hold_mail(&due.id, 30, 45).await.unwrap());
    assert!(!store.hold_mail(&due.id, 30, 45).await.unwrap());
    assert_eq!(store.due_mail(50).await.unwrap().unwrap().created_us, 40);
    assert!(store.hold_mail(&due.id, 45, 30).await.unwrap());
    assert_eq!(store.due_mail(50).await.unwrap(), Some(expected.clone()));
    store.postpone_mail(&due.id, 60).await.unwrap();
    let second = store.due_mail(50).await.unwrap().unwrap();
    assert_eq!(second.created_us, 40);
    store.forget_mail(&second.id).await.unwrap();
    assert_eq!(store.due_mail(50).await.unwrap(), None);
    assert_eq!(store.due_mail(60).await.unwrap(), Some(WaitingMail { due_us: 60, tries: 1, ..expected.clone() }));
    // Choosing otherwise is heard in time; a notice that goes takes its mail along.
    let none = NewChoices { mail_notices: Some(false), ..NewChoices::default() };
    store.choose("1", &none).await.unwrap();
    assert!(!store.due_mail(60).await.unwrap().unwrap().wanted);
    store.choose("1", &both).await.unwrap();
    assert!(store.due_mail(60).await.unwrap().unwrap().wanted);
    store.remove_notice("1", "d").await.unwrap();
    assert_eq!(store.due_mail(60).await.unwrap(), None);
}

/// Opens a link to this address.
async fn confirmed(store: &Store, account: &str, address: &str) {
    let sha256 = &format!("opened by {account}");
    store.add_confirmation(MailLink { sha256, account, address, expires_us: i64::MAX }).await.unwrap();
    assert!(store.confirm_address(sha256, account, 10, NOTE).await.unwrap());
}

pub async fn an_address_counts_once_its_link_was_opened(store: Store) {
    two_accounts(&store).await;
    assert_eq!(store.choices("9").await.unwrap(), None);
    let fresh = store.choices("1").await.unwrap().unwrap();
    let off = ChoicesRow { agrees_to_reruns: false, mail_notices: false, address: None, confirmed_us: None };
    assert_eq!(fresh, off);
    let agrees = NewChoices { agrees_to_reruns: Some(true), mail_notices: None };
    store.choose("1", &agrees).await.unwrap();
    store.choose("1", &NewChoices::default()).await.unwrap();
    assert_eq!(store.choices("1").await.unwrap(), Some(ChoicesRow { agrees_to_reruns: true, ..off.clone() }));
    assert_eq!(store.choices("2").await.unwrap(), Some(off));

    // One mail asks, however often the address is said.
    for _ in 0..2 {
        store.set_address("1", "ada@example.org", true, NOTE).await.unwrap();
    }
    let asks = store.due_mail(i64::MAX).await.unwrap().unwrap();
    assert!(asks.wanted && asks.notice.is_none() && asks.account[0] == "1", "{asks:?}");
    let link = async |sha256: &str, address: &str, expires_us: i64| {
        store.add_confirmation(MailLink { sha256, account: "1", address, expires_us }).await.unwrap();
    };
    let now = now_us();
    let opened =
        async |sha256: &str, account: &str, at: i64| store.confirm_address(sha256, account, at, NOTE).await.unwrap();
    link("a", "ada@example.org", now + 1_000_000_000).await;
    link("b", "ada@example.org", now + 1_000_000_000).await;
    assert!(!opened("a", "2", now).await, "somebody else's");
    assert!(!opened("a", "1", now + 1_000_000_000).await, "its time is over");
    assert!(!opened("x", "1", now).await);
    assert!(opened("a", "1", now).await && !opened("a", "1", now).await && !opened("b", "1", now).await, "one, once");
    assert_eq!(store.choices("1").await.unwrap().unwrap().confirmed_us, Some(now));
    assert_eq!(store.due_mail(i64::MAX).await.unwrap(), None, "nothing is asked any more");

    // The same again stays confirmed, and asks nothing; another one does not, and the way back neither.
    store.set_address("1", "ada@example.org", true, NOTE).await.unwrap();
    assert_eq!(store.choices("1").await.unwrap().unwrap().confirmed_us, Some(now));
    assert_eq!(store.due_mail(i64::MAX).await.unwrap(), None);
    link("c", "ada@example.org", now + 1_000_000_000).await;
    store.set_address("1", "ada@elsewhere.example", false, NOTE).await.unwrap();
    assert_eq!(store.choices("1").await.unwrap().unwrap().confirmed_us, None);
    store.set_address("1", "ada@example.org", false, NOTE).await.unwrap();
    assert!(!opened("c", "1", now).await, "it was for the address before");
    // A link that was on its way when the address changed.
    link("d", "ada@elsewhere.example", now + 1_000_000_000).await;
    assert!(!opened("d", "1", now).await);
    store.set_address("1", "ada@example.org", true, NOTE).await.unwrap();
    store.forget_address("1", NOTE).await.unwrap();
    assert_eq!(store.choices("1").await.unwrap().unwrap().address, None);
    assert_eq!(store.due_mail(i64::MAX).await.unwrap(), None);
    assert_eq!(store.notes_on("x").await.unwrap().len(), 8, "every change is noted, and nothing else");
}

pub async fn a_link_turns_off_the_mails_of_its_account_alone(store: Store) {
    two_accounts(&store).await;
    let wants = NewChoices { mail_notices: Some(true), ..NewChoices::default() };
    for (account, id) in [("1", "a"), ("2", "b")] {
        store.choose(account, &wants).await.unwrap();
        store.set_address(account, "both@example.org", false, NOTE).await.unwrap();
        confirmed(&store, account, "both@example.org").await;
        tell(&store, account, &notice(id, 1), 9, true).await;
    }
    let now = now_us();
    let later = now + 1_000_000_000;
    let link = async |sha256: &str, address: &str, expires_us: i64| {
        store.add_off_link(MailLink { sha256, account: "1", address, expires_us }).await.unwrap();
    };
    let of = async |sha256: &str, at: i64| store.account_of_off_link(sha256, at).await.unwrap();
    link("a", "both@example.org", later).await;
    link("b", "ada@elsewhere.example", later).await;
    let ada = ["1".to_owned(), "ada".to_owned()];
    assert_eq!(of("a", now).await, Some((ada.clone(), true)));
    assert_eq!((of("a", later).await, of("b", now).await, of("x", now).await), (None, None, None));
    let noted = store.notes_on("x").await.unwrap().len();
    let half_open = MailLink { sha256: "c", account: "1", address: "both@example.org", expires_us: later };
    store.add_confirmation(half_open).await.unwrap();
    store.turn_mails_off("1", Some(NOTE)).await.unwrap();
    assert_eq!(of("a", now).await, Some((ada, false)));
    let row = store.choices("1").await.unwrap().unwrap();
    assert_eq!((row.mail_notices, row.address.as_deref()), (false, Some("both@example.org")));
    assert!(row.confirmed_us.is_some() && store.choices("2").await.unwrap().unwrap().mail_notices);
    assert!(!store.confirm_address("c", "1", now, NOTE).await.unwrap(), "no link of before confirms anything");
    assert_eq!(
        store.due_mail(i64::MAX).await.unwrap().unwrap().account[0],
        "2",
        "what waited for the other waits still"
    );
    store.turn_mails_off("1", None).await.unwrap();
    assert_eq!(store.notes_on("x").await.unwrap().len(), noted + 1);

    // What went to an address of before turns nothing off, also when that comes back; nor does what was too late.
    store.set_address("1", "ada@elsewhere.example", false, NOTE).await.unwrap();
    store.set_address("1", "both@example.org", false, NOTE).await.unwrap();
    assert_eq!(of("a", now).await, None);
    link("d", "both@example.org", now - 1).await;
    link("e", "both@example.org", later).await;
    assert_eq!(
        (of("d", now - 2).await.is_some(), of("e", now).await.is_some()),
        (false, true),
        "the old one is forgotten"
    );
    store.forget_address("1", NOTE).await.unwrap();
    assert_eq!(of("e", now).await, None);
}
