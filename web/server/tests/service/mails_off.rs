//! The link in every mail that turns mails off, without logging in.

use std::time::Duration;

use ocb_service::model::Role;
use reqwest::{Method, Response, StatusCode};
use serde_json::{Value, json};

use crate::mail::{choose, given, open, reachable, secret, told};
use crate::mail_server::{PAGES, Post};
use crate::people::member;
use crate::support::{Guest, Service, problem};

/// The secret of the link in a mail, which is the same in its text and in its head.
fn off(mail: &Value) -> String {
    let text = mail["text"].as_str().expect("a text");
    let (_, link) = text.split_once(&format!("{PAGES}/mails/off/")).unwrap_or_else(|| panic!("no link: {text}"));
    let secret = link.split_whitespace().next().expect("a secret");
    let head = &mail["head"];
    let named = head["list-unsubscribe"].as_str().expect("a header").trim();
    assert_eq!(named, format!("<{PAGES}/mails/off/{secret}>"), "{head}");
    assert_eq!(head["list-unsubscribe-post"], "List-Unsubscribe=One-Click");
    assert!(secret.len() == 64 && secret.chars().all(|c| c.is_ascii_hexdigit()), "{secret}");
    secret.to_owned()
}

/// What a mail program sends.
async fn click(guest: &Guest, secret: &str) -> Response {
    let request =
        guest.post(&format!("/mails/off/{secret}")).header("content-type", "application/x-www-form-urlencoded");
    request.body("List-Unsubscribe=One-Click").send().await.expect("an answer")
}

/// What the button of the page sends.
async fn press(guest: &Guest, secret: &str) -> Response {
    guest.post(&format!("/api/v1/mails/off/{secret}")).send().await.expect("an answer")
}

async fn wants_mails(guest: &Guest) -> bool {
    guest.json("/api/v1/account/choices").await["mail_notices"].as_bool().expect("a choice")
}

#[tokio::test]
async fn a_link_turns_off_the_mails_of_its_account_and_does_nothing_else() {
    let post = Post::open("well").await;
    let service = Service::start_mailing(post.server()).await;
    let ada = reachable(&service, &post, "ada", 1).await;
    let bob = reachable(&service, &post, "bob", 2).await;
    told(&ada, 1).await;
    let mails = post.exactly(3).await;
    let link = off(&mails[2]);
    assert!(link != off(&mails[0]) && link != off(&mails[1]), "every mail has a link of its own");

    // Programs that look through mails open links, with and without a body: nothing happens.
    let stranger = service.guest();
    for method in [Method::GET, Method::HEAD] {
        let seen = stranger.request(method, &format!("/mails/off/{link}")).send().await.expect("an answer");
        assert!(matches!(seen.status(), StatusCode::OK | StatusCode::SERVICE_UNAVAILABLE), "{}", seen.status());
    }
    problem(stranger.get(&format!("/api/v1/mails/off/{link}")).send().await.expect("an answer"), 405).await;
    assert!(wants_mails(&ada).await);

    let before = ada.json("/api/v1/account/choices").await;
    assert_eq!(click(&stranger, &link).await.status(), StatusCode::NO_CONTENT);
    let expected = {
        let mut now = before.clone();
        now["mail_notices"] = json!(false);
        now
    };
    assert_eq!(ada.json("/api/v1/account/choices").await, expected, "mails are off, and nothing else is different");
    assert!(wants_mails(&bob).await, "somebody else's are not");
    assert_eq!(stranger.json("/api/v1/account").await["account"], Value::Null, "nobody is logged in by it");
    told(&ada, 2).await;
    told(&bob, 3).await;
    let mails = post.exactly(4).await;
    assert_eq!(mails[3]["to"], json!(["bob@example.org"]));

    // Twice is once, and an older mail of the same address does the same.
    for again in [click(&stranger, &link).await, press(&stranger, &link).await] {
        assert_eq!(again.status(), StatusCode::NO_CONTENT);
    }
    choose(&ada, json!({ "mail_notices": true })).await;
    assert_eq!(press(&bob, &off(&mails[0])).await.status(), StatusCode::NO_CONTENT);
    assert!(!wants_mails(&ada).await && wants_mails(&bob).await, "it is for its account, whoever is logged in");
    service.stop().await;
}

#[tokio::test]
async fn another_link_or_an_old_one_turns_nothing_off_and_says_so() {
    let post = Post::open("well").await;
    let service = Service::start_mailing(post.server()).await;
    let ada = reachable(&service, &post, "ada", 1).await;
    let stranger = service.guest();
    let link = off(&post.taken()[0]);
    let refused = problem(click(&stranger, &"0".repeat(64)).await, 404).await;
    assert!(refused.contains("link is not valid") && refused.contains("account page"), "{refused}");
    for odd in [&link[..63], &link.to_uppercase(), &format!("{link}0"), "x", "%00"] {
        assert_eq!(problem(click(&stranger, odd).await, 404).await, refused, "{odd}");
        assert_eq!(problem(press(&stranger, odd).await, 404).await, refused, "{odd}");
    }
    // Neither kind of link is the other.
    assert_eq!(problem(click(&stranger, &secret(&post.taken()[0])).await, 404).await, refused);
    problem(open(&ada, &link).await, 404).await;
    assert!(wants_mails(&ada).await);
    // What went to the address of before is old, also when that comes back.
    given(&ada, "ada@elsewhere.example").await;
    let mails = post.exactly(2).await;
    assert_eq!(problem(click(&stranger, &link).await, 404).await, refused);
    assert!(wants_mails(&ada).await);
    // In the mail that asks whether an address is right, it stops that, too: the address is not confirmed by it any more.
    assert_eq!(click(&stranger, &off(&mails[1])).await.status(), StatusCode::NO_CONTENT);
    assert!(!wants_mails(&ada).await);
    problem(open(&ada, &secret(&mails[1])).await, 404).await;

    // Its time is over.
    let mut server = post.server();
    server.pace.off = Duration::ZERO;
    let service = service.restart_mailing(server).await;
    let late = member(&service, "late", Role::User).await;
    given(&late, "late@example.org").await;
    choose(&late, json!({ "mail_notices": true })).await;
    let mails = post.exactly(3).await;
    assert_eq!(problem(click(&late, &off(&mails[2])).await, 404).await, refused);
    assert!(wants_mails(&late).await);
    let mut guesses = 0;
    let told = loop {
        let answer = press(&late, "guess").await;
        if answer.status() != StatusCode::NOT_FOUND {
            break problem(answer, 429).await;
        }
        guesses += 1;
        assert!(guesses < 100, "nobody stops who guesses");
    };
    assert!(told.contains("wait"), "{told}");
    service.stop().await;
}
