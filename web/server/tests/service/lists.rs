//! Long lists come part by part, and what is added meanwhile shifts nothing.

use std::time::Duration;

use ocb_service::model::Role;
use serde_json::Value;

use crate::people::member;
use crate::publishing::{failed, garbage};
use crate::support::{Guest, Service, header, problem, small_spec};

/// The ids of the part at this path, without stock objects, and the path of the next.
async fn part(guest: &Guest, path: &str) -> (Vec<String>, Option<String>) {
    let answer = guest.get(path).send().await.expect("an answer");
    assert_eq!(answer.status(), 200, "{path}");
    let link = header(&answer, "link");
    let next = link.strip_prefix('<').and_then(|rest| rest.strip_suffix(">; rel=\"next\"")).map(str::to_owned);
    assert_eq!(next.is_some(), !link.is_empty(), "{link}");
    let entries: Value = answer.json().await.expect("JSON");
    let own = entries.as_array().expect("a list").iter().filter(|entry| entry["stock"] != true);
    (own.map(|entry| entry["id"].as_str().expect("an id").to_owned()).collect(), next)
}

async fn newest(guest: &Guest) -> Value {
    guest.json("/api/v1/notices?limit=1").await
}

/// Walks through a list by twos and adds one after each part: every entry of the beginning comes once, nothing else does.
async fn walked(guest: &Guest, path: &str, add: impl AsyncFn(u8)) {
    for number in 0..5 {
        add(number).await;
    }
    let (expected, end) = part(guest, path).await;
    assert!(expected.len() >= 5 && end.is_none(), "{path}: {expected:?}");
    let (mut got, mut next, mut number) = (Vec::new(), Some(format!("{path}?limit=2")), 5);
    while let Some(path) = next {
        let (ids, behind) = part(guest, &path).await;
        assert!(ids.len() == 2 || behind.is_none(), "{path} holds {}", ids.len());
        got.extend(ids);
        next = behind;
        add(number).await;
        number += 1;
    }
    assert_eq!(got, expected, "{path}");
    for bad in ["limit=0", "limit=201", "cursor=somewhere", "cursor=1x~a", "limit=2&cursor="] {
        problem(guest.get(&format!("{path}?{bad}")).send().await.expect("an answer"), 422).await;
    }
}

#[tokio::test]
async fn a_list_goes_on_where_it_was_left() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = member(&service, "curator", Role::Curator).await;
    // Before the runs, which the checks would wait behind.
    let author = member(&service, "author", Role::Developer).await;
    walked(&author, "/api/v1/plugins", async |number| {
        let sent: Value = garbage(&author, number).await.json().await.expect("JSON");
        failed(&author, &sent).await;
    })
    .await;
    walked(&author, "/api/v1/notices", async |number| {
        let before = newest(&author).await;
        let sent: Value = garbage(&author, 100 + number).await.json().await.expect("JSON");
        failed(&author, &sent).await;
        while newest(&author).await == before {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    })
    .await;
    walked(&guest, "/api/v1/runs", async |_| drop(guest.start(&small_spec()).await)).await;
    walked(&guest, "/api/v1/objects", async |number| {
        let object = format!("v 0 0 {number}\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        assert_eq!(guest.upload("own.obj", object).await.status(), 201);
    })
    .await;
    walked(&guest, "/api/v1/configurations", async |number| {
        let file = crate::configurations::shifts(&[f64::from(number)]);
        assert_eq!(guest.send_file("/api/v1/configurations", "own.csv", file).await.status(), 201);
    })
    .await;
    walked(&guest, "/api/v1/invitations", async |number| {
        let asked = serde_json::json!({ "recipient": format!("somebody {number}") });
        assert_eq!(guest.post("/api/v1/invitations").json(&asked).send().await.expect("an answer").status(), 201);
    })
    .await;
    walked(&guest, "/api/v1/accounts", async |number| {
        service
            .engine
            .add_account(&format!("member{number}"), "a long enough password", Role::User)
            .await
            .expect("one");
    })
    .await;
    service.stop().await;
}
