//! Notices: who is told what, and that it is theirs alone.

use ocb_service::model::Role;
use reqwest::{Method, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::publishing::{decide, manifest, offered_for_curation, well};
use crate::support::{Service, problem};

#[tokio::test]
async fn an_author_is_told_of_every_step_that_others_take() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let author = member(&service, "author", Role::Developer).await;
    let curator = member(&service, "curator", Role::Curator).await;
    let id = offered_for_curation(&author).await;
    let evil = "Where is\r\nthe source?\r\nBcc: eve@example.org";
    for (by, action, reason) in [
        (&curator, "ask", evil),
        (&author, "answer", "In this repository."),
        (&curator, "reject", "It is not."),
        (&curator, "reinstate", "Found it."),
        (&curator, "suspend", "It crashes."),
        (&curator, "reinstate", "It does not."),
        (&curator, "exclude", "It cheats."),
        (&author, "withdraw", ""),
    ] {
        well(decide(by, &id, action, reason).await).await;
    }
    let told = author.json("/api/v1/notices").await;
    let told = told.as_array().expect("a list");
    let subjects: Vec<_> = told.iter().rev().map(|notice| notice["subject"].as_str().expect("a subject")).collect();
    let name = format!("Your plugin {} 1.0 ", manifest("1.0")["name"].as_str().expect("a name"));
    let expected = [
        "passed its check",
        "needs an answer",
        "was rejected",
        "was reinstated",
        "was suspended",
        "was reinstated",
        "was excluded",
    ];
    assert_eq!(subjects, expected.map(|what| format!("{name}{what}")));
    assert!(told.iter().all(|notice| notice["link"] == format!("/p/{id}") && notice["read_us"].is_null()), "{told:#?}");
    assert!(told[5]["text"].as_str().expect("a text").starts_with("Where is\nthe source?\nBcc"), "{}", told[5]);
    assert_eq!(curator.json("/api/v1/notices").await, json!([]), "who decides is told nothing");

    // Read once, and for ever; taken away, and gone.
    let path = format!("/api/v1/notices/{}", told[0]["id"].as_str().expect("an id"));
    let read = async || author.post(&format!("{path}/read")).send().await.expect("an answer");
    let first: Value = read().await.json().await.expect("JSON");
    assert!(first["read_us"].is_i64(), "{first}");
    assert_eq!(read().await.json::<Value>().await.expect("JSON"), first, "the first time stands");
    assert_eq!(author.json("/api/v1/notices").await[0], first);
    let taken = curator.request(Method::DELETE, &path).send().await.expect("an answer");
    problem(taken, 404).await;
    let gone = async || author.request(Method::DELETE, &path).send().await.expect("an answer");
    assert_eq!(gone().await.status(), StatusCode::NO_CONTENT);
    problem(gone().await, 404).await;
    assert_eq!(author.json("/api/v1/notices").await.as_array().map(Vec::len), Some(6));
    service.stop().await;
}
