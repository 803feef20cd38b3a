//! Every bad request gets a problem document with one sentence.

use serde_json::{Value, json};

use crate::support::{Service, problem, small_spec};

#[tokio::test]
async fn bad_specifications_are_refused_before_they_cost_anything() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let count = |count: u64| json!({ "kind": "sphere", "sampling": { "kind": "count", "count": count } });
    let steps = |by: f64| json!({ "kind": "sphere", "sampling": { "kind": "steps", "rotate": by, "move": 20 } });
    let cases: [(&str, Value, u16, &str); 12] = [
        ("relative_distance", json!(-0.1), 422, "distance"),
        ("method", count(0), 422, ""),
        ("method", count(1_000_000_000), 422, "10000000"),
        ("method", steps(0.0), 422, ""),
        ("method", steps(-20.0), 422, ""),
        ("method", json!({ "kind": "spiral" }), 422, "spiral"),
        ("method", json!({ "kind": "file", "sha256": "00" }), 422, ""),
        ("algorithms", json!(["no-such-thing"]), 422, "no-such-thing"),
        ("passes", json!(0), 422, "passes"),
        ("budget_seconds", json!(-1.0), 422, ""),
        ("query", json!("penetration"), 422, "penetration"),
        ("speed", json!("fast"), 422, "speed"),
    ];
    for (field, value, status, expected) in cases {
        let mut spec = small_spec();
        spec[field] = value.clone();
        for path in ["/api/v1/estimates", "/api/v1/runs"] {
            let response = guest.post(path).json(&spec).send().await.expect("an answer");
            let detail = problem(response, status).await;
            assert!(detail.replace(['_', ','], "").contains(&expected.replace('_', "")), "{field} {value}: {detail}");
        }
    }
    assert_eq!(guest.json("/api/v1/runs").await, json!([]));
    service.stop().await;
}

#[tokio::test]
async fn objects_that_are_not_there_are_named() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    for id in ["stock:unicorn@100", "0193f1a0-0000-7000-8000-000000000000", "x"] {
        let mut spec = small_spec();
        spec["object_b"] = json!(id);
        let response = guest.post("/api/v1/estimates").json(&spec).send().await.expect("an answer");
        assert!(response.status().is_client_error());
        let response = guest.get(&format!("/api/v1/objects/{id}")).send().await.expect("an answer");
        problem(response, 404).await;
    }
    service.stop().await;
}

#[tokio::test]
async fn what_is_no_json_is_refused() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let send = |media_type: &'static str, body: &'static str| {
        guest.post("/api/v1/runs").header("content-type", media_type).body(body).send()
    };
    problem(send("application/json", "{\"object_a\":").await.expect("an answer"), 400).await;
    problem(send("text/plain", "{}").await.expect("an answer"), 415).await;
    let detail = problem(send("application/json", "{}").await.expect("an answer"), 422).await;
    assert!(detail.contains("object_a"), "{detail}");
    service.stop().await;
}

#[tokio::test]
async fn unknown_addresses_and_methods_are_problems() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    for path in ["/api/", "/api/v1", "/api/v1/nothing", "/api/v2/objects", "/api/v1/runs/x/y"] {
        problem(guest.get(path).send().await.expect("an answer"), 404).await;
    }
    problem(guest.post("/api/v1/status").send().await.expect("an answer"), 405).await;
    problem(guest.post("/about").send().await.expect("an answer"), 405).await;
    service.stop().await;
}

#[tokio::test]
async fn runs_that_are_not_there_have_nothing() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let map = "algorithm=box-tree&measure=time&statistic=median&outliers=keep";
    for id in ["0193f1a0-0000-7000-8000-000000000000", "nonsense", "%00"] {
        let paths = [
            String::new(),
            "/events".to_owned(),
            format!("/heatmap?{map}"),
            format!("/heatmap.glb?{map}"),
            format!("/heatmap.ply?{map}"),
            format!("/vertices/0?{map}"),
            "/ecdf?algorithm=box-tree".to_owned(),
            "/records.csv?algorithm=box-tree".to_owned(),
            "/records.parquet?algorithm=box-tree".to_owned(),
            "/configurations.parquet".to_owned(),
        ];
        for path in paths {
            problem(guest.get(&format!("/api/v1/runs/{id}{path}")).send().await.expect("an answer"), 404).await;
        }
        problem(guest.post(&format!("/api/v1/runs/{id}/cancel")).send().await.expect("an answer"), 404).await;
    }
    // Nothing is wrong with a service that has not measured its first run yet.
    let featured = guest.get("/api/v1/featured").send().await.expect("an answer");
    assert_eq!((featured.status().as_u16(), featured.text().await.expect("a body").as_str()), (200, "null"));
    service.stop().await;
}

#[tokio::test]
async fn queries_that_do_not_fit_are_refused() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    for query in [
        "",
        "?algorithm=box-tree&measure=colour&statistic=median&outliers=keep",
        "?algorithm=box-tree&measure=time&statistic=mode&outliers=keep",
    ] {
        let response = guest.get(&format!("/api/v1/runs/x/heatmap{query}")).send().await.expect("an answer");
        problem(response, 400).await;
    }
    let response = guest.get("/api/v1/runs/x/vertices/-1?algorithm=a&measure=time&statistic=min&outliers=keep");
    problem(response.send().await.expect("an answer"), 400).await;
    let response = guest.get("/api/v1/runs/x/events").header("last-event-id", "soon").send().await;
    problem(response.expect("an answer"), 400).await;
    service.stop().await;
}
