//! Campaigns on a whole engine: what is of another hardware class or oracle is measured again, once, side by side with the old.
//!
//! The operator's note makes this machine another hardware class.

mod common;

use std::path::{Path, PathBuf};
use std::time::Duration;

use ocb_core::query::Query;
use ocb_service::model::{
    AccountInfo, Action, BoardRequest, CampaignInfo, CampaignRequest, Decision, Manifest, NewChoices, OutcomeName,
    Page, PluginInfo, PluginState, Role, RunInfo, State, Visibility,
};
use ocb_service::{Engine, EngineConfig, EngineError, Profile};
use tempfile::TempDir;
use tokio::sync::{Mutex, MutexGuard, OnceCell};

/// While one engine measures, another of the same process would count fewer CPUs, and so be of another hardware class.
async fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::const_new(());
    ALONE.lock().await
}

/// A suite of one scene at two distances, asked one question.
fn suite(data: &Path) -> PathBuf {
    let document = serde_json::json!({
        "version": 7, "scenes": [["stock:torus-knot@600", "stock:torus-knot@600"]],
        "separations": [{ "kind": "relative", "distance": 0.1 }, { "kind": "step", "of_size": -0.01 }],
        "queries": ["collision_first"], "configurations": 30, "seed": 1, "passes": 1, "budget_seconds": 5.0,
    });
    let file = data.join("suite.json");
    std::fs::write(&file, document.to_string()).unwrap();
    file
}

/// With two algorithms: each more is twelve processes for each time that the suite is measured.
fn config(data: &Path, note: &str) -> EngineConfig {
    let mut config = common::config(data);
    config.plugins.retain(|file| !file.ends_with("libocb_parry.so"));
    EngineConfig {
        suite: Some(suite(data)),
        machine_note: Some(note.into()),
        profile: Profile::Dev,
        quick_checks: true,
        ..config
    }
}

fn asked() -> CampaignRequest {
    CampaignRequest { reason: "A new machine".into(), suite: true, people: true, hardware_class: None }
}

async fn account(engine: &Engine, name: &str, role: Role) -> AccountInfo {
    engine.add_account(name, "a long enough password", role).await.unwrap()
}

/// A run of this account that everybody may see, unless it is `hidden`.
async fn published(engine: &Engine, by: &AccountInfo, seed: u64, hidden: bool) -> RunInfo {
    let mut spec = common::spec("proximity", 20, seed);
    (spec.passes, spec.algorithms) = (1, vec!["box-tree".into()]);
    let run = engine.submit(spec, Some(&by.owner())).await.unwrap();
    let to = if hidden { Visibility::Private } else { Visibility::Public };
    engine.change_run_visibility(&run.id, to, &by.owner()).await.unwrap();
    common::finish(engine, &run.id).await.0
}

/// The campaign when nothing of it waits any more.
async fn ended(engine: &Engine, id: &str) -> CampaignInfo {
    for _ in 0..1200 {
        let campaign = engine.campaign(id, None).await.unwrap();
        if campaign.ended_us.is_some() {
            return campaign;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    panic!("the campaign does not end: {:?}", engine.campaign(id, None).await);
}

/// A folder with the suite measured, and a run of somebody who agrees, one of somebody who does not, and a private one. It is
/// measured once; each test has a copy.
async fn measured_before() -> (TempDir, AccountInfo, RunInfo) {
    static BEFORE: OnceCell<(AccountInfo, RunInfo)> = OnceCell::const_new();
    let measured = Path::new(env!("CARGO_TARGET_TMPDIR")).join("campaigns");
    let (ada, agreed) = BEFORE.get_or_init(|| measure_before(&measured)).await;
    let data = tempfile::tempdir().unwrap();
    common::copy(&measured, data.path());
    (data, ada.clone(), agreed.clone())
}

async fn measure_before(data: &Path) -> (AccountInfo, RunInfo) {
    if data.exists() {
        std::fs::remove_dir_all(data).unwrap();
    }
    std::fs::create_dir_all(data).unwrap();
    let engine = Engine::open(config(data, "old")).await.unwrap();
    for run in engine.measure_suite(&[]).await.unwrap() {
        assert_eq!(common::finish(&engine, &run.id).await.0.state, State::Done);
    }
    let (ada, bob) = (account(&engine, "ada", Role::User).await, account(&engine, "bob", Role::User).await);
    engine.choose(&ada, &NewChoices { agrees_to_reruns: Some(true), ..NewChoices::default() }).await.unwrap();
    let agreed = published(&engine, &ada, 1, false).await;
    published(&engine, &ada, 2, true).await;
    published(&engine, &bob, 3, false).await;
    let nothing = engine.create_campaign(None, asked(), None).await;
    assert!(matches!(nothing, Err(EngineError::Busy(_))), "all of it is of now");
    engine.shutdown().await;
    (ada, agreed)
}

/// Does something to the database of a folder that no engine has open.
async fn edit(data: &Path, text: String) -> u64 {
    sqlx::any::install_default_drivers();
    let url = format!("sqlite://{}", data.join("opencollbench.sqlite").display());
    let pool = sqlx::AnyPool::connect(&url).await.unwrap();
    let rows = sqlx::query(sqlx::AssertSqlSafe(text)).execute(&pool).await.unwrap().rows_affected();
    pool.close().await;
    rows
}

#[tokio::test(flavor = "multi_thread")]
async fn another_hardware_class_is_measured_once_and_stands_beside_the_old_one() {
    let _alone = alone().await;
    let (data, ada, agreed) = measured_before().await;
    let engine = Engine::open(config(data.path(), "new")).await.unwrap();
    let preview = engine.preview_campaign(true, true, None).await.unwrap();
    assert_eq!((preview.suite_runs, preview.suite_repeats, preview.peoples_runs), (2, 2, 1));
    assert_eq!(engine.preview_campaign(true, false, None).await.unwrap().peoples_runs, 0);
    let (made, new) = engine.create_campaign(None, asked(), Some("k")).await.unwrap();
    assert!(new);
    let (again, new) = engine.create_campaign(None, asked(), Some("k")).await.unwrap();
    assert_eq!((again.id.as_str(), new), (made.id.as_str(), false));
    // In the middle the service ends and begins again.
    engine.shutdown().await;
    let engine = Engine::open(config(data.path(), "new")).await.unwrap();
    let campaign = ended(&engine, &made.id).await;
    assert_eq!((campaign.state, campaign.runs.done, campaign.runs.failed), (State::Done, 3, 0));

    // Side by side stands what the runs themselves say.
    assert_eq!(campaign.results.len(), 2 * 2 + 1);
    for row in &campaign.results {
        let (old, new) = (row.old.as_ref().unwrap(), row.new.as_ref().unwrap());
        assert!(
            old.hardware_class != new.hardware_class && new.hardware_class == campaign.hardware_class && row.same_file
        );
        assert_eq!((old.oracle, new.oracle), (Some(ocb_core::oracle::VERSION), Some(ocb_core::oracle::VERSION)));
        for side in [old, new] {
            let run = engine.run(&side.run, None).await.unwrap();
            let result = run.results.iter().find(|result| result.algorithm == row.algorithm).unwrap();
            assert_eq!(side.median_ns, result.time.map(|time| time.median_ns));
            assert_eq!((side.n, side.wrong), (result.n, result.wrong));
            assert_eq!(side.hardware_class, run.environment.unwrap().hardware_class);
        }
        let (run, before) = (engine.run(&new.run, None).await.unwrap(), engine.run(&old.run, None).await.unwrap());
        assert_eq!(
            (run.campaign.as_deref(), run.rerun_of.as_deref()),
            (Some(made.id.as_str()), Some(old.run.as_str()))
        );
        assert_eq!(run.spec, before.spec);
        let ratio = new.median_ns.unwrap().value / old.median_ns.unwrap().value;
        let told = row.ratio.unwrap();
        assert!(told.value == ratio && told.lo <= ratio && ratio <= told.hi);
    }
    let csv = String::from_utf8(ocb_service::campaign_csv(&campaign.results).unwrap()).unwrap();
    assert!(csv.starts_with("algorithm,question,scene,") && csv.lines().count() == 6, "{csv}");

    // The old run is as it was; the new one is its owner's, who is told once.
    let mut now = engine.run(&agreed.id, Some(&ada.owner())).await.unwrap();
    now.mine = false;
    assert_eq!(now, agreed);
    let runs = engine.runs(&ada.owner(), &Page::default()).await.unwrap().entries;
    let repeated: Vec<_> = runs.iter().filter(|run| run.rerun_of.as_deref() == Some(agreed.id.as_str())).collect();
    assert!(repeated.len() == 1 && repeated[0].mine && repeated[0].visibility == Visibility::Public);
    let told = engine.notices(&ada, &Page::default()).await.unwrap().entries;
    assert_eq!(told.len(), 1);
    assert_eq!(told[0].link, format!("/campaigns/{}", made.id));
    assert!(told[0].text.contains("One of your public runs was measured again: A new machine."), "{}", told[0].text);

    // All of it is of now, and the machine from before was measured, too.
    let nothing = engine.create_campaign(None, asked(), None).await;
    assert!(matches!(nothing, Err(EngineError::Busy(_))), "{nothing:#?}");
    let listed = engine.campaigns(&Page::default()).await.unwrap().entries;
    assert!(listed.len() == 1 && listed[0].results.is_empty());
    let log = engine.audit(&format!("campaign:{}", made.id)).await.unwrap();
    assert_eq!((log[0].actor.as_str(), log[0].action.as_str()), ("the operator", "campaign created"));
    engine.shutdown().await;
    let engine = Engine::open(config(data.path(), "old")).await.unwrap();
    let nothing = engine.create_campaign(None, asked(), None).await;
    assert!(matches!(nothing, Err(EngineError::Busy(_))), "{nothing:#?}");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_another_oracle_judged_is_queued_whole_also_when_the_service_ended_halfway() {
    let _alone = alone().await;
    let (data, _, agreed) = measured_before().await;
    let oracle = |version: u32| format!("\"oracle\":{version}");
    let (now, before) = (oracle(ocb_core::oracle::VERSION), oracle(ocb_core::oracle::VERSION - 1));
    assert_eq!(
        edit(data.path(), format!("UPDATE runs SET set_info = replace(set_info, '{now}', '{before}')")).await,
        5
    );
    let idle = || EngineConfig { dispatch: false, ..config(data.path(), "old") };
    let engine = Engine::open(idle()).await.unwrap();
    let (made, _) = engine.create_campaign(None, asked(), None).await.unwrap();
    assert_eq!((made.runs.waiting, made.state), (3, State::Running));
    engine.shutdown().await;

    // As if the service had been killed when one of them was queued.
    let last = format!("SELECT id FROM runs WHERE rerun_of = '{}'", agreed.id);
    for text in [
        "DELETE FROM run_stages WHERE run_id IN",
        "DELETE FROM run_events WHERE run_id IN",
        "DELETE FROM runs WHERE id IN",
    ] {
        edit(data.path(), format!("{text} ({last})")).await;
    }
    assert_eq!(edit(data.path(), "UPDATE campaigns SET queued_us = NULL".into()).await, 1);
    let engine = Engine::open(config(data.path(), "old")).await.unwrap();
    let campaign = ended(&engine, &made.id).await;
    assert_eq!((campaign.runs.done, campaign.results.len()), (3, 5));
    let of =
        |side: fn(&ocb_service::model::Compared) -> Option<u32>| campaign.results.iter().map(side).collect::<Vec<_>>();
    assert_eq!(of(|row| row.old.as_ref()?.oracle), [Some(ocb_core::oracle::VERSION - 1); 5]);
    assert_eq!(of(|row| row.new.as_ref()?.oracle), [Some(ocb_core::oracle::VERSION); 5]);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn cancelling_ends_what_waits_and_so_does_another_machine() {
    let _alone = alone().await;
    let (data, ada, _) = measured_before().await;
    let idle = |note| EngineConfig { dispatch: false, ..config(data.path(), note) };
    let engine = Engine::open(idle("new")).await.unwrap();
    let (first, _) = engine.create_campaign(None, asked(), None).await.unwrap();
    let cancelled = engine.cancel_campaign(None, &first.id).await.unwrap();
    assert_eq!((cancelled.state, cancelled.runs.cancelled, cancelled.runs.waiting), (State::Cancelled, 3, 0));
    assert!(cancelled.ended_us.is_some() && cancelled.results.iter().all(|row| row.old.is_some() && row.new.is_none()));
    assert_eq!(engine.cancel_campaign(None, &first.id).await.unwrap(), cancelled, "cancelling twice changes nothing");
    assert!(engine.notices(&ada, &Page::default()).await.unwrap().entries.is_empty(), "nothing was measured");
    let missing = engine.cancel_campaign(None, "nonsense").await;
    assert!(matches!(missing, Err(EngineError::NotFound(_))));
    let nothing = CampaignRequest { suite: false, people: false, ..asked() };
    assert!(matches!(engine.create_campaign(None, nothing, None).await, Err(EngineError::Invalid(_))));
    let silent = CampaignRequest { reason: " ".into(), ..asked() };
    assert!(matches!(engine.create_campaign(None, silent, None).await, Err(EngineError::Invalid(_))));

    // What was cancelled is due again. On a third machine it would be measured under a wrong name.
    let preview = engine.preview_campaign(true, true, None).await.unwrap();
    let (second, _) = engine.create_campaign(None, asked(), None).await.unwrap();
    assert_eq!(second.runs.waiting, 3);
    // Foretold is what the runs are then expected to take, their configurations being there.
    let told = (preview.expected_seconds, second.runs.expected_seconds);
    assert!(told.0 > 3.0 * 0.5 && (told.0 - told.1).abs() < 1e-9, "{told:?}");
    engine.shutdown().await;
    let engine = Engine::open(config(data.path(), "third")).await.unwrap();
    let cancelled = engine.campaign(&second.id, None).await.unwrap();
    assert_eq!((cancelled.state, cancelled.runs.cancelled), (State::Cancelled, 3));
    assert_eq!(cancelled.runs.expected_seconds, 0.0);
    engine.shutdown().await;
}

/// A plugin that describes itself as ours does, and crashes when it is asked anything.
#[expect(clippy::disallowed_methods, reason = "the test compiles a plugin")]
fn crashing(folder: &Path) -> PathBuf {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let template = std::fs::read_to_string(top.join("plugin-api/templates/c/my_plugin.c")).unwrap();
    let crash = template
        .replace("my-algorithm-c", "sphere-tree")
        .replace("    (void)request;\n", "    (void)request;\n    __builtin_trap();\n");
    assert!(crash.contains("__builtin_trap") && crash.contains("sphere-tree"), "the template has changed");
    let (source, library) = (folder.join("crash.c"), folder.join("crash.so"));
    std::fs::write(&source, crash).unwrap();
    let mut cc = std::process::Command::new("cc");
    cc.args(["-std=c11", "-O1", "-fPIC", "-shared", "-fvisibility=hidden", "-I"]).arg(top.join("plugin-api/include"));
    assert!(cc.arg(&source).arg("-o").arg(&library).status().unwrap().success());
    library
}

/// Sends a plugin that this service has not installed, and makes it public.
async fn publish(engine: &Engine, author: &AccountInfo, curator: &AccountInfo, file: &Path) -> PluginInfo {
    let manifest = Manifest {
        name: "Sphere tree".into(),
        version: "1.0".into(),
        authors: "Somebody".into(),
        license: "MIT".into(),
        paper: String::new(),
        source: String::new(),
        queries: vec![Query::CollisionFirst, Query::CollisionAll, Query::Proximity],
        threads: false,
    };
    let bytes = std::fs::read(file).unwrap();
    let id = engine.submit_plugin(author, "tree.so", bytes, manifest, None).await.unwrap().0.id;
    for _ in 0..2400 {
        let plugin = engine.plugin(&id, Some(author)).await.unwrap();
        if !plugin.state.is_checking() {
            assert_eq!(plugin.state, PluginState::Validated, "{}", plugin.reason);
            break;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    let step = |action| Decision { action, reason: String::new() };
    engine.decide(&id, author, step(Action::Offer)).await.unwrap();
    engine.decide(&id, curator, step(Action::Approve)).await.unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn who_crashes_on_the_new_class_is_taken_out_there_and_nobody_for_our_faults() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(config(data.path(), "old")).await.unwrap();
    let old_class = engine.status().await.unwrap().hardware_class;
    let author = account(&engine, "author", Role::Developer).await;
    let curator = account(&engine, "curator", Role::Curator).await;
    let file = config(data.path(), "old").runner.with_file_name("libocb_sphere_tree.so");
    let plugin = publish(&engine, &author, &curator, &file).await;
    let waiting =
        async |engine: &Engine| engine.suite(None).await.unwrap().progress.iter().map(|p| p.waiting).sum::<u32>();
    while waiting(&engine).await > 0 {
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    engine.shutdown().await;

    // A jail that does not begin is our fault: everything fails, and nobody is taken out.
    let broken = data.path().join("broken-runner");
    std::fs::copy("/bin/false", &broken).unwrap();
    let engine = Engine::open(EngineConfig { runner: broken, ..config(data.path(), "new") }).await.unwrap();
    let (made, _) = engine.create_campaign(None, asked(), None).await.unwrap();
    let campaign = ended(&engine, &made.id).await;
    assert!(campaign.runs.failed >= 2 && campaign.runs.done == 0, "{:?}", campaign.runs);
    let failed = campaign.results.iter().filter_map(|row| row.new.as_ref());
    assert!(
        failed.clone().count() > 0 && failed.clone().all(|new| new.outcome == OutcomeName::SandboxFault),
        "{:?}",
        failed.collect::<Vec<_>>()
    );
    assert_eq!(engine.plugin(&plugin.id, None).await.unwrap().state, PluginState::Public);
    engine.shutdown().await;

    // As if these were its bytes from the beginning: on the machine before they did not crash.
    let crash = std::fs::read(crashing(data.path())).unwrap();
    let (old, new) = (&plugin.sha256, ocb_service::sha256_hex(&crash));
    std::fs::write(data.path().join("plugins").join(format!("{new}.so")), crash).unwrap();
    let same = format!("SELECT '{new}', bytes, media_type, created_us FROM blobs WHERE sha256 = '{old}'");
    edit(data.path(), format!("INSERT INTO blobs (sha256, bytes, media_type, created_us) {same}")).await;
    let text = format!("blob = '{new}', algorithms = replace(algorithms, '{old}', '{new}')");
    assert_eq!(edit(data.path(), format!("UPDATE submissions SET {text}")).await, 1);
    let text = format!("plugin_sha256 = '{new}' WHERE plugin_sha256 = '{old}'");
    assert!(edit(data.path(), format!("UPDATE results SET {text}")).await >= 4);
    let engine = Engine::open(config(data.path(), "new")).await.unwrap();
    let (made, _) = engine.create_campaign(None, asked(), None).await.unwrap();
    let campaign = ended(&engine, &made.id).await;
    let now = engine.plugin(&plugin.id, Some(&author)).await.unwrap();
    let class = campaign.hardware_class.as_str();
    let mut told = format!("{:?}", campaign.runs);
    for row in &campaign.results {
        let run = engine.run(&row.run, None).await.unwrap();
        let outcomes: Vec<_> = run.results.iter().map(|result| result.outcome.message.clone()).collect();
        told += &format!("\n{} {:?} {:?} {outcomes:?}", row.algorithm, run.state, run.message);
    }
    assert_eq!((now.state, now.excluded_on.as_deref()), (PluginState::Excluded, Some(class)), "{told}");
    assert_eq!(now.hardware_class.as_deref(), Some(old_class.as_str()), "its check was elsewhere");
    let crash = campaign
        .results
        .iter()
        .find(|row| row.new.as_ref().is_some_and(|new| new.outcome == OutcomeName::Signaled))
        .unwrap();
    for part in [class, "sphere-tree", "torus-knot@600", "The plugin crashed", &format!("/r/{}", crash.run)] {
        assert!(now.reason.contains(part), "{part}: {}", now.reason);
    }
    let last = now.history.last().unwrap();
    assert_eq!((last.actor.as_str(), last.action.as_str(), &last.detail), ("the service", "excluded", &now.reason));
    let told = engine.notices(&author, &Page::default()).await.unwrap().entries;
    let of_it: Vec<_> =
        told.iter().filter(|notice| notice.subject.contains("is excluded on the hardware class")).collect();
    assert_eq!(of_it.len(), 1, "{told:?}");
    assert!(of_it[0].text.contains("The plugin crashed") && of_it[0].link == format!("/p/{}", plugin.id));
    // Its other run waited and is ended; those of other plugins go on.
    let runs = campaign.runs;
    assert_eq!((runs.done, runs.failed, runs.cancelled), (2, 1, 1), "{runs:?}");
    assert!(
        campaign.results.iter().any(|row| row.algorithm == "box-tree" && row.new.as_ref().is_some_and(|new| new.n > 0))
    );
    assert!(engine.algorithms(None).iter().all(|algorithm| algorithm.id != "sphere-tree"));

    // On the old class its results keep their place.
    let board = async |hardware: &str| {
        let request =
            BoardRequest { hardware: Some(hardware.into()), suite: Some("7".into()), ..BoardRequest::default() };
        engine.board(&request, None).await.unwrap().rows.into_iter().find(|row| row.algorithm == "sphere-tree")
    };
    let excluded =
        |reason: Option<String>| reason.is_some_and(|reason| reason.contains("excluded on this hardware class"));
    assert!(!excluded(board(&old_class).await.unwrap().reason));
    assert_eq!(board(class).await, None, "where nothing of it was measured it is not");

    // A curator who knows better is not overruled by what was found before.
    let step = Decision { action: Action::Reinstate, reason: "Mended elsewhere.".into() };
    assert_eq!(engine.decide(&plugin.id, &curator, step).await.unwrap().excluded_on, None);
    engine.shutdown().await;
    edit(data.path(), "UPDATE campaigns SET ended_us = NULL".into()).await;
    let engine = Engine::open(config(data.path(), "new")).await.unwrap();
    assert_eq!(engine.plugin(&plugin.id, None).await.unwrap().state, PluginState::Public);
    engine.shutdown().await;
}
