//! What the board makes of given results.

use ocb_service::board::{self, Measured, Named, add_stability, board};
use ocb_service::model::{Accuracy, Board, BoardRequest, BoardRow, Controls, OutcomeName, Tally, UnrankedCause};
use ocb_service::suite::Suite;
use serde_json::{Value, json};

fn named(value: &str) -> Named {
    Named { value: value.into(), words: value.into() }
}

/// A result with this mean time, within 2 %, and these verdicts among `n`.
fn measured(algorithm: &str, mean_ns: f64, n: u32, verdicts: &[(&str, u32)]) -> Measured {
    let wrong: u32 = verdicts.iter().map(|(_, count)| count).sum();
    let estimate = |value: f64| json!({ "value": value, "lo": 0.98 * value, "hi": 1.02 * value });
    let result = json!({
        "algorithm": algorithm, "name": algorithm, "n": n, "of": n, "budget_limited": false, "wrong": wrong,
        "outcome": { "name": "Completed", "message": "All.", "ours": false },
        "time": { "mean_ns": estimate(mean_ns), "median_ns": estimate(mean_ns), "p95_ns": estimate(mean_ns),
                  "max_ns": estimate(mean_ns), "below_resolution": 0 },
        "class": { "delivered": "first_contact", "order": "shuffled", "cpus": 1, "bits": 64 },
        "verdicts": verdicts.iter().map(|(verdict, count)| json!({ "verdict": verdict, "count": count })).collect::<Vec<_>>(),
        "resolution": { "eps": if wrong > 0 { 1e-3 } else { 1e-9 }, "seen": wrong > 0,
                        "false_hits": { "n": n, "wrong": wrong, "at": if wrong > 0 { 1e-3 } else { 1e-9 } },
                        "misses": { "n": 0, "wrong": 0, "at": null }, "distance": null },
        "bv_tests_mean": null, "primitive_tests_mean": null, "build_ms": 2.5, "memory_bytes": 1000,
    });
    Measured {
        run: format!("run of {algorithm}"),
        finished_us: 1_000,
        hardware: named("this"),
        ranked: true,
        suite: None,
        standing: None,
        preview: None,
        question: named("collision_first"),
        scene: named("a~a"),
        distance: named("0"),
        oracle: Some(4),
        plugin_sha256: "p".into(),
        result: serde_json::from_value(result).expect("a result"),
    }
}

fn failed(algorithm: &str) -> Measured {
    let mut measured = measured(algorithm, 1.0, 0, &[]);
    measured.result.time = None;
    measured.result.outcome.name = OutcomeName::Signaled;
    measured.result.outcome.message = "It crashed with SIGSEGV.".into();
    measured
}

fn five() -> Vec<Measured> {
    vec![
        measured("box-tree", 1_000.0, 200, &[]),
        measured("box-tree:leaf_size=8", 1_010.0, 200, &[]),
        measured("parry", 4_000.0, 200, &[]),
        measured("voxmap-pointshell", 200.0, 200, &[("false_negative", 3), ("false_positive", 7)]),
        failed("embree"),
    ]
}

fn ask(measured: Vec<Measured>, request: &Value) -> Board {
    let request: BoardRequest = serde_json::from_value(request.clone()).expect("a request");
    board(measured, &request, &[suite()]).expect("a board")
}

fn row<'a>(board: &'a Board, algorithm: &str) -> &'a BoardRow {
    board.rows.iter().find(|row| row.algorithm == algorithm).unwrap_or_else(|| panic!("{algorithm} in {board:#?}"))
}

/// With so many of 50 control questions answered wrongly.
fn guessing(mut of: Measured, wrong: u32) -> Measured {
    of.result.controls = Some(Controls { n: 50, of: 50, crossing: 25, wrong, silent: 0, guess: 1e-6 });
    of.result.unranked = Some(UnrankedCause::WrongControls { wrong, n: 50 }.into());
    of
}

#[test]
fn what_guesses_has_neither_a_place_nor_a_mark() {
    let mut all = five();
    all.push(guessing(measured("guesser", 10.0, 200, &[]), 25));
    // One wrong answer more would otherwise buy the mark of a method that approximates.
    all.push(guessing(measured("sly", 10.0, 200, &[("false_negative", 1)]), 25));
    all.push(guessing(measured("distance-field", 500.0, 200, &[("false_negative", 40)]), 12));
    let board = ask(all, &json!({}));
    for algorithm in ["guesser", "sly"] {
        let row = row(&board, algorithm);
        assert_eq!((row.rank, row.frontier), (None, false), "{row:?}");
        assert_eq!(row.reason.as_deref(), Some("25 of 50 control questions were answered wrongly."));
        assert!(board.chart.series.iter().all(|series| !series.name.contains(algorithm)), "{:#?}", board.chart);
    }
    assert!(row(&board, "distance-field").reason.as_deref().is_some_and(|why| why.contains("wrong answers")));
    assert!(row(&board, "voxmap-pointshell").frontier && !board.finding.contains("guesser"), "{}", board.finding);
    assert_eq!(row(&board, "box-tree").rank, Some(1));
}

#[test]
fn places_go_by_speed_with_ties_and_only_what_is_right_has_one() {
    let board = ask(five(), &json!({}));
    let ranks: Vec<(&str, Option<u32>, bool)> =
        board.rows.iter().map(|row| (row.algorithm.as_str(), row.rank, row.tied)).collect();
    assert_eq!(
        ranks,
        [
            ("box-tree", Some(1), true),
            ("box-tree:leaf_size=8", Some(1), true),
            ("parry", Some(3), false),
            ("voxmap-pointshell", None, false),
            ("embree", None, false),
        ]
    );
    let rate = row(&board, "parry").rate.expect("a rate");
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * b;
    assert!(near(rate.value, 250_000.0) && near(rate.lo, 1e9 / 4080.0) && near(rate.hi, 1e9 / 3920.0), "{rate:?}");
    assert_eq!(row(&board, "embree").reason.as_deref(), Some("It crashed with SIGSEGV."));
    assert!(row(&board, "voxmap-pointshell").reason.as_deref().is_some_and(|why| why.contains("wrong")));
    assert_eq!(
        board.finding,
        "Fastest with no wrong answer seen: box-tree, 1,000,000 queries per second, 1.0 times the next \
         (box-tree:leaf_size=8); the 95 % intervals overlap, so the order is not decided."
    );
}

#[test]
fn a_preview_has_no_place_until_it_is_refined() {
    let mut measured = five();
    measured[0].preview = Some((500, 20_000));
    let board = ask(measured, &json!({}));
    let reason = row(&board, "box-tree").reason.as_deref().expect("a reason");
    assert!(reason.starts_with("A preview: 500 of 20000 configurations"), "{reason}");
    assert_eq!((row(&board, "box-tree").rank, row(&board, "box-tree:leaf_size=8").rank), (None, Some(1)));
    assert!(board.finding.contains("no wrong answer seen: box-tree:leaf_size=8"), "{}", board.finding);
    let marks = board.chart.series.iter().flat_map(|series| &series.points);
    assert!(
        marks.clone().count() > 0 && marks.filter_map(|point| point.name.as_deref()).all(|name| name != "box-tree")
    );
}

#[test]
fn missed_collisions_and_false_alarms_are_apart_and_have_intervals() {
    let board = ask(five(), &json!({}));
    let wrong = row(&board, "voxmap-pointshell");
    assert_eq!((wrong.wrong, wrong.missed, wrong.false_alarms), (10, 3, 7));
    let [all, missed, alarms] =
        [wrong.wrong_share, wrong.missed_share, wrong.false_alarm_share].map(|share| share.expect("a share"));
    assert_eq!([all.value, missed.value, alarms.value], [0.05, 0.015, 0.035]);
    assert!(all.lo < 0.05 && 0.05 < all.hi && missed.hi < all.hi);
    let clean = row(&board, "parry").wrong_share.expect("a share");
    assert_eq!([clean.value, clean.lo, clean.hi], [0.0, 0.0, 3.0 / 200.0]);
}

#[test]
fn the_chart_has_the_rows_numbers_filled_on_the_frontier_and_hollow_when_a_collision_was_missed() {
    for accuracy in [Accuracy::Wrong, Accuracy::Missed, Accuracy::FalseAlarms, Accuracy::Digits] {
        let board = ask(five(), &json!({ "accuracy": accuracy }));
        let lines = board.chart.series.iter().filter(|series| series.style.is_some());
        let points: Vec<_> = lines.clone().flat_map(|series| &series.points).collect();
        assert_eq!(points.len(), 4, "what failed has no mark");
        for point in &points {
            let row = row(&board, point.name.as_deref().expect("a name"));
            let rate = row.rate.expect("a rate");
            assert_eq!((point.y, point.y_lo, point.y_hi), (rate.value, Some(rate.lo), Some(rate.hi)));
            assert_eq!((point.n, point.missed, point.false_alarms), (row.n, row.missed, row.false_alarms));
            let share = |share: Option<ocb_service::model::Estimated>| share.map(|s| s.value).filter(|x| *x > 0.0);
            let x = match accuracy {
                Accuracy::Wrong => share(row.wrong_share),
                Accuracy::Missed => share(row.missed_share),
                Accuracy::FalseAlarms => share(row.false_alarm_share),
                _ => row.eps.map(|eps| -eps.log10()),
            };
            assert_eq!(point.x, x);
            assert_eq!(point.filled, row.frontier && row.missed == 0);
        }
        // The fastest is on the frontier with its faults, but hollow; the slowest clean one is beaten.
        assert!(row(&board, "voxmap-pointshell").frontier && row(&board, "box-tree").frontier);
        assert!(!row(&board, "parry").frontier);
        let joined = lines.filter(|series| series.points.len() == 2).count();
        assert_eq!(joined, 1, "the two settings of box-tree are joined");
    }
}

#[test]
fn one_class_one_machine_one_scene_unless_asked_and_filters_say_what_they_took() {
    let mut all = five();
    let mut elsewhere = measured("parry", 500.0, 50, &[]);
    elsewhere.hardware = named("other");
    let mut single = measured("parry-f32", 300.0, 50, &[]);
    single.result.class.as_mut().expect("a class").bits = 32;
    let mut apart = measured("parry", 100.0, 50, &[]);
    apart.distance = named("0.1");
    all.extend([elsewhere, single, apart]);
    let board = ask(all.clone(), &json!({}));
    let removed: Vec<(&str, u32)> = board.filters.iter().map(|f| (f.name.as_str(), f.removed)).collect();
    assert_eq!(
        removed,
        [("suite", 0), ("question", 0), ("class", 1), ("hardware", 1), ("scene", 0), ("distance", 1), ("precision", 0)]
    );
    assert_eq!(board.results, 8);
    assert_eq!(row(&board, "parry").rate.map(|r| r.value.round()), Some(250_000.0));
    // Over all distances counts are added, and who was not measured everywhere has no place.
    let board = ask(all.clone(), &json!({ "distance": "all" }));
    let parry = row(&board, "parry");
    assert_eq!((parry.n, parry.rank, parry.scenarios), (250, Some(1), 2));
    assert!((parry.rate.expect("a rate").value - 1e9 / 2050.0).abs() < 1e-6);
    assert!(row(&board, "box-tree").reason.as_deref().is_some_and(|why| why.contains("1 of 2 scenarios")));
    // A filter that leaves nothing says so.
    let board = ask(all.clone(), &json!({ "scene": "b~b" }));
    assert!(board.rows.is_empty());
    assert_eq!(board.filters.iter().find(|f| f.name == "scene").map(|f| f.removed), Some(6));
    let board = ask(all, &json!({ "precision": "1e-6" }));
    assert!(board.rows.iter().all(|row| row.algorithm != "voxmap-pointshell"));
    assert_eq!(board.filters.last().map(|f| f.removed), Some(1));
}

#[test]
fn the_newest_plugin_counts_and_of_its_runs_the_largest() {
    let older = Measured { plugin_sha256: "old".into(), ..measured("parry", 9_000.0, 900, &[]) };
    let large = Measured { finished_us: 2_000, ..measured("parry", 4_000.0, 300, &[]) };
    let small = Measured { finished_us: 3_000, ..measured("parry", 5_000.0, 20, &[]) };
    let board = ask(vec![small, large, older], &json!({}));
    let parry = row(&board, "parry");
    assert_eq!((parry.n, parry.finished_us), (300, 2_000));
}

/// Two scenes of 500 triangles at two distances, first contact only.
fn suite() -> Suite {
    let document = json!({
        "version": 7, "scenes": [["stock:box@500", "stock:box@500"], ["stock:box@500", "stock:sphere@500"]],
        "separations": [{ "kind": "relative", "distance": 0.1 }, { "kind": "ladder" }], "queries": ["collision_first"],
        "configurations": 10, "seed": 1, "passes": 3, "budget_seconds": 1.0,
    });
    Suite::read(&document.to_string()).expect("a suite")
}

/// Results of one algorithm in every scenario of the suite.
fn in_suite(algorithm: &str, plugin: &str, mean_ns: f64, finished_us: i64) -> Vec<Measured> {
    let scenarios = [
        ("box@500~box@500", "0.1"),
        ("box@500~box@500", "ladder"),
        ("box@500~sphere@500", "0.1"),
        ("box@500~sphere@500", "ladder"),
    ];
    let one = |(scene, distance)| Measured {
        suite: Some(board::suite(&suite())),
        scene: named(scene),
        distance: named(distance),
        plugin_sha256: plugin.into(),
        finished_us,
        ..measured(algorithm, mean_ns, 10, &[])
    };
    scenarios.map(one).into()
}

#[test]
fn a_suite_is_a_whole_and_never_mixed_with_the_runs_of_people() {
    let mut all = [five(), in_suite("box-tree", "p", 1_000.0, 5), in_suite("parry", "p", 2_000.0, 9)].concat();
    all.extend(in_suite("dop-tree", "p", 500.0, 7).into_iter().take(3));
    let shown = ask(all.clone(), &json!({}));
    let chosen: Vec<(&str, &str)> =
        shown.filters.iter().map(|f| (f.name.as_str(), f.chosen.as_str())).take(5).collect();
    assert_eq!(chosen[0], ("suite", "7"));
    assert_eq!(chosen[3..], [("hardware", "this"), ("scene", "all")]);
    let ranks: Vec<_> =
        shown.rows.iter().map(|row| (row.algorithm.as_str(), row.rank, row.scenarios, row.of)).collect();
    assert_eq!(ranks, [("box-tree", Some(1), 4, 4), ("parry", Some(2), 4, 4), ("dop-tree", None, 3, 4)]);
    let told = shown.suite.expect("it says which suite");
    assert_eq!((told.version, told.scenarios, told.hardware.as_str()), (7, 4, "this"));
    assert_eq!((told.oldest_us, told.newest_us, told.sha256), (5, 9, suite().sha256));
    // Where only some were measured, all of the suite is missing, not what others have.
    let alone = ask(in_suite("dop-tree", "p", 500.0, 7).into_iter().take(3).collect(), &json!({}));
    assert!(row(&alone, "dop-tree").reason.as_deref().is_some_and(|why| why.contains("3 of 4 scenarios")));
    let one = ask(all.clone(), &json!({ "scene": "box@500~sphere@500", "distance": "0.1" }));
    assert_eq!((row(&one, "parry").of, one.suite.map(|s| s.scenarios)), (1, Some(1)));
    // The runs of people are one filter away.
    let people = ask(all, &json!({ "suite": "none" }));
    assert_eq!((people.rows.len(), people.suite, people.filters[0].removed), (5, None, 11));
}

#[test]
fn a_new_version_of_a_plugin_is_not_completed_by_results_of_the_old_one() {
    let new = in_suite("parry", "new", 500.0, 9).into_iter().take(1);
    let board = ask(in_suite("parry", "old", 2_000.0, 5).into_iter().chain(new).collect(), &json!({}));
    let parry = row(&board, "parry");
    assert_eq!((parry.plugin_sha256.as_str(), parry.scenarios, parry.rank), ("new", 1, None));
}

#[test]
fn what_another_oracle_judged_again_counts_though_it_has_fewer_configurations() {
    let mut all = in_suite("parry", "p", 1_000.0, 5);
    let again = |old: &Measured| Measured { oracle: Some(5), finished_us: 9, ..old.clone() };
    let mut renewed = again(&all[0]);
    renewed.result.n = 8;
    all.push(renewed);
    let board = ask(all, &json!({}));
    assert_eq!((row(&board, "parry").n, row(&board, "parry").oracle), (38, Some(4)));
}

#[test]
fn who_was_taken_out_keeps_the_numbers_and_has_no_place() {
    let mut all = [in_suite("box-tree", "p", 1_000.0, 5), in_suite("parry", "p", 500.0, 5)].concat();
    all.iter_mut()
        .filter(|m| m.result.algorithm == "parry")
        .for_each(|m| m.standing = Some("Its author has withdrawn this plugin.".into()));
    let board = ask(all, &json!({}));
    let parry = row(&board, "parry");
    assert_eq!((parry.rank, parry.frontier, parry.rate.is_some()), (None, false, true));
    assert_eq!(parry.reason.as_deref(), Some("Its author has withdrawn this plugin."));
    assert_eq!(row(&board, "box-tree").rank, Some(1));
}

#[test]
fn a_precision_that_is_none_is_refused() {
    for bad in ["0", "-1", "NaN", "fine", "2"] {
        let request = BoardRequest { precision: Some(bad.into()), ..BoardRequest::default() };
        let refused = board(five(), &request, &[]).expect_err("it is no precision").to_string();
        assert!(refused.contains(bad) && refused.contains("1e-6"), "{refused}");
    }
}

#[test]
fn the_same_plugin_file_brings_its_stability_and_another_one_none() {
    let mut board = ask(five(), &json!({}));
    let family = |state: &str, family: &str| json!({ "family": family, "state": state, "tally": Tally::default(), "steps": [], "thresholds": [], "first": null });
    let of = |algorithm: &str, sha256: &str| {
        json!({
            "algorithm": algorithm, "name": "A", "version": "1", "plugin_sha256": sha256, "single_precision": false,
            "seeds": 1, "created_us": 0, "complete": true, "relations": [], "failures": [], "tessellations": [],
            "search": null, "unit_safe": null, "offset_safe": null,
            "families": [
                family("agrees", "one"), family("slow", "two"), family("wrong", "three"), family("broken", "four"),
                family("wrong", "beyond"), family("unsupported", "six"),
            ],
        })
    };
    let known = board.rows[0].plugin_sha256.clone();
    let info = |id: &str| {
        json!({
            "id": id, "name": id, "sentence": "", "source": "", "parameter": "", "continuous": true,
            "harder": "small", "beyond": id == "beyond",
        })
    };
    let table = serde_json::from_value(json!({
        "families": [info("one"), info("beyond")], "relations": [], "failures": [],
        "methods": [of("box-tree", &known), of("parry", "another file")],
    }));
    add_stability(&mut board.rows, &table.expect("a table"));
    let passed = row(&board, "box-tree").stability.expect("it was tried");
    assert_eq!((passed.passed, passed.of), (3, 5));
    assert_eq!(row(&board, "parry").stability, None);
}
