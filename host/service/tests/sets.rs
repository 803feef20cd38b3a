//! Configuration sets by themselves: the same bytes everywhere, kept and used again, and read back from files.

mod common;

use ocb_core::configuration::{Method, Separation};
use ocb_service::model::{RunSpec, SetInfo};
use ocb_service::truth::{Gauge, read_matrices};
use ocb_service::{Engine, EngineError};
use serde_json::{Value, json};

fn spec(object_b: &str, method: Value, separation: Value) -> RunSpec {
    let mut spec = json!({
        "object_a": "stock:chair@600", "object_b": object_b, "query": "proximity", "method": method,
    });
    spec.as_object_mut().expect("an object").extend(separation.as_object().expect("an object").clone());
    serde_json::from_value(spec).expect("a spec")
}

async fn make(engine: &Engine, spec: &RunSpec) -> (SetInfo, Vec<u8>) {
    let job = engine.set_job(spec).await.expect("a good spec");
    let info = match &job.stored {
        Some(info) => info.clone(),
        None => {
            let gauge = Gauge::default();
            let set = job.find(&gauge).expect("a set").expect("not stopped");
            let done = gauge.done.load(std::sync::atomic::Ordering::Relaxed);
            assert!(done >= set.placed.len() as u64, "{done}");
            engine.keep_set(&job, &set, 1.0).await.expect("kept")
        }
    };
    let bytes = engine.set_parquet(&info).await.expect("the file");
    (info, bytes)
}

fn counted(kind: &str) -> Value {
    json!({ "kind": kind, "seed": 7, "sampling": { "kind": "count", "count": 40 } })
}

/// One small set of every method, and the SHA-256 of its file.
///
/// A change of sampling or oracle may change the bytes: then say so in its `VERSION` and put the new hashes here. No
/// machine, compiler or number of threads may.
fn golden() -> Vec<(RunSpec, &'static str)> {
    let steps = json!({ "kind": "paper_compat", "rotate": 90.0, "move": 90.0 });
    vec![
        (
            spec("stock:sponge@600", counted("sphere"), json!({})),
            "4a9f986c5d6436adddbeb14c0c71352cad89dac2f4a93af27f7505bde77ae43a",
        ),
        (
            spec(
                "stock:sponge@600",
                json!({ "kind": "sphere", "sampling": steps }),
                json!({ "separation": { "kind": "relative", "distance": 0.2 } }),
            ),
            "4c3aa956dac82a60dda81812e3144c433f6c6fda54fa5d722e59d430700c44b5",
        ),
        (
            spec("stock:sponge@600", counted("grid"), json!({ "separation": { "kind": "ladder" } })),
            "2a66549c8f927a05f8bee530736ad0ca6e9a0f6540b6f39d4edf7ecde0624f72",
        ),
        (
            spec("stock:sponge@600", json!({ "kind": "trajectory", "center_distance": 0.9, "count": 40 }), json!({})),
            "10e0382cc56344480857f4d3254377a320f87a26b16a90ec31bcdda918919166",
        ),
        (
            spec("stock:sponge@600", json!({ "kind": "random", "count": 40, "hit_share": 0.3 }), json!({})),
            "4d300cd27851033b42414dd7e8225778eae45ae2f1fb167f8971ce5138741c22",
        ),
    ]
}

#[tokio::test]
async fn a_set_is_the_same_bytes_everywhere_and_found_once() {
    let mut wrong = Vec::new();
    for (spec, sha256) in golden() {
        let data = tempfile::tempdir().expect("a folder");
        let engine = Engine::open(common::idle_config(data.path())).await.expect("an engine");
        let (info, bytes) = make(&engine, &spec).await;
        if info.sha256 != sha256 {
            wrong.push(format!("{:?}: {} instead of {sha256}", spec.method, info.sha256));
        }
        // It is kept; whoever asks again need not search.
        let stored = engine.set_job(&spec).await.expect("a good spec").stored.expect("it is kept");
        assert_eq!((&stored.sha256, stored.configurations), (&info.sha256, info.configurations));
        assert_eq!(info.classes.iter().map(|c| c.count).sum::<u32>(), info.configurations);
        assert!(info.configurations + info.missed_rays >= 36, "{info:?}");
        assert!(info.coverage_a > 0.0 && info.coverage_a <= 1.0 && info.evenness_a <= 1.0, "{info:?}");
        assert_eq!(info.box_side.is_some(), matches!(spec.method, Method::Random { .. }));
        assert_eq!(info.spacing.is_some(), matches!(spec.method, Method::Grid { .. }));
        // The file can be given as configurations: the same poses have the same truth.
        let poses = read_matrices(&bytes).expect("our own file");
        assert_eq!(poses.len() as u32, info.configurations);
        let method = engine.add_configurations(bytes.clone()).await.expect("our own file");
        let (again, _) =
            make(&engine, &RunSpec { method, separation: Separation::Relative { distance: 0.0 }, ..spec.clone() })
                .await;
        assert_eq!((again.configurations, &again.classes), (info.configurations, &info.classes));
        assert_eq!(again.missed_rays, 0);
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[tokio::test]
async fn a_set_does_not_depend_on_the_threads() {
    let data = tempfile::tempdir().expect("a folder");
    let engine = Engine::open(common::idle_config(data.path())).await.expect("an engine");
    let job = engine.set_job(&spec("stock:sponge@600", counted("grid"), json!({}))).await.expect("a good spec");
    let found = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| job.find(&Gauge::default())).expect("a set").expect("not stopped")
    };
    assert_eq!(found(1), found(3));
    let stopped = Gauge::default();
    stopped.stop.store(true, std::sync::atomic::Ordering::Relaxed);
    assert!(job.find(&stopped).expect("no fault").is_none());
    // Also while it looks for a box, of which there is none: a speck does not meet a chair so often.
    let speck = b"v 0 0 0\nv 1e-6 0 0\nv 0 1e-6 0\nf 1 2 3\n".to_vec();
    let speck = engine.add_object("speck.obj", speck, None).await.expect("a mesh").id;
    let often = json!({ "kind": "random", "count": 9, "hit_share": 0.9 });
    let job = engine.set_job(&spec(&speck, often, json!({}))).await.expect("a good spec");
    let error = job.find(&Gauge::default()).map(|_| ()).expect_err("no box").to_string();
    assert!(error.contains("no box gives"), "{error}");
    assert!(job.find(&stopped).expect("no fault").is_none());
}

#[tokio::test]
async fn what_cannot_be_is_refused_in_one_sentence() {
    let data = tempfile::tempdir().expect("a folder");
    let engine = Engine::open(common::idle_config(data.path())).await.expect("an engine");
    let random = |share: f64| json!({ "kind": "random", "count": 9, "hit_share": share });
    let cases = [
        (
            counted("sphere"),
            json!({ "separation": { "kind": "step", "of_size": 0.5 } }),
            "a step must be from 7e-15 to 0.1",
        ),
        (random(0.5), json!({ "separation": { "kind": "ladder" } }), "require the sphere or the grid method"),
        (random(1.0), json!({}), "the share of colliding poses must be more than 0 and less than 1"),
        (json!({ "kind": "trajectory", "center_distance": -1.0 }), json!({}), "the distance of the centres"),
        (json!({ "kind": "trajectory", "center_distance": 1.0, "count": 0 }), json!({}), "at least 1"),
        (json!({ "kind": "grid", "sampling": { "kind": "steps", "rotate": 90.0, "move": 0.0 } }), json!({}), "move-by"),
    ];
    for (method, separation, must_say) in cases {
        let spec = spec("stock:sponge@600", method, separation);
        let error = engine.set_job(&spec).await.err().expect("refused");
        assert!(matches!(error, EngineError::Invalid(_)), "{error:?}");
        assert!(error.to_string().contains(must_say), "{error} does not say {must_say:?}");
    }
    // So fine a grid is only known to be one when the objects are.
    let fine = json!({ "kind": "grid", "sampling": { "kind": "steps", "rotate": 180.0, "move": 0.3 } });
    let job = engine.set_job(&spec("stock:sponge@600", fine, json!({}))).await.expect("it may be");
    let error = job.find(&Gauge::default()).map(|_| ()).expect_err("too fine").to_string();
    assert!(error.contains("positions for each rotation"), "{error}");
    // Far objects would cost without limit.
    let far = json!([[1, 0, 0, 1e9, 0, 1, 0, 0, 0, 0, 1, 0]]).to_string();
    let method = engine.add_configurations(far.into_bytes()).await.expect("finite poses");
    let job = engine.set_job(&RunSpec { method, ..spec("stock:sponge@600", random(0.5), json!({})) }).await;
    let error = job.expect("known file").find(&Gauge::default()).map(|_| ()).expect_err("too far").to_string();
    assert!(error.contains("times their size apart"), "{error}");
}
