//! Runs of algorithms that depend on the unit of length, and of one that does not.

mod common;

use std::path::{Path, PathBuf};

use ocb_core::configuration::Method;
use ocb_service::model::{AlgorithmResult, InUnit, RunSpec, State};
use ocb_service::{Engine, EngineConfig, Profile};

/// Coordinates of the file are at most 1, so they are below this in the small unit and above it in the others.
const SMALL: &str = "0.5";
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[expect(clippy::disallowed_methods, reason = "the test compiles a plugin")]
fn plugin(folder: &Path) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = folder.join("units.so");
    let mut cc = std::process::Command::new("cc");
    cc.args(["-std=gnu11", "-O1", "-fPIC", "-shared", "-fvisibility=hidden"]).arg(format!("-DSMALL={SMALL}"));
    cc.arg("-I").arg(here.join("../../plugin-api/include")).arg("-I").arg(here.join("../../plugin-api/templates/c"));
    assert!(cc.arg(here.join("tests/fixtures/units.c")).arg("-o").arg(&file).arg("-lm").status().unwrap().success());
    file
}

/// All coordinates of the tetrahedron times this, so that another unit is that of the file.
fn tetrahedron(times: u32) -> Vec<u8> {
    let scaled = |line: &str| match line.strip_prefix("v ") {
        Some(_) => line.replace('1', &times.to_string()),
        None => line.to_owned(),
    };
    TETRAHEDRON.lines().map(scaled).collect::<Vec<_>>().join("\n").into_bytes()
}

async fn measured(times: u32) -> Vec<AlgorithmResult> {
    let (data, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let plain = common::config(data.path());
    let plugins = plain.plugins.iter().cloned().chain([plugin(folder.path())]).collect();
    let engine = Engine::open(EngineConfig { plugins, profile: Profile::Dev, ..plain }).await.unwrap();
    let object = engine.add_object("tetrahedron", tetrahedron(times), Some("guest")).await.unwrap();
    let spec = RunSpec {
        object_a: object.id,
        method: Method::Random { count: 200, hit_share: 0.5, seed: 3 },
        algorithms: ["steady", "slow-when-small", "wrong-when-small"].map(str::to_owned).to_vec(),
        passes: 5,
        ..common::spec("collision_first", 1, 5)
    };
    let run = engine.submit(spec, Some("guest")).await.unwrap();
    let (run, _) = common::finish(&engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    engine.shutdown().await;
    run.results
}

#[tokio::test(flavor = "multi_thread")]
async fn time_and_wrong_answers_are_told_by_unit_and_a_dependence_is_named() {
    let results = measured(1).await;
    let [steady, slow, wrong] = &results[..] else { panic!("{results:?}") };
    for result in &results {
        let units: Vec<[i64; 3]> =
            result.by_unit.iter().map(|u| [i64::from(u.exponent), i64::from(u.processes), i64::from(u.n)]).collect();
        let n = i64::from(result.n);
        let [build] = &result.builds[..] else { panic!("{:?}", result.builds) };
        assert!(build.file == "units.so" && build.compilers.iter().any(|said| said.starts_with("GCC")), "{build:?}");
        assert_eq!(units, [[0, 5, n], [-3, 2, 60], [3, 2, 60]], "{result:?}");
        assert_eq!(result.by_unit[0].mean_ns, result.time.map(|time| time.mean_ns), "the file's unit leads");
        assert!(result.by_unit[0].answers >= 5 * result.n && result.by_unit[1].answers >= 60);
    }
    let all_right = |units: &[InUnit]| units.iter().all(|unit| unit.wrong == 0);
    assert!(steady.depends_on_unit.is_none() && all_right(&steady.by_unit), "{steady:?}");

    let finding = slow.depends_on_unit.as_ref().expect("ten times as slow in one unit");
    assert_eq!((finding.time.as_slice(), finding.answers.as_slice()), (&[-3][..], &[][..]), "{finding:?}");
    assert!(finding.message.contains("coordinates times 1/8"), "{}", finding.message);
    // The headline is that of the file's unit: 20 us and not 200 us.
    let headline = slow.time.expect("times").median_ns.value;
    assert!((15e3..100e3).contains(&headline), "{headline}");
    let [file, small, large] = [0, 1, 2].map(|i| slow.by_unit[i].mean_ns.expect("a time").value);
    // Other work on the machine lengthens some of the few answers.
    assert!(small > 4.0 * file && small > 2.0 * large, "{file} {small} {large}");

    let finding = wrong.depends_on_unit.as_ref().expect("wrong in one unit");
    assert_eq!(finding.answers, [-3], "{finding:?}");
    let [file, small, large] = [0, 1, 2].map(|i| wrong.by_unit[i]);
    assert_eq!((file.wrong, large.wrong), (0, 0), "{wrong:?}");
    assert!(small.wrong > 15 && small.missed == small.wrong, "{small:?}");
    // What is wrong in any unit is wrong, and no rank is given to it.
    assert!(wrong.wrong > 15 && wrong.rank.is_none(), "{wrong:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn the_headline_follows_the_unit_of_the_file() {
    // In a file of coordinates up to 2, only a quarter is small: 2/8. The file's own unit and the large one are not.
    let large = measured(2).await;
    // In a file of coordinates up to 8, an eighth is 1: no unit is small, so nothing depends on it.
    let larger = measured(8).await;
    for (results, depends) in [(large, true), (larger, false)] {
        for result in &results[1..] {
            assert_eq!(result.depends_on_unit.is_some(), depends, "{result:?}");
        }
        assert!(results[0].depends_on_unit.is_none(), "{:?}", results[0]);
    }
}
