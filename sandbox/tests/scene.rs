//! Scenes of many objects in one process: each is built once, after the others and out of their sight, and every query names two.

mod common;

use common::{apart, fixture, launcher};
use nalgebra::Point3;
use ocb_core::mesh::Mesh;
use ocb_core::query::{Answer, Query};
use ocb_sandbox::{Ending, Objects, Outcome, Phase, Question, Session, Trial};

/// Four fans, of one triangle, of two, of three and of four.
fn fans() -> Vec<Mesh> {
    let corner = |i: u32| Point3::new(f64::from(i) + 1.0, f64::from(i * i), 0.5);
    let fan = |n: u32| {
        let corners = std::iter::once(Point3::origin()).chain((0..=n).map(corner)).collect();
        Mesh::new(corners, (1..=n).map(|i| [0, i, i + 1]).collect()).unwrap()
    };
    (1..=4).map(fan).collect()
}

fn start(defines: &[&str], parameters: &[(String, f64)]) -> Result<Session, Ending> {
    let fans = fans();
    let meshes: Vec<&Mesh> = fans.iter().collect();
    let plugin = fixture(defines);
    let trial = Trial { parameters, ..Trial::of(&plugin, "fixture", Objects::Scene(&meshes)) };
    launcher().start(&trial)
}

fn refused(defines: &[&str]) -> Outcome {
    match start(defines, &[]) {
        Ok(session) => panic!("it was loaded: {:?}", session.finish()),
        Err(ending) => ending.outcome,
    }
}

#[test]
fn every_query_is_about_the_two_objects_that_it_names() {
    let mut session = start(&["TELL_BUILDS"], &[]).unwrap();
    let set_up = session.set_up();
    assert!(set_up.build_ns > 0.0 && set_up.load_ns > 0.0, "{set_up:?}");
    for turn in 0..32u32 {
        let objects = [turn * 7 % 4, turn / 4 % 4];
        let question = Question { query: Query::CollisionFirst, objects, configuration: apart(0.5) };
        // The fixture names its number of builds, and the last triangle of the object that stands second.
        let hit = Answer::Collision { hit: true, pair: Some([4, objects[1]]) };
        assert_eq!(session.question(&question).unwrap().answer, hit, "{objects:?}");
        // In between another kind of query, about the objects in the other order.
        let [a, b] = objects;
        let question = Question { query: Query::Proximity, objects: [b, a], configuration: apart(2.5) };
        let sample = session.question(&question).unwrap();
        let told =
            matches!(sample.answer, Answer::Distance { distance: 2.5, triangles: Some([0, last]), .. } if last == a);
        assert!(told && sample.time_ns > 0.0, "{objects:?}: {sample:?}");
    }
    assert_eq!(session.finish().outcome, Outcome::Completed);
}

#[test]
fn no_object_is_in_sight_before_it_is_built() {
    let session = start(&["FAULT_PEEK"], &[]).unwrap_or_else(|ending| panic!("{ending}"));
    assert_eq!(session.finish().outcome, Outcome::Completed);
}

#[test]
fn a_plugin_that_does_not_offer_scenes_with_its_parameters_gets_none() {
    let ending = start(&[], &[("knob".into(), 0.0)]).err().expect("no scene");
    let reason = "it does not offer ocb.scene/1 with these parameters".to_owned();
    assert_eq!(ending.outcome, Outcome::Failed { phase: Phase::Load, reason });
}

#[test]
fn what_happens_at_the_third_object_has_a_name() {
    let phase = Phase::Build;
    let third = |attack: &str| refused(&[attack, "IN_BUILD", "AT_OBJECT=2", "KEEPS_ITS_FILE"]);
    assert_eq!(third("ATTACK=store_to_null"), Outcome::Signaled { phase, signal: libc::SIGSEGV });
    assert_eq!(third("ATTACK=loop"), Outcome::TimedOut { phase, limit_seconds: 3.0, cpu: false });
    let reason = "it ended its process with exit status 0".to_owned();
    assert_eq!(third("ATTACK=leave"), Outcome::Failed { phase, reason });
    // The tighter filters hold since before the first object.
    let Outcome::Failed { phase: Phase::Build, reason } = third("ATTACK=more_code") else { panic!("no error") };
    assert_eq!(reason, "load_mesh returned OCB_ERROR: EPERM");
    let Outcome::Failed { phase: Phase::Build, reason } = refused(&["FAULT_NO_OBJECT"]) else { panic!("no error") };
    assert_eq!(reason, "load_mesh returned OCB_OK and no object");
}

#[test]
#[should_panic(expected = "names an object that was not loaded")]
fn the_host_never_asks_about_an_object_that_is_not_there() {
    let mut session = start(&[], &[]).unwrap();
    let _ = session.question(&Question { query: Query::CollisionFirst, objects: [0, 4], configuration: apart(0.5) });
}
