//! Pages, headers, cookies, compression.

use reqwest::StatusCode;
use serde_json::Value;

use crate::support::{Service, header};

#[tokio::test]
async fn every_answer_protects_the_visitor() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    for path in ["/", "/r/some-run", "/api/v1/status", "/api/v1/nothing", "/mark.svg"] {
        let response = guest.get(path).send().await.expect("an answer");
        let policy = header(&response, "content-security-policy");
        let scripts = policy.split(';').find(|part| part.trim_start().starts_with("script-src")).unwrap_or_default();
        assert_eq!(scripts.trim(), "script-src 'self'", "{path}");
        assert_eq!(header(&response, "x-content-type-options"), "nosniff", "{path}");
        assert_eq!(header(&response, "referrer-policy"), "no-referrer", "{path}");
    }
    service.stop().await;
}

#[tokio::test]
async fn the_guest_cookie_is_set_once() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let first = guest.get("/api/v1/status").send().await.expect("an answer");
    let cookie = header(&first, "set-cookie");
    for part in ["ocb_guest=", "HttpOnly", "SameSite=Lax", "Path=/", "Max-Age="] {
        assert!(cookie.contains(part), "{part} is not in {cookie}");
    }
    let second = guest.get("/api/v1/status").send().await.expect("an answer");
    assert_eq!(header(&second, "set-cookie"), "");

    // A value of one's own choice is not taken.
    let client = reqwest::Client::new();
    let forged = client.get(format!("{}/api/v1/status", service.url)).header("cookie", "ocb_guest=cli");
    assert!(header(&forged.send().await.expect("an answer"), "set-cookie").contains("ocb_guest="));
    service.stop().await;
}

#[tokio::test]
async fn pages_answer_every_address_that_is_no_api() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let response = guest.get("/r/0193f1a0?m=time").send().await.expect("an answer");
    let (status, media_type) = (response.status(), header(&response, "content-type"));
    let (cache, tag) = (header(&response, "cache-control"), header(&response, "etag"));
    let page = response.text().await.expect("a body");
    assert_eq!(media_type, "text/html; charset=utf-8");
    assert!(page.to_lowercase().starts_with("<!doctype html>"), "{page}");
    if status == StatusCode::OK {
        assert_eq!(cache, "no-cache");
        let again = guest.get("/").header("if-none-match", tag).send().await.expect("an answer");
        assert_eq!(again.status(), StatusCode::NOT_MODIFIED);
        let script =
            page.split('"').find(|part| part.starts_with("/assets/") && part.ends_with(".js")).expect("a script");
        let response = guest.get(script).send().await.expect("an answer");
        assert_eq!(header(&response, "cache-control"), "public, max-age=31536000, immutable");
        assert_eq!(header(&response, "content-type"), "text/javascript; charset=utf-8");
    } else {
        assert_eq!(status, StatusCode::SERVICE_UNAVAILABLE, "only pages that are not built may be missing");
        assert!(page.contains("make serve"));
    }
    let missing = guest.get("/assets/index-00000000.js").send().await.expect("an answer");
    assert_eq!(missing.status(), StatusCode::NOT_FOUND);
    service.stop().await;
}

#[tokio::test]
async fn the_document_is_served_compressed() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let served = guest.json("/api/v1/openapi.json").await;
    let stored: Value = serde_json::from_str(include_str!("../../openapi.json")).expect("JSON");
    assert_eq!(served, stored);
    let response = guest.get("/api/v1/openapi.json").header("accept-encoding", "gzip").send().await.expect("an answer");
    assert_eq!(header(&response, "content-encoding"), "gzip");
    service.stop().await;
}

#[tokio::test]
async fn status_and_algorithms_answer() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let status = guest.json("/api/v1/status").await;
    assert_eq!(status["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!((&status["running"], &status["queued"]), (&0.into(), &0.into()));
    let algorithms = guest.json("/api/v1/algorithms").await;
    let ids: Vec<&str> = algorithms.as_array().expect("a list").iter().filter_map(|one| one["id"].as_str()).collect();
    for id in ["box-tree", "brute-force"] {
        assert!(ids.contains(&id), "{ids:?}");
    }
    service.stop().await;
}

#[tokio::test]
async fn the_examples_of_the_document_are_accepted() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_fast.so"]).await;
    let guest = service.guest();
    let document = guest.json("/api/v1/openapi.json").await;
    let example = |path: &str| {
        let body = &document["paths"][path]["post"]["requestBody"]["content"]["application/json"];
        body["example"].as_object().unwrap_or_else(|| panic!("no example for {path}")).clone()
    };
    let spec = Value::Object(example("/api/v1/estimates"));
    let response = guest.post("/api/v1/estimates").json(&spec).send().await.expect("an answer");
    assert_eq!(response.status(), StatusCode::OK, "{:?}", response.text().await);
    guest.start(&Value::Object(example("/api/v1/runs"))).await;
    service.stop().await;
}
