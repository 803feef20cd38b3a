//! Runs and their results.

use reqwest::StatusCode;
use serde_json::Value;

use crate::stream::follow;
use crate::support::{Guest, Service, header, problem, small_comparison, small_spec};

#[tokio::test]
async fn a_run_ends_with_every_result() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (guest, other) = (service.guest(), service.guest());

    let estimate = guest.post("/api/v1/estimates").json(&small_comparison()).send().await.expect("an answer");
    let estimate: Value = estimate.json().await.expect("JSON");
    assert_eq!(estimate["configurations"], 60);

    let id = guest.start(&small_comparison()).await;
    follow(&guest, &id, 0).await;
    let path = format!("/api/v1/runs/{id}");
    let run = guest.json(&path).await;
    assert_eq!(run["state"], "done", "{run:#}");
    assert_eq!(run["mine"], true);
    let results = run["results"].as_array().expect("results");
    assert_eq!(results.len(), 2);
    for result in results {
        assert_eq!(result["outcome"]["name"], "Completed", "{result:#}");
        assert_eq!(result["wrong"], 0, "{result:#}");
    }

    check_numbers(&guest, &path, run["set"]["configurations"].as_u64().expect("a set")).await;
    check_files(&guest, &path).await;
    check_others(&guest, &other, &id).await;
    service.stop().await;
}

#[tokio::test]
async fn a_request_that_is_sent_again_makes_no_second_run() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (guest, other) = (service.guest(), service.guest());
    let ask = |by: &Guest, key: &str, passes: u32| {
        let mut spec = small_spec();
        spec["passes"] = passes.into();
        by.post("/api/v1/runs").header("idempotency-key", key).json(&spec).send()
    };
    let first = ask(&guest, "night 7", 1).await.expect("an answer");
    assert_eq!(first.status(), StatusCode::CREATED);
    let place = header(&first, "location");
    // Also while the first is on its way, and many at once.
    let again = futures::future::join_all((0..4).map(|_| ask(&guest, "night 7", 1))).await;
    for answer in again {
        let answer = answer.expect("an answer");
        assert_eq!((answer.status(), header(&answer, "location")), (StatusCode::OK, place.clone()));
    }
    assert!(problem(ask(&guest, "night 7", 2).await.expect("an answer"), 422).await.contains("night 7"));
    problem(ask(&guest, "", 1).await.expect("an answer"), 400).await;
    problem(ask(&guest, &"k".repeat(201), 1).await.expect("an answer"), 400).await;
    assert_eq!(guest.json("/api/v1/runs").await.as_array().map(Vec::len), Some(1));
    // The keys of others are theirs.
    assert_eq!(ask(&other, "night 7", 2).await.expect("an answer").status(), StatusCode::CREATED);
    service.stop().await;
}

const MAP: &str = "algorithm=box-tree&measure=time&statistic=median&outliers=per_vertex";

async fn check_numbers(guest: &Guest, path: &str, configurations: u64) {
    let heatmap = guest.json(&format!("{path}/heatmap?{MAP}")).await;
    assert_eq!(heatmap["unit"], "ns");
    let by_default = MAP.trim_end_matches("&outliers=per_vertex");
    assert_eq!(guest.json(&format!("{path}/heatmap?{by_default}")).await, heatmap);
    let values = heatmap["values"].as_array().expect("values");
    let coloured = values.iter().position(Value::is_number).expect("a vertex with a value");
    let vertex = guest.json(&format!("{path}/vertices/{coloured}?{MAP}")).await;
    assert_eq!(vertex["value"], values[coloured]);
    assert_eq!(vertex["count"], heatmap["counts"][coloured]);
    let beyond = guest.get(&format!("{path}/vertices/{}?{MAP}", values.len())).send().await.expect("an answer");
    assert!(problem(beyond, 404).await.contains(&values.len().to_string()));

    let density = "algorithm=box-tree&side=b&measure=density&statistic=mean&outliers=keep";
    let density = guest.json(&format!("{path}/heatmap?{density}")).await;
    assert_eq!(density["unit"], "configurations");

    let ecdf = guest.json(&format!("{path}/ecdf?algorithm=box-tree")).await;
    assert_eq!(ecdf["n"], configurations);
    let none = guest.json(&format!("{path}/ecdf?algorithm=box-tree&where=wrong")).await;
    assert_eq!(none["n"], 0);
    let chosen = guest.json(&format!("{path}/chart?kind=ecdf&where=!wrong%20of%20box-tree")).await;
    assert!(chosen["notes"].as_array().expect("notes").iter().any(|n| n.to_string().contains("!wrong of box-tree")));
    let bad = guest.get(&format!("{path}/chart?kind=ecdf&where=tame")).send().await.expect("an answer");
    assert!(problem(bad, 422).await.contains("at character 1"));
    let response = guest.get(&format!("{path}/ecdf?algorithm=parry")).send().await.expect("an answer");
    problem(response, 404).await;

    let all = guest.json(&format!("{path}/selection?algorithm=box-tree&where=near(vertex%200,%202)")).await;
    assert_eq!((&all["n"], &all["where"]), (&configurations.into(), &"near(vertex 0, 2)".into()), "{all:#}");
    let worst = guest.json(&format!("{path}/worst?algorithm=box-tree&limit=3&where=!wrong")).await;
    let worst = worst.as_array().expect("a list");
    assert_eq!(worst.len(), 3);
    assert!(worst[0]["time_ns"].as_f64() >= worst[1]["time_ns"].as_f64() && worst[0]["pose_b"].as_array().is_some());
    let meeting = guest.json(&format!("{path}/configurations/{}/contacts", worst[0]["configuration"])).await;
    assert_eq!(meeting["total"].as_u64().expect("a count") as usize, meeting["pairs"].as_array().expect("pairs").len());
    for route in ["selection", "selection.arrow"] {
        let bad = guest.get(&format!("{path}/{route}?algorithm=box-tree&where=tame")).send().await.expect("an answer");
        assert!(problem(bad, 422).await.contains("at character 1"));
    }

    let (csv, media_type) = guest.bytes(&format!("{path}/records.csv?algorithm=box-tree")).await;
    assert_eq!(media_type, "text/csv; charset=utf-8");
    let lines = String::from_utf8(csv).expect("text").lines().count() as u64;
    assert_eq!(lines, configurations + 1);

    let tests = "algorithm=box-tree&measure=triangle_tests&statistic=mean";
    let tests = guest.json(&format!("{path}/heatmap?{tests}")).await;
    assert_eq!((&tests["unit"], &tests["n"]), (&"tests per query".into(), &configurations.into()));
    let (parquet, media_type) = guest.bytes(&format!("{path}/triangles.parquet?algorithm=box-tree")).await;
    assert!(parquet.starts_with(b"PAR1") && media_type == "application/vnd.apache.parquet");
}

async fn check_files(guest: &Guest, path: &str) {
    for (file, magic) in [
        ("records.parquet?algorithm=brute-force".to_owned(), &b"PAR1"[..]),
        ("configurations.parquet".to_owned(), b"PAR1"),
        (format!("heatmap.glb?{MAP}"), b"glTF"),
        (format!("heatmap.glb?{MAP}&colormap=viridis&scale=log"), b"glTF"),
        (format!("heatmap.ply?{MAP}"), b"ply\n"),
        (format!("heatmap.glb?{MAP}&against=brute-force"), b"glTF"),
        ("records.parquet?algorithm=brute-force&where=!wrong".to_owned(), b"PAR1"),
        // A stream of Arrow begins with its sign for "a message follows".
        ("columns.arrow?algorithm=brute-force".to_owned(), &[255; 4]),
        ("selection.arrow?algorithm=brute-force&where=!wrong".to_owned(), &[255; 4]),
        ("witnesses.arrow".to_owned(), &[255; 4]),
    ] {
        let response = guest.get(&format!("{path}/{file}")).send().await.expect("an answer");
        assert_eq!(response.status(), StatusCode::OK, "{file}");
        assert!(header(&response, "content-disposition").starts_with("attachment; filename=\""), "{file}");
        assert_eq!(&response.bytes().await.expect("a body")[..4], magic, "{file}");
    }
    let response = guest.get(&format!("{path}/heatmap.glb?{MAP}&colormap=jet")).send().await.expect("an answer");
    assert!(problem(response, 400).await.contains("jet"));
}

/// Whoever has the link may look; only its owner lists and cancels.
async fn check_others(guest: &Guest, other: &Guest, id: &str) {
    assert_eq!(guest.json("/api/v1/runs").await[0]["id"], id);
    assert_eq!(other.json("/api/v1/runs").await, Value::Array(Vec::new()));
    assert_eq!(other.json(&format!("/api/v1/runs/{id}")).await["mine"], false);
    let response = other.post(&format!("/api/v1/runs/{id}/cancel")).send().await.expect("an answer");
    problem(response, 403).await;
}

#[tokio::test]
async fn its_owner_cancels_a_run() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let mut spec = small_spec();
    spec["object_a"] = "stock:torus-knot@20000".into();
    spec["passes"] = 99.into();
    let id = guest.start(&spec).await;
    let response = guest.post(&format!("/api/v1/runs/{id}/cancel")).send().await.expect("an answer");
    assert_eq!(response.status(), StatusCode::OK);
    let last = follow(&guest, &id, 0).await.pop().expect("events");
    assert_eq!(last.data["state"], "cancelled");
    assert_eq!(guest.json(&format!("/api/v1/runs/{id}")).await["state"], "cancelled");
    service.stop().await;
}
