//! What a run shows before it has ended, in real processes.

mod common;

use std::fs::File;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::Duration;

use futures::StreamExt;
use ocb_core::comparison::compare;
use ocb_core::statistics::{Outliers, Statistic};
use ocb_core::stock;
use ocb_lab::algorithm::{Algorithm, Runner, plugin_hash};
use ocb_lab::configurations::{Gauge, make};
use ocb_lab::machine::{Machine, MeasuringRight};
use ocb_lab::measure::{Measured, News, Part, Task, first_look, measure};
use ocb_lab::pairing::Pairing;
use ocb_service::model::{Heatmap, HeatmapRequest, Measure, RunEvent, RunSpec, StageKind, State};
use ocb_service::{Engine, EngineError, Profile, Stop, chart_csv};
use tokio::sync::{Mutex, MutexGuard};

/// One run at a time on a machine.
async fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::const_new(());
    ALONE.lock().await
}

async fn times(engine: &Engine, run: &str, algorithm: &str) -> Result<Heatmap, EngineError> {
    let request = HeatmapRequest::new(algorithm, Measure::Time, Statistic::Median, Outliers::Keep);
    engine.heatmap(run, &request).await
}

/// The charts of a run under way say that they are preliminary, and are no files yet.
async fn charts_so_far(engine: &Engine, run: &str, of: u64) {
    for kind in ["accuracy", "ecdf", "distance", "triangles", "resolution", "bv_tests", "primitive_tests"] {
        let request = serde_json::from_value(serde_json::json!({ "kind": kind })).unwrap();
        let chart = engine.chart(run, request, Some("guest")).await.unwrap();
        assert!(chart.preliminary && chart.notes.iter().any(|note| note.starts_with("Preliminary:")), "{chart:?}");
        let points = chart.series.iter().flat_map(|series| &series.points);
        let most = points.map(|point| point.n).max().unwrap();
        assert!((1..=of).contains(&most), "{kind}: {most} of {of}");
        assert!(matches!(chart_csv(&chart), Err(EngineError::NotFound(_))), "{kind}");
    }
}

/// Waits until no other process measures on this machine.
fn machine_is_free() {
    let folder = if Path::new("/run/lock").is_dir() { "/run/lock" } else { "/tmp" };
    let lock = File::options().create(true).append(true).open(Path::new(folder).join("opencollbench-measuring.lock"));
    lock.unwrap().lock().unwrap();
}

/// How far an algorithm is, and what there is to show of it.
fn told<'e>(event: &'e RunEvent, algorithm: &str) -> (u64, Option<&'e ocb_service::model::AlgorithmResult>) {
    let stage = event.stage.as_ref().filter(|stage| stage.algorithm.as_deref() == Some(algorithm));
    (stage.map_or(0, |stage| stage.done), event.result.as_ref().filter(|result| result.algorithm == algorithm))
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fast_algorithm_is_seen_while_a_slow_one_builds_and_nothing_of_it_counts() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let mut config = common::config(data.path());
    config.plugins.push(common::slow(data.path(), 800, 0, 1));
    let engine = Engine::open(config).await.unwrap();
    let algorithms: Vec<String> = ["slow-0", "box-tree"].map(Into::into).to_vec();
    let spec = RunSpec { algorithms, budget_seconds: 3.0, ..common::spec("collision_first", 1000, 7) };
    let run = engine.submit(spec, Some("guest")).await.unwrap().id;
    let mut events = Box::pin(engine.follow(&run, 0).await.unwrap());
    let mut seen: Vec<RunEvent> = Vec::new();
    let (mut n, mut placed) = (Vec::new(), None);
    while let Some(event) = events.next().await {
        let event = event.unwrap();
        if let (_, Some(result)) = told(&event, "box-tree")
            && result.preliminary
        {
            n.push(result.n);
            placed = result.place_so_far;
            if n.len() == 1 {
                assert!(seen.iter().all(|event| told(event, "slow-0").0 == 0), "the slow one was waited for");
                let map = times(&engine, &run, "box-tree").await.unwrap();
                assert!(map.preliminary && map.n == result.n && map.range.is_some(), "{:?}", map.n);
                let ecdf = engine.ecdf(&run, "box-tree", None).await.unwrap();
                assert!(ecdf.preliminary && ecdf.n == result.n);
                // What leaves the service, and what it remembers, is final.
                for refused in [
                    engine.records_parquet(&run, "box-tree").await.err(),
                    engine.columns_arrow(&run, "box-tree").await.err(),
                    engine.heatmap_ply(&run, &map.request, Default::default(), Default::default()).await.err(),
                ] {
                    assert!(matches!(refused, Some(EngineError::NotFound(_))), "{refused:?}");
                }
                let info = engine.run(&run, None).await.unwrap();
                let so_far = info.results.iter().find(|r| r.algorithm == "box-tree").unwrap();
                assert!(so_far.preliminary && so_far.rank.is_none() && so_far.of == 1000, "{so_far:?}");
                charts_so_far(&engine, &run, 1000).await;
                let median = so_far.time.unwrap().median_ns;
                assert!(median.lo <= median.value && median.value <= median.hi && median.lo < median.hi);
            }
        }
        seen.push(event);
    }
    assert!((1..=300).contains(&n[0]), "{n:?}");
    assert!(n.len() > 1 && n.last() > n.first(), "it becomes finer: {n:?}");
    assert_eq!(placed, Some(1), "once the reference was asked, it has a place so far");

    let last = engine.run(&run, None).await.unwrap();
    assert_eq!(last.state, State::Done, "{:?}", last.message);
    let [slow, fast] = &last.results[..] else { panic!("{:?}", last.results) };
    assert!(slow.budget_limited && (fast.n, fast.of) == (1000, 1000), "{fast:?}");
    for result in &last.results {
        assert!(!result.preliminary && result.wrong == 0, "{result:?}");
        assert_eq!(result.timing.as_ref().unwrap().processes, 2, "a look is no pass");
        assert!(result.controls.is_some());
    }
    assert!(fast.rank.is_some(), "{:?}", fast.unranked);
    let stored = engine.events(&run, 0).await.unwrap();
    assert!(stored.iter().filter_map(|event| event.result.as_ref()).all(|result| !result.preliminary));
    let map = times(&engine, &run, "box-tree").await.unwrap();
    assert_eq!((map.preliminary, map.n), (false, 1000));
    engine.shutdown().await;
}

/// The set takes many seconds to be found.
#[tokio::test(flavor = "multi_thread")]
async fn the_beginning_of_a_large_set_is_seen_and_goes_when_the_run_is_cancelled() {
    let _alone = alone().await;
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    // Another process may measure at the very moment: then the beginning is not looked at.
    for attempt in 1.. {
        machine_is_free();
        let algorithms = vec!["parry".into()];
        let spec = RunSpec { algorithms, ..common::spec("proximity", 2_000_000, attempt) };
        let run = engine.submit(spec, Some("guest")).await.unwrap().id;
        let mut events = Box::pin(engine.follow(&run, 0).await.unwrap());
        let next = async {
            while let Some(event) = events.next().await {
                if told(&event.unwrap(), "parry").1.is_some() {
                    return;
                }
            }
        };
        let seen = tokio::time::timeout(Duration::from_secs(10), next).await.is_ok();
        let info = engine.run(&run, None).await.unwrap();
        if !seen && attempt < 6 {
            engine.cancel(&run, Some("guest")).await.unwrap();
            continue;
        }
        let finding = info.stages.iter().find(|stage| stage.kind == StageKind::Configurations).unwrap();
        assert_eq!((finding.state, info.results.len()), (State::Running, 1));
        let map = times(&engine, &run, "parry").await.unwrap();
        assert!(map.preliminary && map.n == info.results[0].n && (1..=300).contains(&map.n), "{}", map.n);
        let cancelled = engine.cancel(&run, Some("guest")).await.unwrap();
        assert_eq!((cancelled.state, cancelled.results.len()), (State::Cancelled, 0));
        assert!(matches!(times(&engine, &run, "parry").await, Err(EngineError::NotFound(_))));
        break;
    }
    engine.shutdown().await;
}

/// With the same seed, a task that is looked at before its rounds and shown between them asks the same processes the same
/// questions as one that is not, and finds the same ratio but for chance.
#[tokio::test(flavor = "multi_thread")]
async fn a_first_look_changes_neither_questions_nor_ratios() {
    let _alone = alone().await;
    let program = common::config(Path::new("")).runner;
    let (runner, machine) = (Runner { program, profile: Profile::Dev }, Machine::observe().unwrap());
    let described = |name: &str| {
        let file = runner.program.with_file_name(name);
        let info = runner.describe(&file, &plugin_hash(&file).unwrap(), true).unwrap().remove(0);
        Arc::new(Algorithm::plain(info, file, true))
    };
    let algorithms = ["libocb_parry.so", "libocb_box_tree.so"].map(described);
    let mesh = Arc::new(stock::generate("torus-knot", 600).unwrap());
    let pairing = Pairing::new(mesh.clone(), None);
    let spec = RunSpec { passes: 3, ..common::spec("collision_first", 120, 5) };
    let set = make(&pairing, &spec, None, &Gauge::default(), None).unwrap().unwrap();
    let _right = MeasuringRight::wait(|| false, || {}).unwrap();
    let measured = |watched: bool| {
        let (stop, (sender, news), mut seen) = (Stop::default(), channel(), 0);
        let task = Task {
            pairing: &pairing,
            set: &set,
            controls: &[],
            query: spec.query,
            semantics: spec.semantics,
            passes: spec.passes,
            budget: Duration::from_secs(60),
            seed: 7,
            algorithms: &algorithms,
            reference: Some(&algorithms[1]),
            part: Part::of(&spec, &set),
            watched,
            in_order: false,
            rounds_only: false,
        };
        if watched {
            let mut compared = Vec::new();
            first_look(&task, &runner, &machine, &stop, &mut |place, seen| {
                compared.push((place, seen.result.ratio.is_some()));
            });
            // Who is seen before the reference is seen again, compared with it.
            assert_eq!(compared, [(0, false), (0, true), (1, true)]);
            seen += compared.len();
        }
        measure(&task, &runner, &machine, &stop, &sender);
        drop(sender);
        let mut all: Vec<Measured> = Vec::new();
        for news in news {
            match news {
                News::Finished { measured, .. } => all.push(*measured),
                News::Preliminary { .. } => seen += 1,
                _ => {}
            }
        }
        (all, seen)
    };
    let ((plain, unseen), (looked, seen)) = (measured(false), measured(true));
    assert!(unseen == 0 && seen >= algorithms.len(), "{unseen} and {seen} preliminary results");
    for (plain, looked) in plain.iter().zip(&looked) {
        let questions =
            |of: &Measured| of.records.iter().map(|r| (r.configuration, r.asked, r.verdict)).collect::<Vec<_>>();
        assert_eq!(questions(plain), questions(looked));
        assert_eq!((plain.passes.len(), looked.passes.len()), (3, 3), "rounds");
    }
    let ratio = |all: &[Measured]| {
        let n = set.placed.len() as u64;
        compare(&all[0].times, Some(&all[1].times), spec.passes, n).unwrap().ratio.unwrap()
    };
    let (plain, looked) = (ratio(&plain), ratio(&looked));
    // Three processes make rough intervals.
    assert!(plain.lo <= 1.25 * looked.hi && looked.lo <= 1.25 * plain.hi, "{plain:?} and {looked:?}");
}
