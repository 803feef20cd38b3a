//! How much of a model is enough: asked, followed, taken away, cancelled, and found again after a restart.

use std::time::Duration;

use serde_json::{Value, json};

use crate::support::{Guest, Service, header, problem};

fn question(object: &str, tolerance: f64) -> Value {
    json!({ "object_a": object, "question": { "kind": "distance", "tolerance": tolerance } })
}

async fn ask(guest: &Guest, spec: &Value) -> String {
    let asked = guest.post("/api/v1/advice").json(spec).send().await.expect("an answer");
    assert_eq!(asked.status(), 201);
    header(&asked, "location")
}

/// What became of it.
async fn ended(guest: &Guest, place: &str) -> Value {
    loop {
        let info = guest.json(place).await;
        if !matches!(info["state"].as_str(), Some("queued" | "running")) {
            return info;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
}

#[tokio::test]
async fn advice_is_certified_and_its_objects_are_taken_away() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let guest = service.guest();
    let place = ask(&guest, &question("stock:torus-knot@1500", 0.02)).await;
    let info = ended(&guest, &place).await;
    assert_eq!(info["state"], "done", "{}", info["message"]);
    let advice = &info["advice"];
    assert!(advice["triangles_after"].as_u64() < advice["triangles_before"].as_u64());
    assert_eq!(
        (&advice["held_out"]["wrong"]["seen"], &advice["held_out"]["violations"]["seen"]),
        (&json!(0), &json!(0))
    );
    let side = advice["longest_side"].as_f64().expect("a length");
    assert!(advice["guaranteed_error"].as_f64().expect("an error") <= 0.02 * side * (1.0 + 1e-9));

    let (obj, media_type) = guest.bytes(&format!("{place}/reduced.obj?side=a")).await;
    assert_eq!(media_type, "model/obj");
    let triangles = String::from_utf8(obj).expect("text").lines().filter(|line| line.starts_with("f ")).count();
    let level = advice["stages"][0][0].as_u64().expect("a level") as usize;
    assert_eq!(json!(triangles), advice["levels_a"][level]["triangles"]);
    let paper = guest.json(&format!("{place}/certificate.json?side=a")).await;
    assert_eq!(paper["thickness"].as_array().map(Vec::len), Some(triangles));
    let nothing = guest.get(&format!("{place}/reduced.obj?side=a&stage=9")).send().await.expect("an answer");
    problem(nothing, 404).await;
    service.stop().await;
}

#[tokio::test]
async fn only_who_asked_cancels_and_what_cannot_be_asked_says_so() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let (guest, other) = (service.guest(), service.guest());
    let at_work = ask(&guest, &question("stock:castle@60000", 0.001)).await;
    let waiting = ask(&guest, &question("stock:torus-knot@60000", 0.001)).await;
    let cancel = |by: &Guest, place: &str| by.post(&format!("{place}/cancel")).send();
    problem(cancel(&other, &waiting).await.expect("an answer"), 403).await;
    for place in [&waiting, &at_work] {
        assert_eq!(cancel(&guest, place).await.expect("an answer").status(), 200);
        assert_eq!(ended(&guest, place).await["state"], "cancelled");
    }
    let asked = |spec: Value| guest.post("/api/v1/advice").json(&spec).send();
    problem(asked(question("stock:torus-knot@4000", 0.0)).await.expect("an answer"), 422).await;
    problem(asked(question("nothing", 0.01)).await.expect("an answer"), 404).await;
    problem(guest.get("/api/v1/advice/nothing").send().await.expect("an answer"), 404).await;
    service.stop().await;
}

#[tokio::test]
async fn a_restart_takes_the_work_up_again() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let guest = service.guest();
    let place = ask(&guest, &question("stock:torus-knot@1500", 0.02)).await;
    let service = service.restart().await;
    let info = ended(&service.guest(), &place).await;
    assert_eq!(info["state"], "done", "{}", info["message"]);
    service.stop().await;
}
