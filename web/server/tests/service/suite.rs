//! The public benchmark: a plugin that becomes public is measured on the suite, and the board compares what is valid.

use std::collections::HashSet;
use std::path::Path;

use ocb_service::model::Role;
use reqwest::StatusCode;
use serde_json::{Value, json};

use crate::people::member;
use crate::publishing::published;
use crate::support::{Guest, Service};

/// The file of a suite of one scene at two distances, asked one question.
pub fn small_suite(folder: &Path, version: u32) -> std::path::PathBuf {
    let document = json!({
        "version": version, "scenes": [["stock:torus-knot@600", "stock:torus-knot@600"]],
        "separations": [{ "kind": "relative", "distance": 0.1 }, { "kind": "step", "of_size": -0.01 }],
        "queries": ["collision_first"], "configurations": 40, "passes": 1, "budget_seconds": 1.0,
    });
    let file = folder.join(format!("suite-{version}.json"));
    std::fs::write(&file, document.to_string()).expect("a file");
    file
}

/// The suite when nothing of it waits any more.
pub async fn measured(guest: &Guest) -> Value {
    for _ in 0..600 {
        let suite = guest.json("/api/v1/suite").await;
        let progress = suite["progress"].as_array().expect("progress");
        if progress.iter().all(|one| one["waiting"] == 0) {
            return suite;
        }
        tokio::time::sleep(std::time::Duration::from_millis(100)).await;
    }
    panic!("the suite is not measured within a minute");
}

fn of<'a>(suite: &'a Value, algorithm: &str) -> &'a Value {
    let all = suite["progress"].as_array().expect("progress");
    all.iter().find(|one| one["algorithm"] == algorithm).unwrap_or_else(|| panic!("{algorithm} in {suite:#}"))
}

#[tokio::test]
async fn what_becomes_public_is_measured_on_the_suite_and_leaves_the_board_when_it_is_withdrawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let plugins = ["libocb_box_tree.so", "libocb_brute_force.so"];
    let service = Service::start_on(&plugins, &small_suite(folder.path(), 3)).await;
    let guest = service.guest();
    let suite = guest.json("/api/v1/suite").await;
    assert_eq!((&suite["version"], &suite["scenarios"]), (&json!(3), &json!(2)));
    assert_eq!(
        of(&suite, "box-tree"),
        &json!({ "algorithm": "box-tree", "name": "BoxTree", "measured": 0, "waiting": 0, "failed": 0, "of": 2 })
    );

    let author = member(&service, "author", Role::Developer).await;
    let curator = member(&service, "curator", Role::Curator).await;
    let id = published(&author, &curator).await;
    let suite = measured(&guest).await;
    assert_eq!(of(&suite, "sphere-tree")["measured"], 2);
    assert_eq!(of(&suite, "box-tree")["measured"], 0, "ours are measured when somebody asks for it");
    let queued = service.engine.measure_suite(&["box-tree".to_owned()]).await.expect("queued");
    assert_eq!(queued.len(), 2);
    assert_eq!(service.engine.measure_suite(&[]).await.expect("queued").len(), 2, "only what is missing");
    let suite = measured(&guest).await;
    assert!(["box-tree", "brute-force", "sphere-tree"].iter().all(|a| of(&suite, a)["measured"] == 2), "{suite:#}");
    assert!(service.engine.measure_suite(&[]).await.expect("nothing").is_empty());
    let refused = service.engine.measure_suite(&["nonsense".to_owned()]).await.expect_err("it is none").to_string();
    assert!(refused.contains("\"nonsense\""), "{refused}");

    // The board is of the suite unless somebody asks for something else, and says which one and how old.
    let board = guest.json("/api/v1/board").await;
    assert_eq!((&board["suite"]["version"], &board["suite"]["scenarios"]), (&json!(3), &json!(2)));
    assert_eq!(board["suite"]["sha256"], suite["sha256"]);
    assert!(board["suite"]["oldest_us"].as_i64() <= board["suite"]["newest_us"].as_i64());
    let rows = board["rows"].as_array().expect("rows");
    assert!(rows.len() == 3 && rows.iter().all(|row| row["scenarios"] == 2 && row["wrong"] == 0), "{board:#}");
    // No two runs ask at the same configurations, so that there are no answers to bring along.
    let mut drawn = HashSet::new();
    for run in rows.iter().flat_map(|row| row["runs"].as_array().expect("runs")) {
        let run = guest.json(&format!("/api/v1/runs/{}", run.as_str().expect("an id"))).await;
        drawn.insert((run["spec"]["method"]["seed"].to_string(), run["set"]["sha256"].to_string()));
    }
    assert_eq!(drawn.len(), 6, "{drawn:?}");
    let runs = rows[0]["runs"].as_array().expect("runs");
    let run = guest.json(&format!("/api/v1/runs/{}", runs[0].as_str().expect("an id"))).await;
    assert_eq!((&run["mine"], &run["visibility"], &run["state"]), (&json!(false), &json!("public"), &json!("done")));
    let none = guest.json("/api/v1/board?suite=none").await;
    assert_eq!((&none["suite"], none["rows"].as_array().map(Vec::len)), (&Value::Null, Some(0)));

    let step = json!({ "action": "withdraw", "reason": "A better one is on its way." });
    let gone = author.post(&format!("/api/v1/plugins/{id}/decisions")).json(&step).send().await.expect("an answer");
    assert_eq!(gone.status(), StatusCode::OK);
    let board = guest.json("/api/v1/board").await;
    let rows = board["rows"].as_array().expect("rows");
    let own = rows.iter().find(|row| row["algorithm"] == "sphere-tree").expect("its results stay");
    assert_eq!(own["reason"], "Its author has withdrawn this plugin: A better one is on its way.");
    assert_eq!(own["rank"], Value::Null);
    service.stop().await;
}
