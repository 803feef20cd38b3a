//! Runs and plugins are cited by links that lead to them. That the texts hold what they should: `host/citation/tests`.

use ocb_service::model::Role;
use reqwest::StatusCode;
use serde_json::Value;

use crate::people::member;
use crate::publishing::{manifest, submit};
use crate::stream::follow;
use crate::support::{Service, problem, small_spec};

#[tokio::test]
async fn what_is_cited_is_found_again_and_says_what_it_is() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (author, stranger) = (member(&service, "author", Role::Developer).await, service.guest());
    let run = stranger.start(&small_spec()).await;
    follow(&stranger, &run, 0).await;
    let citation = stranger.json(&format!("/api/v1/runs/{run}/citation")).await;
    assert_eq!(citation["link"], format!("{}/r/{run}", service.url));
    let (bibtex, cff) = (citation["bibtex"].as_str().expect("text"), citation["cff"].as_str().expect("text"));
    assert!(bibtex.starts_with(&format!("@misc{{opencollbench-run-{run},")), "{bibtex}");
    let environment = stranger.json(&format!("/api/v1/runs/{run}")).await["environment"].clone();
    let class = environment["hardware_class"].as_str().expect("a hardware class");
    for said in ["torus-knot x torus-knot: collision queries, first contact, 60 configurations", "box-tree (", class] {
        assert!(bibtex.contains(said) && cff.contains(said), "{said}: {bibtex}{cff}");
    }
    assert!(cff.contains("cff-version: 1.2.0\n") && cff.contains("type: dataset\n"), "{cff}");

    let mut said = manifest("1.0");
    (said["name"], said["authors"]) = ("Tree }, author = {Mallory}".into(), "Ada Lovelace, Charles Babbage".into());
    let sent = submit(&author, &said, b"\x7fELF but no plugin".to_vec()).await;
    assert_eq!(sent.status(), StatusCode::CREATED);
    let sent: Value = sent.json().await.expect("JSON");
    let path = format!("/api/v1/plugins/{}/citation", sent["id"].as_str().expect("an id"));
    let citation = author.json(&path).await;
    let (bibtex, cff) = (citation["bibtex"].as_str().expect("text"), citation["cff"].as_str().expect("text"));
    assert!(bibtex.contains("author = {Ada Lovelace and Charles Babbage}") && !bibtex.contains("{Mallory"), "{bibtex}");
    assert!(cff.contains("title: \"Tree }, author = {Mallory} 1.0\"\n") && cff.contains("version: \"1.0\""), "{cff}");
    assert!(cff.contains(sent["sha256"].as_str().expect("a hash")), "{cff}");
    problem(stranger.get(&path).send().await.expect("an answer"), 404).await;
    service.stop().await;
}
