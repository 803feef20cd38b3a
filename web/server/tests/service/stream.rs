//! Progress: replay, resumption, end, shutdown.

use std::time::Duration;

use reqwest::{Response, StatusCode};
use serde_json::Value;

use crate::support::{Guest, Service, header, small_spec};

/// An event as it stands in the stream.
pub struct Event {
    pub id: i64,
    pub data: Value,
}

/// Follows a run from behind an event to the end of the stream.
pub async fn follow(guest: &Guest, run: &str, after: i64) -> Vec<Event> {
    let request = guest.get(&format!("/api/v1/runs/{run}/events")).header("last-event-id", after);
    let response = request.send().await.expect("an answer");
    assert_eq!(response.status(), StatusCode::OK);
    assert_eq!(header(&response, "content-type"), "text/event-stream");
    assert_eq!(header(&response, "x-accel-buffering"), "no");
    parse(&response.text().await.expect("a stream that ends"))
}

fn parse(text: &str) -> Vec<Event> {
    assert!(text.contains("retry:"), "{text}");
    let field = |block: &str, name: &str| {
        block.lines().find_map(|line| line.strip_prefix(name).map(|value| value.trim_start().to_owned()))
    };
    text.split("\n\n")
        .filter_map(|block| {
            let (id, data) = (field(block, "id:")?, field(block, "data:")?);
            Some(Event { id: id.parse().expect("a number"), data: serde_json::from_str(&data).expect("JSON") })
        })
        .collect()
}

#[tokio::test]
async fn a_stream_replays_resumes_and_ends() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let run = guest.start(&small_spec()).await;
    let events = follow(&guest, &run, 0).await;
    // A place in the queue is not kept, and comes before the first that is.
    let ids: Vec<i64> = events.iter().map(|event| event.id).filter(|id| *id > 0).collect();
    assert_eq!(ids, (1..=ids.len() as i64).collect::<Vec<_>>(), "without gaps from 1");
    assert!(events.iter().all(|event| event.data["seq"] == event.id));
    assert_eq!(events.last().expect("events").data["state"], "done");

    // Somebody who has lost the connection half-way gets exactly the rest.
    let half = ids.len() as i64 / 2;
    let rest: Vec<i64> = follow(&guest, &run, half).await.iter().map(|event| event.id).collect();
    assert_eq!(rest, ids[half as usize..]);

    // Who has seen all is told not to come again.
    let path = format!("/api/v1/runs/{run}/events");
    let response = guest.get(&path).header("last-event-id", *ids.last().expect("ids")).send().await.expect("an answer");
    assert_eq!(response.status(), StatusCode::NO_CONTENT);
    service.stop().await;
}

/// An open stream must not keep the service from ending.
#[tokio::test]
async fn the_service_stops_under_an_open_stream() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let mut spec = small_spec();
    spec["passes"] = 99.into();
    spec["object_a"] = "stock:torus-knot@20000".into();
    let run = guest.start(&spec).await;
    let response: Response = guest.get(&format!("/api/v1/runs/{run}/events")).send().await.expect("an answer");
    let reader = tokio::spawn(async move { response.text().await });
    tokio::time::timeout(Duration::from_secs(30), service.stop()).await.expect("it stops");
    let text = reader.await.expect("no panic").expect("the stream ends well");
    assert!(!text.is_empty());
}
