//! A small part far from the origin, of which single precision loses the detail: who gets what, and is judged by what.

mod common;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use ocb_core::configuration::Separation;
use ocb_core::record::Verdict;
use ocb_service::model::{AlgorithmResult, RunInfo, RunSpec, State, WorstBy, WorstRequest};

use ocb_service::{Engine, EngineConfig, EngineError, Profile, Unpacked};

#[expect(clippy::disallowed_methods, reason = "the test compiles a plugin")]
fn plugin(folder: &Path) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = folder.join("rounding.so");
    let mut cc = std::process::Command::new("cc");
    cc.args(["-std=gnu11", "-O1", "-fPIC", "-shared", "-fvisibility=hidden"]);
    cc.arg("-I").arg(here.join("../../plugin-api/include")).arg("-I").arg(here.join("../../plugin-api/templates/c"));
    assert!(cc.arg(here.join("tests/fixtures/rounding.c")).arg("-o").arg(&file).status().unwrap().success());
    file
}

/// A ball of this radius at (10^6, 10^6, 10^6), with waves of a thousandth on it. Numbers of single precision are a sixteenth
/// apart there.
fn ball(radius: f64) -> Vec<u8> {
    const AROUND: usize = 8;
    const RINGS: usize = 5;
    let mut text = String::new();
    let mut vertex = |direction: [f64; 3], wave: f64| {
        let [x, y, z] = direction.map(|x| 1e6 + (radius + wave) * x);
        let _ = writeln!(text, "v {x} {y} {z}");
    };
    vertex([0.0, 0.0, 1.0], 0.0);
    for i in 0..RINGS * AROUND {
        let (ring, step) = ((i / AROUND + 1) as f64, (i % AROUND) as f64);
        let (polar, around) = (ring * std::f64::consts::PI / (RINGS + 1) as f64, step * std::f64::consts::PI / 4.0);
        vertex(
            [polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()],
            1e-3 * (7.0 * around + ring).sin(),
        );
    }
    vertex([0.0, 0.0, -1.0], 0.0);
    let at = |ring: usize, step: usize| 2 + ring * AROUND + step % AROUND;
    let last = RINGS * AROUND + 2;
    for step in 0..AROUND {
        let _ = writeln!(text, "f 1 {} {}", at(0, step), at(0, step + 1));
        let _ = writeln!(text, "f {last} {} {}", at(RINGS - 1, step + 1), at(RINGS - 1, step));
        for ring in 1..RINGS {
            let corners = [at(ring - 1, step), at(ring, step), at(ring, step + 1), at(ring - 1, step + 1)];
            let [a, b, c, d] = corners;
            let _ = writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}");
        }
    }
    text.into_bytes()
}

fn of<'r>(run: &'r RunInfo, algorithm: &str) -> &'r AlgorithmResult {
    run.results.iter().find(|result| result.algorithm == algorithm).expect("a result")
}

#[tokio::test(flavor = "multi_thread")]
async fn each_algorithm_gets_the_numbers_of_its_precision_and_is_judged_by_the_truth_about_them() {
    let (data, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let plain = common::config(data.path());
    let plugins = plain.plugins.iter().cloned().chain([plugin(folder.path())]).collect();
    let engine = Engine::open(EngineConfig { plugins, profile: Profile::Dev, ..plain }).await.unwrap();
    let object = engine.add_object("ball.obj", ball(10.0), Some("guest")).await.unwrap();
    let rounding = object.rounding.expect("single precision does not hold it");
    assert!(rounding.moves > 0.02 && rounding.moves <= 1.0 / 32.0 && !rounding.flattens, "{rounding:?}");

    // Some thousandths apart: nearer than rounding moves the surfaces.
    let spec = RunSpec {
        object_a: object.id.clone(),
        separation: Separation::Step { of_size: 1e-9 },
        algorithms: ["double", "box-tree", "single", "parry-f32"].map(str::to_owned).to_vec(),
        // On a busy machine, too, all configurations are measured.
        budget_seconds: 300.0,
        ..common::spec("collision_first", 40, 5)
    };
    let run = engine.submit(spec.clone(), Some("guest")).await.unwrap();
    let (run, _) = common::finish(&engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    let set = run.set.as_ref().unwrap();
    let effect = set.rounding.expect("two truths");
    assert!(effect.other_answers > 5 && effect.largest_change > 1e-3, "{effect:?}");
    for exact in ["double", "box-tree"].map(|name| of(&run, name)) {
        assert!(!exact.rounded && exact.outcome.completed(), "{exact:?}");
        assert!(exact.verdicts.iter().all(|count| count.verdict == Verdict::Correct), "{exact:?}");
    }
    for rounded in ["single", "parry-f32"].map(|name| of(&run, name)) {
        assert!(rounded.rounded && rounded.outcome.completed() && rounded.wrong == 0, "{rounded:?}");
    }
    // So near nothing is scored in single precision; all the same, these answers are those of exact arithmetic to the rounding.
    let single = of(&run, "single");
    assert_eq!((single.grazing.n, single.grazing.agree), (set.configurations, set.configurations), "{single:?}");
    assert_eq!(single.by_unit.len(), 3, "in other units, too");
    let request = |by, algorithm: &str| WorstRequest { algorithm: algorithm.into(), by, limit: 40, selection: None };
    let worst = engine.worst(&run.id, &request(WorstBy::Time, "single")).await.unwrap();
    assert!(worst.iter().all(|case| case.hit == Some(case.true_hit)), "{worst:?}");
    assert_eq!(
        worst.iter().filter(|case| case.true_hit).count() as u32,
        effect.other_answers,
        "apart without rounding"
    );
    for case in &worst {
        let meeting = engine.meeting(&run.id, case.configuration, true).await.unwrap();
        assert_eq!(meeting.total > 0, case.true_hit);
    }
    // Two right answers to different objects do not contradict each other; what parry says in single precision may.
    let disputed = engine.selected(&run.id, "double", "disputed of double").await.unwrap();
    assert!(disputed.n < effect.other_answers / 2, "{disputed:?}, {effect:?}");

    // The files say it.
    for (algorithm, rounded) in [("double", "false"), ("single", "true")] {
        let csv = String::from_utf8(engine.records_csv(&run.id, algorithm).await.unwrap()).unwrap();
        let (told, rows) = (format!(",{rounded}"), csv.lines().count() - 1);
        assert_eq!(rows, of(&run, algorithm).n as usize);
        assert_eq!(csv.lines().filter(|line| line.ends_with(&told)).count(), rows, "{csv}");
    }
    // And a replay asks each again in its own numbers.
    let archive = folder.path().join("run.zip");
    std::io::copy(&mut engine.repro(&run.id).await.unwrap(), &mut std::fs::File::create(&archive).unwrap()).unwrap();
    let only = ["double", "single"].map(str::to_owned);
    let replay = engine.replay(Unpacked::read(&archive).unwrap(), &only, |_| {}).await.unwrap();
    assert!(replay.identical && replay.algorithms.len() == 2, "{replay:?}");

    // Where nothing is left of the object, algorithms in single precision are refused by name and left out otherwise.
    let grain = engine.add_object("grain.obj", ball(0.01), Some("guest")).await.unwrap();
    assert!(
        grain.rounding.is_some_and(|rounding| rounding.flattens && rounding.collapsed == grain.triangles),
        "{grain:?}"
    );
    let separation = Separation::Step { of_size: 1e-12 };
    let spec = RunSpec { object_a: grain.id, separation, passes: 1, at_most: Some(8), ..spec };
    let refused = engine.submit(spec.clone(), Some("guest")).await.unwrap_err();
    assert!(
        matches!(&refused, EngineError::Invalid(why) if why.starts_with("\"single\" computes in single precision")),
        "{refused}"
    );
    let run = engine.submit(RunSpec { algorithms: vec!["all".into()], ..spec }, Some("guest")).await.unwrap();
    let asked = &run.spec.algorithms;
    assert!(
        asked.contains(&"double".into()) && !asked.iter().any(|id| id == "single" || id == "parry-f32"),
        "{asked:?}"
    );
    let (run, _) = common::finish(&engine, &run.id).await;
    assert_eq!(of(&run, "double").wrong, 0);
    assert!(run.set.unwrap().rounding.is_none() && run.results.iter().all(|result| !result.rounded));
    engine.shutdown().await;
}
