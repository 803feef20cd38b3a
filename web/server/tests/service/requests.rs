//! What is asked for again under the same key is there once; and nobody asks for everything.

use ocb_service::model::Role;
use reqwest::{Method, RequestBuilder, Response, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::publishing::manifest;
use crate::support::{Guest, Service, problem, small_spec};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn file(request: RequestBuilder, name: &str, bytes: impl Into<Vec<u8>>, said: Option<&Value>) -> RequestBuilder {
    let part = reqwest::multipart::Part::bytes(bytes.into()).file_name(name.to_owned());
    let form = said.iter().fold(reqwest::multipart::Form::new(), |form, said| form.text("manifest", said.to_string()));
    request.multipart(form.part("file", part))
}

async fn under(key: &str, request: RequestBuilder) -> Response {
    request.header("idempotency-key", key).send().await.expect("an answer")
}

async fn made(response: Response, status: StatusCode) -> Value {
    assert_eq!(response.status(), status);
    response.json().await.expect("JSON")
}

#[tokio::test]
async fn what_is_made_under_a_key_is_made_once() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let (maker, other) = (member(&service, "maker", Role::Curator).await, service.guest());
    let question = |tolerance: f64| json!({ "object_a": "stock:torus-knot@2000", "question": { "kind": "distance", "tolerance": tolerance } });
    let advice = |by: &Guest, tolerance| by.post("/api/v1/advice").json(&question(tolerance));
    let first = made(under("k", advice(&maker, 0.05)).await, StatusCode::CREATED).await;
    let again = futures::future::join_all((0..4).map(|_| under("k", advice(&maker, 0.05)))).await;
    for again in again {
        assert_eq!(made(again, StatusCode::OK).await["id"], first["id"]);
    }
    assert!(problem(under("k", advice(&maker, 0.06)).await, 422).await.contains("another request"));
    // Keys are their owner's, and of one kind of thing.
    assert_ne!(made(under("k", advice(&other, 0.06)).await, StatusCode::CREATED).await["id"], first["id"]);

    let object = |text: &'static str| file(maker.post("/api/v1/objects"), "own.obj", text, None);
    let first = made(under("k", object(TRIANGLE)).await, StatusCode::CREATED).await;
    assert_eq!(made(under("k", object(TRIANGLE)).await, StatusCode::CREATED).await["id"], first["id"]);
    problem(under("k", object("v 0 0 2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).await, 422).await;

    let plugin =
        |version: &str| file(maker.post("/api/v1/plugins"), "x.so", *b"\x7fELF nothing", Some(&manifest(version)));
    let first = made(under("k", plugin("1")).await, StatusCode::CREATED).await;
    assert_eq!(made(under("k", plugin("1")).await, StatusCode::OK).await["id"], first["id"]);
    problem(under("k", plugin("2")).await, 422).await;

    // A lost secret is replaced; there is one token, and one invitation.
    let token = |name: &str| maker.post("/api/v1/account/tokens").json(&json!({ "name": name, "scopes": ["runs"] }));
    let first = made(under("k", token("t")).await, StatusCode::CREATED).await;
    let second = made(under("k", token("t")).await, StatusCode::CREATED).await;
    assert_eq!(first["token"]["id"], second["token"]["id"]);
    assert_eq!(maker.json("/api/v1/account/tokens").await.as_array().map(Vec::len), Some(1));
    let program = service.guest();
    let with =
        |made: &Value| program.get("/api/v1/data").bearer_auth(made["secret"].as_str().expect("a secret")).send();
    problem(with(&first).await.expect("an answer"), 401).await;
    assert_eq!(with(&second).await.expect("an answer").status(), StatusCode::OK);
    problem(under("k", token("u")).await, 422).await;
    let invitation = || maker.post("/api/v1/invitations").json(&json!({ "recipient": "Ada" }));
    let first = made(under("k", invitation()).await, StatusCode::CREATED).await;
    let second = made(under("k", invitation()).await, StatusCode::CREATED).await;
    assert!(first["invitation"]["id"] == second["invitation"]["id"] && first["secret"] != second["secret"]);
    let listed = maker.json("/api/v1/invitations").await;
    assert_eq!(listed.as_array().map(Vec::len), Some(1));
    let ada = member(&service, "ada", Role::User).await;
    let accept =
        |made: &Value| ada.post("/api/v1/account/invitation").json(&json!({ "secret": made["secret"] })).send();
    problem(accept(&first).await.expect("an answer"), 404).await;
    assert_eq!(accept(&second).await.expect("an answer").status(), StatusCode::OK);
    problem(under("k", invitation()).await, 409).await;
    service.stop().await;
}

#[tokio::test]
async fn a_guest_does_not_fill_the_queue() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (guest, other) = (service.guest(), service.guest());
    let mut long = small_spec();
    (long["method"]["sampling"]["count"], long["passes"]) = (20_000.into(), 5.into());
    let first = guest.start(&long).await;
    while guest.json(&format!("/api/v1/runs/{first}")).await["state"] == "queued" {
        tokio::time::sleep(std::time::Duration::from_millis(10)).await;
    }
    let ask = |by: &Guest| by.post("/api/v1/runs").json(&small_spec());
    let waiting = under("night", ask(&guest)).await;
    let waiting = made(waiting, StatusCode::CREATED).await;
    for _ in 1..20 {
        guest.start(&small_spec()).await;
    }
    assert!(problem(ask(&guest).send().await.expect("an answer"), 429).await.contains("20 runs of yours are queued"));
    // What was asked for is found again, and others have room.
    assert_eq!(made(under("night", ask(&guest)).await, StatusCode::OK).await["id"], waiting["id"]);
    other.start(&small_spec()).await;
    let gone = guest.request(Method::DELETE, "/api/v1/data").send().await.expect("an answer");
    assert_eq!(gone.status(), StatusCode::OK);
    guest.start(&small_spec()).await;
    service.stop().await;
}
