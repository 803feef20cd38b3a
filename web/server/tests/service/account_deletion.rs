//! Deleting an account: what goes, what stays and says no name, and who cannot.

use ocb_service::model::Role;
use reqwest::{Method, Response, StatusCode};
use serde_json::{Value, json};

use crate::people::{PASSWORD, member};
use crate::privacy::{Made, uploaded};
use crate::publishing::{decide, published, well};
use crate::stream::follow;
use crate::support::{Guest, Service, header, problem, small_spec};

async fn leave(guest: &Guest, password: &str) -> Response {
    let request = guest.request(Method::DELETE, "/api/v1/account").json(&json!({ "password": password }));
    request.send().await.expect("an answer")
}

async fn publish(by: &Guest, path: &str) {
    let asked = by.request(Method::PUT, &format!("{path}/visibility")).json(&json!({ "visibility": "public" }));
    assert_eq!(asked.send().await.expect("an answer").status(), StatusCode::OK, "{path}");
}

/// Of each kind so many; saved configurations and stability runs as many as pieces of advice.
fn counts(runs: u32, objects: u32, advice: u32, plugins: u32) -> Value {
    json!({
        "runs": runs, "objects": objects, "configurations": advice, "advice": advice, "stability": advice,
        "workloads": advice, "plugins": plugins,
    })
}

#[tokio::test]
async fn what_is_public_outlives_its_account_and_the_rest_is_gone() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let made = Made::by(member(&service, "Ada@example.org", Role::Developer).await).await;
    let (owner, curator, stranger) = (&made.owner, member(&service, "curator", Role::Curator).await, service.guest());
    let [run, object, advice, garbage] = ["runs", "objects", "advice", "plugins"].map(|kind| made.id(kind).to_owned());
    let plugin = published(owner, &curator).await;
    let shown = owner.start(&small_spec()).await;
    follow(owner, &shown, 0).await;
    publish(owner, &format!("/api/v1/runs/{shown}")).await;
    let token = json!({ "name": "script", "scopes": ["runs"] });
    let token = well(owner.post("/api/v1/account/tokens").json(&token).send().await.expect("an answer")).await;
    let elsewhere = service.guest();
    let body = json!({ "name": "ada@example.org", "password": PASSWORD });
    well(elsewhere.post("/api/v1/account/login").json(&body).send().await.expect("an answer")).await;
    // It would run for a while yet, and shall not.
    let mut long = small_spec();
    (long["method"]["sampling"]["count"], long["passes"]) = (4_000.into(), 5.into());
    let under_way = owner.start(&long).await;

    let before = owner.json("/api/v1/account/deletion-preview").await;
    assert_eq!((&before["goes"], &before["stays"]), (&counts(2, 1, 1, 1), &counts(1, 0, 0, 1)));
    assert!(before["bytes"].as_u64() > Some(0) && before["blocked_by"].is_null(), "{before:#}");
    problem(leave(&stranger, PASSWORD).await, 401).await;
    problem(leave(owner, "some other password").await, 403).await;
    let nothing = owner.request(Method::DELETE, "/api/v1/account").json(&json!({})).send().await.expect("an answer");
    problem(nothing, 422).await;
    let foreign = owner.request(Method::DELETE, "/api/v1/account").header("origin", "https://evil.example");
    problem(foreign.json(&json!({ "password": PASSWORD })).send().await.expect("an answer"), 403).await;
    assert_eq!(owner.json("/api/v1/account/deletion-preview").await["goes"]["runs"], 2, "nothing has happened yet");

    let long = owner.json(&format!("/api/v1/runs/{under_way}")).await;
    assert!(long["state"] == "queued" || long["state"] == "running", "it has ended before its account: {long}");
    let blobs = service.blobs();
    let gone = leave(owner, PASSWORD).await;
    assert!(header(&gone, "set-cookie").starts_with("ocb_session=;"), "{:?}", gone.headers());
    let gone = well(gone).await;
    assert_eq!((&gone["goes"], &gone["stays"]), (&before["goes"], &before["stays"]));
    assert!(service.blobs() < blobs);

    // Neither session nor token nor password opens anything; the name is given to nobody.
    for session in [owner, &elsewhere] {
        assert_eq!(session.json("/api/v1/account").await["account"], Value::Null);
    }
    problem(leave(owner, PASSWORD).await, 401).await;
    let secret = token["secret"].as_str().expect("a secret");
    problem(stranger.get("/api/v1/runs").bearer_auth(secret).send().await.expect("an answer"), 401).await;
    problem(elsewhere.post("/api/v1/account/login").json(&body).send().await.expect("an answer"), 403).await;
    problem(stranger.post("/api/v1/account").json(&body).send().await.expect("an answer"), 409).await;

    // What was not public is there for nobody.
    for path in [
        format!("/api/v1/runs/{run}"),
        format!("/api/v1/runs/{under_way}"),
        format!("/api/v1/objects/{object}"),
        format!("/api/v1/advice/{advice}"),
        format!("/api/v1/stability-runs/{}", made.id("stability-runs")),
        format!("/api/v1/workloads/{}", made.id("workloads")),
        format!("/api/v1/plugins/{garbage}"),
    ] {
        for asking in [owner, &curator] {
            problem(asking.get(&path).send().await.expect("an answer"), 404).await;
        }
    }
    // What was public is as it was, and says no name.
    let kept = stranger.json(&format!("/api/v1/runs/{shown}")).await;
    assert_eq!((&kept["state"], &kept["visibility"], &kept["mine"]), (&json!("done"), &json!("public"), &json!(false)));
    stranger.bytes(&format!("/api/v1/runs/{shown}/records.parquet?algorithm=box-tree")).await;
    let kept = stranger.json(&format!("/api/v1/plugins/{plugin}")).await;
    assert_eq!((&kept["state"], &kept["owner"]), (&json!("public"), &json!("a former account")));
    assert!(kept["history"].as_array().is_some_and(|all| all.len() == 4 && all[0]["actor"] == "a former account"));
    assert!(!kept.to_string().to_lowercase().contains("ada@"), "{kept:#}");
    well(stranger.get(&format!("/api/v1/plugins/{plugin}/citation")).send().await.expect("an answer")).await;
    assert!(!curator.json("/api/v1/accounts").await.to_string().contains("Ada"));
    // Curators go on deciding about it, and nobody has to be told.
    well(decide(&curator, &plugin, "suspend", "It crashes.").await).await;
    well(decide(&curator, &plugin, "reinstate", "It does not.").await).await;
    let spec = json!({
        "object_a": "stock:torus-knot@600", "query": "proximity", "algorithms": ["sphere-tree"], "passes": 1,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 20 } },
    });
    let again = stranger.start(&spec).await;
    assert!(follow(&stranger, &again, 0).await.last().is_some_and(|event| event.data["state"] == "done"));
    assert_eq!(service.engine.broken_audit().await.expect("a log"), None);
    let service = service.restart().await;
    assert_eq!(service.guest().json(&format!("/api/v1/runs/{shown}")).await["state"], "done");
    service.stop().await;
}

#[tokio::test]
async fn the_last_who_decides_cannot_leave_and_is_told_how_to() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let administrator = member(&service, "admin", Role::Administrator).await;
    let curator = member(&service, "curator", Role::Curator).await;
    // Nothing of theirs has gone when they are refused.
    let object = uploaded(&administrator).await;
    let blocked_by = administrator.json("/api/v1/account/deletion-preview").await["blocked_by"].clone();
    let told = problem(leave(&administrator, PASSWORD).await, 409).await;
    assert!(told.starts_with("This is the last administrator,") && told.contains("ocb admin create"), "{told}");
    assert_eq!(blocked_by, told);
    administrator.json(&format!("/api/v1/objects/{object}")).await;
    assert_eq!(curator.json("/api/v1/account/deletion-preview").await["blocked_by"], Value::Null);
    well(leave(&curator, PASSWORD).await).await;
    let next = member(&service, "next", Role::Administrator).await;
    well(leave(&administrator, PASSWORD).await).await;
    problem(leave(&next, PASSWORD).await, 409).await;
    service.stop().await;
}

#[tokio::test]
async fn what_was_being_made_while_its_account_was_deleted_is_swept() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let leaving = member(&service, "ada", Role::User).await;
    let account = leaving.json("/api/v1/account").await["account"]["id"].as_str().expect("an id").to_owned();
    let kept = uploaded(&member(&service, "bob", Role::User).await).await;
    well(leave(&leaving, PASSWORD).await).await;
    let mesh = ocb_core::mesh::obj::write(&ocb_core::stock::generate("torus-knot", 600).expect("a mesh"));
    let owner = format!("account:{account}");
    let late = service.engine.add_object("late", mesh.into(), Some(&owner)).await.expect("an object");
    assert_eq!(service.engine.sweep_once(0).await.expect("it sweeps"), 1);
    let stranger = service.guest();
    problem(stranger.get(&format!("/api/v1/objects/{}", late.id)).send().await.expect("an answer"), 404).await;
    stranger.json(&format!("/api/v1/objects/{kept}")).await;
    assert_eq!(service.engine.sweep_once(0).await.expect("it sweeps"), 0);
    service.stop().await;
}
