//! What the choice promises, asked of the oracle again.

mod bodies;
mod robot;

use std::collections::HashMap;

use nalgebra::{Point3, Rotation3, Vector3};
use ocb_advice::Unwatched;
use ocb_core::configuration::Truth;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::query::Semantics;
use ocb_core::scene::{Geometry, Scene, SceneObject, tessellate};
use ocb_core::stock;

use super::*;
use crate::model::BodyKind;
use crate::workload::mesh_of;

fn knot(triangles: u32) -> Mesh {
    stock::generate("torus-knot", triangles).expect("a knot")
}

/// A ring about z, of this many sections with this many triangles.
pub fn ring(sections: u32, triangles: u32) -> Mesh {
    let across = triangles / 2;
    let turn = |i: u32, of: u32| std::f64::consts::TAU * f64::from(i) / f64::from(of);
    let corner = |i: u32, j: u32| {
        let (u, v) = (turn(i, sections), turn(j, across));
        let out = 1.0 + 0.25 * v.cos();
        Point3::new(out * u.cos(), out * u.sin(), 0.25 * v.sin())
    };
    let all = |i: u32| (0..across).map(move |j| (i, j));
    let at = |i: u32, j: u32| (i % sections) * across + j % across;
    let sides = |(i, j)| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
    let positions = (0..sections).flat_map(all).map(|(i, j)| corner(i, j)).collect();
    Mesh::new(positions, (0..sections).flat_map(all).flat_map(sides).collect()).expect("a ring")
}

fn object(name: &str, geometry: Geometry) -> SceneObject {
    SceneObject {
        name: name.to_owned(),
        link: None,
        geometry,
        pose: Pose::identity(),
        source: String::new(),
        scale: [1.0; 3],
        licence: None,
    }
}

/// Three knots and a ball, of unit size: the first two come near each other, the third stays far away.
fn recording(queries: Vec<Recorded>) -> Recording {
    let mut meshes = HashMap::new();
    let geometry = SceneFile::keep(&mut meshes, knot(2000));
    let objects = ["a", "b", "far"].map(|name| object(name, geometry.clone()));
    let ball = object("ball", Geometry::Sphere { radius: 0.3 });
    let scene =
        Scene { name: "knots".into(), objects: objects.into_iter().chain([ball]).collect(), disabled: Vec::new() };
    Recording { scene: SceneFile { scene, meshes }, about: About::default(), queries }
}

fn turned(x: f64, angle: f64) -> Pose {
    let linear = *Rotation3::from_euler_angles(angle, 2.0 * angle, 0.3).matrix();
    Pose { linear, translation: Vector3::new(x, 0.1, -0.2) }
}

/// Every kind of query about every pair, at many places; each step is a group.
fn queries(kinds: &[Kind]) -> Vec<Recorded> {
    let side = knot(2000).longest_side();
    let mut queries = Vec::new();
    for step in 0..40 {
        for &kind in kinds {
            for objects in [[0, 1], [0, 2], [1, 2], [0, 3]] {
                let near = if objects[1] == 2 { 9.0 } else { 0.5 + 0.03 * f64::from(step) };
                let configuration =
                    Configuration { pose_a: Pose::identity(), pose_b: turned(near * side, 0.2 * f64::from(step)) };
                queries.push(Recorded {
                    sequence: queries.len() as u64,
                    group: u64::from(step as u32),
                    objects,
                    configuration,
                    kind,
                    limit: if kind == Kind::Tolerance { 0.1 * side } else { 0.0 },
                    answered: Answered { hit: Some(true), distance: None },
                    seconds: Some(1.0),
                    library: 0,
                });
            }
        }
    }
    queries
}

/// The same knot with fewer triangles, and the box as its hull.
fn make(_: &str, object: &Arc<Mesh>) -> Result<Option<Simplified>> {
    let bounds = object.bounds();
    let cuboid = tessellate::outside(&Geometry::Box { size: bounds.sides().into() }, 0.0).expect("a box");
    let moved = cuboid.positions().iter().map(|p| p + bounds.center().coords).collect();
    let hull = Mesh::new(moved, cuboid.triangles().to_vec()).expect("a box");
    let levels = [1400, 1000, 700].map(|triangles| Arc::new(knot(triangles)));
    Ok(Some(Simplified { levels: levels.into(), hull: Some(Arc::new(hull)), parts: Vec::new() }))
}

fn done(recording: &Recording, terms: ReduceTerms, make: Make<LabError>) -> Reduced {
    reduce(recording, terms, make, &Unwatched).expect("a reduction").expect("nothing stops it")
}

/// The truth about the surfaces of all queries, with polyhedra around curved bodies.
fn truths(recording: &Recording) -> Vec<Truth> {
    let objects = 0..recording.scene.scene.objects.len();
    let shapes: Vec<Shape> = objects.map(|object| Shape::new(mesh_of(recording, object).expect("a mesh"))).collect();
    let truth = |query: &Recorded| {
        let [a, b] = query.objects.map(|object| &shapes[object as usize]);
        Pair::new(a, b).truth(&query.configuration)
    };
    recording.queries.iter().map(truth).collect()
}

/// Lower and upper bounds of the same distances.
fn distances(recording: &Recording) -> Vec<[f64; 2]> {
    truths(recording).into_iter().map(|truth| [truth.distance_lo, truth.distance_hi]).collect()
}

#[test]
fn outside_only_misses_no_collision_and_keeps_what_is_far_apart() {
    let before = recording(queries(&[Kind::Collide]));
    let side = knot(2000).longest_side();
    let terms = ReduceTerms { tolerance: 0.02 * side, near: 0.0, outside_only: true, frontier: false };
    let after = done(&before, terms, &make);
    let bodies: Vec<BodyKind> = after.reduction.objects.iter().map(|it| it.body).collect();
    assert_eq!(bodies[2], BodyKind::Sphere, "an object that nothing comes near is a ball: {bodies:?}");
    assert_eq!(bodies[3], BodyKind::Object, "a ball stays what it is");
    assert_eq!((after.reduction.queries, after.reduction.grazing), (160, 0));
    let mut hits = 0;
    for (row, (truth, reduced)) in truths(&before).into_iter().zip(truths(&after.recording)).enumerate() {
        hits += u64::from(truth.hit);
        // As solid bodies, all of which are closed here.
        let collide = reduced.hit || reduced.is_inside(Semantics::Solid);
        assert!(!truth.hit || collide, "{row}: {truth:?} was missed: {reduced:?}");
        assert!(truth.distance_lo <= terms.tolerance || !collide, "{row}: {truth:?} became a collision");
    }
    assert!(hits > 5 && after.reduction.hits >= hits - 2, "{hits} {:?}", after.reduction.hits);
    assert!(after.recording.queries.iter().all(|query| query.answered == Answered::default()));
}

#[test]
fn distances_change_by_no_more_than_the_tolerance_also_where_objects_are_moved() {
    let before = recording(queries(&[Kind::Distance, Kind::Tolerance]));
    let side = knot(2000).longest_side();
    let terms = ReduceTerms { tolerance: 0.05 * side, near: 0.01 * side, outside_only: false, frontier: false };
    let mut after = done(&before, terms, &make);
    let bodies: Vec<BodyKind> = after.reduction.objects.iter().map(|it| it.body).collect();
    assert!(bodies[..3].contains(&BodyKind::Level), "{bodies:?}");
    assert!(after.reduction.objects.iter().map(|it| it.after).sum::<u64>() < 4_500);
    let largest = after.reduction.largest_change.expect("distances were asked for");
    assert!(largest > 0.0 && largest + 2.0 * terms.near <= terms.tolerance);
    let mut moved = recording(before.queries.clone());
    for step in [0.0, 0.99] {
        for (row, query) in moved.queries.iter_mut().enumerate() {
            let along = Vector3::new(1.0, (row % 5) as f64 - 2.0, (row % 3) as f64).normalize() * (step * terms.near);
            query.configuration.pose_b.translation += along;
            after.recording.queries[row].configuration.pose_b.translation += along;
        }
        let both = distances(&moved).into_iter().zip(distances(&after.recording));
        for (row, ([lo, hi], [below, above])) in both.enumerate() {
            let off = (above - lo).max(hi - below);
            // A far pair may change by anything where only a limit is asked.
            let free = moved.queries[row].kind == Kind::Tolerance && lo.min(below) > moved.queries[row].limit;
            // Of the ball this looks at the polyhedron around it.
            let ball = if moved.queries[row].objects[1] == 3 { 0.005 * 0.3 } else { 0.0 };
            assert!(free || off <= terms.tolerance + ball, "{row}: {lo} to {hi} became {below} to {above}");
        }
    }
}

#[test]
fn what_a_foreign_library_makes_is_not_believed() {
    let before = recording(queries(&[Kind::Collide, Kind::Distance]));
    let side = knot(2000).longest_side();
    let lies = |_: &str, object: &Arc<Mesh>| {
        let smaller = object.positions().iter().map(|p| p * 0.5).collect();
        let smaller = Arc::new(Mesh::new(smaller, object.triangles()[..700].to_vec()).expect("a mesh"));
        let parts = vec![vec![smaller.clone()], vec![smaller.clone(); 3]];
        Ok(Some(Simplified { levels: vec![smaller.clone()], hull: Some(smaller), parts }))
    };
    for outside_only in [true, false] {
        let after =
            done(&before, ReduceTerms { tolerance: 0.01 * side, near: 0.0, outside_only, frontier: false }, &lies);
        let bodies: Vec<BodyKind> = after.reduction.objects.iter().map(|it| it.body).collect();
        let hulls = [BodyKind::Hull, BodyKind::Hulls];
        assert!(!bodies.iter().any(|it| hulls.contains(it)), "a hull that contains nothing is none: {bodies:?}");
        assert!(!bodies[..2].contains(&BodyKind::Level), "{bodies:?}");
    }
}

#[test]
fn a_choice_that_does_not_hold_later_says_so() {
    // The last fifth comes much nearer than anything before.
    let mut asked = queries(&[Kind::Collide]);
    let side = knot(2000).longest_side();
    for query in &mut asked {
        let near = if query.group < 32 { 5.0 } else { 0.72 + 0.01 * (query.group - 32) as f64 };
        query.configuration.pose_b.translation.x = near * side;
    }
    let terms = ReduceTerms { tolerance: 0.01 * side, near: 0.0, outside_only: true, frontier: false };
    let after = done(&recording(asked), terms, &make);
    let held_out = after.reduction.held_out.expect("a fifth is held out");
    assert_eq!((held_out.queries, held_out.missed), (32, 0));
    assert!(held_out.changed.seen > 0 && held_out.examples.len() == held_out.changed.seen as usize);
    // The certificate is about the choice that has seen them all.
    assert!(after.reduction.objects[..2].iter().any(|it| it.body != BodyKind::Sphere), "{:?}", after.reduction.objects);
}

#[test]
fn terms_without_sense_are_refused() {
    let before = recording(queries(&[Kind::Collide]));
    let refused = |tolerance, near| {
        let terms = ReduceTerms { tolerance, near, outside_only: false, frontier: false };
        reduce(&before, terms, &make, &Unwatched).err().map(|e| e.to_string()).unwrap_or_default()
    };
    assert!(refused(0.0, 0.0).contains("tolerance") && refused(f64::NAN, 0.0).contains("tolerance"));
    assert!(refused(1.0, 0.5).contains("half") && refused(1.0, -1.0).contains("0 or more"));
}

#[test]
fn a_reduced_recording_is_read_again_with_meshes_that_stay() {
    // The mesh of the recording is known by the hash of other bytes than ours, as other recorders write them.
    let mut before = recording(queries(&[Kind::Distance]));
    let mesh = before.scene.meshes.drain().next().expect("a mesh").1;
    let name = "0f".repeat(32);
    for object in &mut before.scene.scene.objects[..3] {
        object.geometry = Geometry::Mesh { sha256: name.clone(), solid: false };
    }
    before.scene.meshes.insert(name, mesh);
    let after = done(&before, ReduceTerms { tolerance: 1e-7, near: 0.0, outside_only: true, frontier: false }, &make);
    assert!(after.reduction.objects[..2].iter().all(|it| it.body == BodyKind::Object));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("reduced.ocbrec");
    after.recording.write(&path).expect("a file");
    let again = Recording::read(&path).expect("a recording");
    assert_eq!((again.scene, again.queries), (after.recording.scene, after.recording.queries));
}

#[test]
fn a_reduction_that_is_stopped_says_nothing() {
    struct Stopped;
    impl Watch for Stopped {
        fn step(&self, _: &str, _: u64, _: u64) {}
        fn stopped(&self) -> bool {
            true
        }
    }
    let terms = ReduceTerms { tolerance: 1.0, near: 0.0, outside_only: true, frontier: false };
    assert!(reduce(&recording(queries(&[Kind::Collide])), terms, &make, &Stopped).expect("no fault").is_none());
}
