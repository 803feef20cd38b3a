//! Checks of plugins, parts of stability runs, replays and advice on machines.

use std::sync::{Arc, Mutex};

use ocb_service::LabError;
use ocb_service::model::{
    Action, AdviceSpec, Asked, CellState, Decision, Ended, Errand, NextWork, PluginInfo, PluginState, ReduceTerms,
    Sentinel, Side, StabilityRunInfo, StabilitySpec, State, Told, Track, Wanted, WorkloadResult, WorkloadSpec,
};
use ocb_service::worker::{Handed, Report, Worker};
use ocb_service::{Ceilings, Engine, EngineConfig, EngineError, Handing, Profile, Stop, Visitor};
use tempfile::TempDir;
use tokio::runtime::Handle;
use tokio::sync::MutexGuard;

use crate::{AccountInfo, Duration, MachineFacts, NOW, Role, alone, common, config, small};

/// Of a class whose machines do more than runs.
pub async fn next_errand(engine: &Engine, machine: &str, facts: &MachineFacts) -> Option<Errand> {
    loop {
        match engine.next_order(machine, facts, NOW).await.unwrap() {
            NextWork::Errand(errand) => return Some(*errand),
            NextWork::Run(order) => panic!("the run {}", order.run),
            NextWork::Nothing => return None,
            NextWork::Sentinel(_) => {
                engine.sentinel_of(machine, Sentinel::Measured { median_ns: 1000.0 }).await.unwrap();
            }
        }
    }
}

/// Does the errand in this process; also what it tells.
pub async fn done(engine: &Engine, machine: &str, worker: Worker, errand: &Errand) -> (Worker, Handed, Vec<Told>) {
    let (engine, machine, errand, handle) = (engine.clone(), machine.to_owned(), errand.clone(), Handle::current());
    // Other tests may measure for longer than a lease.
    let (beats, of) = (engine.clone(), (machine.clone(), errand.attempt.clone()));
    let beating = tokio::spawn(async move {
        loop {
            tokio::time::sleep(Duration::from_secs(2)).await;
            let _ = beats.beat_of(&of.0, &of.1, Vec::new()).await;
        }
    });
    let told: Arc<Mutex<Vec<Told>>> = Arc::default();
    let heard = told.clone();
    let work = move || {
        let fetch = |name: &str| {
            let file = handle.block_on(engine.file_of_order(&machine, &errand.attempt, name));
            file.map_err(|e| LabError::Fault(e.to_string()))
        };
        let mut tell = |report| {
            if let Report::Told(told) = report {
                heard.lock().unwrap().push(told);
            }
        };
        let handed = worker.run_errand(&errand, &Stop::default(), &fetch, &mut tell).unwrap().unwrap();
        (worker, handed)
    };
    let (worker, handed) = tokio::task::spawn_blocking(work).await.unwrap();
    beating.abort();
    let told = std::mem::take(&mut *told.lock().unwrap());
    (worker, handed, told)
}

async fn hand_in(engine: &Engine, machine: &str, errand: &Errand, ended: Ended) -> Result<bool, EngineError> {
    engine.hand_in(machine, &errand.attempt, Handing { ended, files: Vec::new() }).await
}

fn is_refused(answer: &Result<bool, EngineError>) -> bool {
    matches!(answer, Err(EngineError::Invalid(_)))
}

/// A service with two machines, the first of which is this process, and an author.
async fn site() -> ((MutexGuard<'static, ()>, TempDir), Engine, Worker, AccountInfo) {
    let here = (alone().await, tempfile::tempdir().unwrap());
    let settings = EngineConfig { profile: Profile::Dev, ..config(here.1.path()) };
    let engine = Engine::open(settings.clone()).await.unwrap();
    let worker = common::here(&settings);
    for machine in ["alpha", "beta"] {
        engine.add_machine(machine).await.unwrap();
        assert_eq!(next_errand(&engine, machine, worker.facts()).await, None);
    }
    let author = engine.add_account("author", "a long enough password", Role::Developer).await.unwrap();
    (here, engine, worker, author)
}

/// A plugin whose answers are slow or not, sent by its author.
async fn sent(engine: &Engine, author: &AccountInfo, folder: &TempDir, query_ms: u32) -> PluginInfo {
    let bytes = std::fs::read(common::slow(folder.path(), 0, query_ms, 1)).unwrap();
    engine.submit_plugin(author, "slow.so", bytes, common::manifest(), None).await.unwrap().0
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_checks_a_plugin_and_its_report_counts_once() {
    let ((_alone, folder), engine, worker, author) = site().await;
    let facts = worker.facts().clone();
    let plugin = sent(&engine, &author, &folder, 0).await;
    let errand = next_errand(&engine, "alpha", &facts).await.expect("the check");
    assert_eq!((errand.job.as_str(), errand.wanted.name()), (plugin.id.as_str(), "the check of the plugin"));
    assert_eq!(next_errand(&engine, "beta", &facts).await, None, "nobody else gets it");
    let Wanted::Check { plugin_sha256, .. } = &errand.wanted else { panic!("a check") };
    let file = format!("plugin-{plugin_sha256}");
    for (machine, name) in [("beta", file.as_str()), ("alpha", "a"), ("alpha", "plugin-")] {
        let refused = engine.file_of_order(machine, &errand.attempt, name).await;
        assert!(matches!(refused, Err(EngineError::NotFound(_))), "{machine} {name}");
    }

    let (_, handed, told) = done(&engine, "alpha", worker, &errand).await;
    let Ended::Checked { report } = handed.ended.clone() else { panic!("it was checked") };
    let lines = told.iter().filter(|told| matches!(told, Told::Line { .. })).count();
    assert!(report.passed && lines == report.lines.len() && told.contains(&Told::Loads), "{report:?}");
    // The first line arrives, twice; the others are lost.
    for _ in 0..2 {
        assert!(engine.beat_of("alpha", &errand.attempt, vec![told[0].clone(), Told::Loads]).await.unwrap());
    }
    let seen = engine.plugin(&plugin.id, Some(&author)).await.unwrap();
    assert_eq!((seen.state, seen.lines.len()), (PluginState::Vetted, 1));

    let mut other = report.clone();
    other.sha256 = Some("0".repeat(64));
    assert!(is_refused(&hand_in(&engine, "alpha", &errand, Ended::Checked { report: other }).await));
    let none = Ended::Measured { algorithms: Vec::new(), environment: None, preview: None };
    assert!(is_refused(&hand_in(&engine, "alpha", &errand, none).await));
    assert!(!hand_in(&engine, "beta", &errand, handed.ended.clone()).await.unwrap());
    assert!(hand_in(&engine, "alpha", &errand, handed.ended.clone()).await.unwrap());
    assert!(!hand_in(&engine, "alpha", &errand, handed.ended).await.unwrap(), "once");
    let seen = engine.plugin(&plugin.id, Some(&author)).await.unwrap();
    assert_eq!((seen.state, &seen.lines), (PluginState::Validated, &report.lines));
    assert!(seen.reason.contains(&facts.hardware_class), "{}", seen.reason);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_check_that_a_machine_did_not_end_waits_for_another() {
    let ((_alone, folder), engine, worker, author) = site().await;
    let facts = worker.facts();
    let plugin = sent(&engine, &author, &folder, 0).await;
    let state = async || engine.plugin(&plugin.id, Some(&author)).await.unwrap().state;
    let first = next_errand(&engine, "alpha", facts).await.unwrap();
    assert!(hand_in(&engine, "alpha", &first, Ended::PutBack).await.unwrap());
    assert_eq!(state().await, PluginState::Uploaded);
    // Who asks again has forgotten what it had.
    let second = next_errand(&engine, "alpha", facts).await.unwrap();
    assert!(engine.beat_of("alpha", &second.attempt, vec![Told::Loads]).await.unwrap());
    let third = next_errand(&engine, "alpha", facts).await.unwrap();
    assert!(!engine.beat_of("alpha", &second.attempt, vec![Told::Loads]).await.unwrap());
    let failed = Ended::Failed { message: "its disk is full".into() };
    assert!(hand_in(&engine, "alpha", &third, failed).await.unwrap());
    assert!(matches!(engine.next_order("alpha", facts, NOW).await, Err(EngineError::TooMuch { .. })), "it rests");
    let fourth = next_errand(&engine, "beta", facts).await.unwrap();
    assert_eq!((state().await, &fourth.job), (PluginState::Uploaded, &plugin.id));
    // The author ends it, and the machine hears of that.
    let end = Decision { action: Action::EndCheck, reason: String::new() };
    engine.decide(&plugin.id, &author, end).await.unwrap();
    assert!(!engine.beat_of("beta", &fourth.attempt, Vec::new()).await.unwrap());
    assert_eq!(next_errand(&engine, "beta", facts).await, None);
    assert_eq!(state().await, PluginState::Failed);
    engine.shutdown().await;
}

async fn started(engine: &Engine, owner: &str, parts: &[&str]) -> StabilityRunInfo {
    let parts = parts.iter().map(|part| (*part).to_owned()).collect();
    let spec = StabilitySpec { algorithm: "box-tree".into(), parts, seeds: Some(1) };
    let visitor = Visitor { owner: owner.into(), address: None };
    engine.start_stability(spec, &visitor, None).await.unwrap().0
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_tries_a_stability_run_part_by_part_with_runs_between() {
    let ((_alone, _folder), engine, worker, _) = site().await;
    let facts = worker.facts().clone();
    let trying = started(&engine, "me", &["vertex-face", "edge-edge"]).await;
    let first = next_errand(&engine, "alpha", &facts).await.expect("its first part");
    let (worker, handed, _) = done(&engine, "alpha", worker, &first).await;
    let Ended::Tried { found, seconds } = handed.ended.clone() else { panic!("it was tried") };
    assert_eq!((found.families.len(), seconds > 0.0), (1, true));
    let mut other = found.clone();
    other.plugin_sha256 = "0".repeat(64);
    for wrong in [Ended::Tried { found: other, seconds }, Ended::Tried { found, seconds: f64::NAN }] {
        assert!(is_refused(&hand_in(&engine, "alpha", &first, wrong).await));
    }
    assert!(hand_in(&engine, "alpha", &first, handed.ended.clone()).await.unwrap());
    assert!(!hand_in(&engine, "alpha", &first, handed.ended).await.unwrap(), "once");
    let now = engine.stability_run(&trying.id).await.unwrap();
    assert_eq!((now.state, now.done, now.total), (State::Running, 1, 2));

    // A run that waits comes before the next part.
    let run = engine.submit(small(&["box-tree"]), Some("you")).await.unwrap();
    let between = loop {
        match engine.next_order("alpha", &facts, NOW).await.unwrap() {
            // It is not prepared yet.
            NextWork::Errand(errand) => {
                assert!(hand_in(&engine, "alpha", &errand, Ended::PutBack).await.unwrap());
                tokio::time::sleep(Duration::from_millis(50)).await;
            }
            NextWork::Run(order) => break order,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(between.run, run.id);
    let second = next_errand(&engine, "beta", &facts).await.expect("its second part");
    let (worker, handed, _) = done(&engine, "beta", worker, &second).await;
    assert!(hand_in(&engine, "beta", &second, handed.ended).await.unwrap());
    let now = engine.stability_run(&trying.id).await.unwrap();
    let found = now.result.expect("a result");
    let names: Vec<&str> = found.families.iter().map(|family| family.family.as_str()).collect();
    assert_eq!((now.state, found.complete, names), (State::Done, true, vec!["vertex-face", "edge-edge"]));
    let steps: usize = found.families.iter().map(|family| family.steps.len()).sum();
    assert!(
        steps > 1 && found.families.iter().all(|it| matches!(it.state, CellState::Agrees | CellState::Slow)),
        "{found:?}"
    );

    // Another class does nothing but runs.
    started(&engine, "me", &["vertex-face"]).await;
    let other = MachineFacts { hardware_class: "0123456789abcdef".into(), ..worker.facts().clone() };
    engine.add_machine("gamma").await.unwrap();
    assert_eq!(next_errand(&engine, "gamma", &other).await, None);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn how_a_machine_ends_a_stability_run_is_told_to_its_owner() {
    let _alone = alone().await;
    let folder = tempfile::tempdir().unwrap();
    let ceilings = Ceilings { guest_run: Duration::from_secs(90), ..Ceilings::default() };
    let settings = EngineConfig { ceilings, ..config(folder.path()) };
    let engine = Engine::open(settings.clone()).await.unwrap();
    let facts = common::here(&settings).facts().clone();
    engine.add_machine("alpha").await.unwrap();
    let guest = uuid::Uuid::now_v7().to_string();
    let ends: [(Ended, State, &str); 3] = [
        (Ended::TooLong, State::Cancelled, "the time limit for guests"),
        (Ended::Impossible { message: "It cannot be tried.".into() }, State::Failed, "It cannot be tried."),
        (Ended::PutBack, State::Running, ""),
    ];
    for (ended, state, words) in ends {
        let trying = started(&engine, &guest, &["vertex-face"]).await;
        let errand = next_errand(&engine, "alpha", &facts).await.unwrap();
        assert_eq!((&errand.job, errand.most_seconds), (&trying.id, Some(90.0)));
        assert!(hand_in(&engine, "alpha", &errand, ended).await.unwrap());
        let now = engine.stability_run(&trying.id).await.unwrap();
        assert_eq!(now.state, state, "{now:?}");
        assert!(now.message.unwrap_or_default().contains(words));
    }
    // Three machines that fail end it, and its owner is told.
    let mut trying = String::new();
    for machine in ["beta", "gamma", "delta", "epsilon"] {
        engine.add_machine(machine).await.unwrap();
        let Some(errand) = next_errand(&engine, machine, &facts).await else { break };
        trying.clone_from(&errand.job);
        let failed = Ended::Failed { message: "its disk is full".into() };
        assert!(hand_in(&engine, machine, &errand, failed).await.unwrap());
    }
    let now = engine.stability_run(&trying).await.unwrap();
    assert_eq!(now.state, State::Failed, "{now:?}");
    assert!(now.message.unwrap().contains("not tried again"));

    // What somebody cancels is stopped on the machine.
    let trying = started(&engine, &guest, &["vertex-face"]).await;
    engine.add_machine("zeta").await.unwrap();
    let errand = next_errand(&engine, "zeta", &facts).await.unwrap();
    engine.cancel_stability(&trying.id, Some(&guest)).await.unwrap();
    assert!(!engine.beat_of("zeta", &errand.attempt, Vec::new()).await.unwrap());
    assert!(!hand_in(&engine, "zeta", &errand, Ended::PutBack).await.unwrap());
    engine.shutdown().await;
}

/// A recording of a ball that comes near a knot, as a file.
fn recording(folder: &TempDir) -> Vec<u8> {
    let knot = ocb_core::mesh::obj::write(&ocb_core::stock::generate("torus-knot", 600).unwrap());
    std::fs::write(folder.path().join("knot.obj"), knot).unwrap();
    let query = |i: u32| {
        let pose_b = [1.0, 0.0, 0.0, 0.1 * f64::from(i), 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        serde_json::json!({ "objects": ["knot", "ball"], "query": "distance", "pose_b": pose_b, "group": i / 4 })
    };
    let written = serde_json::json!({
        "objects": [{ "name": "knot", "file": "knot.obj" },
                    { "name": "ball", "geometry": { "kind": "sphere", "radius": 0.2 } }],
        "queries": (0..40).map(query).collect::<Vec<_>>(),
    });
    let file = folder.path().join("near.ocbrec");
    let recording = ocb_service::recording::from_json(written.to_string().as_bytes(), folder.path()).unwrap();
    recording.write(&file).unwrap();
    std::fs::read(file).unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_replays_a_recording_and_reduces_its_scene() {
    let ((_alone, folder), engine, worker, author) = site().await;
    let facts = worker.facts().clone();
    let visitor = Visitor { owner: author.owner(), address: None };
    let spec = WorkloadSpec {
        algorithms: vec!["box-tree".into()],
        tracks: vec![Track::Shuffled],
        passes: 1,
        budget_seconds: 5.0,
        seed: None,
        reduce: Some(ReduceTerms { tolerance: 0.05, near: 0.0, outside_only: false, frontier: false }),
    };
    let add = engine.add_workload("near.ocbrec", recording(&folder), spec.clone(), &visitor, None);
    let (workload, _) = add.await.unwrap();
    let errand = next_errand(&engine, "alpha", &facts).await.expect("the replay");
    let Wanted::Replay { spec: ordered, .. } = &errand.wanted else { panic!("a replay") };
    assert!(ordered.seed.is_some() && errand.job == workload.id && errand.most_seconds.is_none());
    assert!(matches!(engine.file_of_order("alpha", &errand.attempt, "a").await, Err(EngineError::NotFound(_))));

    let (_, handed, told) = done(&engine, "alpha", worker, &errand).await;
    let doing = |told: &Told| matches!(told, Told::Replaying { doing: Some(what), .. } if what.contains("Reducing"));
    let reduces = told.iter().find(|told| doing(told)).expect("it tells what it does").clone();
    assert!(engine.beat_of("alpha", &errand.attempt, vec![reduces]).await.unwrap());
    let now = engine.workload(&workload.id).await.unwrap();
    assert!(now.message.is_some_and(|what| what.contains("Reducing")));
    let Handed { ended: Ended::Replayed { result }, files } = &handed else { panic!("it was replayed") };
    assert_eq!((result.queries, files.len(), result.reduced.is_some()), (40, 2, true));
    let of = async |ended: Ended, files: &[Vec<u8>]| {
        engine.hand_in("alpha", &errand.attempt, Handing { ended, files: files.to_vec() }).await
    };
    let with = |change: &dyn Fn(&mut WorkloadResult)| {
        let mut result = result.clone();
        change(&mut result);
        Ended::Replayed { result }
    };
    assert!(is_refused(&of(with(&|it| it.tracks[0].algorithms[0].algorithm = "other".into()), files).await));
    assert!(is_refused(&of(with(&|it| it.queries = 41), files).await));
    assert!(is_refused(&of(with(&|it| it.reduced = None), files).await));
    assert!(is_refused(&of(with(&|_| ()), &files[..1]).await));
    assert!(is_refused(&of(with(&|_| ()), &[b"PAR1".to_vec(), files[1].clone()]).await));
    assert!(is_refused(&of(with(&|_| ()), &[files[0].clone(), b"PK".to_vec()]).await));
    assert!(of(with(&|_| ()), files).await.unwrap());
    assert!(!of(with(&|_| ()), files).await.unwrap(), "once");
    let now = engine.workload(&workload.id).await.unwrap();
    let found = now.result.expect("a result");
    assert_eq!((now.state, found.tracks[0].algorithms[0].wrong, found.reduced.is_some()), (State::Done, 0, true));

    // Another one is cancelled while a machine has it.
    let (again, _) = engine.replay_again(&workload.id, spec, &visitor, None).await.unwrap();
    let errand = next_errand(&engine, "beta", &facts).await.unwrap();
    engine.cancel_workload(&again.id, Some(&visitor.owner)).await.unwrap();
    assert!(!engine.beat_of("beta", &errand.attempt, Vec::new()).await.unwrap());
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_machine_makes_advice() {
    let _alone = alone().await;
    let folder = tempfile::tempdir().unwrap();
    let settings = EngineConfig { quick_advice: true, ..config(folder.path()) };
    let engine = Engine::open(settings.clone()).await.unwrap();
    let worker = common::here(&settings);
    let facts = worker.facts().clone();
    engine.add_machine("alpha").await.unwrap();
    let visitor = Visitor { owner: uuid::Uuid::now_v7().to_string(), address: None };
    let spec = AdviceSpec {
        object_a: "stock:torus-knot@1200".into(),
        object_b: None,
        question: Asked::Distance { tolerance: 0.05 },
    };
    let (asked, _) = engine.ask_advice(spec.clone(), &visitor, None).await.unwrap();
    let errand = next_errand(&engine, "alpha", &facts).await.expect("the advice");
    assert_eq!((&errand.job, errand.wanted.name()), (&asked.id, "the advice"));
    assert_eq!(engine.advice(&asked.id).await.unwrap().state, State::Running);
    for (name, there) in [("a", true), ("b", true), ("set", false)] {
        assert_eq!(engine.file_of_order("alpha", &errand.attempt, name).await.is_ok(), there, "{name}");
    }
    let (_, handed, told) = done(&engine, "alpha", worker, &errand).await;
    assert!(engine.beat_of("alpha", &errand.attempt, vec![told[0].clone()]).await.unwrap());
    let Told::Step { what, .. } = &told[0] else { panic!("{:?}", told[0]) };
    assert_eq!(&engine.advice(&asked.id).await.unwrap().step, what);
    let Ended::Advised { papers, .. } = &handed.ended else { panic!("advice was made") };
    assert!(!papers[0].is_empty(), "fewer triangles are enough");
    assert_eq!(papers.iter().map(Vec::len).sum::<usize>(), handed.files.len());
    let of = async |files: &[Vec<u8>]| {
        let handing = Handing { ended: handed.ended.clone(), files: files.to_vec() };
        engine.hand_in("alpha", &errand.attempt, handing).await
    };
    assert!(is_refused(&of(&[&handed.files[..], &[b"no mesh".to_vec()]].concat()).await));
    let Ended::Advised { advice, papers } = handed.ended.clone() else { panic!("advice was made") };
    let [mut other, mut foreign] = [papers.clone(), papers.clone()];
    other[0][0].certificate.reduced = "0".repeat(64);
    foreign[0][0].certificate.object = "0".repeat(64);
    let mut question = advice.clone();
    question.question = ocb_advice::Question::Distance { tolerance: 0.06 };
    let wrong = [(advice.clone(), other), (advice.clone(), foreign), (question, papers.clone())];
    for (advice, papers) in wrong {
        let handing = Handing { ended: Ended::Advised { advice, papers }, files: handed.files.clone() };
        assert!(is_refused(&engine.hand_in("alpha", &errand.attempt, handing).await));
    }
    assert!(of(&handed.files).await.unwrap());
    assert!(!of(&handed.files).await.unwrap(), "once");
    let now = engine.advice(&asked.id).await.unwrap();
    assert_eq!((now.state, now.advice.is_some()), (State::Done, true));
    for stage in 0..papers[0].len() {
        let (mesh, file) = engine.reduced(&asked.id, Side::A, stage).await.unwrap();
        assert!(!mesh.is_empty() && file.ends_with(".obj"), "{file}");
    }

    // One waits and is cancelled, one is cancelled on its machine, and three machines that fail end the last.
    let (waits, _) = engine.ask_advice(spec.clone(), &visitor, None).await.unwrap();
    assert_eq!(engine.cancel_advice(&waits.id, Some(&visitor.owner)).await.unwrap().state, State::Cancelled);
    let (begun, _) = engine.ask_advice(spec.clone(), &visitor, None).await.unwrap();
    let errand = next_errand(&engine, "alpha", &facts).await.unwrap();
    assert_eq!(errand.job, begun.id);
    assert_eq!(engine.cancel_advice(&begun.id, Some(&visitor.owner)).await.unwrap().state, State::Cancelled);
    assert!(!engine.beat_of("alpha", &errand.attempt, Vec::new()).await.unwrap());
    let (fails, _) = engine.ask_advice(spec, &visitor, None).await.unwrap();
    for machine in ["beta", "gamma", "delta", "epsilon"] {
        engine.add_machine(machine).await.unwrap();
        let Some(errand) = next_errand(&engine, machine, &facts).await else { break };
        let failed = Ended::Failed { message: "its disk is full".into() };
        assert!(hand_in(&engine, machine, &errand, failed).await.unwrap());
    }
    let now = engine.advice(&fails.id).await.unwrap();
    assert_eq!(now.state, State::Failed, "{now:?}");
    assert!(now.message.unwrap().contains("not tried again"));
    engine.shutdown().await;
}
