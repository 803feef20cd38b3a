//! What machines do besides runs.

use std::time::{Duration, Instant};

use nix::sys::signal::Signal;
use serde_json::{Value, json};

use crate::{LEASE, Site};

/// Looks at a job until its state is one of these.
fn until(site: &Site, path: &str, states: &[&str]) -> Value {
    let end = Instant::now() + Duration::from_secs(120);
    loop {
        let now = site.guest.get(site.service(), path);
        if states.iter().any(|state| now["state"] == *state) {
            return now;
        }
        assert!(Instant::now() < end, "waited in vain until it is {states:?}: {now}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_machine_does_more_than_runs_and_what_it_had_when_it_was_killed_goes_to_another() {
    let mut site = Site::open();
    let asked = json!({ "object_a": "stock:torus-knot@20000", "question": { "kind": "distance", "tolerance": 0.01 } });
    let killed = site.machine("alpha");
    let (status, advice) = site.guest.post(site.service(), "/advice", &asked);
    assert_eq!(status, 201, "{advice}");
    let advice = advice["id"].as_str().expect("an id").to_owned();
    killed.says(&format!("at work on the advice {advice}"), Duration::from_secs(60));
    until(&site, &format!("/advice/{advice}"), &["running"]);
    killed.signal(Signal::SIGKILL);

    let spec = json!({ "algorithm": "box-tree", "parts": ["vertex-face", "edge-edge"], "seeds": 1 });
    let (status, trying) = site.guest.post(site.service(), "/stability-runs", &spec);
    assert_eq!(status, 201, "{trying}");
    let trying = trying["id"].as_str().expect("an id");
    std::thread::sleep(Duration::from_secs(1));
    let still = until(&site, &format!("/stability-runs/{trying}"), &["queued", "done"]);
    assert_eq!(still["state"], "queued", "the service tries nothing by itself: {still}");
    let machine = site.machine("beta");
    let tried = until(&site, &format!("/stability-runs/{trying}"), &["done", "failed"]);
    assert_eq!(
        (&tried["state"], &tried["done"], &tried["result"]["complete"]),
        (&json!("done"), &json!(2), &json!(true))
    );
    assert_eq!(machine.said().matches(&format!("a part of the stability run {trying} is handed in")).count(), 2);

    machine.says(&format!("at work on the advice {advice}"), 2 * LEASE + Duration::from_secs(15));
    site.guest.post(site.service(), &format!("/advice/{advice}/cancel"), &json!({}));
    machine.says(&format!("the advice {advice} was ended by the service"), Duration::from_secs(5));
    assert_eq!(until(&site, &format!("/advice/{advice}"), &["cancelled"])["advice"], Value::Null);
}
