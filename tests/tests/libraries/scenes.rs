//! Whole scenes: libraries that offer them answer about any two of several objects, in any order of pairs.

use nalgebra::Vector3;
use ocb_core::configuration::{Class, Configuration};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::stock;
use ocb_sandbox::{Launcher, Objects, Policy, Profile, Question, Trial};
use ocb_tests::place::built;

const OFFER: [&str; 6] = ["bullet", "cgal", "coal", "embree", "fcl", "parry"];

#[test]
fn libraries_answer_about_any_two_objects_of_a_scene() {
    let objects = [("sphere", 500), ("torus-knot", 600), ("gear", 2000), ("torus-knot", 1000)];
    let meshes: Vec<Mesh> =
        objects.map(|(name, triangles)| stock::generate(name, triangles).expect("a stock object")).into();
    let shapes: Vec<Shape> = meshes.iter().map(|mesh| Shape::new(mesh.clone().into())).collect();
    let all: Vec<&Mesh> = meshes.iter().collect();
    let policy = Policy { trusted: true, profile: Profile::Dev, rough_clock: true, ..Policy::default() };
    let launcher = Launcher::new(built("ocb-runner"), policy);
    for algorithm in OFFER {
        let plugin = built(&format!("libocb_{algorithm}.so"));
        let objects = Objects::Scene(&all);
        let trial = Trial { plugin: &plugin, algorithm, objects, parameters: &[], semantics: Semantics::Surface };
        let mut session = launcher.start(&trial).unwrap_or_else(|end| panic!("{algorithm}: {end} {}", end.stderr));
        let mut seen = [0, 0];
        for turn in 0..64_u32 {
            let objects = [turn % 4, (turn / 4 + turn) % 4];
            let [a, b] = objects.map(|object| &shapes[object as usize]);
            let side = meshes[objects[0] as usize].longest_side();
            let along = Vector3::new(0.21, 0.13, 0.17) * (f64::from(turn % 7) * side);
            let configuration =
                Configuration { pose_a: Pose::identity(), pose_b: Pose { translation: along, ..Pose::identity() } };
            let truth = Pair::new(a, b).truth(&configuration);
            if truth.class32 == Class::Grazing {
                continue;
            }
            let question = Question { query: Query::CollisionFirst, objects, configuration };
            let answer = session.question(&question).expect("an answer").answer;
            let Answer::Collision { hit, .. } = answer else { panic!("{algorithm}: {answer:?}") };
            // Bullet is known for collisions that are none.
            let right = hit == truth.hit || (algorithm == "bullet" && hit);
            assert!(right, "{algorithm}, objects {objects:?}, turn {turn}: {hit}, but {truth:?}");
            seen[usize::from(truth.hit)] += 1;
        }
        assert!(seen.iter().all(|n| *n > 8), "{algorithm}: {seen:?}");
    }
}
