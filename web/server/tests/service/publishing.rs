//! A plugin from its upload to the public benchmark, and who sees it on the way.

use ocb_service::model::Role;
use reqwest::multipart::{Form, Part};
use reqwest::{Response, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::stream::follow;
use crate::support::{Guest, Service, built, problem, small_spec};

/// One of our plugins that this service has not installed: a stranger's, as far as it knows.
const PLUGIN: &str = "libocb_sphere_tree.so";

pub fn manifest(version: &str) -> Value {
    json!({
        "name": "Sphere tree", "version": version, "authors": "Somebody", "license": "MIT OR Apache-2.0",
        "queries": ["collision_first", "collision_all", "proximity"],
    })
}

pub async fn submit(guest: &Guest, manifest: &Value, bytes: Vec<u8>) -> Response {
    let file = Part::bytes(bytes).file_name("tree.so");
    let form = Form::new().text("manifest", manifest.to_string()).part("file", file);
    guest.post("/api/v1/plugins").multipart(form).send().await.expect("an answer")
}

pub async fn decide(guest: &Guest, id: &str, action: &str, reason: &str) -> Response {
    let path = format!("/api/v1/plugins/{id}/decisions");
    guest.post(&path).json(&json!({ "action": action, "reason": reason })).send().await.expect("an answer")
}

pub async fn well(response: Response) -> Value {
    let status = response.status();
    let body: Value = response.json().await.expect("JSON");
    assert!(status.is_success(), "{status}: {body:#}");
    body
}

async fn offered(guest: &Guest) -> Vec<String> {
    let all = guest.json("/api/v1/algorithms").await;
    all.as_array().expect("a list").iter().map(|a| a["id"].as_str().expect("an id").to_owned()).collect()
}

#[tokio::test]
async fn a_plugin_is_private_until_a_curator_publishes_it() {
    let service = Service::start_checking(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let author = member(&service, "author", Role::Developer).await;
    let curator = member(&service, "curator", Role::Curator).await;
    let (stranger, other) = (service.guest(), member(&service, "other", Role::Developer).await);
    let bytes = std::fs::read(built().join(PLUGIN)).expect("the plugin is built");

    let response = submit(&author, &manifest("1.0"), bytes.clone()).await;
    assert_eq!(response.status(), StatusCode::CREATED);
    let sent = well(response).await;
    let id = sent["id"].as_str().expect("an id").to_owned();
    let again = submit(&author, &manifest("1.0"), bytes).await;
    assert_eq!(again.status(), StatusCode::OK);
    assert_eq!(well(again).await["id"], id);

    // The stream gives the report line by line and ends with the check.
    let stream = author.get(&format!("/api/v1/plugins/{id}/events")).send().await.expect("an answer");
    let text = stream.text().await.expect("the stream ends");
    let last: Value = serde_json::from_str(text.rsplit("data: ").next().expect("an event").trim()).expect("JSON");
    assert_eq!(last["state"], "validated", "{last:#}");
    assert!(text.matches("data: ").count() > 3, "{text}");
    let lines = last["lines"].as_array().expect("lines");
    assert!(lines.len() > 15 && lines.iter().all(|line| line["verdict"] != "fail"), "{last:#}");
    let many = lines.iter().find(|line| line["check"] == "sphere-tree: first contact, many times").expect("a line");
    println!("{}", many["evidence"]);

    // Its author may benchmark it; nobody else knows of it, nor of the run.
    let own = "sphere-tree@1.0";
    assert!(offered(&author).await.iter().any(|a| a == own));
    for nobody in [&stranger, &other] {
        assert!(!offered(nobody).await.iter().any(|a| a.starts_with("sphere-tree")));
        for path in [format!("/api/v1/plugins/{id}"), format!("/api/v1/plugins/{id}/events")] {
            problem(nobody.get(&path).send().await.expect("an answer"), 404).await;
        }
        problem(decide(nobody, &id, "withdraw", "x").await, if std::ptr::eq(nobody, &stranger) { 401 } else { 404 })
            .await;
        assert_eq!(nobody.json("/api/v1/plugins").await, json!([]));
    }
    let mut spec = small_spec();
    spec["algorithms"] = json!(["box-tree", own]);
    let response = stranger.post("/api/v1/runs").json(&spec).send().await.expect("an answer");
    assert!(problem(response, 422).await.contains("There is no algorithm"));
    let run = author.start(&spec).await;
    follow(&author, &run, 0).await;
    assert_eq!(author.json(&format!("/api/v1/runs/{run}")).await["state"], "done");
    let below = [
        "",
        "/events",
        "/ecdf?algorithm=box-tree",
        "/records.csv?algorithm=box-tree",
        "/triangles.parquet?algorithm=box-tree",
        "/configurations.parquet",
    ];
    for nobody in [&stranger, &other, &curator] {
        for rest in below {
            let hidden =
                problem(nobody.get(&format!("/api/v1/runs/{run}{rest}")).send().await.expect("an answer"), 404).await;
            assert_eq!(hidden, format!("There is no run {run:?}; check the link."));
        }
        let cancelled = nobody.post(&format!("/api/v1/runs/{run}/cancel")).send().await.expect("an answer");
        problem(cancelled, 404).await;
    }

    // Steps in their order, each by who may take it.
    problem(decide(&curator, &id, "approve", "").await, 409).await;
    problem(decide(&curator, &id, "offer", "").await, 403).await;
    well(decide(&author, &id, "offer", "").await).await;
    assert_eq!(curator.json("/api/v1/curation").await[0]["id"], id);
    problem(decide(&author, &id, "approve", "").await, 403).await;
    problem(decide(&curator, &id, "ask", " ").await, 422).await;
    well(decide(&curator, &id, "ask", "Where is the source?").await).await;
    assert_eq!(author.json(&format!("/api/v1/plugins/{id}")).await["reason"], "Where is the source?");
    well(decide(&author, &id, "answer", "In this repository.").await).await;
    well(decide(&curator, &id, "approve", "").await).await;

    // Now it is everybody's, under its plain name.
    assert!(offered(&stranger).await.iter().any(|a| a == "sphere-tree"));
    let shown = stranger.json(&format!("/api/v1/plugins/{id}")).await;
    assert_eq!((&shown["state"], &shown["owner"], &shown["flags"]), (&json!("public"), &json!("author"), &json!([])));
    let words: Vec<&str> =
        shown["history"].as_array().expect("a history").iter().filter_map(|e| e["action"].as_str()).collect();
    assert_eq!(words, ["submitted", "validated", "offered", "asked", "answered", "approved"]);
    spec["algorithms"] = json!(["box-tree", "sphere-tree"]);
    let run = stranger.start(&spec).await;
    follow(&stranger, &run, 0).await;
    let results = stranger.json(&format!("/api/v1/runs/{run}")).await["results"].clone();
    assert_eq!(results[1]["wrong"], 0, "{results:#}");
    assert_eq!(other.json(&format!("/api/v1/runs/{run}")).await["state"], "done");

    // Another version of it must say so, and nobody decides about their own.
    problem(decide(&author, &id, "suspend", "x").await, 403).await;
    well(decide(&curator, &id, "suspend", "It crashes on new objects.").await).await;
    assert!(!offered(&stranger).await.iter().any(|a| a == "sphere-tree"));
    well(decide(&author, &id, "withdraw", "").await).await;
    assert_eq!(stranger.json(&format!("/api/v1/plugins/{id}")).await["state"], "withdrawn");
    assert_eq!(service.engine.broken_audit().await.expect("a log"), None);
    service.stop().await;
}

#[tokio::test]
async fn what_is_no_plugin_is_refused_before_anything_is_kept() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let author = member(&service, "author", Role::Developer).await;
    let elf = || b"\x7fELF and nothing behind it".to_vec();
    let told = problem(submit(&author, &manifest("1.0"), b"hello".to_vec()).await, 422).await;
    assert!(told.contains("not an ELF file"), "{told}");
    for (field, value, expected) in [
        ("license", json!("free as in beer"), "SPDX"),
        ("version", json!("one two"), "version"),
        ("source", json!("javascript:alert(1)"), "https://"),
        ("queries", json!([]), "queries"),
        ("queries", json!(["telepathy"]), "telepathy"),
        ("colour", json!("red"), "colour"),
    ] {
        let mut manifest = manifest("1.0");
        manifest[field] = value;
        let told = problem(submit(&author, &manifest, elf()).await, 422).await;
        assert!(told.contains(expected), "{field}: {told}");
    }
    let file = Form::new().part("file", Part::bytes(elf()).file_name("x.so"));
    let sent = author.post("/api/v1/plugins").multipart(file).send().await.expect("an answer");
    assert!(problem(sent, 400).await.contains("manifest"));
    assert_eq!(author.json("/api/v1/plugins").await, json!([]));

    // An ELF file that is no plugin fails its check.
    let sent = well(submit(&author, &manifest("1.0"), elf()).await).await;
    let sent = failed(&author, &sent).await;
    assert!(sent["reason"].as_str().expect("a reason").contains("ELF gate"), "{sent:#}");
    service.stop().await;
}

/// A key for tests, and what minisign wrote of [`SIGNED`] with it.
const KEY: &str = include_str!("../../../../host/service/src/plugins/signature/minisign.pub");
const SIGNATURE: &str = include_str!("../../../../host/service/src/plugins/signature/elf.minisig");
const SIGNED: &[u8] = b"\x7fELF and nothing behind it";

#[tokio::test]
async fn a_signature_is_that_of_this_file_by_the_registered_key() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let author = member(&service, "author", Role::Developer).await;
    let send = async |bytes: &[u8], signature: &str| {
        let file = Part::bytes(bytes.to_vec()).file_name("tree.so");
        let form = Form::new().text("manifest", manifest("1.0").to_string()).text("signature", signature.to_owned());
        author.post("/api/v1/plugins").multipart(form.part("file", file)).send().await.expect("an answer")
    };
    assert!(problem(send(SIGNED, SIGNATURE).await, 422).await.contains("register your minisign.pub"));
    let register = |key: &str| author.post("/api/v1/account/signing-key").json(&json!({ "public_key": key })).send();
    assert!(problem(register("RWnonsense").await.expect("an answer"), 422).await.contains("not a minisign public key"));
    let known = well(register(KEY).await.expect("an answer")).await;
    let key = KEY.lines().last().expect("a key");
    assert_eq!(known["signing_key"], key);
    assert_eq!(author.json("/api/v1/account").await["account"]["signing_key"], key);

    assert!(problem(send(b"\x7fELF and more", SIGNATURE).await, 422).await.contains("does not match this file"));
    assert!(problem(send(SIGNED, "a scribble").await, 422).await.contains("cannot be read"));
    problem(send(SIGNED, &"x".repeat(5000)).await, 413).await;
    assert_eq!(author.json("/api/v1/plugins").await, json!([]), "nothing of these is kept");
    let unsigned = well(submit(&author, &manifest("1.0"), SIGNED.to_vec()).await).await;
    assert_eq!(unsigned["signed_by"], Value::Null);
    assert!(unsigned["flags"][0].as_str().expect("a flag").contains("not signed"), "{unsigned:#}");
    // The signature may come later: the bytes are the same, and so is the plugin.
    let signed = well(send(SIGNED, SIGNATURE).await).await;
    assert_eq!((&signed["signed_by"], &signed["id"]), (&json!(key), &unsigned["id"]));
    assert!(!signed["flags"].to_string().contains("not signed"), "{signed:#}");
    let forgotten = author.client.delete(format!("{}/api/v1/account/signing-key", service.url)).send().await;
    assert_eq!(forgotten.expect("an answer").status(), StatusCode::NO_CONTENT);
    assert_eq!(author.json("/api/v1/account").await["account"]["signing_key"], Value::Null);
    service.stop().await;
}

/// A plugin that an author has sent and offered, and a curator approved; its id.
pub async fn published(author: &Guest, curator: &Guest) -> String {
    let id = offered_for_curation(author).await;
    well(decide(curator, &id, "approve", "").await).await;
    id
}

/// A plugin that an author has sent and offered; its id.
pub async fn offered_for_curation(author: &Guest) -> String {
    let bytes = std::fs::read(built().join(PLUGIN)).expect("the plugin is built");
    let sent = well(submit(author, &manifest("1.0"), bytes).await).await;
    let id = sent["id"].as_str().expect("an id").to_owned();
    let stream = author.get(&format!("/api/v1/plugins/{id}/events")).send().await.expect("an answer");
    stream.text().await.expect("the stream ends");
    well(decide(author, &id, "offer", "").await).await;
    id
}

/// Sends what is an ELF file and no plugin, another one for each number.
pub async fn garbage(guest: &Guest, number: u8) -> Response {
    submit(guest, &manifest("1.0"), [SIGNED, &[number]].concat()).await
}

/// The plugin when its check has ended, which it did not pass.
pub async fn failed(guest: &Guest, sent: &Value) -> Value {
    let path = format!("/api/v1/plugins/{}", sent["id"].as_str().expect("an id"));
    let stream = guest.get(&format!("{path}/events")).send().await.expect("an answer");
    stream.text().await.expect("the stream ends");
    let now = guest.json(&path).await;
    assert_eq!(now["state"], "failed", "{now:#}");
    now
}

#[tokio::test]
async fn a_plugin_that_cannot_be_read_is_a_problem_and_the_service_starts() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let author = member(&service, "author", Role::Developer).await;
    let curator = member(&service, "curator", Role::Curator).await;
    let id = published(&author, &curator).await;
    let plugin = author.json(&format!("/api/v1/plugins/{id}")).await;
    service.lose(plugin["sha256"].as_str().expect("a hash"));
    let service = service.restart().await;
    let guest = service.guest();
    let problems = guest.json("/api/v1/status").await["problems"].to_string();
    assert!(problems.contains("cannot be read") && !problems.contains("/tmp"), "{problems}");
    let offered = guest.json("/api/v1/algorithms").await.to_string();
    assert!(offered.contains("\"box-tree\"") && !offered.contains("\"sphere-tree\""), "{offered}");
    service.stop().await;
}
