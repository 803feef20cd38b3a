//! Where methods fail: heatmaps of failure, differences, selections and the worst configurations of whole runs.
//!
//! The failures are real ones: parry in single precision calls objects hit that are ten times as far apart as its
//! arithmetic can tell.

mod common;

use ocb_core::configuration::Separation;
use ocb_core::statistics::{Outliers, Statistic};
use ocb_service::model::{Heatmap, HeatmapRequest, Measure, RunInfo, State, WorstBy, WorstRequest};
use ocb_service::{Engine, EngineError};
use tempfile::TempDir;

/// Asked so near to contact that parry in f32 fails.
async fn measured(engine: &Engine, query: &str, algorithms: [&str; 2]) -> RunInfo {
    let mut spec = common::spec(query, 60, 3);
    spec.separation = Separation::Step { of_size: 1e-5 };
    spec.algorithms = algorithms.map(str::to_owned).to_vec();
    let run = engine.submit(spec, Some("guest")).await.unwrap();
    let (run, _) = common::finish(engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    run
}

async fn engine() -> (Engine, TempDir) {
    let data = tempfile::tempdir().unwrap();
    (Engine::open(common::config(data.path())).await.unwrap(), data)
}

fn request(algorithm: &str, measure: Measure) -> HeatmapRequest {
    // What a share has no use for must not matter.
    HeatmapRequest::new(algorithm, measure, Statistic::Median, Outliers::PerVertex)
}

fn wrong(run: &RunInfo, algorithm: &str) -> u32 {
    run.results.iter().find(|r| r.algorithm == algorithm).unwrap().wrong
}

fn values(map: &Heatmap) -> Vec<f64> {
    map.values.iter().flatten().copied().collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn failures_of_collision_answers_are_shown_where_they_are() {
    let (engine, _data) = engine().await;
    let run = measured(&engine, "collision_first", ["box-tree", "parry-f32"]).await;
    let (n, failed) = (run.set.as_ref().unwrap().configurations, wrong(&run, "parry-f32"));
    assert!(failed > 0 && wrong(&run, "box-tree") == 0, "{:?}", run.results);
    let map = async |algorithm: &str, measure| engine.heatmap(&run.id, &request(algorithm, measure)).await.unwrap();

    // Zero is a value: as many vertices have it as have a time.
    let times = values(&map("box-tree", Measure::Time).await).len();
    for measure in [Measure::Wrong, Measure::Missed, Measure::FalseAlarms, Measure::Flips] {
        let none = map("box-tree", measure).await;
        assert_eq!((values(&none), none.unit.as_str(), none.n), (vec![0.0; times], "share", n), "{measure:?}");
    }
    let bad = map("parry-f32", Measure::Wrong).await;
    assert_eq!((bad.request.statistic, bad.request.outliers), (Statistic::Mean, Outliers::Keep));
    assert_eq!(bad.dropped.iter().sum::<u32>(), 0, "no failure is dropped as an outlier");
    let assigned: f64 = bad.values.iter().zip(&bad.counts).map(|(x, n)| x.unwrap_or(0.0) * f64::from(*n)).sum();
    assert!((assigned - 3.0 * f64::from(failed)).abs() < 1e-9, "every wrong answer goes to three vertices");
    assert_eq!(map("parry-f32", Measure::FalseAlarms).await.values, bad.values, "they are false alarms all");
    assert_eq!(
        map("box-tree", Measure::Disagreement).await.values,
        bad.values,
        "one other algorithm, right where it is wrong"
    );

    // Differences: of two algorithms, and of two runs on the same object.
    let minus = |against: Option<&str>, against_run: Option<&str>, algorithm: &str| HeatmapRequest {
        against: against.map(str::to_owned),
        against_run: against_run.map(str::to_owned),
        ..request(algorithm, Measure::Wrong)
    };
    let both = engine.heatmap(&run.id, &minus(Some("box-tree"), None, "parry-f32")).await.unwrap();
    assert_eq!(both.values, bad.values);
    let turned = engine.heatmap(&run.id, &minus(Some("parry-f32"), None, "box-tree")).await.unwrap();
    assert_eq!(turned.range.unwrap()[0], -bad.range.unwrap()[1]);
    let again = engine.heatmap(&run.id, &minus(None, Some(&run.id), "parry-f32")).await.unwrap();
    assert!(values(&again).iter().all(|x| *x == 0.0) && values(&again).len() == times);
    let subtracted = minus(Some("box-tree"), None, "parry-f32");
    let glb = engine.heatmap_glb(&run.id, &subtracted, Default::default(), Default::default()).await.unwrap();
    let glb = String::from_utf8_lossy(&glb).into_owned();
    assert!(glb.contains(r#""against":"box-tree""#) && glb.contains(r#""colormap":"purple_orange""#));

    // What a collision run cannot show is told.
    let Err(EngineError::Invalid(sentence)) =
        engine.heatmap(&run.id, &request("box-tree", Measure::DistanceError)).await
    else {
        panic!("a collision has no distance error")
    };
    assert!(sentence.contains("only distances have an error"), "{sentence}");
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn selections_choose_count_and_filter_alike_everywhere() {
    let (engine, _data) = engine().await;
    let run = measured(&engine, "collision_first", ["box-tree", "parry-f32"]).await;
    let failed = wrong(&run, "parry-f32");
    let selected = engine.selected(&run.id, "parry-f32", "wrong").await.unwrap();
    assert_eq!((selected.n, selected.selection.as_str()), (failed, "wrong"));
    assert_eq!(selected.algorithms.iter().find(|a| a.algorithm == "parry-f32").unwrap().wrong, failed);
    let theirs = engine.selected(&run.id, "box-tree", "wrong of parry-f32 & !wrong").await.unwrap();
    assert_eq!(theirs.n, failed);
    let csv = String::from_utf8(engine.selected_csv(&run.id, "parry-f32", "wrong").await.unwrap()).unwrap();
    assert_eq!(csv.lines().count() as u32, failed + 1);
    assert!(csv.lines().skip(1).all(|line| line.contains("false_positive")), "{csv}");

    // A ball of the object's size takes everything; a point of no size takes what lies exactly there.
    let all = engine.selected(&run.id, "box-tree", "near(vertex 0, 2)").await.unwrap();
    assert_eq!((all.n, all.of), (all.of, run.set.as_ref().unwrap().configurations));
    let some = engine.selected(&run.id, "box-tree", "near(vertex 0, 0.3)").await.unwrap().n;
    assert!(0 < some && some < all.n, "{some}");
    let near = HeatmapRequest { selection: Some("near(vertex 0, 0.3)".into()), ..request("box-tree", Measure::Time) };
    assert_eq!(engine.heatmap(&run.id, &near).await.unwrap().n, some);
    let density = HeatmapRequest { measure: Measure::Density, ..near };
    let density = engine.heatmap(&run.id, &density).await.unwrap();
    assert_eq!(density.values.iter().flatten().sum::<f64>(), 3.0 * f64::from(some));

    for (bad, must_say) in [
        ("wrong of nobody", "\"nobody\" is not in this run"),
        ("near(vertex 999999, 1)", "vertex 999999 of object A"),
        ("time in [1", "at character"),
    ] {
        match engine.selected(&run.id, "box-tree", bad).await {
            Err(EngineError::Invalid(sentence) | EngineError::NotFound(sentence)) => {
                assert!(sentence.contains(must_say), "{sentence}");
            }
            other => panic!("{other:?} instead of {must_say:?}"),
        }
    }
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_worst_come_wrong_ones_first_with_poses_witnesses_and_triangles() {
    let (engine, _data) = engine().await;
    let run = measured(&engine, "collision_first", ["box-tree", "parry-f32"]).await;
    let ask = |by, limit| WorstRequest { algorithm: "parry-f32".into(), by, limit, selection: None };
    let worst = engine.worst(&run.id, &ask(WorstBy::Time, 100)).await.unwrap();
    let failed = wrong(&run, "parry-f32") as usize;
    assert!(worst[..failed].iter().all(|case| case.verdict.is_wrong() && case.hit == Some(true) && !case.true_hit));
    for part in [&worst[..failed], &worst[failed..]] {
        assert!(part.iter().all(|case| case.verdict.is_wrong() == (part.as_ptr() == worst.as_ptr())));
        assert!(part.windows(2).all(|w| w[0].time_ns >= w[1].time_ns));
    }
    let first = &worst[0];
    let apart: f64 = (0..3).map(|i| (first.points[0][i] - first.points[1][i]).powi(2)).sum::<f64>().sqrt();
    assert!((apart - first.true_distance[1]).abs() < 1e-9 && first.pose_b.len() == 16 && apart > 0.0);
    // A false alarm names triangles; what is right points at nothing that would have to be looked at.
    assert!(worst[..failed].iter().all(|case| case.claim.is_some_and(|c| c.triangles.is_some() && c.points.is_none())));
    assert!(worst[failed..].iter().all(|case| case.claim.is_none()));
    let meeting = engine.meeting(&run.id, first.configuration, false).await.unwrap();
    assert_eq!((meeting.total, meeting.pairs.len()), (0, 0), "they do not meet");
    assert!(matches!(engine.meeting(&run.id, 60_000, false).await, Err(EngineError::NotFound(_))));
    assert!(matches!(engine.worst(&run.id, &ask(WorstBy::Time, 0)).await, Err(EngineError::Invalid(_))));
    assert!(matches!(engine.worst(&run.id, &ask(WorstBy::Error, 9)).await, Err(EngineError::Invalid(_))));

    // Distances: the error is what the worst list says, in units of the algorithm's own arithmetic.
    let run = measured(&engine, "proximity", ["box-tree", "parry-f32"]).await;
    let map = HeatmapRequest { statistic: Statistic::Max, ..request("parry-f32", Measure::DistanceError) };
    let map = engine.heatmap(&run.id, &map).await.unwrap();
    let worst = engine.worst(&run.id, &ask(WorstBy::Error, 1000)).await.unwrap();
    let largest = worst.iter().filter_map(|case| case.error).fold(0.0, f64::max);
    assert_eq!((map.range.unwrap()[1], map.unit.as_str()), (largest, "u S"));
    assert!(worst.iter().all(|case| case.verdict.is_wrong() || case.error.is_none_or(|error| error <= 32.0)));
    assert!(worst.iter().all(|case| case.verdict.is_wrong() || case.claim.is_none()));
    assert!(worst.iter().any(|case| case.claim.is_some_and(|claim| claim.triangles.is_some())), "{:?}", worst[0]);
    engine.shutdown().await;
}
