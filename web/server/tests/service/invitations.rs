//! Invitations: one link makes one developer, once and in time, and tells nothing to whoever guesses.

use ocb_service::model::{InvitationRequest, Role};
use reqwest::{Method, Response, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::support::{Guest, Service, problem};

async fn invite(by: &Guest, recipient: &str) -> Value {
    let made = by.post("/api/v1/invitations").json(&json!({ "recipient": recipient })).send().await.expect("an answer");
    assert_eq!(made.status(), StatusCode::CREATED);
    made.json().await.expect("JSON")
}

async fn accept(by: &Guest, secret: &Value) -> Response {
    by.post("/api/v1/account/invitation").json(&json!({ "secret": secret })).send().await.expect("an answer")
}

async fn role(of: &Guest) -> Value {
    of.json("/api/v1/account").await["account"]["role"].clone()
}

#[tokio::test]
async fn an_invitation_makes_one_developer() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let curator = member(&service, "curator", Role::Curator).await;
    let (ada, bob) = (member(&service, "ada", Role::User).await, member(&service, "bob", Role::User).await);
    let made = invite(&curator, "Ada, of the GJK paper").await;
    let (secret, id) = (&made["secret"], made["invitation"]["id"].as_str().expect("an id").to_owned());
    let link = format!("{}/account#invitation={}", service.url, secret.as_str().expect("text"));
    assert_eq!((&made["link"], &made["invitation"]["state"]), (&json!(link), &json!("open")));
    assert!(secret.as_str().is_some_and(|secret| secret.len() == 64), "{made}");
    let listed = curator.json("/api/v1/invitations").await;
    assert!(!listed.to_string().contains(secret.as_str().expect("text")), "the secret is shown once");
    assert_eq!(listed[0]["invited_by"], "curator");

    // Nobody without an account, nobody who is one already, and then nobody after the first.
    problem(accept(&service.guest(), secret).await, 401).await;
    assert!(problem(accept(&curator, secret).await, 409).await.contains("stays open"));
    assert_eq!(accept(&ada, secret).await.status(), StatusCode::OK);
    assert_eq!((role(&ada).await, role(&bob).await), (json!("developer"), json!("user")));
    let listed = curator.json("/api/v1/invitations").await;
    assert_eq!((&listed[0]["state"], &listed[0]["accepted_by"]), (&json!("accepted"), &json!("ada")));
    let used = problem(accept(&bob, secret).await, 404).await;

    // Withdrawn, expired, never there, and of somebody who is no curator any more: all sound alike.
    let withdrawn = invite(&curator, "Bob").await;
    let path = format!("/api/v1/invitations/{}", withdrawn["invitation"]["id"].as_str().expect("an id"));
    let revoke = |path: String| curator.request(Method::DELETE, &path).send();
    let gone: Value = revoke(path.clone()).await.expect("an answer").json().await.expect("JSON");
    assert_eq!(gone["state"], "revoked");
    problem(revoke(path).await.expect("an answer"), 409).await;
    problem(revoke(format!("/api/v1/invitations/{id}")).await.expect("an answer"), 409).await;
    problem(revoke("/api/v1/invitations/none".into()).await.expect("an answer"), 404).await;
    let passing = member(&service, "passing", Role::Curator).await;
    let of_passing = invite(&passing, "Bob").await;
    let administrator = member(&service, "admin", Role::Administrator).await;
    let account = passing.json("/api/v1/account").await["account"]["id"].as_str().expect("an id").to_owned();
    let demoted = administrator.post(&format!("/api/v1/accounts/{account}/role")).json(&json!({ "role": "user" }));
    assert_eq!(demoted.send().await.expect("an answer").status(), StatusCode::OK);
    for secret in [&withdrawn["secret"], &of_passing["secret"], &json!("0".repeat(64)), &json!("")] {
        assert_eq!(problem(accept(&bob, secret).await, 404).await, used);
    }
    assert_eq!(role(&bob).await, "user");

    // The operator's own, and what was done stands in the log.
    let asked = InvitationRequest { recipient: "Bob".into(), days: 1 };
    let operators = service.engine.invite(None, asked, "https://bench.example", None).await.expect("an invitation");
    assert!(operators.link.starts_with("https://bench.example/account#invitation="), "{}", operators.link);
    assert_eq!(accept(&bob, &json!(operators.secret)).await.status(), StatusCode::OK);
    let log = service.engine.audit(&format!("invitation:{id}")).await.expect("a log");
    let told: Vec<_> = log.iter().map(|entry| (entry.actor.as_str(), entry.action.as_str())).collect();
    assert_eq!(told, [("curator", "invitation created"), ("ada", "invitation accepted")]);
    let bob = bob.json("/api/v1/account").await["account"]["id"].as_str().expect("an id").to_owned();
    let log = service.engine.audit(&format!("account:{bob}")).await.expect("a log");
    assert!(log.iter().any(|entry| entry.detail == "user to developer, invited"), "{log:?}");
    assert_eq!(service.engine.broken_audit().await.expect("a log"), None);

    for bad in
        [json!({ "recipient": " " }), json!({ "recipient": "x", "days": 0 }), json!({ "recipient": "x", "days": 91 })]
    {
        problem(curator.post("/api/v1/invitations").json(&bad).send().await.expect("an answer"), 422).await;
    }
    service.stop().await;
}
