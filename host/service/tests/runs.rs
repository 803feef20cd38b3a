//! Whole runs with the real runner and the plugins that ship with the service.

mod common;

use std::fs::File;
use std::path::Path;
use std::time::{Duration, Instant};

use ocb_core::configuration::{Class, Method, Separation};
use ocb_core::statistics::{Outliers, Statistic};
use ocb_lab::columns::read_triangle_tests;
use ocb_service::model::{
    ChartKind, ChartRequest, Ecdf, HeatmapRequest, Measure, OutcomeName, Page, RunSpec, StageKind, State,
};
use ocb_service::{Ceilings, Engine, EngineConfig, EngineError};

fn request(algorithm: &str, measure: Measure, statistic: Statistic) -> HeatmapRequest {
    HeatmapRequest::new(algorithm, measure, statistic, Outliers::Keep)
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_goes_from_object_to_heatmap() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    assert_eq!(engine.status().await.unwrap().problems, Vec::<String>::new());
    let estimate = engine.estimate(&common::spec("proximity", 60, 1), None).await.unwrap();
    assert_eq!((estimate.configurations, estimate.configurations_stored, estimate.runs_ahead), (60, false, 0));
    let run = engine.submit(common::spec("proximity", 60, 1), Some("guest")).await.unwrap();
    let (run, events) = common::finish(&engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);

    // The log is complete, in order, and ends with the end. Places in the queue are told without a number.
    let numbered: Vec<i64> = events.iter().map(|e| e.seq).filter(|seq| *seq > 0).collect();
    assert_eq!(numbered, (1..=numbered.len() as i64).collect::<Vec<_>>());
    assert_eq!(events.last().unwrap().state, State::Done);
    assert_eq!(events.iter().filter(|e| e.result.is_some()).count(), 3);
    assert_eq!(engine.events(&run.id, 3).await.unwrap().first().unwrap().seq, 4);
    let kinds: Vec<StageKind> = run.stages.iter().map(|s| s.kind).collect();
    use StageKind::*;
    assert_eq!(kinds, [Object, Configurations, Measuring, Measuring, Measuring, Heatmap]);
    assert!(run.stages.iter().all(|s| s.state == State::Done && s.done == s.total), "{:?}", run.stages);

    let set = run.set.clone().unwrap();
    assert_eq!(set.configurations + set.missed_rays, 60);
    assert_eq!(set.classes.iter().map(|c| c.count).sum::<u32>(), set.configurations);
    assert!(set.classes.iter().all(|c| c.class == Class::Clear), "relative distance 0 is placed just clear");
    let environment = run.environment.clone().unwrap();
    assert!(environment.null_ns.value > 0.0 && !environment.jail.is_empty());
    assert_eq!(environment.hardware_class, engine.status().await.unwrap().hardware_class);
    for result in &run.results {
        assert_eq!(result.outcome.name, OutcomeName::Completed, "{}: {}", result.algorithm, result.outcome.message);
        assert_eq!((result.n, result.of, result.wrong), (set.configurations, set.configurations, 0));
        let time = result.time.unwrap();
        assert!(0.0 < time.median_ns.value && time.median_ns.value <= time.max_ns.value);
        assert!(time.mean_ns.lo <= time.mean_ns.value && time.mean_ns.value <= time.mean_ns.hi);
        assert!(result.build_ms.unwrap() > 0.0 && result.primitive_tests_mean.unwrap() > 0.0);
    }

    // The map's numbers follow from the records.
    let density = engine.heatmap(&run.id, &request("", Measure::Density, Statistic::Mean)).await.unwrap();
    assert_eq!(density.values.iter().flatten().sum::<f64>(), 3.0 * f64::from(set.configurations));
    let csv = String::from_utf8(engine.records_csv(&run.id, "box-tree").await.unwrap()).unwrap();
    let times: Vec<f64> = csv.lines().skip(1).map(|l| l.split(',').nth(1).unwrap().parse().unwrap()).collect();
    assert_eq!(times.len() as u32, set.configurations);
    let longest = engine.heatmap(&run.id, &request("box-tree", Measure::Time, Statistic::Max)).await.unwrap();
    assert_eq!(longest.range.unwrap()[1], times.iter().copied().fold(0.0, f64::max));
    assert_eq!(longest.values.len(), engine.mesh(&run.spec.object_a).await.unwrap().positions().len());
    assert_eq!((longest.n, longest.unit.as_str()), (set.configurations, "ns"));
    // Each primitive test counts for one triangle of A and one of B.
    let counted = read_triangle_tests(&engine.triangle_tests_parquet(&run.id, "box-tree").await.unwrap()).unwrap();
    let tests_mean = run.results.iter().find(|r| r.algorithm == "box-tree").unwrap().primitive_tests_mean.unwrap();
    assert_eq!(counted.queries, set.configurations);
    for of in &counted.tests {
        let all = of.iter().map(|tests| f64::from(*tests)).sum::<f64>();
        assert!((all / f64::from(counted.queries) - tests_mean).abs() < 1e-9 * tests_mean, "{all} and {tests_mean}");
    }
    let tests = request("box-tree", Measure::TriangleTests, Statistic::Max);
    let map = engine.heatmap(&run.id, &tests).await.unwrap();
    let most = f64::from(*counted.tests[0].iter().max().unwrap()) / f64::from(counted.queries);
    assert_eq!((map.range.unwrap()[1], map.n, map.unit.as_str()), (most, set.configurations, "tests per query"));
    let selected = HeatmapRequest { selection: Some("time in [0, 1s]".into()), ..tests };
    assert!(matches!(engine.heatmap(&run.id, &selected).await, Err(EngineError::Invalid(_))));
    let ecdf = engine.ecdf(&run.id, "parry", None).await.unwrap();
    assert_eq!((ecdf.n, ecdf.share.last().copied()), (set.configurations, Some(1.0)));
    a_selection_has_its_own_charts(&engine, &run.id, &ecdf).await;
    assert!(engine.records_parquet(&run.id, "parry").await.unwrap().starts_with(b"PAR1"));
    let map = request("parry", Measure::BvTests, Statistic::Mean);
    let glb = engine.heatmap_glb(&run.id, &map, Default::default(), Default::default()).await.unwrap();
    assert!(glb.starts_with(b"glTF"));
    let ply = engine.heatmap_ply(&run.id, &map, Default::default(), Default::default()).await.unwrap();
    assert!(ply.starts_with(b"ply"));
    let absent = engine.ecdf(&run.id, "quantum", None).await.unwrap_err().to_string();
    assert!(absent.contains("box-tree, brute-force, parry"), "{absent}");

    // The same set is found again, and its file may be brought back as a file of configurations.
    let again = RunSpec { algorithms: vec!["box-tree".into()], ..common::spec("proximity", 60, 1) };
    assert!(engine.estimate(&again, None).await.unwrap().configurations_stored);
    let again = engine.submit(again, Some("guest")).await.unwrap();
    let (again, _) = common::finish(&engine, &again.id).await;
    assert_eq!(again.set.as_ref().map(|s| &s.sha256), Some(&set.sha256));
    assert!(again.stages[1].message.as_deref().is_some_and(|m| m.contains("Saved positions")));
    let file = engine.configurations_parquet(&run.id).await.unwrap();
    let method = engine.add_configurations(file).await.unwrap();
    let brought = RunSpec { method, algorithms: vec!["parry".into()], ..common::spec("collision_first", 1, 0) };
    let brought = engine.submit(brought, Some("guest")).await.unwrap();
    let (brought, _) = common::finish(&engine, &brought.id).await;
    assert_eq!(brought.results[0].n, set.configurations);
    assert_eq!(brought.results[0].wrong, 0);
    assert_eq!(engine.runs("guest", &Page::default()).await.unwrap().entries.len(), 3);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_small_budget_measures_the_same_prefix_and_says_so() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let mut spec = common::spec("collision_first", 4000, 2);
    spec.algorithms = vec!["brute-force".into()];
    spec.separation = Separation::Relative { distance: 0.05 };
    // Nothing is measured in a microsecond. How much more a first answer takes depends on what else the machine does, so the
    // budget is doubled until there is one; all questions take many times as long.
    spec.budget_seconds = 1e-6;
    let mut empty = 0;
    let run = loop {
        let run = engine.submit(spec.clone(), Some("guest")).await.unwrap();
        let (run, _) = common::finish(&engine, &run.id).await;
        if run.results[0].n > 0 {
            break run;
        }
        assert_eq!(run.state, State::Failed);
        assert_eq!((run.results[0].outcome.name, run.results[0].rank), (OutcomeName::OutOfBudget, None));
        assert_eq!(run.stages[2].state, State::Failed, "{:?}", run.stages[2]);
        assert!(run.message.as_deref().is_some_and(|m| m.contains("time budget")), "{:?}", run.message);
        empty += 1;
        spec.budget_seconds = (2.0 * spec.budget_seconds).max(0.05);
        assert!(spec.budget_seconds < 30.0, "nothing is measured in {} s", spec.budget_seconds / 2.0);
    };
    assert!(empty > 0, "{:?}", run.results[0]);
    let result = &run.results[0];
    assert!(result.budget_limited && result.n < result.of, "{} of {}", result.n, result.of);
    assert!(run.stages[2].message.as_deref().is_some_and(|m| m.contains(&format!("{} of {}", result.n, result.of))));
    assert_eq!(run.state, State::Done);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_expected_of_a_run_hardly_changes_and_the_reference_is_no_gap() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let spec = RunSpec {
        algorithms: vec!["brute-force".into()],
        separation: Separation::Relative { distance: 0.05 },
        budget_seconds: 2.0,
        ..common::spec("proximity", 4000, 2)
    };
    let estimate = engine.estimate(&spec, Some("guest")).await.unwrap();
    let asked_for: f64 = estimate.measuring_seconds.iter().map(|one| one.seconds).sum();
    assert!(estimate.total_seconds > estimate.configuration_seconds + asked_for, "the reference too: {estimate:?}");
    let run = engine.submit(spec, Some("guest")).await.unwrap();
    let (run, events) = common::finish(&engine, &run.id).await;
    assert!(run.results[0].budget_limited, "{:?}", run.results[0]);
    let stages: Vec<_> = events.iter().filter_map(|event| event.stage.as_ref()).collect();
    let measuring = || stages.iter().filter(|stage| stage.kind == StageKind::Measuring);
    let done = run.stages[2].done as f64;
    let known: Vec<u64> = measuring().map(|stage| stage.total).filter(|total| *total > 0).collect();
    assert!(known.iter().all(|total| (0.5 * done..2.0 * done).contains(&(*total as f64))), "{done}: {known:?}");
    assert!(measuring().any(|stage| stage.message.as_deref().is_some_and(|said| said.contains("reference algorithm"))));
    assert!(run.stages[2].message.as_deref().is_none_or(|said| !said.contains("reference")));
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn only_the_owner_cancels_and_the_next_run_goes_on() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let long = engine.submit(common::spec("proximity", 2_000_000, 3), Some("guest")).await.unwrap();
    let waiting = engine.submit(common::spec("proximity", 2_000_000, 4), Some("other")).await.unwrap();
    let next = engine.submit(common::spec("collision_first", 20, 5), Some("guest")).await.unwrap();
    assert!(waiting.runs_ahead >= 1 && next.runs_ahead > waiting.runs_ahead);
    for stranger in [None, Some("other")] {
        assert!(matches!(engine.cancel(&long.id, stranger).await, Err(EngineError::Forbidden(_))));
    }
    let waiting = engine.cancel(&waiting.id, Some("other")).await.unwrap();
    assert_eq!(waiting.state, State::Cancelled);
    assert!(waiting.stages.iter().all(|s| s.state == State::Cancelled), "{:?}", waiting.stages);
    assert_eq!(engine.cancel(&long.id, Some("guest")).await.unwrap().state, State::Cancelled);
    let (next, _) = common::finish(&engine, &next.id).await;
    assert_eq!(next.state, State::Done, "{:?}", next.message);
    let (long, events) = common::finish(&engine, &long.id).await;
    assert!(long.stages.iter().skip(1).all(|s| s.state == State::Cancelled), "{:?}", long.stages);
    assert_eq!(events.last().unwrap().state, State::Cancelled);
    assert!(matches!(engine.cancel("no such run", Some("guest")).await, Err(EngineError::NotFound(_))));
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_guests_run_is_stopped_at_its_time_limit_and_waiting_for_others_does_not_count() {
    let data = tempfile::tempdir().unwrap();
    let ceilings = Ceilings { guest_run: Duration::from_secs(8), ..Ceilings::default() };
    let engine = Engine::open(EngineConfig { ceilings, ..common::config(data.path()) }).await.unwrap();
    let spec = |configurations, seed, budget_seconds| RunSpec {
        algorithms: vec!["brute-force".into()],
        budget_seconds,
        ..common::spec("proximity", configurations, seed)
    };
    // Another process measures, for longer than the run may take.
    let folder = if Path::new("/run/lock").is_dir() { "/run/lock" } else { "/tmp" };
    let lock = File::options().create(true).append(true).open(Path::new(folder).join("opencollbench-measuring.lock"));
    let lock = lock.unwrap();
    lock.lock().unwrap();
    let guest = "0193f1a0-0000-4000-8000-000000000000";
    let waits = engine.submit(spec(20, 1, 1.0), Some(guest)).await.unwrap();
    // Guests cannot ask for a run that takes too long.
    let long = engine.submit(spec(20_000, 2, 300.0), Some("cli")).await.unwrap();
    let database = common::database(data.path()).await;
    let taken =
        sqlx::query("UPDATE runs SET owner = ?1 WHERE id = ?2").bind(guest).bind(&long.id).execute(&database).await;
    assert_eq!(taken.unwrap().rows_affected(), 1);
    tokio::time::sleep(Duration::from_secs(9)).await;
    let waiting = engine.run(&waits.id, None).await.unwrap();
    assert_eq!(waiting.state, State::Running, "{:?}", waiting.message);
    lock.unlock().unwrap();
    // On a busy machine it may need more than a guest's time now.
    common::finish(&engine, &waits.id).await;

    let (late, _) = common::finish(&engine, &long.id).await;
    assert_eq!(late.state, State::Cancelled, "{:?}", late.message);
    assert!(late.message.is_some_and(|message| message.contains("time limit for guests")));
    let next = engine.submit(spec(20, 3, 1.0), Some("cli")).await.unwrap();
    let (next, _) = common::finish(&engine, &next.id).await;
    assert_eq!(next.state, State::Done, "{:?}", next.message);
    database.close().await;
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_ends_as_soon_as_the_database_can_record_it() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let database = common::database(data.path()).await;
    let refuse = "CREATE TRIGGER refuse BEFORE UPDATE ON runs WHEN NEW.state = 'done' \
                  BEGIN SELECT RAISE(ABORT, 'disk I/O error'); END";
    sqlx::query(refuse).execute(&database).await.unwrap();
    let spec = |seed| RunSpec { algorithms: vec!["brute-force".into()], ..common::spec("proximity", 20, seed) };
    let run = engine.submit(spec(1), Some("guest")).await.unwrap();
    let begun = Instant::now();
    while engine.run(&run.id, None).await.unwrap().stages.last().unwrap().state != State::Done {
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing was measured");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    tokio::time::sleep(Duration::from_secs(1)).await;
    let now = engine.run(&run.id, None).await.unwrap();
    assert_eq!((now.state, now.environment), (State::Running, None), "all of its end is recorded, or nothing");

    sqlx::query("DROP TRIGGER refuse").execute(&database).await.unwrap();
    for run in [run.id, engine.submit(spec(2), Some("guest")).await.unwrap().id] {
        let ended = tokio::time::timeout(Duration::from_secs(60), common::finish(&engine, &run)).await;
        assert_eq!(ended.expect("it never ends").0.state, State::Done);
    }
    engine.delete_all("guest").await.unwrap();
    database.close().await;
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_that_the_service_cannot_carry_out_waits_again_and_fails_after_three_attempts() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let database = common::database(data.path()).await;
    // The configurations are found, and cannot be stored.
    let refuse = "CREATE TRIGGER refuse BEFORE INSERT ON blobs BEGIN SELECT RAISE(ABORT, 'disk I/O error'); END";
    sqlx::query(refuse).execute(&database).await.unwrap();
    let spec = |seed| RunSpec { algorithms: vec!["brute-force".into()], ..common::spec("proximity", 20, seed) };
    let run = engine.submit(spec(1), Some("guest")).await.unwrap();
    let failed = tokio::time::timeout(Duration::from_secs(60), common::finish(&engine, &run.id)).await.unwrap().0;
    assert_eq!((failed.state, failed.attempts), (State::Failed, 3));
    let message = failed.message.unwrap();
    assert!(message.contains("no fault of the algorithms") && !message.contains("disk"), "{message}");

    let run = engine.submit(spec(2), Some("guest")).await.unwrap();
    let begun = Instant::now();
    let lost = "SELECT COUNT(*) FROM attempts WHERE job = $1 AND outcome = 'lost'";
    while sqlx::query_scalar::<_, i64>(lost).bind(&run.id).fetch_one(&database).await.unwrap() == 0 {
        assert!(begun.elapsed() < Duration::from_secs(60), "no attempt was lost");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    sqlx::query("DROP TRIGGER refuse").execute(&database).await.unwrap();
    let done = tokio::time::timeout(Duration::from_secs(60), common::finish(&engine, &run.id)).await.unwrap().0;
    assert_eq!((done.state, done.results.len()), (State::Done, 1), "{:?}", done.message);
    assert!((2..=3).contains(&done.attempts), "{}", done.attempts);
    database.close().await;
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_replaced_plugin_file_is_reported_as_such() {
    let (data, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut config = common::config(data.path());
    let brought = folder.path().join("libocb_parry.so");
    let theirs = config.plugins.iter_mut().find(|file| file.ends_with("libocb_parry.so")).unwrap();
    std::fs::copy(&*theirs, &brought).unwrap();
    theirs.clone_from(&brought);
    let engine = Engine::open(config.clone()).await.unwrap();
    // Somebody installs another version while the service is up.
    std::fs::remove_file(&brought).unwrap();
    std::fs::copy(&config.plugins[0], &brought).unwrap();
    let algorithms = vec!["box-tree".into(), "parry".into()];
    let spec = RunSpec { algorithms, passes: 5, ..common::spec("proximity", 60, 1) };
    let run = engine.submit(spec, Some("guest")).await.unwrap();
    let (run, _) = common::finish(&engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    let [ours, replaced] = &run.results[..] else { panic!("{:?}", run.results) };
    assert_eq!((ours.outcome.name, ours.rank), (OutcomeName::Completed, Some(1)), "{:?}", ours.unranked);
    assert_eq!((replaced.outcome.name, replaced.rank, replaced.n), (OutcomeName::FileReplaced, None, 0));
    assert!(replaced.outcome.message.contains("SHA-256"), "{}", replaced.outcome.message);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_start_page_has_a_measured_run_without_being_asked() {
    let data = tempfile::tempdir().unwrap();
    let mut config = EngineConfig { featured: true, ..common::config(data.path()) };
    // One that is through soon: brute force would take all of its time.
    config.plugins.retain(|file| file.ends_with("libocb_box_tree.so"));
    let engine = Engine::open(config.clone()).await.unwrap();
    let started = std::time::Instant::now();
    let featured = loop {
        match engine.featured().await.unwrap() {
            Some(run) if run.state == State::Done => break run,
            _ => assert!(started.elapsed().as_secs() < 120, "{:?}", engine.status().await),
        }
        tokio::time::sleep(std::time::Duration::from_millis(200)).await;
    };
    assert_eq!((featured.state, featured.mine), (State::Done, false));
    assert!(featured.results.iter().any(|r| r.n > 0));
    engine.shutdown().await;
    drop(engine);
    let engine = Engine::open(config).await.unwrap();
    assert_eq!(engine.featured().await.unwrap().map(|run| run.id), Some(featured.id), "it is made once");
    assert_eq!(engine.status().await.unwrap().queued, 0);
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_program_is_no_plugin() {
    let data = tempfile::tempdir().unwrap();
    let config = EngineConfig { dispatch: false, ..common::config(data.path()) };
    let engine = Engine::open(config.clone()).await.unwrap();
    // An ELF file: the runner's own program. What is a plugin is checked by `known_failures`.
    let report = engine.check_plugin(&config.runner, common::quick()).await.unwrap();
    assert!(!report.passed);
    let gate = &report.lines[1];
    assert!(gate.check.starts_with("ELF gate") && gate.evidence.contains("a program"), "{report:#?}");
    assert!(gate.hint.as_ref().is_some_and(|hint| hint.contains("-shared")), "{report:#?}");
}

/// Charts of the selected configurations alone: as many as the selection counts, and no others.
async fn a_selection_has_its_own_charts(engine: &Engine, run: &str, whole: &Ecdf) {
    let median = whole.time_ns[whole.share.iter().position(|share| *share >= 0.5).unwrap()];
    let slow = format!("time of parry in [{median}, 1e12]");
    let counted = engine.selected(run, "parry", &slow).await.unwrap().n;
    assert!(0 < counted && counted < whole.n, "{counted} of {}", whole.n);
    let ecdf = engine.ecdf(run, "parry", Some(&slow)).await.unwrap();
    assert_eq!((ecdf.n, ecdf.time_ns.last()), (counted, whole.time_ns.last()));
    assert!(ecdf.time_ns[0] >= median, "{ecdf:?}");
    assert_eq!(engine.ecdf(run, "parry", Some("time in [1000s, 2000s]")).await.unwrap().n, 0);
    let chart = |kind, selection: &str, algorithm: Option<&str>| {
        let (selection, algorithm) = (Some(selection.to_owned()), algorithm.map(str::to_owned));
        engine.chart(run, ChartRequest { kind, accuracy: Default::default(), selection, algorithm }, None)
    };
    let spread = chart(ChartKind::Ecdf, &slow, None).await.unwrap();
    assert_eq!(spread.series.len(), 3);
    for series in &spread.series {
        assert!(series.points.iter().all(|point| point.n == u64::from(counted)), "{series:?}");
    }
    let note = spread.notes.last().unwrap();
    assert!(note.contains(&format!("{counted} of {}", whole.n)) && note.contains(&slow), "{note}");
    let tests = chart(ChartKind::PrimitiveTests, "time in [0, 1000s]", Some("parry")).await.unwrap();
    let counted: u64 = tests.series[0].points.iter().map(|point| point.n).sum();
    assert_eq!(counted, u64::from(whole.n));
    for (kind, selection, word) in [
        (ChartKind::Ecdf, "time in [1us, 1s]", "does not name an algorithm"),
        (ChartKind::Ecdf, "time of parry in [1000s, 2000s]", "has none of these"),
        (ChartKind::Ecdf, "tame", "character 1"),
        (ChartKind::Accuracy, slow.as_str(), "whole runs"),
    ] {
        let said = chart(kind, selection, None).await.unwrap_err().to_string();
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn a_spec_needs_little() {
    let spec: RunSpec = serde_json::from_str(
        r#"{"object_a": "x", "query": "proximity", "method": {"kind": "sphere", "sampling": {"kind": "count", "count": 3}}}"#,
    )
    .unwrap();
    assert_eq!((spec.passes, spec.separation), (5, Separation::Relative { distance: 0.0 }));
    assert!(matches!(spec.method, Method::Sphere { seed: 0, .. }));
}
