//! One visitor cannot monopolise the service: not by dropping cookies, using many addresses of one subnet, or trying a name.

use std::time::{Duration, Instant};

use ocb_service::Ceilings;
use ocb_service::model::Role;
use reqwest::{RequestBuilder, Response, StatusCode};
use serde_json::{Value, json};

use crate::people::{PASSWORD, log_in, member};
use crate::support::{Guest, Service, database, header, problem, small_comparison};

/// Two algorithms that may take so long each.
fn spec(seconds: f64) -> Value {
    let mut spec = small_comparison();
    spec["budget_seconds"] = seconds.into();
    spec
}

/// As a proxy at this machine passes it on.
async fn from(address: &str, request: RequestBuilder) -> Response {
    request.header("x-forwarded-for", address).send().await.expect("an answer")
}

/// A visitor without a cookie asks for a run.
async fn asked(service: &Service, address: &str, seconds: f64) -> Response {
    from(address, service.guest().post("/api/v1/runs").json(&spec(seconds))).await
}

fn ceilings() -> Ceilings {
    let minutes = |n: u64| Duration::from_secs(60 * n);
    Ceilings { guest_run: minutes(10), guest: minutes(15), account: minutes(40), address: minutes(30) }
}

/// What is too long for a guest is estimated all the same, so that the page can offer a part of it.
#[tokio::test]
async fn an_estimate_says_what_a_guest_may_not_start() {
    let service = Service::start_limited(ceilings()).await;
    let guest = service.guest();
    for (budget, refused) in [(86_400.0, true), (1.0, false)] {
        let answer = guest.post("/api/v1/estimates").json(&spec(budget)).send().await.expect("an answer");
        assert_eq!(answer.status(), 200);
        let estimate: Value = answer.json().await.expect("JSON");
        assert_eq!(estimate["refused"].as_str().is_some_and(|why| why.contains("300 s")), refused, "{estimate}");
        assert!(estimate["total_seconds"].as_f64().is_some_and(|seconds| seconds > 0.0), "{estimate}");
    }
}

#[tokio::test]
async fn requests_without_cookies_share_the_limits_of_their_address() {
    let service = Service::start_limited(ceilings()).await;
    for _ in 0..40 {
        let told = problem(asked(&service, "203.0.113.7", 86_400.0).await, 422).await;
        assert!(told.contains("10 minutes") && told.contains("300 s"), "{told}");
    }
    let mut refused = 0;
    for _ in 0..40 {
        let answer = asked(&service, "203.0.113.7", 300.0).await;
        if answer.status() == StatusCode::CREATED {
            continue;
        }
        let again: u32 = header(&answer, "retry-after").parse().expect("seconds");
        let told = problem(answer, 429).await;
        refused += 1;
        assert!((10..=3600).contains(&again) && told.contains("from your address"), "{again}: {told}");
    }
    assert_eq!(refused, 37, "three runs of ten minutes");
    // Another address has its own, and its turn comes after one run of the first: theirs share a turn.
    let other = asked(&service, "203.0.113.8", 300.0).await;
    assert_eq!(other.status(), StatusCode::CREATED);
    let other: Value = other.json().await.expect("JSON");
    assert_eq!(other["runs_ahead"], 1);
    // A subscriber has 64 bits of addresses, which are one.
    for host in ["1", "2", "ffff:2:3"] {
        assert_eq!(asked(&service, &format!("2001:db8:0:7::{host}"), 300.0).await.status(), StatusCode::CREATED);
    }
    problem(asked(&service, "2001:db8:0:7:5::9", 300.0).await, 429).await;
    assert_eq!(asked(&service, "2001:db8:0:8::1", 300.0).await.status(), StatusCode::CREATED);
    service.stop().await;
}

#[tokio::test]
async fn guests_and_accounts_have_a_ceiling_of_their_own() {
    let day = Duration::from_secs(86_400);
    let service = Service::start_limited(Ceilings { address: day, ..ceilings() }).await;
    let guest = service.guest();
    let ask = |by: &Guest, seconds: f64| by.post("/api/v1/runs").json(&spec(seconds)).send();
    assert_eq!(ask(&guest, 300.0).await.expect("an answer").status(), StatusCode::CREATED);
    let told = problem(ask(&guest, 300.0).await.expect("an answer"), 429).await;
    assert!(told.contains("of yours") && told.contains("15 minutes"), "{told}");
    assert_eq!(ask(&guest, 150.0).await.expect("an answer").status(), StatusCode::CREATED);
    // A cancelled run frees its share.
    let waiting = guest.json("/api/v1/runs").await;
    let ended = guest.post(&format!("/api/v1/runs/{}/cancel", waiting[0]["id"].as_str().expect("an id"))).send().await;
    assert_eq!(ended.expect("an answer").status(), StatusCode::OK);
    assert_eq!(ask(&guest, 150.0).await.expect("an answer").status(), StatusCode::CREATED);

    let account = member(&service, "ada", Role::User).await;
    assert!(problem(ask(&account, 1500.0).await.expect("an answer"), 422).await.contains("40 minutes"));
    assert_eq!(ask(&account, 1100.0).await.expect("an answer").status(), StatusCode::CREATED);
    problem(ask(&account, 300.0).await.expect("an answer"), 429).await;
    service.stop().await;
}

#[tokio::test]
async fn concurrent_requests_do_not_exceed_a_limit() {
    let service = Service::start_limited(ceilings()).await;
    let all = futures::future::join_all((0..20).map(|_| asked(&service, "203.0.113.7", 300.0))).await;
    assert_eq!(all.iter().filter(|answer| answer.status() == StatusCode::CREATED).count(), 3);
    service.stop().await;
}

#[tokio::test]
async fn a_curator_cancels_any_run_and_its_owner_sees_why() {
    let service = Service::start_limited(ceilings()).await;
    let (guest, curator) = (service.guest(), member(&service, "curator", Role::Curator).await);
    let id = guest.start(&spec(60.0)).await;
    let path = format!("/api/v1/runs/{id}/cancel");
    let user = member(&service, "ada", Role::User).await;
    for stranger in [&user, &service.guest()] {
        problem(stranger.post(&path).send().await.expect("an answer"), 403).await;
    }
    // A token is not a person.
    let asked = json!({ "name": "t", "scopes": ["runs"] });
    let token = curator.post("/api/v1/account/tokens").json(&asked).send().await.expect("an answer");
    let token: Value = token.json().await.expect("JSON");
    let program = service.guest().post(&path).bearer_auth(token["secret"].as_str().expect("a secret"));
    problem(program.send().await.expect("an answer"), 403).await;
    let campaign = json!({ "suite": true, "people": false, "reason": "Another machine." });
    let program = service.guest().post("/api/v1/campaigns").json(&campaign);
    let sent = program.bearer_auth(token["secret"].as_str().expect("a secret")).send().await;
    problem(sent.expect("an answer"), 403).await;

    assert_eq!(curator.post(&path).send().await.expect("an answer").status(), StatusCode::OK);
    let run = guest.json(&format!("/api/v1/runs/{id}")).await;
    assert_eq!((&run["state"], &run["message"]), (&json!("cancelled"), &json!("Cancelled by a curator.")));
    service.stop().await;
}

#[tokio::test]
async fn services_on_one_database_count_attempts_together() {
    let database = database();
    let services = [Service::start_beside(&database).await, Service::start_beside(&database).await];
    let body = json!({ "name": "nobody", "password": "some password" });
    let tried = async |service: &Service, address: &str| {
        from(address, service.guest().post("/api/v1/account/login").json(&body)).await.status().as_u16()
    };
    let (begun, mut answers) = (Instant::now(), Vec::new());
    // Each of them alone would let ten through.
    for service in services.iter().cycle().take(40) {
        answers.push(tried(service, "203.0.113.7").await);
    }
    let again = begun.elapsed().as_secs() as usize / 6 + 1;
    let let_through = answers.iter().filter(|status| **status == 403).count();
    assert!((10..=10 + again).contains(&let_through), "{answers:?}");
    assert_eq!(answers.iter().filter(|status| **status == 429).count(), 40 - let_through, "{answers:?}");
    for service in services {
        assert_eq!(tried(&service, "203.0.113.8").await, 403, "another address");
        service.stop().await;
    }
}

#[tokio::test]
async fn trying_a_name_does_not_lock_its_account() {
    let service = Service::start_limited(ceilings()).await;
    let ada = member(&service, "ada", Role::User).await;
    let tried = async |address: &str, password: &str| {
        let body = json!({ "name": "ada", "password": password });
        from(address, service.guest().post("/api/v1/account/login").json(&body)).await.status().as_u16()
    };
    let mut answers = Vec::new();
    for _ in 0..40 {
        answers.push(tried("203.0.113.7", "some other password").await);
    }
    assert_eq!(answers.iter().filter(|status| **status == 403).count(), 10);
    assert!(answers[10..].iter().all(|status| *status == 429), "{answers:?}");
    assert_eq!(tried("203.0.113.8", PASSWORD).await, 200, "the right one from elsewhere");
    // Many addresses together use up the name, but not for a browser that has entered before.
    for host in 1..=10 {
        for _ in 0..10 {
            tried(&format!("198.51.100.{host}"), "some other password").await;
        }
    }
    assert_eq!(tried("203.0.113.9", PASSWORD).await, 429);
    assert_eq!(log_in(&ada, "ada", PASSWORD).await.status(), StatusCode::OK);
    service.stop().await;
}

#[tokio::test]
async fn a_name_of_megabytes_gets_the_same_answer_as_an_unknown_one() {
    let service = Service::start_limited(ceilings()).await;
    let told = problem(log_in(&service.guest(), &"a".repeat(1_900_000), PASSWORD).await, 403).await;
    assert_eq!(told, problem(log_in(&service.guest(), "nobody", PASSWORD).await, 403).await);
    service.stop().await;
}

#[tokio::test]
async fn advice_has_slots_for_each() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let ask = |address: &'static str, tolerance: f64| {
        let question =
            json!({ "object_a": "stock:torus-knot@8000", "question": { "kind": "distance", "tolerance": tolerance } });
        from(address, service.guest().post("/api/v1/advice").json(&question))
    };
    let mut mine = Vec::new();
    for i in 1..=4 {
        mine.push(ask("203.0.113.7", 0.001 * f64::from(i)).await);
    }
    let (last, first) = mine.split_last().expect("four");
    assert!(first.iter().all(|answer| answer.status() == StatusCode::CREATED));
    assert_eq!((last.status().as_u16(), header(last, "retry-after").as_str()), (429, "120"));
    assert_eq!(ask("203.0.113.8", 0.001).await.status(), StatusCode::CREATED, "others wait behind three, not outside");
    service.stop().await;
}
