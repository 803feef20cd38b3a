//! Advice about small scenes: enough, never wrong, and what stands beside it in the plot.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use ocb_advisor::{
    Advice, Kind, Level, Question, Scene, Shelf, Unwatched, Watch, advise, ladder, sample, usual_distances,
};
use ocb_core::stock;

fn levels(name: &str, triangles: u32, shelf: &Shelf) -> Vec<Level> {
    let mesh = stock::generate(name, triangles).expect("a stock object");
    ladder(name, &Arc::new(mesh), shelf, &Unwatched).expect("nobody stops it")
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

#[test]
fn a_distance_gets_the_fewest_triangles_that_keep_the_tolerance() {
    let (a, b) = (levels("torus-knot", 3000, &Shelf::none()), levels("gear", 2000, &Shelf::none()));
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
    let (a, b) = (levels("torus-knot", 2000, &Shelf::none()), levels("wreath", 2000, &Shelf::none()));
    let told = advice(&a, &b, |side| Question::Clearance { clearance: 0.05 * side }, &Unwatched).expect("not stopped");
    assert_eq!((told.held_out.wrong.seen, told.held_out.violations.seen), (0, 0), "{:?}", told.held_out);
    let find = |kind| told.points.iter().find(|p| p.kind == kind).expect("it is in the plot");
    let (boxes, hulls) = (find(Kind::Boxes), find(Kind::Hulls));
    let alarms = |point: &ocb_advisor::Point| point.false_alarms.expect("counted");
    assert!(
        alarms(boxes).seen > 0 && alarms(hulls).seen <= alarms(boxes).seen,
        "{:?} {:?}",
        alarms(boxes),
        alarms(hulls)
    );
    // What is around the objects misses nothing.
    assert_eq!((boxes.missed.expect("counted").seen, hulls.missed.expect("counted").seen), (0, 0));
    assert!(!boxes.certified && find(Kind::Levels).certified);
}

#[test]
fn the_surfaces_touch_or_not_is_a_clearance_of_nothing() {
    let (a, b) = (levels("castle", 700, &Shelf::none()), levels("chair", 700, &Shelf::none()));
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

#[test]
fn it_can_be_stopped_at_any_time_and_certificates_are_found_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let shelf = Shelf::folder(folder.path());
    let fresh = levels("gear", 900, &shelf);
    let kept = std::fs::read_dir(folder.path()).expect("it is there").count();
    assert_eq!(kept + 1, fresh.len());
    let again = levels("gear", 900, &shelf);
    assert!(fresh.iter().zip(&again).all(|(x, y)| x.certificate == y.certificate && x.mesh == y.mesh));
    for looks in [0, 1, 20, 300] {
        let watch = Impatient(AtomicU32::new(looks));
        let question = |side: f64| Question::Distance { tolerance: 0.01 * side };
        assert!(advice(&fresh, &again, question, &watch).is_none(), "{looks}");
    }
    let mesh = Arc::clone(&fresh[0].mesh);
    assert!(ladder("gear", &mesh, &Shelf::none(), &Impatient(AtomicU32::new(3))).is_none());
}
