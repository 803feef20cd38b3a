//! Advice about small scenes: enough, never wrong, and what stands beside it in the plot.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use nalgebra::Point3;
use ocb_advice::{Advice, Certificate, Kind, Point, Question, Unit, Unwatched, Watch, usual_distances};
use ocb_advisor::{Level, Scene, advise, ladder, sample};
use ocb_core::mesh::Mesh;
use ocb_core::stock;

fn levels(name: &str, triangles: u32) -> Vec<Level> {
    let mesh = stock::generate(name, triangles).expect("a stock object");
    ladder(&Arc::new(mesh), &[], &Unwatched).expect("nobody stops it")
}

fn advice(a: &[Level], b: &[Level], question: impl Fn(f64) -> Question, watch: &dyn Watch) -> Option<Advice> {
    let side = a[0].mesh.longest_side();
    let question = question(side);
    let distances = usual_distances(question, side);
    let shapes = [a[0].lod.shape(), b[0].lod.shape()];
    let both = |seed| sample(shapes, &distances, 120, seed, "", &Unwatched).expect("it can be sampled");
    let (chosen_by, held_out) = (both(1), both(2));
    let scene = Scene { ladders: [a, b], question, distances: &distances, sample: &chosen_by, held_out: &held_out };
    advise(&scene, watch)
}

fn by_name<'a>(advice: &'a Advice, algorithm: &str) -> &'a Point {
    let named = |point: &&Point| point.algorithm.as_deref() == Some(algorithm);
    advice.points.iter().find(named).unwrap_or_else(|| panic!("{algorithm} is not there: {:?}", advice.left_out))
}

#[test]
fn a_distance_gets_the_fewest_triangles_that_keep_the_tolerance() {
    let (a, b) = (levels("torus-knot", 3000), levels("gear", 2000));
    let told = |share: f64| {
        advice(&a, &b, |side| Question::Distance { tolerance: share * side }, &Unwatched).expect("nobody stops it")
    };
    let (coarse, fine) = (told(0.08), told(0.02));
    for (share, advice) in [(0.08, &coarse), (0.02, &fine)] {
        let most = share * advice.longest_side;
        assert!(advice.guaranteed_error.expect("a distance has one") <= most);
        let held = &advice.held_out;
        assert_eq!(
            (held.wrong.seen, held.violations.seen, held.wrong.of),
            (0, 0, advice.held_out.wrong.of),
            "{held:?}"
        );
        assert!(held.observed_error.expect("a distance has one") <= most && held.wrong.of >= 100, "{held:?}");
        // Nothing fell back on the configurations that it was chosen by.
        let own = advice.points.iter().find(|p| p.advised).expect("it is in the plot");
        assert_eq!(own.falls_back.expect("counted").seen, 0);
        // A level that was seen to be off cannot have been certified to be less.
        for point in advice.points.iter().filter(|p| p.certified) {
            if let (Some(sure), Some(seen)) = (point.guaranteed_error, point.observed_error) {
                assert!(seen <= sure * (1.0 + 1e-9) + 1e-12, "{point:?}");
            }
        }
    }
    assert!(coarse.triangles_after < fine.triangles_after && fine.triangles_after <= 5000, "{:?}", fine.stages);
    let detail = &fine.detail[0].triangles;
    assert_eq!(detail.len(), a[0].mesh.positions().len());
    let needed: Vec<f64> = detail.iter().flatten().copied().collect();
    assert!(!needed.is_empty() && needed.iter().all(|n| a.iter().any(|l| l.mesh.triangles().len() as f64 == *n)));
}

#[test]
fn a_clearance_is_never_answered_wrongly_and_boxes_raise_false_alarms() {
    let (a, b) = (levels("torus-knot", 2000), levels("wreath", 2000));
    let told = advice(&a, &b, |side| Question::Clearance { clearance: 0.05 * side }, &Unwatched).expect("not stopped");
    assert_eq!((told.held_out.wrong.seen, told.held_out.violations.seen), (0, 0), "{:?}", told.held_out);
    let find = |kind| told.points.iter().find(|p| p.kind == kind).expect("it is in the plot");
    let (boxes, hulls) = (find(Kind::Boxes), find(Kind::Hulls));
    let alarms = |point: &ocb_advice::Point| point.false_alarms.expect("counted");
    assert!(
        alarms(boxes).seen > 0 && alarms(hulls).seen <= alarms(boxes).seen,
        "{:?} {:?}",
        alarms(boxes),
        alarms(hulls)
    );
    // What is around the objects misses nothing.
    assert_eq!((boxes.missed.expect("counted").seen, hulls.missed.expect("counted").seen), (0, 0));
    assert!(!boxes.certified && find(Kind::Levels).certified);
    // Hulls of parts and maps of voxels hold the surfaces; spheres lie inside them.
    let wrong = |algorithm: &str| {
        let point = by_name(&told, algorithm);
        assert!(!point.certified && point.observed_error.is_none(), "{point:?}");
        [point.false_alarms, point.missed].map(|share| share.expect("counted").seen)
    };
    let (coarse, fine) = (wrong("convex-parts:depth=5"), wrong("convex-parts:depth=7"));
    assert!(coarse[1] == 0 && fine[1] == 0 && fine[0] <= coarse[0], "parts: {coarse:?} {fine:?}");
    assert!(coarse[0] < alarms(boxes).seen, "parts: {coarse:?}");
    let (coarse, fine) = (wrong("voxmap-pointshell:voxel=0.01"), wrong("voxmap-pointshell:voxel=0.005"));
    assert!(coarse[1] == 0 && fine[1] == 0 && 0 < coarse[0] && fine[0] < coarse[0], "voxels: {coarse:?} {fine:?}");
    let (coarse, fine) = (wrong("inner-spheres:spheres=512"), wrong("inner-spheres:spheres=4096"));
    assert!(coarse[0] == 0 && fine[0] == 0 && fine[1] <= coarse[1], "spheres: {coarse:?} {fine:?}");
    // No configuration is so near the clearance that rounding to f32 decides.
    assert_eq!([wrong("parry"), wrong("parry-f32")], [[0; 2]; 2]);
    assert_eq!(told.left_out, []);
}

#[test]
fn other_methods_err_as_they_do_and_less_with_a_finer_knob() {
    let (a, b) = (levels("torus-knot", 3000), levels("gear", 2000));
    let told = advice(&a, &b, |side| Question::Distance { tolerance: 0.02 * side }, &Unwatched).expect("not stopped");
    let error = |algorithm: &str| {
        let point = by_name(&told, algorithm);
        assert!(!point.certified && point.guaranteed_error.is_none() && point.micros.lo > 0.0, "{point:?}");
        point.observed_error.expect("a distance has one") / told.longest_side
    };
    let (coarse, fine) = (error("convex-parts:depth=5"), error("convex-parts:depth=7"));
    assert!(1e-4 < fine && fine < coarse && coarse < 0.5, "parts: {coarse} {fine}");
    let (coarse, fine) = (error("inner-spheres:spheres=512"), error("inner-spheres:spheres=4096"));
    assert!(1e-4 < fine && fine < coarse && coarse < 0.5, "spheres: {coarse} {fine}");
    let (single, double) = (error("parry-f32"), error("parry"));
    // Surfaces that are 0.3 % apart meet for it in single precision.
    assert!(double < 1e-6 && double < single && single < 0.004, "parry: {single} {double}");
    // Sizes are counted in what a model consists of.
    let size = |algorithm: &str| (by_name(&told, algorithm).elements, by_name(&told, algorithm).unit);
    assert_eq!(size("inner-spheres:spheres=512"), (1024, Unit::Spheres));
    assert_eq!(size("parry-f32"), (told.triangles_before, Unit::Triangles));
    let (coarse, fine) = (size("voxmap-pointshell:voxel=0.01"), size("voxmap-pointshell:voxel=0.005"));
    assert!(coarse.1 == Unit::Voxels && 2 * coarse.0 < fine.0, "voxels: {coarse:?} {fine:?}");
    let (coarse, fine) = (size("convex-parts:depth=5"), size("convex-parts:depth=7"));
    assert!(coarse.1 == Unit::Triangles && coarse.0 < fine.0, "parts: {coarse:?} {fine:?}");
    // Voxels know no distance, and are asked what the objects are asked instead of one.
    let voxels = by_name(&told, "voxmap-pointshell:voxel=0.01");
    assert!(voxels.observed_error.is_none() && voxels.missed.expect("counted").seen == 0, "{voxels:?}");
}

#[test]
fn what_cannot_be_made_of_an_object_is_left_out_with_a_reason() {
    let mesh = |name, triangles| stock::generate(name, triangles).expect("a stock object");
    let ball = mesh("sphere", 600);
    let bowl = Mesh::new(ball.positions().to_vec(), ball.triangles()[..400].to_vec()).expect("a mesh");
    let corner = |i: u32| Point3::new(f64::from(i % 9), f64::from(i / 9), 0.0);
    let square = |i: u32| [[i, i + 1, i + 9], [i + 1, i + 10, i + 9]];
    let flat = (0..80).filter(|i| i % 9 < 8).take(64).flat_map(square).collect();
    let plate = Mesh::new((0..81).map(corner).collect(), flat).expect("a mesh");
    let levels = |mesh: Mesh| ladder(&Arc::new(mesh), &[], &Unwatched).expect("nobody stops it");
    let (bowl, plate) = (levels(bowl), levels(plate));
    for (a, b, open) in [(&bowl, &plate, "A: "), (&plate, &bowl, "A: ")] {
        let told = advice(a, b, |side| Question::Clearance { clearance: 0.5 * side }, &Unwatched).expect("not stopped");
        let reason = |what: &str| {
            let left_out = told.left_out.iter().find(|left_out| left_out.what.iter().any(|name| name == what));
            left_out.unwrap_or_else(|| panic!("{what} is there: {:?}", told.left_out)).reason.clone()
        };
        for spheres in ["inner-spheres:spheres=512", "inner-spheres:spheres=4096"] {
            assert!(reason(spheres).starts_with(open) && reason(spheres).contains("odd number"), "{}", reason(spheres));
        }
        assert!(reason("voxmap-pointshell:voxel=0.005").contains("no further than 16"), "{:?}", told.left_out);
        for there in ["convex-parts:depth=5", "parry", "parry-f32"] {
            assert_eq!(by_name(&told, there).missed.expect("counted").seen, 0, "{there}");
        }
    }
}

#[test]
fn the_surfaces_touch_or_not_is_a_clearance_of_nothing() {
    let (a, b) = (levels("castle", 700), levels("chair", 700));
    let told = advice(&a, &b, |_| Question::Clearance { clearance: 0.0 }, &Unwatched).expect("not stopped");
    assert_eq!((told.held_out.wrong.seen, told.held_out.violations.seen), (0, 0), "{:?}", told.held_out);
}

/// Stops after so many looks.
struct Impatient(AtomicU32);

impl Watch for Impatient {
    fn step(&self, _: &str, _: u64, _: u64) {}

    fn stopped(&self) -> bool {
        self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1)).is_err()
    }
}

/// Stops as soon as another method is at work, and counts what goes on.
#[derive(Default)]
struct NoOthers {
    stop: AtomicBool,
    after: AtomicU32,
}

impl Watch for NoOthers {
    fn step(&self, what: &str, _: u64, _: u64) {
        if self.stop.fetch_or(what == "other methods", Ordering::Relaxed) {
            self.after.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

#[test]
fn stopping_ends_the_other_methods_each_at_its_next_step() {
    let (a, b) = (levels("torus-knot", 1000), levels("gear", 900));
    let watch = NoOthers::default();
    assert!(advice(&a, &b, |side| Question::Clearance { clearance: 0.05 * side }, &watch).is_none());
    let (stopped, after) = (watch.stopped(), watch.after.load(Ordering::Relaxed));
    assert!(stopped && after < 8, "{after} steps");
}

#[test]
fn it_can_be_stopped_at_any_time_and_known_certificates_are_not_looked_for() {
    let fresh = levels("gear", 900);
    let known: Vec<Certificate> = fresh.iter().filter_map(|level| level.certificate.clone()).collect();
    assert_eq!(known.len() + 1, fresh.len());
    // One that asks to be stopped as soon as a certificate is looked for.
    let again = ladder(&fresh[0].mesh, &known, &Impatient(AtomicU32::new(0))).expect("nothing is looked for");
    assert!(fresh.iter().zip(&again).all(|(x, y)| x.certificate == y.certificate && x.mesh == y.mesh));
    for looks in [0, 1, 20, 300] {
        let watch = Impatient(AtomicU32::new(looks));
        let question = |side: f64| Question::Distance { tolerance: 0.01 * side };
        assert!(advice(&fresh, &again, question, &watch).is_none(), "{looks}");
    }
    let mesh = Arc::clone(&fresh[0].mesh);
    assert!(ladder(&mesh, &[], &Impatient(AtomicU32::new(3))).is_none());
}
