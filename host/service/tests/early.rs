//! Runs that measure no more than they need, in real processes.
//!
//! `OCB_REPETITIONS=100` makes of the few repetitions here the campaign of `tests/setup/soak.sh`.

mod common;

use ocb_core::sequential::ERROR;
use ocb_service::model::{AlgorithmResult, Preview, RunInfo, RunSpec, State};
use ocb_service::{Engine, EngineError};

/// `count` random poses of a small knot against itself, half of them colliding: all but free to find.
fn spec(count: u32, algorithms: &[&str]) -> RunSpec {
    let method = serde_json::json!({"kind": "random", "count": count, "hit_share": 0.5, "seed": 5});
    RunSpec {
        method: serde_json::from_value(method).expect("a method"),
        algorithms: algorithms.iter().map(|&name| name.into()).collect(),
        passes: 5,
        ..common::spec("collision_first", 1, 0)
    }
}

async fn measure(engine: &Engine, spec: RunSpec) -> RunInfo {
    let run = engine.submit(spec, Some("guest")).await.expect("a good spec");
    let (run, _) = common::finish(engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    run
}

/// The fastest of the only contract class.
fn winner(run: &RunInfo) -> &str {
    let ratio = |r: &&AlgorithmResult| r.ratio.map_or(f64::INFINITY, |ratio| ratio.value);
    assert!(run.results.iter().all(|r| r.class == run.results[0].class && r.wrong == 0), "{:?}", run.results);
    let fastest = run.results.iter().min_by(|x, y| ratio(x).total_cmp(&ratio(y)));
    &fastest.expect("a result").algorithm
}

#[tokio::test(flavor = "multi_thread")]
async fn the_winner_of_a_part_is_that_of_the_whole() {
    let repetitions: u32 = std::env::var("OCB_REPETITIONS").map_or(3, |n| n.parse().expect("a number"));
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let whole = spec(12_000, &["box-tree", "box-tree:leaf_size=16", "box-tree:leaf_size=32"]);
    let run = measure(&engine, whole.clone()).await;
    assert_eq!(run.preview, None);
    for r in &run.results {
        println!("whole: {} {:?}, rank {:?}, {} configurations", r.algorithm, r.ratio, r.rank, r.n);
    }
    let (mut same, mut n) = (0, Vec::new());
    for seed in 0..repetitions {
        let early = RunSpec { precision: Some(0.05), seed: Some(u64::from(seed)), ..whole.clone() };
        let early = measure(&engine, early).await;
        let Preview { n: measured, of, settled, beside, .. } = early.preview.as_ref().expect("a part");
        assert!(*settled && early.results.iter().all(|r| r.n == *measured && !r.budget_limited), "{:?}", early.preview);
        assert!(early.stages.iter().all(|s| s.state == State::Done && s.done == s.total), "{:?}", early.stages);
        same += u32::from(beside.iter().all(|b| b.fastest == winner(&run)));
        n.push(f64::from(*measured) / *of as f64);
    }
    n.sort_by(f64::total_cmp);
    let mean = n.iter().sum::<f64>() / f64::from(repetitions);
    // One that other work prolongs makes the mean of three, but not that of the campaign.
    let asked = if repetitions < 10 { n[n.len() / 2] } else { mean };
    println!(
        "{same} of {repetitions} name the winner of the whole, {}, at {:.1} % of its questions",
        winner(&run),
        100.0 * mean
    );
    println!("shares of {} configurations: {n:?}", run.results[0].n);
    assert!(f64::from(repetitions - same) <= (ERROR * f64::from(repetitions)).ceil(), "{same} of {repetitions}");
    assert!(asked < 0.1, "{asked}");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_quick_look_is_a_preview_until_it_is_refined() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let whole = spec(900, &["box-tree", "box-tree:leaf_size=32"]);
    let quick = RunSpec { at_most: Some(200), ..whole.clone() };
    let estimate = engine.estimate(&quick, None).await.unwrap();
    assert_eq!(estimate.configurations, 200);
    assert!(estimate.total_seconds < engine.estimate(&whole, None).await.unwrap().total_seconds);
    let first = measure(&engine, quick).await;
    let preview = first.preview.clone().expect("a preview");
    assert_eq!((preview.n, preview.of, preview.looks), (200, 900, 1));
    assert!(preview.more.contains("1 in 300") && preview.more.contains("1 in 66"), "{}", preview.more);
    assert!(first.results.iter().all(|r| r.n == 200 && r.of == 200 && r.wrong == 0), "{:?}", first.results);

    // Nobody else refines it; who gives up refining keeps the preview.
    for stranger in [None, Some("other")] {
        assert!(matches!(engine.refine(&first.id, stranger).await, Err(EngineError::Forbidden(_))));
    }
    let begun = engine.refine(&first.id, Some("guest")).await.unwrap();
    assert!(matches!(begun.state, State::Queued | State::Running), "{:?}", begun.state);
    assert!(engine.refine(&first.id, Some("guest")).await.is_err());
    let left = engine.cancel(&first.id, Some("guest")).await.unwrap();
    assert_eq!((left.state, left.preview), (State::Done, Some(preview)));
    assert_eq!(left.results, first.results);

    engine.refine(&first.id, Some("guest")).await.unwrap();
    let (full, events) = common::finish(&engine, &first.id).await;
    assert_eq!((full.state, full.preview), (State::Done, None), "{:?}", full.message);
    assert!(full.results.iter().all(|r| r.n == 900 && r.of == 900 && r.wrong == 0), "{:?}", full.results);
    assert_eq!(events.iter().filter(|e| e.result.is_some()).count(), 2);
    assert_ne!(full.commitment, first.commitment, "the first secret is known");
    let again = engine.refine(&first.id, Some("guest")).await.unwrap_err().to_string();
    assert!(again.contains("preview"), "{again}");
    engine.shutdown().await;
}
