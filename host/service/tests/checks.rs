//! Checks of uploaded plugins end: by their limit, by a stop of the service, by somebody's order.

mod common;

use std::collections::HashSet;
use std::path::Path;
use std::time::{Duration, Instant};

use ocb_service::model::{
    AccountInfo, Action, CheckVerdict, Decision, Page, PluginInfo, PluginReport, PluginState, Role,
};
use ocb_service::{Engine, EngineConfig, EngineError, Profile};
use tokio::sync::{Mutex, MutexGuard};

/// One check at a time on a machine.
async fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::const_new(());
    ALONE.lock().await
}

fn config(data: &Path) -> EngineConfig {
    EngineConfig { plugins: Vec::new(), profile: Profile::Dev, ..common::config(data) }
}

async fn sent(engine: &Engine, author: &AccountInfo, file: &Path) -> PluginInfo {
    let bytes = std::fs::read(file).unwrap();
    engine.submit_plugin(author, "slow.so", bytes, common::manifest(), None).await.unwrap().0
}

async fn developer(engine: &Engine, name: &str) -> AccountInfo {
    engine.add_account(name, "a long enough password", Role::Developer).await.unwrap()
}

/// Waits until the check is so far that the plugin answers questions, or builds.
async fn under_way(engine: &Engine, id: &str, viewer: &AccountInfo) {
    let begun = Instant::now();
    while engine.plugin(id, Some(viewer)).await.unwrap().state != PluginState::Vetted {
        assert!(begun.elapsed() < Duration::from_secs(60), "the check did not begin");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    tokio::time::sleep(Duration::from_millis(500)).await;
}

async fn checked_within(limit: Duration, file: &Path, quick: bool) -> (PluginReport, Duration) {
    let data = tempfile::tempdir().unwrap();
    let engine =
        Engine::open(EngineConfig { check_limit: limit, dispatch: false, ..config(data.path()) }).await.unwrap();
    let begun = Instant::now();
    let report = engine.check_plugin(file, ocb_service::Extent { quick, ..Default::default() }).await.unwrap();
    let took = begun.elapsed();
    engine.shutdown().await;
    (report, took)
}

#[tokio::test(flavor = "multi_thread")]
async fn many_slow_algorithms_share_one_limit() {
    let _alone = alone().await;
    let folder = tempfile::tempdir().unwrap();
    let limit = Duration::from_secs(12);
    let (report, took) = checked_within(limit, &common::slow(folder.path(), 0, 800, 64), false).await;
    // Where nothing is shared it takes 64 times 36 questions of 0.8 s, half an hour.
    assert!(took < 5 * limit, "{took:?}");
    assert!(!report.passed);
    let late: Vec<_> =
        report.lines.iter().filter(|line| line.evidence.starts_with("Not finished within the limit")).collect();
    assert_eq!(late.len(), 64, "each algorithm had its turn: {:?}", report.lines);
    assert!(late.iter().all(|line| line.verdict == CheckVerdict::Fail && line.evidence.contains("12 seconds")));
    assert!(late[0].hint.as_ref().unwrap().contains("fewer algorithms"));
}

#[tokio::test(flavor = "multi_thread")]
async fn one_slow_algorithm_is_asked_as_long_as_there_is_time() {
    let _alone = alone().await;
    let folder = tempfile::tempdir().unwrap();
    // Each part has a share of some seconds, so that it gets an answer beside other work, too.
    let limit = Duration::from_secs(60);
    let (report, took) = checked_within(limit, &common::slow(folder.path(), 0, 60, 1), false).await;
    assert!(report.passed, "{:?}", report.lines);
    // All of its questions would take hours.
    assert!(took < 5 * limit, "{took:?}");
    // It is too slow for all four hundred thousand questions, but every scene was reached.
    let reached = report.lines.iter().filter(|line| line.evidence.contains("answers agree with the reference"));
    assert_eq!(reached.count(), 1 + 1 + 5, "{:?}", report.lines);
}

/// The service is stopped in the middle of this plugin's check: in time, and the check waits again.
async fn check_stopped(file: &Path) {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(config(data.path())).await.unwrap();
    let author = developer(&engine, "author").await;
    let plugin = sent(&engine, &author, file).await;
    under_way(&engine, &plugin.id, &author).await;
    let begun = Instant::now();
    engine.shutdown().await;
    let took = begun.elapsed();
    println!("stopped after {:.3} s", took.as_secs_f64());
    // A second, and what other work on the machine adds; one slow build takes fifteen seconds.
    assert!(took < Duration::from_secs(10), "{took:?}");
    let engine = Engine::open(EngineConfig { dispatch: false, ..config(data.path()) }).await.unwrap();
    let now = engine.plugin(&plugin.id, Some(&author)).await.unwrap();
    assert_eq!(now.state, PluginState::Uploaded, "{}", now.reason);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stop_ends_a_slow_answer_within_a_second() {
    let _alone = alone().await;
    let folder = tempfile::tempdir().unwrap();
    check_stopped(&common::slow(folder.path(), 0, 800, 1)).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stop_ends_a_slow_build_within_a_second() {
    let _alone = alone().await;
    let folder = tempfile::tempdir().unwrap();
    check_stopped(&common::slow(folder.path(), 15_000, 0, 1)).await;
}

fn end(reason: &str) -> Decision {
    Decision { action: Action::EndCheck, reason: reason.into() }
}

#[tokio::test(flavor = "multi_thread")]
async fn author_and_curators_end_a_check() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(config(data.path())).await.unwrap();
    let (author, other) = (developer(&engine, "author").await, developer(&engine, "other").await);
    let curator = engine.add_account("curator", "a long enough password", Role::Curator).await.unwrap();
    // One under way, and one that waits behind it.
    let first = sent(&engine, &author, &common::slow(data.path(), 0, 800, 1)).await;
    under_way(&engine, &first.id, &author).await;
    let second = sent(&engine, &author, &common::slow(data.path(), 0, 801, 1)).await;
    let refused = engine.decide(&second.id, &other, end("")).await.unwrap_err();
    assert!(matches!(refused, EngineError::NotFound(_)), "{refused:?}");

    let ended = engine.decide(&second.id, &author, end("")).await.unwrap();
    assert_eq!((ended.state, ended.reason.as_str()), (PluginState::Failed, "The check was ended by its author."));
    let begun = Instant::now();
    let ended = engine.decide(&first.id, &curator, end("Too slow.")).await.unwrap();
    let reason = "The check was ended by a curator: Too slow.";
    assert_eq!((ended.state, ended.reason.as_str()), (PluginState::Failed, reason));
    let done = ended.history.last().unwrap();
    assert_eq!(
        (done.actor.as_str(), done.action.as_str(), done.detail.as_str()),
        ("curator", "ended the check", reason)
    );
    // The author is told of what another did, and of that alone.
    let notices = engine.notices(&author, &Page::default()).await.unwrap().entries;
    assert_eq!(notices.len(), 1, "{notices:?}");
    assert!(notices[0].subject.ends_with("was not checked") && notices[0].text.contains("Too slow."), "{notices:?}");

    // The queue goes on at once, and what was ended stays so.
    let third = sent(&engine, &other, &common::slow(data.path(), 0, 802, 1)).await;
    under_way(&engine, &third.id, &other).await;
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    let again = engine.decide(&first.id, &author, end("")).await.unwrap_err();
    assert!(matches!(again, EngineError::Busy(_)), "{again:?}");
    engine.shutdown().await;
    let engine = Engine::open(EngineConfig { dispatch: false, ..config(data.path()) }).await.unwrap();
    for (plugin, state) in [(first, PluginState::Failed), (second, PluginState::Failed), (third, PluginState::Uploaded)]
    {
        assert_eq!(engine.plugin(&plugin.id, Some(&curator)).await.unwrap().state, state);
    }
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fault_of_the_database_costs_a_check_no_attempt() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(config(data.path())).await.unwrap();
    let database = common::database(data.path()).await;
    let refuse = "CREATE TRIGGER refuse BEFORE INSERT ON submission_lines \
                  BEGIN SELECT RAISE(ABORT, 'disk I/O error'); END";
    sqlx::query(refuse).execute(&database).await.unwrap();
    let author = developer(&engine, "author").await;
    let plugin = sent(&engine, &author, &common::slow(data.path(), 0, 800, 1)).await;
    // Begun three times, which is as often as a check may end the service.
    let (begun, mut starts) = (Instant::now(), HashSet::new());
    while starts.len() < 3 {
        assert!(begun.elapsed() < Duration::from_secs(60), "{starts:?}");
        let now = "SELECT begun_us FROM submissions WHERE begun_us IS NOT NULL AND state = 'uploaded'";
        starts.extend(sqlx::query_scalar::<_, i64>(now).fetch_optional(&database).await.unwrap());
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    sqlx::query("DROP TRIGGER refuse").execute(&database).await.unwrap();
    under_way(&engine, &plugin.id, &author).await;
    database.close().await;
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn one_of_two_concurrent_approvals_wins_and_a_lost_file_stops_no_start() {
    let data = tempfile::tempdir().unwrap();
    let idle = || common::idle_config(data.path());
    let engine = Engine::open(idle()).await.unwrap();
    let database = common::database(data.path()).await;
    let mut plugins = Vec::new();
    for name in ["one", "two"] {
        let author = developer(&engine, name).await;
        let bytes = format!("\x7fELF of {name}").into_bytes();
        plugins.push(engine.submit_plugin(&author, "slow.so", bytes, common::manifest(), None).await.unwrap().0);
    }
    let awaiting = "UPDATE submissions SET state = 'awaiting', algorithms = '[{\"id\": \"slow\", \"name\": \"Slow\", \
        \"version\": \"1.0\", \"authors\": \"Somebody\", \"license\": \"MIT\", \"url\": \"\", \"paper\": \"\", \
        \"queries\": [\"collision_first\"], \"counters\": false, \"witness_points\": false, \"single_precision\": false, \
        \"solid\": false, \"coherent\": false, \"threads\": false, \"usual\": true, \"parameters\": [], \
        \"plugin_sha256\": \"\"}]'";
    sqlx::query(awaiting).execute(&database).await.unwrap();
    database.close().await;
    let curator = engine.add_account("curator", "a long enough password", Role::Curator).await.unwrap();
    let approve = || Decision { action: Action::Approve, reason: String::new() };
    let (one, two) = tokio::join!(
        engine.decide(&plugins[0].id, &curator, approve()),
        engine.decide(&plugins[1].id, &curator, approve()),
    );
    let [won, lost] = if one.is_ok() { [one, two] } else { [two, one] };
    assert_eq!(won.unwrap().state, PluginState::Public);
    let lost = lost.unwrap_err();
    assert!(lost.to_string().contains("belongs to another author's plugin"), "{lost}");
    engine.shutdown().await;

    for kept in ["blobs", "plugins"] {
        let _ = std::fs::remove_dir_all(data.path().join(kept));
    }
    let engine = Engine::open(idle()).await.unwrap();
    let problems = engine.status().await.unwrap().problems;
    assert!(problems.iter().any(|problem| problem.contains("Slow 1.0 cannot be read")), "{problems:?}");
    engine.shutdown().await;
}
