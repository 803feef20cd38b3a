//! Each service knows the changes of the other, and exclusive work is exclusive across both.

use futures::future::join_all;

use super::*;
use crate::EngineError;
use crate::campaigns::sql::CampaignRow;
use crate::locks::JOINED;
use crate::model::{Action, AdviceInfo, AdviceSpec, Decision, RunSpec};
use crate::quotas::Visitor;
use crate::store::tests::fixtures::advice_info;

fn decision(action: Action) -> Decision {
    Decision { action, reason: "for a test".into() }
}

/// How many were admitted, and how many exceeded a quota.
fn admitted<T>(answers: &[Result<T, EngineError>]) -> [usize; 2] {
    let refused = |answer: &&Result<T, EngineError>| matches!(answer, Err(EngineError::TooMuch { .. }));
    [answers.iter().filter(|answer| answer.is_ok()).count(), answers.iter().filter(refused).count()]
}

#[tokio::test(flavor = "multi_thread")]
async fn a_plugin_is_offered_and_suspended_at_every_service() {
    let pair = Pair::open().await;
    let Pair { first, second, .. } = &pair;
    let curator = pair.plugin("p", "x", PluginState::Awaiting).await;
    first.decide("p", &curator, decision(Action::Approve)).await.unwrap();
    assert!(offers(first, "x"));
    until("the other service does not offer the plugin", async || offers(second, "x")).await;
    second.decide("p", &curator, decision(Action::Suspend)).await.unwrap();
    assert!(!offers(second, "x"));
    until("the other service still offers the plugin", async || !offers(first, "x")).await;

    // What was missed while the connection was lost is read when there is another.
    for text in ["ALTER TABLE submissions DISABLE TRIGGER USER", "UPDATE submissions SET state = 'public'"] {
        sqlx::query(text).execute(&pair.database).await.unwrap();
    }
    pair.terminate("AND query LIKE 'LISTEN%'", &pair.name).await;
    until("a missed change stays unknown", async || offers(first, "x") && offers(second, "x")).await;
    pair.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn of_two_approvals_at_once_one_publishes_an_id() {
    let pair = Pair::open().await;
    for round in 0..5 {
        let (id, other) = (format!("p{round}"), format!("q{round}"));
        let algorithm = format!("x{round}");
        let curators = [
            pair.plugin(&id, &algorithm, PluginState::Awaiting).await,
            pair.plugin(&other, &algorithm, PluginState::Awaiting).await,
        ];
        let (here, there) = tokio::join!(
            pair.first.decide(&id, &curators[0], decision(Action::Approve)),
            pair.second.decide(&other, &curators[1], decision(Action::Approve)),
        );
        let refused = match (here, there) {
            (Ok(_), Err(refused)) | (Err(refused), Ok(_)) => refused,
            other => panic!("one is public: {other:?}"),
        };
        assert!(matches!(refused, EngineError::Busy(_)), "{refused:?}");
    }
    pair.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_guest_has_one_quota_at_all_services() {
    let pair = Pair::open().await;
    let Pair { first, second, .. } = &pair;
    pair.plugin("p", "x", PluginState::Public).await;
    until("the plugin is not offered", async || offers(first, "x") && offers(second, "x")).await;
    let spec: RunSpec = serde_json::from_value(serde_json::json!({
        "object_a": "stock:torus-knot@600", "query": "proximity", "passes": 2, "budget_seconds": 1.0, "algorithms": ["x"],
        "method": {"kind": "sphere", "sampling": {"kind": "count", "count": 5}},
    }))
    .unwrap();
    let guest = Visitor { owner: uuid::Uuid::new_v4().to_string(), address: None };
    // Twenty runs of a guest may wait; these come at once.
    let asked = (0..30).map(|i| [first, second][i % 2].submit_for(spec.clone(), &guest, None));
    assert_eq!(admitted(&join_all(asked).await), [20, 10]);
    pair.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn requests_for_advice_have_one_quota_at_all_services() {
    let pair = Pair::open().await;
    let Pair { first, second, .. } = &pair;
    let spec: AdviceSpec = serde_json::from_value(serde_json::json!({
        "object_a": "stock:torus-knot@600", "question": {"kind": "distance", "tolerance": 0.01},
    }))
    .unwrap();
    let guest = Visitor { owner: uuid::Uuid::new_v4().to_string(), address: Some("203.0.113.7".into()) };
    // New requests wait, so that none of them ends meanwhile.
    let held = tokio::join!(first.inner.advices.one.lock(), second.inner.advices.one.lock());
    // Three may wait or be at work.
    for id in ["v", "w"] {
        let info = AdviceInfo { spec: spec.clone(), ..advice_info(id) };
        let added = first.inner.store.add_advice(&info, Some("another"), "address:203.0.113.7").await;
        assert!(added.unwrap());
    }
    let asked = (0..6).map(|i| [first, second][i % 2].ask_advice(spec.clone(), &guest, None));
    assert_eq!(admitted(&join_all(asked).await), [1, 5]);
    drop(held);
    pair.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_suite_is_planned_once() {
    let pair = Pair::open().await;
    let Pair { first, second, .. } = &pair;
    pair.plugin("p", "x", PluginState::Public).await;
    until("the plugin is not offered", async || offers(first, "x") && offers(second, "x")).await;
    let only = ["x".to_owned()];
    let (here, there) = tokio::join!(first.measure_suite(&only), second.measure_suite(&only));
    let scenarios = first.inner.suite.scenarios().len();
    let mut queued = [here.unwrap().len(), there.unwrap().len()];
    queued.sort_unstable();
    assert_eq!(queued, [0, scenarios]);
    assert_eq!(first.inner.store.suite_runs().await.unwrap().len(), scenarios);
    pair.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_campaign_that_a_service_left_is_completed_once() {
    let pair = Pair::open().await;
    let Pair { first, second, .. } = &pair;
    pair.plugin("p", "x", PluginState::Public).await;
    until("the plugin is not offered", async || offers(first, "x") && offers(second, "x")).await;
    let inner = &first.inner;
    inner.suite_runs.keep_suite().await.unwrap();
    let row = |id: &str, class: &str| CampaignRow {
        id: id.into(),
        reason: "another kernel".into(),
        of_suite: true,
        of_people: false,
        created_by: "somebody".into(),
        created_us: 1,
        hardware_class: class.into(),
        oracle: ocb_core::oracle::VERSION,
        suite: inner.suite.sha256.clone(),
        queued_us: None,
        cancelled_us: None,
        ended_us: None,
    };
    for row in [row("here", &inner.machine.hardware_class), row("elsewhere", "another class")] {
        assert!(inner.store.add_campaign(&row, NOTE).await.unwrap());
    }
    let (here, there) = tokio::join!(first.complete_campaigns(), second.complete_campaigns());
    here.and(there).unwrap();
    assert_eq!(inner.store.campaign_runs("here").await.unwrap().len(), inner.suite.scenarios().len());
    assert!(inner.store.campaign("here").await.unwrap().unwrap().queued_us.is_some());
    assert!(inner.store.campaign_runs("elsewhere").await.unwrap().is_empty());
    pair.close().await;
}

/// The same object at both services: one is deleted while the other is being stored.
#[tokio::test(flavor = "multi_thread")]
async fn a_file_that_one_service_stores_is_not_removed_by_the_other() {
    let pair = Pair::open().await;
    let Pair { first, second, .. } = &pair;
    // Another one at each run: the bucket may outlive this test.
    let size = 1 + uuid::Uuid::new_v4().as_u64_pair().0 % 1_000_000;
    let file = format!("v 0 0 0\nv {size} 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n").into_bytes();
    let object = first.add_object("a.obj", file.clone(), Some("me")).await.unwrap();

    let keeping = second.inner.store.locks.keeping().await.unwrap();
    let (engine, id) = (first.clone(), object.id.clone());
    let mut removing = tokio::spawn(async move { engine.remove_object(&id, "me").await });
    let early = tokio::time::timeout(Duration::from_millis(500), &mut removing).await;
    assert!(early.is_err(), "it did not wait for a file that is being stored");
    // Those who come later wait behind it, so that it does not wait for ever.
    tokio::time::sleep(JOINED).await;
    let (engine, same) = (second.clone(), file.clone());
    let mut adding = tokio::spawn(async move { engine.add_object("b.obj", same, Some("you")).await });
    let early = tokio::time::timeout(Duration::from_millis(500), &mut adding).await;
    assert!(early.is_err(), "it overtook the one that waits to remove a file");
    drop(keeping);
    removing.await.unwrap().unwrap();
    let other = adding.await.unwrap().unwrap();
    assert_eq!(other.sha256, object.sha256);
    let kept = second.inner.store.object(&other.id).await.unwrap().unwrap();
    second.inner.blobs.get(&kept.blob).await.expect("its file is there");
    pair.close().await;
}
