//! Whole runs whose answers are known: solid bodies, lists of contacts, eps*.

mod common;

use ocb_core::query::Semantics;
use ocb_service::model::{RunSpec, State};
use ocb_service::{Engine, EngineError};

/// A tetrahedron, with and without its last face.
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// Raw matrices that shift B.
fn shifts(all: &[[f64; 3]]) -> Vec<u8> {
    let matrix = |[x, y, z]: [f64; 3]| [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z, 0.0, 0.0, 0.0, 1.0];
    all.iter().flat_map(|shift| matrix(*shift)).flat_map(f64::to_le_bytes).collect()
}

async fn object(engine: &Engine, name: &str, text: &str) -> String {
    engine.add_object(name, text.as_bytes().to_vec(), Some("guest")).await.unwrap().id
}

/// The small tetrahedron inside the large one, across its surface, and beside it.
async fn spec(engine: &Engine, query: &str, semantics: Semantics) -> RunSpec {
    let large = TETRAHEDRON.replace(" 1 0 0", " 8 0 0").replace("v 0 1 0", "v 0 8 0").replace("v 0 0 1", "v 0 0 8");
    let method =
        engine.add_configurations(shifts(&[[1.0, 1.0, 1.0], [-0.25, 1.0, 1.0], [9.0, 0.0, 0.0]])).await.unwrap();
    RunSpec {
        object_a: object(engine, "large", &large).await,
        object_b: Some(object(engine, "small", TETRAHEDRON).await),
        semantics,
        method,
        ..common::spec(query, 1, 0)
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_inside_collides_as_a_solid_body_and_not_as_a_surface() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    for (query, surface, solid) in [
        ("collision_first", ["false", "true", "false"], ["true", "true", "false"]),
        ("proximity", ["1.0", "0.0", "1.0"], ["0.0", "0.0", "1.0"]),
    ] {
        for (semantics, expected) in [(Semantics::Surface, surface), (Semantics::Solid, solid)] {
            let mut spec = spec(&engine, query, semantics).await;
            if semantics == Semantics::Surface {
                spec.algorithms = vec!["brute-force".into()];
            }
            let run = engine.submit(spec, Some("guest")).await.unwrap();
            assert_eq!(run.spec.algorithms, ["brute-force"], "the only one that knows solid bodies");
            let (run, _) = common::finish(&engine, &run.id).await;
            assert_eq!(run.state, State::Done, "{:?}", run.message);
            let result = &run.results[0];
            assert_eq!((result.n, result.wrong), (3, 0), "{query} {semantics:?}: {:?}", result.verdicts);
            let csv = String::from_utf8(engine.records_csv(&run.id, "brute-force").await.unwrap()).unwrap();
            let column = if query == "proximity" { "distance" } else { "hit" };
            assert_eq!(values(&csv, column), expected, "{query} {semantics:?}");
        }
    }
    engine.shutdown().await;
}

/// One column of a CSV file.
fn values(csv: &str, column: &str) -> Vec<String> {
    let place = csv.lines().next().unwrap().split(',').position(|name| name == column).unwrap();
    csv.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().to_owned()).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn solid_bodies_are_refused_where_they_mean_nothing() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let good = spec(&engine, "collision_first", Semantics::Solid).await;
    let open = object(&engine, "open", TETRAHEDRON.strip_suffix("f 3 1 4\n").unwrap()).await;
    for (spec, must_say) in [
        (RunSpec { object_a: open.clone(), ..good.clone() }, "\"open\" is open"),
        (RunSpec { object_b: Some(open), ..good.clone() }, "\"open\" is open"),
        (RunSpec { algorithms: vec!["parry".into()], ..good.clone() }, "of solid bodies; these do: brute-force"),
        (RunSpec { query: ocb_core::query::Query::CollisionAll, ..good.clone() }, "choose first contact or distance"),
    ] {
        match engine.submit(spec, Some("guest")).await {
            Err(EngineError::Invalid(sentence)) => assert!(sentence.contains(must_say), "{sentence}"),
            other => panic!("{other:?} instead of {must_say:?}"),
        }
    }
    engine.shutdown().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn results_carry_contacts_resolution_and_agreement() {
    let data = tempfile::tempdir().unwrap();
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let mut wanted = spec(&engine, "collision_all", Semantics::Surface).await;
    wanted.algorithms = vec!["box-tree".into(), "brute-force".into()];
    // Crossing, beside, and in one place with a shared face.
    wanted.object_b = None;
    let places = shifts(&[[0.5, 0.5, 0.5], [20.0, 0.0, 0.0], [0.0, 0.0, 0.0]]);
    wanted.method = engine.add_configurations(places).await.unwrap();
    let run = engine.submit(wanted.clone(), Some("guest")).await.unwrap();
    let (run, _) = common::finish(&engine, &run.id).await;
    assert_eq!(run.state, State::Done, "{:?}", run.message);
    for result in &run.results {
        assert_eq!((result.n, result.wrong), (3, 0), "{result:?}");
        let contacts = result.contacts.expect("lists were asked for");
        assert_eq!((contacts.precision, contacts.recall), (Some(1.0), Some(1.0)), "{contacts:?}");
        assert!(contacts.robust > 0 && contacts.listed >= contacts.robust, "{contacts:?}");
        let resolution = result.resolution.as_ref().expect("it is always computed");
        assert!(!resolution.seen && resolution.eps.is_some_and(|eps| eps > 0.0), "{resolution:?}");
        assert_eq!((resolution.false_hits.n, resolution.false_hits.wrong, resolution.misses.wrong), (1, 0, 0));
        assert_eq!(result.grazing.n, result.grazing.agree, "{:?}", result.grazing);
    }
    let csv = String::from_utf8(engine.records_csv(&run.id, "box-tree").await.unwrap()).unwrap();
    assert_eq!(values(&csv, "precision"), ["1.0", "", "1.0"]);

    wanted.query = ocb_core::query::Query::Proximity;
    wanted.algorithms = vec!["parry".into()];
    let run = engine.submit(wanted, Some("guest")).await.unwrap();
    let (run, _) = common::finish(&engine, &run.id).await;
    assert!(run.stages[1].message.as_deref().is_some_and(|m| m.contains("Saved positions")), "truth is computed once");
    let result = &run.results[0];
    assert!(
        result.contacts.is_none()
            && result.resolution.as_ref().is_some_and(|r| r.distance.as_ref().is_some_and(|d| d.n == 3))
    );
    engine.shutdown().await;
}
