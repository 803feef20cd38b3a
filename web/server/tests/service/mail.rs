//! Mails, brought to a real mail server: what arrives, when, and to whom.

use std::time::{Duration, Instant};

use ocb_service::model::Role;
use reqwest::{Method, Response, StatusCode};
use serde_json::{Value, json};

use crate::mail_server::{FROM, PAGES, Post};
use crate::people::member;
use crate::publishing::{decide, failed, garbage, offered_for_curation, well};
use crate::support::{Guest, Service, problem};

async fn give(guest: &Guest, address: &str) -> Response {
    let request = guest.request(Method::PUT, "/api/v1/account/address");
    request.json(&json!({ "address": address })).send().await.expect("an answer")
}

pub async fn given(guest: &Guest, address: &str) -> Value {
    let answer = give(guest, address).await;
    assert_eq!(answer.status(), StatusCode::OK);
    answer.json().await.expect("JSON")
}

pub async fn choose(guest: &Guest, choices: Value) -> Value {
    let answer = guest.request(Method::PUT, "/api/v1/account/choices").json(&choices).send().await.expect("an answer");
    assert_eq!(answer.status(), StatusCode::OK);
    answer.json().await.expect("JSON")
}

pub async fn open(guest: &Guest, secret: &str) -> Response {
    let request = guest.post("/api/v1/account/address/confirmation");
    request.json(&json!({ "secret": secret })).send().await.expect("an answer")
}

/// The secret in the link of a mail that asks whether an address is right.
pub fn secret(mail: &Value) -> String {
    let text = mail["text"].as_str().expect("a text");
    let (_, link) = text.split_once(&format!("{PAGES}/account#confirm=")).unwrap_or_else(|| panic!("no link: {text}"));
    link.split_whitespace().next().expect("a secret").to_owned()
}

/// An account with notices by mail, at an address that it has confirmed by the mail of this number.
pub async fn reachable(service: &Service, post: &Post, name: &str, number: usize) -> Guest {
    let guest = member(service, name, Role::Developer).await;
    given(&guest, &format!("{name}@example.org")).await;
    let mails = post.exactly(number).await;
    assert_eq!(open(&guest, &secret(&mails[number - 1])).await.status(), StatusCode::OK);
    let now = choose(&guest, json!({ "mail_notices": true })).await;
    assert_eq!((&now["confirmed"], &now["mailing"]), (&json!(true), &json!(true)), "{now}");
    guest
}

/// Something happens that the account is told of.
pub async fn told(guest: &Guest, number: u8) -> Value {
    let sent: Value = garbage(guest, number).await.json().await.expect("JSON");
    let ended = failed(guest, &sent).await;
    while !guest.json("/api/v1/notices").await.to_string().contains(ended["id"].as_str().expect("an id")) {
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    ended
}

#[tokio::test]
async fn a_notice_arrives_with_its_head_and_text_and_only_where_the_address_is_confirmed() {
    let post = Post::open("well").await;
    let service = Service::start_mailing(post.server()).await;
    let author = reachable(&service, &post, "ada", 1).await;
    // This one wants mails and has not opened the link.
    let hasty = member(&service, "hasty", Role::Developer).await;
    choose(&hasty, json!({ "mail_notices": true })).await;
    assert_eq!(given(&hasty, "hasty@example.org").await["confirmed"], false);
    post.exactly(2).await;
    told(&hasty, 1).await;
    let plugin = told(&author, 2).await;

    let mails = post.exactly(3).await;
    let mail = &mails[2];
    assert_eq!((&mail["from"], &mail["to"]), (&json!(FROM), &json!(["ada@example.org"])));
    let head = &mail["head"];
    assert_eq!(head["from"], format!("OpenCollBench <{FROM}>"));
    assert_eq!(head["to"], "ada@example.org");
    assert_eq!(head["subject"], "[OpenCollBench] Your plugin Sphere tree 1.0 failed its check");
    assert_eq!(head["auto-submitted"], "auto-generated");
    assert!(head["message-id"].as_str().is_some_and(|id| id.ends_with("@example.org>")), "{head}");
    assert!(head["content-type"].as_str().is_some_and(|kind| kind.starts_with("text/plain")), "{head}");
    let text = mail["text"].as_str().expect("a text");
    for part in [&format!("{PAGES}/p/{}", plugin["id"].as_str().expect("an id")), &format!("{PAGES}/account#mails")] {
        assert!(text.contains(part), "{part} is missing: {text}");
    }
    assert!(text.contains("ELF gate"), "the reason is told: {text}");

    // Off again, and another address counts for nothing until its link was opened.
    choose(&author, json!({ "mail_notices": false })).await;
    told(&author, 3).await;
    choose(&author, json!({ "mail_notices": true })).await;
    assert_eq!(given(&author, "ada@elsewhere.example").await["confirmed"], false);
    told(&author, 4).await;
    let mails = post.exactly(4).await;
    assert_eq!(mails[3]["to"], json!(["ada@elsewhere.example"]));
    secret(&mails[3]);
    service.stop().await;
}

#[tokio::test]
async fn what_people_write_is_no_line_of_a_head() {
    let post = Post::open("well").await;
    let service = Service::start_mailing(post.server()).await;
    let author = reachable(&service, &post, "ada", 1).await;
    let curator = member(&service, "curator", Role::Curator).await;
    let plugin = offered_for_curation(&author).await;
    let plain = post.exactly(2).await[1]["fields"].clone();
    // Nobody says an address in two lines, or two in one.
    for odd in ["ada@example.org\r\nBcc: eve@example.org", "ada@example.org, eve@example.org", "Ada <ada@example.org>"]
    {
        assert!(problem(give(&author, odd).await, 422).await.contains("look like"), "{odd}");
    }
    let evil = "No.\r\nBcc: eve@example.org\r\n\r\nInstead\r\n.\r\nMAIL FROM:<eve@example.org>\r\n";
    well(decide(&curator, &plugin, "ask", evil).await).await;
    let mails = post.exactly(3).await;
    assert_eq!(mails[2]["to"], json!(["ada@example.org"]));
    assert_eq!(mails[2]["fields"], plain, "{:#}", mails[2]);
    let text = mails[2]["text"].as_str().expect("a text");
    assert!(text.contains("Instead\n.\nMAIL FROM:<eve@example.org>\n"), "what was written is told, as text: {text}");
    service.stop().await;
}

#[tokio::test]
async fn a_server_that_was_away_gets_each_mail_once() {
    let mut post = Post::closed();
    let service = Service::start_mailing(post.server()).await;
    let ada = member(&service, "ada", Role::User).await;
    assert_eq!(given(&ada, "ada@example.org").await["confirmed"], false);
    let bob = member(&service, "bob", Role::User).await;
    given(&bob, "bob@example.org").await;
    // It is tried in vain a few times.
    tokio::time::sleep(Duration::from_millis(900)).await;
    // A farewell that is never answered brings nothing again: the server has said that it has the mail.
    post.serve("no-farewell").await;
    let mails = post.exactly(2).await;
    let mut to: Vec<_> = mails.iter().map(|mail| mail["to"][0].as_str().expect("an address")).collect();
    to.sort_unstable();
    assert_eq!(to, ["ada@example.org", "bob@example.org"]);
    service.stop().await;
}

#[tokio::test]
async fn a_server_that_hangs_keeps_nobody_waiting_and_what_waits_outlives_the_service() {
    let deaf = tokio::net::TcpListener::bind("127.0.0.1:0").await.expect("a free port");
    let mut post = Post::closed();
    let hanging = Post::at(deaf.local_addr().expect("an address").port());
    let mut server = hanging.server();
    server.pace.delivery = Duration::from_secs(600);
    let service = Service::start_mailing(server).await;
    let guest = member(&service, "ada", Role::User).await;
    given(&guest, "ada@example.org").await;
    let (held, _) =
        tokio::time::timeout(Duration::from_secs(30), deaf.accept()).await.expect("it is tried").expect("a connection");
    let begun = Instant::now();
    given(&guest, "ada@elsewhere.example").await;
    guest.json("/api/v1/account/choices").await;
    post.serve("well").await;
    let service = service.restart_mailing(post.server()).await;
    assert!(begun.elapsed() < Duration::from_secs(30), "somebody waited for a server that hangs");
    drop(held);
    let mails = post.exactly(1).await;
    assert_eq!(mails[0]["to"], json!(["ada@elsewhere.example"]));
    service.stop().await;
}

#[tokio::test]
async fn a_server_that_never_answers_is_left_after_its_time() {
    let deaf = tokio::net::TcpListener::bind("127.0.0.1:0").await.expect("a free port");
    let mut server = Post::at(deaf.local_addr().expect("an address").port()).server();
    server.pace.delivery = Duration::from_millis(300);
    let service = Service::start_mailing(server).await;
    let guest = member(&service, "ada", Role::User).await;
    given(&guest, "ada@example.org").await;
    let mut held = Vec::new();
    for _ in 0..3 {
        let tried = tokio::time::timeout(Duration::from_secs(30), deaf.accept()).await;
        held.push(tried.expect("it is tried again").expect("a connection"));
    }
    service.stop().await;
}

#[tokio::test]
async fn what_no_server_ever_takes_is_given_up() {
    // The receiver is unknown for good.
    let mut post = Post::open("stranger").await;
    let service = Service::start_mailing(post.server()).await;
    let guest = member(&service, "ada", Role::User).await;
    given(&guest, "ada@example.org").await;
    tokio::time::sleep(Duration::from_secs(1)).await;
    post = Post::open("well").await;
    let service = service.restart_mailing(post.server()).await;
    post.exactly(0).await;
    // Or its time is over.
    let away = Post::closed();
    let mut server = away.server();
    server.pace.give_up = Duration::ZERO;
    let service = service.restart_mailing(server).await;
    let guest = member(&service, "bob", Role::User).await;
    given(&guest, "bob@example.org").await;
    tokio::time::sleep(Duration::from_secs(1)).await;
    let service = service.restart_mailing(post.server()).await;
    post.exactly(0).await;
    service.stop().await;
}

#[tokio::test]
async fn a_server_with_a_lock_is_opened_by_name_and_password() {
    let post = Post::open("locked").await;
    let service = Service::start_mailing(post.as_user("ada:wrong@")).await;
    let guest = member(&service, "ada", Role::User).await;
    given(&guest, "ada@example.org").await;
    post.exactly(0).await;
    let service = service.restart_mailing(post.as_user("ada:s%3Acret@")).await;
    post.exactly(1).await;
    service.stop().await;
}

#[tokio::test]
async fn a_link_confirms_one_address_of_one_account_once_and_in_time() {
    let post = Post::open("well").await;
    let service = Service::start_mailing(post.server()).await;
    let (ada, eve) = (member(&service, "ada", Role::User).await, member(&service, "eve", Role::User).await);
    given(&ada, "ada@example.org").await;
    let first = secret(&post.exactly(1).await[0]);
    // Others may say the same address; the answer is the same, and the link of one is nothing to the other.
    let same = given(&eve, "ada@example.org").await;
    assert_eq!(same, ada.json("/api/v1/account/choices").await);
    post.exactly(2).await;
    let refused = problem(open(&eve, &first).await, 404).await;
    assert_eq!(eve.json("/api/v1/account/choices").await["confirmed"], false);
    assert_eq!(problem(open(&ada, &"0".repeat(64)).await, 404).await, refused, "whatever is wrong, the answer is one");
    // Another address: the old link is nothing any more, also when the old address comes back.
    given(&ada, "ada@elsewhere.example").await;
    post.exactly(3).await;
    given(&ada, "ada@example.org").await;
    let mails = post.exactly(4).await;
    assert_eq!(problem(open(&ada, &first).await, 404).await, refused);
    assert_eq!(problem(open(&ada, &secret(&mails[2])).await, 404).await, refused);
    assert_eq!(open(&ada, &secret(&mails[3])).await.status(), StatusCode::OK);
    assert_eq!(problem(open(&ada, &secret(&mails[3])).await, 404).await, refused, "once");
    assert_eq!(ada.json("/api/v1/account/choices").await["confirmed"], true);
    // Saying the same again asks nothing; forgetting it forgets that it was confirmed.
    assert_eq!(given(&ada, "ada@example.org").await["confirmed"], true);
    post.exactly(4).await;
    let gone = ada.request(Method::DELETE, "/api/v1/account/address").send().await.expect("an answer");
    assert_eq!(gone.json::<Value>().await.expect("JSON")["address"], Value::Null);

    // Its time is over.
    let mut server = post.server();
    server.pace.link = Duration::ZERO;
    let service = service.restart_mailing(server).await;
    let late = member(&service, "late", Role::User).await;
    given(&late, "late@example.org").await;
    let mails = post.exactly(5).await;
    assert_eq!(problem(open(&late, &secret(&mails[4])).await, 404).await, refused);
    let mut guesses = 0;
    let told = loop {
        let answer = open(&late, "guess").await;
        if answer.status() != StatusCode::NOT_FOUND {
            break problem(answer, 429).await;
        }
        guesses += 1;
        assert!(guesses < 100, "nobody stops who guesses");
    };
    assert!(told.contains("wait"), "{told}");
    service.stop().await;
}

#[tokio::test]
async fn nobody_is_flooded_by_others() {
    let post = Post::open("well").await;
    let service = Service::start_mailing(post.server()).await;
    for (number, name) in ["a-one", "a-two", "a-three", "a-four", "a-five", "a-six"].iter().enumerate() {
        let guest = member(&service, name, Role::User).await;
        // The sixth is answered as the first, and nothing goes out.
        let answer = given(&guest, "Victim@example.org").await;
        assert_eq!(answer["confirmed"], false);
        post.exactly((number + 1).min(5)).await;
    }
    service.stop().await;
}

#[tokio::test]
async fn without_a_mail_server_nothing_fails_and_the_answers_say_so() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let author = member(&service, "ada", Role::Developer).await;
    let now = choose(&author, json!({ "mail_notices": true, "agrees_to_reruns": true })).await;
    let expected = json!({
        "agrees_to_reruns": true, "mail_notices": true, "address": null, "confirmed": false, "mailing": false,
    });
    assert_eq!(now, expected);
    assert_eq!(
        choose(&author, json!({ "mail_notices": false })).await["agrees_to_reruns"],
        true,
        "what is not said stays"
    );
    assert_eq!(given(&author, "ada@example.org").await["confirmed"], false);
    told(&author, 1).await;
    // What was said before there was a server goes nowhere when there is one.
    let post = Post::open("well").await;
    let service = service.restart_mailing(post.server()).await;
    post.exactly(0).await;
    service.stop().await;
}
