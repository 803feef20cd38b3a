//! Bad input gets one clear sentence and leaves nothing behind.

mod common;

use ocb_core::configuration::{Method, Sampling, Separation};
use ocb_core::export::glb;
use ocb_core::mesh::FileFormat;
use ocb_service::model::{Page, RunSpec};
use ocb_service::{Engine, EngineError};

/// What must not change: blobs on disk, the guest's objects and runs.
async fn inventory(engine: &Engine, data: &std::path::Path) -> (usize, usize, usize) {
    let objects = engine.objects(Some("guest"), &Page::default()).await.unwrap().entries.len();
    let runs = engine.runs("guest", &Page::default()).await.unwrap().entries.len();
    (common::files(&data.join("blobs")), objects, runs)
}

/// One sentence, for a person.
fn check_sentence(error: &EngineError, must_say: &str) {
    let text = error.to_string();
    assert!(text.contains(must_say), "{text:?} should say {must_say:?}");
    assert!(text.ends_with('.') && !text.contains('\n') && text.len() < 500, "{text:?} is no clear sentence");
}

#[tokio::test]
async fn no_bad_object_leaves_a_trace() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::idle_config(data.path())).await.unwrap();
    let before = inventory(&engine, data.path()).await;
    let huge = vec![b'#'; 300 << 20];
    let cases: [(&[u8], &str); 9] = [
        (b"", "empty"),
        (b"  \n\n", "empty"),
        (b"\x7fELF\x00\x01\x02\x03 binary junk \x00\xff", "OBJ, STL, PLY"),
        (&huge, "bytes"),
        (b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "line 2"),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4"),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces"),
        (b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "zero area"),
        (b"v 1e300 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "line 1"),
    ];
    for (bytes, must_say) in cases {
        let error = engine.add_object("my.obj", bytes.to_vec(), Some("guest")).await.unwrap_err();
        assert!(matches!(error, EngineError::Invalid(_)), "{error}");
        check_sentence(&error, must_say);
        check_sentence(&error, "my");
    }
    assert_eq!(inventory(&engine, data.path()).await, before);
}

#[tokio::test]
async fn a_good_object_is_kept_once() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::idle_config(data.path())).await.unwrap();
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 0.1 0\nf 1 2 3\n".to_vec();
    let info = engine.add_object("a/b/tri.obj", obj.clone(), Some("guest")).await.unwrap();
    assert_eq!((info.name.as_str(), info.triangles, info.vertices, info.stock), ("tri", 1, 3, false));
    assert!(info.rounding.is_some_and(|rounding| rounding.moves > 0.0 && !rounding.flattens), "{info:?}");
    assert_eq!(engine.add_object("again.obj", obj.clone(), Some("guest")).await.unwrap(), info);
    let theirs = engine.add_object("tri.obj", obj, Some("somebody else")).await.unwrap();
    assert_ne!(theirs.id, info.id, "another owner has an object of their own");
    assert_eq!(common::files(&data.path().join("blobs")), 1, "over the same bytes");
    assert_eq!(engine.mesh(&info.id).await.unwrap().positions()[2].y, 0.1, "the number of the file");
    assert_eq!(engine.object(&info.id, Some("guest")).await.unwrap(), info);
    let listed = engine.objects(Some("guest"), &Page::default()).await.unwrap().entries;
    assert_eq!(listed.iter().filter(|o| !o.stock).collect::<Vec<_>>(), [&info]);
    engine.shutdown().await;
}

#[tokio::test]
async fn the_content_decides_the_format_and_the_unit_is_kept() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::idle_config(data.path())).await.unwrap();
    let facet = |z: u8| {
        format!("facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 {z}\nendloop\nendfacet\n")
    };
    let stl = format!("solid two\n{}{}endsolid two\n", facet(0), facet(1)).into_bytes();
    let info = engine.add_object("named.glb", stl, Some("guest")).await.unwrap();
    assert_eq!((info.name.as_str(), info.format, &info.unit), ("named", Some(FileFormat::Stl), &None));
    assert!(info.warnings[0].starts_with("6 vertices of the triangles were merged into 4"), "{:?}", info.warnings);

    let mesh = engine.mesh(&info.id).await.unwrap();
    let info = engine.add_object("cube.glb", glb::geometry(&mesh), Some("somebody else")).await.unwrap();
    assert_eq!((info.format, info.unit.as_ref().unwrap().metres), (Some(FileFormat::Glb), 1.0));
    assert_eq!(engine.mesh(&info.id).await.unwrap(), mesh);
    assert_eq!(engine.object(&info.id, None).await.unwrap().unit, info.unit);
    engine.shutdown().await;
}

#[tokio::test]
async fn no_bad_request_is_queued() {
    let data = tempfile::tempdir().unwrap();
    let engine =
        Engine::open(ocb_service::EngineConfig { dispatch: false, ..common::config(data.path()) }).await.unwrap();
    let before = inventory(&engine, data.path()).await;
    let good = common::spec("proximity", 10, 0);
    let count = |count| Method::Sphere { sampling: Sampling::Count { count }, seed: 0 };
    let steps = |by| Method::Sphere { sampling: Sampling::Steps { rotate: by, move_by: by }, seed: 0 };
    let trajectory = Method::Trajectory { center_distance: 1.0, count: 10 };
    let cases: Vec<(RunSpec, &str)> = vec![
        (RunSpec { separation: Separation::Relative { distance: -0.1 }, ..good.clone() }, "relative distance"),
        (RunSpec { separation: Separation::Relative { distance: f64::NAN }, ..good.clone() }, "relative distance"),
        (RunSpec { method: count(0), ..good.clone() }, "at least 1"),
        (RunSpec { method: count(1_000_000_000), ..good.clone() }, "1000000000 configurations are too many"),
        (RunSpec { method: steps(0.0), ..good.clone() }, "degrees"),
        (RunSpec { method: steps(0.5), ..good.clone() }, "too many"),
        (RunSpec { algorithms: vec!["quantum".into()], ..good.clone() }, "box-tree"),
        (RunSpec { object_a: "stock:teapot".into(), ..good.clone() }, "no object"),
        (RunSpec { object_b: Some("../../etc/passwd".into()), ..good.clone() }, "no object"),
        (RunSpec { object_a: "stock:castle@4000000000".into(), ..good.clone() }, "triangles"),
        (RunSpec { passes: 0, ..good.clone() }, "passes"),
        (RunSpec { budget_seconds: f64::INFINITY, ..good.clone() }, "seconds"),
        (RunSpec { precision: Some(1.0), ..good.clone() }, "less than 1"),
        (RunSpec { precision: Some(f64::NAN), ..good.clone() }, "less than 1"),
        (RunSpec { precision: Some(0.05), passes: 2, ..good.clone() }, "at least 3"),
        (
            RunSpec { precision: Some(0.05), passes: 3, algorithms: vec!["parry".into()], ..good.clone() },
            "two algorithms",
        ),
        (RunSpec { at_most: Some(0), ..good.clone() }, "at least 1"),
        (RunSpec { at_most: Some(9), method: trajectory, ..good.clone() }, "trajectory is measured as a whole"),
        (RunSpec { method: Method::File { sha256: "0".repeat(64) }, ..good.clone() }, "file of configurations"),
    ];
    for (spec, must_say) in cases {
        for error in
            [engine.estimate(&spec, None).await.unwrap_err(), engine.submit(spec, Some("guest")).await.unwrap_err()]
        {
            assert!(matches!(error, EngineError::Invalid(_) | EngineError::NotFound(_)), "{error:?}");
            check_sentence(&error, must_say);
        }
    }
    let error = engine.add_configurations(b"no matrices".to_vec()).await.unwrap_err();
    check_sentence(&error, "Not a configuration file");
    assert_eq!(inventory(&engine, data.path()).await, before);
    let run = engine.submit(good, Some("guest")).await.unwrap();
    assert_eq!(run.spec.algorithms, ["box-tree", "brute-force", "parry"], "all that answer the question");
}

#[tokio::test]
async fn a_file_that_is_no_plugin_is_reported() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::idle_config(data.path())).await.unwrap();
    let file = data.path().join("fake.so");
    std::fs::write(&file, "I am a text").unwrap();
    let report = engine.check_plugin(&file, common::quick()).await.unwrap();
    assert!(!report.passed);
    assert_eq!(report.lines.len(), 1);
    assert!(report.lines[0].evidence.contains("not an ELF file"), "{}", report.lines[0].evidence);
    assert!(report.lines[0].hint.is_some());
    let absent = engine.check_plugin(&data.path().join("absent.so"), common::quick()).await.unwrap_err();
    check_sentence(&absent, "does not exist");
}

#[tokio::test]
async fn a_second_engine_on_the_same_folder_is_refused() {
    let data = tempfile::tempdir().unwrap();
    let first = Engine::open(common::idle_config(data.path())).await.unwrap();
    let error = Engine::open(common::idle_config(data.path())).await.err().unwrap();
    assert!(matches!(error, EngineError::Busy(_)));
    check_sentence(&error, "in use by another process");
    first.shutdown().await;
    drop(first);
    Engine::open(common::idle_config(data.path())).await.unwrap();
}
