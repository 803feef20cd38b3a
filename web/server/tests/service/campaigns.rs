//! Campaigns over HTTP: who may begin one, and what everybody sees of it.

use ocb_service::model::{NewChoices, Role};
use reqwest::{Response, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::stream::follow;
use crate::suite::small_suite;
use crate::support::{Guest, Service, header, problem, small_spec};

const PLUGINS: [&str; 2] = ["libocb_box_tree.so", "libocb_brute_force.so"];

async fn ask(by: &Guest, key: &str, body: &Value) -> Response {
    by.post("/api/v1/campaigns").header("idempotency-key", key).json(body).send().await.expect("an answer")
}

/// The campaign when nothing of it waits any more.
async fn ended(guest: &Guest, id: &str) -> Value {
    for _ in 0..600 {
        let campaign = guest.json(&format!("/api/v1/campaigns/{id}")).await;
        if campaign["ended_us"].is_i64() {
            return campaign;
        }
        tokio::time::sleep(std::time::Duration::from_millis(100)).await;
    }
    panic!("the campaign does not end within a minute");
}

#[tokio::test]
async fn a_curator_has_old_results_measured_again_and_everybody_sees_both() {
    let folder = tempfile::tempdir().expect("a folder");
    let service = Service::start_on(&PLUGINS, &small_suite(folder.path(), 4)).await;
    for run in service.engine.measure_suite(&[]).await.expect("queued") {
        follow(&service.guest(), &run.id, 0).await;
    }
    let user = member(&service, "ada", Role::User).await;
    let run = user.start(&small_spec()).await;
    let public = user.client.put(format!("{}/api/v1/runs/{run}/visibility", service.url));
    assert_eq!(
        public.json(&json!({ "visibility": "public" })).send().await.expect("an answer").status(),
        StatusCode::OK
    );
    follow(&user, &run, 0).await;
    let all = service.engine.accounts(&ocb_service::model::Page::default()).await.expect("accounts").entries;
    let agrees = NewChoices { agrees_to_reruns: Some(true), ..NewChoices::default() };
    service.engine.choose(&all[0], &agrees).await.expect("chosen");
    let service = service.restart_noted("turbo off").await;

    let guest = service.guest();
    let curator = member(&service, "curator", Role::Curator).await;
    let preview = curator.json("/api/v1/campaigns/preview").await;
    assert_eq!(
        (&preview["suite_runs"], &preview["suite_repeats"], &preview["peoples_runs"]),
        (&json!(2), &json!(2), &json!(1))
    );
    assert_eq!(curator.json("/api/v1/campaigns/preview?suite=false").await["suite_runs"], 0);
    let asked = json!({ "reason": "Turbo is off now." });
    problem(ask(&guest, "k", &asked).await, 401).await;
    problem(ask(&member(&service, "eve", Role::Developer).await, "k", &asked).await, 403).await;
    assert!(problem(ask(&curator, "a", &json!({ "reason": "" })).await, 422).await.contains("say why"));
    problem(ask(&curator, "b", &json!({ "reason": "x", "suite": false, "people": false })).await, 422).await;
    assert_eq!(guest.json("/api/v1/campaigns").await, json!([]), "nothing of these is kept");

    let made = ask(&curator, "k", &asked).await;
    assert_eq!(made.status(), StatusCode::CREATED);
    let location = header(&made, "location");
    let made: Value = made.json().await.expect("JSON");
    let id = made["id"].as_str().expect("an id").to_owned();
    assert_eq!(location, format!("/api/v1/campaigns/{id}"));
    let again = ask(&curator, "k", &asked).await;
    assert_eq!(again.status(), StatusCode::OK);
    assert_eq!(again.json::<Value>().await.expect("JSON")["id"], id);
    problem(ask(&curator, "k", &json!({ "reason": "Another." })).await, 422).await;

    let campaign = ended(&guest, &id).await;
    assert_eq!((&campaign["state"], &campaign["runs"]["done"]), (&json!("done"), &json!(3)));
    assert_eq!(campaign["created_by"], "curator");
    let results = campaign["results"].as_array().expect("results");
    assert_eq!(results.len(), 5);
    for row in results {
        let new = guest.json(&format!("/api/v1/runs/{}", row["new"]["run"].as_str().expect("an id"))).await;
        assert_eq!((&new["campaign"], &new["rerun_of"]), (&json!(id), &row["old"]["run"]));
        assert!(row["old"]["hardware_class"] != row["new"]["hardware_class"], "{row:#}");
        assert_eq!((&row["old"]["oracle"], &row["same_file"]), (&row["new"]["oracle"], &json!(true)));
    }
    let listed = guest.json("/api/v1/campaigns").await;
    assert_eq!(
        (&listed[0]["id"], &listed[0]["results"], listed.as_array().map(Vec::len)),
        (&json!(id), &json!([]), Some(1))
    );
    assert!(problem(ask(&curator, "c", &asked).await, 409).await.contains("nothing to measure again"));

    // What its owner keeps to themselves from now on is not there for others.
    let mine = user_again(&service, "ada").await;
    let hidden = mine.client.put(format!("{}/api/v1/runs/{run}/visibility", service.url));
    hidden.json(&json!({ "visibility": "private" })).send().await.expect("an answer");
    let olds = |campaign: &Value| {
        campaign["results"].as_array().expect("rows").iter().filter(|row| row["old"].is_object()).count()
    };
    let (theirs, own) = (ended(&guest, &id).await, ended(&mine, &id).await);
    assert_eq!((olds(&theirs), olds(&own)), (4, 5));
    let rows = |campaign: &Value| campaign["results"].as_array().map(Vec::len);
    assert_eq!((rows(&theirs), rows(&own)), (Some(5), Some(5)));
    let repeated =
        own["results"].as_array().expect("rows").iter().find(|row| row["old"]["run"] == run).expect("its row");
    let again = repeated["run"].as_str().expect("an id");
    let hidden = mine.client.put(format!("{}/api/v1/runs/{again}/visibility", service.url));
    hidden.json(&json!({ "visibility": "private" })).send().await.expect("an answer");
    let (theirs, own) = (ended(&guest, &id).await, ended(&mine, &id).await);
    assert_eq!((rows(&theirs), rows(&own)), (Some(4), Some(5)));
    assert!(!theirs.to_string().contains(again) && !theirs.to_string().contains(&run), "nothing names them");

    let cancelled = curator.post(&format!("/api/v1/campaigns/{id}/cancel")).send().await.expect("an answer");
    assert_eq!(cancelled.json::<Value>().await.expect("JSON")["state"], "done", "one that has ended stays as it is");
    problem(curator.post("/api/v1/campaigns/x/cancel").send().await.expect("an answer"), 404).await;
    problem(guest.get("/api/v1/campaigns/x").send().await.expect("an answer"), 404).await;
    problem(mine.post(&format!("/api/v1/campaigns/{id}/cancel")).send().await.expect("an answer"), 403).await;
    service.stop().await;
}

/// A browser that enters an account that there is.
async fn user_again(service: &Service, name: &str) -> Guest {
    let guest = service.guest();
    let body = json!({ "name": name, "password": crate::people::PASSWORD });
    let entered = guest.post("/api/v1/account/login").json(&body).send().await.expect("an answer");
    assert_eq!(entered.status(), StatusCode::OK);
    guest
}
