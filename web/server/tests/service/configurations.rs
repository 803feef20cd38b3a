//! Saved configurations: of a file and of a run, measured on again, and gone when nothing needs them.

use reqwest::{Method, StatusCode};
use serde_json::{Value, json};

use crate::stream::follow;
use crate::support::{Guest, Service, problem, small_spec};

/// A CSV file in which B stands so far beside A.
pub fn shifts(x: &[f64]) -> String {
    x.iter().map(|x| format!("1,0,0,{x},0,1,0,0,0,0,1,0\n")).collect()
}

async fn saved(by: &Guest, name: &str, file: impl Into<Vec<u8>>) -> Value {
    let answer = by.send_file("/api/v1/configurations", name, file).await;
    assert_eq!(answer.status(), StatusCode::CREATED);
    answer.json().await.expect("JSON")
}

async fn measured(by: &Guest, saved: &Value) -> Value {
    let mut spec = small_spec();
    spec["method"] = json!({ "kind": "file", "sha256": saved["sha256"] });
    let run = by.start(&spec).await;
    follow(by, &run, 0).await;
    by.json(&format!("/api/v1/runs/{run}")).await
}

#[tokio::test]
async fn saved_configurations_are_measured_on_again_and_go_with_their_last_use() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (guest, other) = (service.guest(), service.guest());
    let own = saved(&guest, "folder/shelf.csv", shifts(&[0.0, 0.5, 9.0])).await;
    assert_eq!((&own["name"], &own["configurations"]), (&json!("shelf.csv"), &json!(3)));
    assert_eq!(saved(&guest, "again.csv", shifts(&[0.0, 0.5, 9.0])).await, own, "the same file is one");
    let list = guest.json("/api/v1/configurations").await;
    assert_eq!((list, other.json("/api/v1/configurations").await), (json!([own]), json!([])));

    let first = measured(&guest, &own).await;
    assert_eq!((&first["state"], &first["set"]["configurations"]), (&json!("done"), &json!(3)), "{first:#}");
    // Those of a run are its set; the run on them asks the same, and the truth of each is what it was.
    let path = format!("/api/v1/runs/{}/save-configurations", first["id"].as_str().expect("an id"));
    let of_run: Value = guest.post(&path).send().await.expect("an answer").json().await.expect("JSON");
    assert_eq!((&of_run["configurations"], &of_run["name"]), (&json!(3), &json!("torus-knot x torus-knot")));
    assert_eq!(of_run["sha256"], first["set"]["sha256"]);
    let second = measured(&guest, &of_run).await;
    assert_eq!(second["set"]["classes"], first["set"]["classes"]);

    // A file that a run names stays when its row goes, and goes with the run.
    let delete = async |path: &str| {
        let answer = guest.request(Method::DELETE, path).send().await.expect("an answer");
        assert_eq!(answer.status(), StatusCode::OK, "{path}");
        answer.json::<Value>().await.expect("JSON")
    };
    let id = own["id"].as_str().expect("an id");
    let (file, _) = guest.bytes(&format!("/api/v1/configurations/{id}/file")).await;
    assert_eq!(file, shifts(&[0.0, 0.5, 9.0]).into_bytes());
    let gone = delete(&format!("/api/v1/configurations/{id}")).await;
    assert_eq!((&gone["configurations"][0]["name"], &gone["bytes"]), (&json!("shelf.csv"), &json!(0)));
    problem(guest.get(&format!("/api/v1/configurations/{id}/file")).send().await.expect("an answer"), 404).await;
    assert_eq!(measured(&guest, &own).await["state"], "done", "the first run still names the file");
    let all = delete("/api/v1/data").await;
    assert_eq!(
        (all["runs"].as_array().map(Vec::len), all["configurations"].as_array().map(Vec::len)),
        (Some(3), Some(1))
    );
    assert_eq!(service.blobs(), 0);
    service.stop().await;
}

#[tokio::test]
async fn what_is_no_such_file_is_refused_with_its_row() {
    let service = Service::start_limited(ocb_service::Ceilings::default()).await;
    let guest = service.guest();
    let parquet = b"PAR1 whatever comes behind".to_vec();
    for (file, says) in [
        (b"1,0,0,0,0,1,0,0,0,0,1,0\n1,2,3\n".to_vec(), "line 2"),
        (b"2,0,0,0,0,1,0,0,0,0,1,0\n".to_vec(), "must be a rotation"),
        (parquet, "send JSON, CSV or raw f64 matrices"),
        (Vec::new(), "Not a configuration file"),
    ] {
        let told = problem(guest.send_file("/api/v1/configurations", "x.csv", file).await, 422).await;
        assert!(
            told.contains(says) && told.starts_with("\"x.csv\" cannot be used: "),
            "{told:?} does not say {says:?}"
        );
    }
    problem(guest.send_file("/api/v1/configurations", "x.csv", vec![b'1'; (64 << 20) + 1]).await, 413).await;
    assert_eq!(service.blobs(), 0);
    service.stop().await;
}
