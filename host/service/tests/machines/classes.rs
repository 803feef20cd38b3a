//! Machines of several hardware classes, and idle work on machines.

use std::time::{Duration, Instant};

use ocb_service::model::{CampaignRequest, RunInfo, RunSpec, State};
use ocb_service::{Engine, EngineConfig, EngineError};

use crate::{NOW, alone, common, config, hand_in, order, small};

#[tokio::test(flavor = "multi_thread")]
async fn machines_of_several_hardware_classes_get_the_runs_of_theirs() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let config = EngineConfig { suite: Some(common::small_suite(data.path())), ..config(data.path()) };
    let engine = Engine::open(config.clone()).await.unwrap();
    let workers = [common::here(&config), common::noted(&config, "another memory")];
    let [usual, other] = [0, 1].map(|place: usize| workers[place].facts().clone());
    assert_ne!(usual.hardware_class, other.hardware_class);
    for (machine, facts) in [("alpha", &usual), ("beta", &other)] {
        engine.add_machine(machine).await.unwrap();
        assert!(common::next(&engine, machine, facts, NOW).await.unwrap().is_none());
    }
    let on = |class: Option<&str>| RunSpec { hardware_class: class.map(str::to_owned), ..small(&["box-tree"]) };
    let refused = engine.submit(on(Some("0123456789abcdef")), Some("me")).await;
    let named = |why: &str| why.contains("0123456789abcdef") && why.contains(&other.hardware_class);
    assert!(matches!(&refused, Err(EngineError::Invalid(why)) if named(why)), "{refused:?}");
    // Two for the other class, then one for no class.
    let first = engine.submit(on(Some(&other.hardware_class)), Some("me")).await.unwrap();
    let second = engine.submit(on(Some(&other.hardware_class)), Some("me")).await.unwrap();
    let plain = engine.submit(on(None), Some("me")).await.unwrap();
    let ahead = async |run: &RunInfo| engine.run(&run.id, None).await.unwrap().runs_ahead;
    assert_eq!((ahead(&second).await, ahead(&plain).await), (1, 0), "each class has its queue");
    // One that is being prepared does not wait.
    let begun = Instant::now();
    loop {
        let waits: Vec<u32> = engine.status().await.unwrap().classes.iter().map(|class| class.queued).collect();
        if waits == [1, 2] {
            break;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "{waits:?} wait");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    let expected = engine.estimate(&on(Some(&other.hardware_class)), Some("me")).await.unwrap();
    assert_eq!((expected.runs_ahead, engine.estimate(&on(None), Some("me")).await.unwrap().runs_ahead), (2, 1));
    let of_plain = order(&engine, "alpha", &usual).await;
    assert_eq!(of_plain.run, plain.id, "though the others were asked for before");
    let of_first = order(&engine, "beta", &other).await;
    assert_eq!(of_first.run, first.id);
    let [here, there] = workers;
    let (_, handed) = common::measured(&engine, "beta", there, &of_first).await;
    assert!(hand_in(&engine, "beta", &of_first, handed).await);
    let measured = engine.run(&first.id, None).await.unwrap();
    assert_eq!(measured.environment.unwrap().hardware_class, other.hardware_class);
    engine.cancel(&second.id, Some("me")).await.unwrap();
    let (_, handed) = common::measured(&engine, "alpha", here, &of_plain).await;
    assert!(hand_in(&engine, "alpha", &of_plain, handed).await);
    // The suite is measured on both, and a campaign on the one that it names.
    let queued = engine.measure_suite(&["box-tree".to_owned()]).await.unwrap();
    let classes: Vec<_> = queued.iter().map(|run| run.spec.hardware_class.as_deref()).collect();
    assert_eq!(classes, [None, Some(other.hardware_class.as_str())]);
    for class in [&usual.hardware_class, &other.hardware_class] {
        let suite = engine.suite(Some(class)).await.unwrap();
        let of = |id: &str| suite.progress.iter().find(|it| it.algorithm == id).map(|it| (it.waiting, it.of)).unwrap();
        assert_eq!((of("box-tree"), of("brute-force"), suite.hardware_classes.len()), ((1, 1), (0, 1), 2));
    }
    engine.end_suite_runs(&queued[1..]).await.unwrap();
    let waiting = async |class: Option<&str>| {
        engine.suite(class).await.unwrap().progress.iter().map(|it| it.waiting).sum::<u32>()
    };
    assert_eq!((waiting(None).await, waiting(Some(&other.hardware_class)).await), (1, 0));
    let preview = engine.preview_campaign(true, false, Some(&other.hardware_class)).await.unwrap();
    assert_eq!(preview.hardware_class, other.hardware_class);
    let asked = CampaignRequest {
        reason: "New machines".into(),
        suite: true,
        people: false,
        hardware_class: Some(other.hardware_class.clone()),
    };
    let (campaign, _) = engine.create_campaign(None, asked, None).await.unwrap();
    assert_eq!((campaign.hardware_class.as_str(), campaign.state), (other.hardware_class.as_str(), State::Running));
    let runs = u64::from(campaign.runs.waiting + campaign.runs.running);
    assert_eq!((runs, waiting(None).await), (u64::from(preview.suite_runs), 1), "all for the other class");
    // Without its machine the class is gone, and the other one is the usual one.
    engine.revoke_machine("alpha").await.unwrap();
    assert!(common::next(&engine, "beta", &other, NOW).await.is_ok());
    let status = engine.status().await.unwrap();
    assert_eq!((status.hardware_class, status.classes.len()), (other.hardware_class, 1));
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn idle_machines_measure_the_suite_and_give_way_to_a_visitor() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let config = EngineConfig { suite: Some(common::small_suite(data.path())), idle: true, ..config(data.path()) };
    let plugins = vec![config.plugins.iter().find(|file| file.ends_with("libocb_box_tree.so")).unwrap().clone()];
    let config = EngineConfig { plugins, ..config };
    let engine = Engine::open(config.clone()).await.unwrap();
    engine.add_machine("alpha").await.unwrap();
    let worker = common::here(&config);
    let facts = worker.facts().clone();
    let idle = order(&engine, "alpha", &facts).await;
    assert_eq!(engine.suite(None).await.unwrap().progress[0].waiting, 1);
    assert!(engine.beat_of("alpha", &idle.attempt, Vec::new()).await.unwrap(), "nobody else waits");
    let run = engine.submit(small(&["box-tree"]), Some("me")).await.unwrap();
    assert_eq!(run.runs_ahead, 0, "idle work delays no run");
    let asked = Instant::now();
    while engine.beat_of("alpha", &idle.attempt, Vec::new()).await.unwrap() {
        assert!(asked.elapsed() < Duration::from_secs(60), "it gives way when the run is prepared");
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    let of_visitor = order(&engine, "alpha", &facts).await;
    assert_eq!(of_visitor.run, run.id);
    let put_back = engine.run(&idle.run, None).await.unwrap();
    assert_eq!((put_back.state, put_back.attempts), (State::Queued, 0));
    let (worker, handed) = common::measured(&engine, "alpha", worker, &of_visitor).await;
    assert!(hand_in(&engine, "alpha", &of_visitor, handed).await);
    let again = order(&engine, "alpha", &facts).await;
    assert_eq!((again.run.as_str(), again.attempt == idle.attempt), (idle.run.as_str(), false));
    let (_, handed) = common::measured(&engine, "alpha", worker, &again).await;
    assert!(hand_in(&engine, "alpha", &again, handed).await);
    assert_eq!(engine.suite(None).await.unwrap().progress[0].measured, 1);
    engine.shutdown().await;
}
