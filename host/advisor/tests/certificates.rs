//! What certificates say is true, and what is not true is found out.

use std::sync::Arc;

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use ocb_advice::{Certificate, Doubt, Unwatched};
use ocb_advisor::{Level, ladder, simplified};
use ocb_core::configuration::Configuration;
use ocb_core::lod::{Answer, LodPair};
use ocb_core::mesh::Mesh;
use ocb_core::numbers::Numbers;
use ocb_core::oracle::Pair;
use ocb_core::pose::Pose;
use ocb_core::stock;
use proptest::prelude::*;

fn object(name: &str, triangles: u32) -> Mesh {
    stock::generate(name, triangles).expect("a stock object")
}

fn share(numbers: &mut Numbers) -> f64 {
    numbers.bits() as f64 / u64::MAX as f64
}

/// Both objects turned somehow, the second up to `reach` away.
fn somehow(numbers: &mut Numbers, reach: f64) -> Configuration {
    let mut pose = |reach: f64| {
        let axis = Vector3::from_fn(|_, _| share(numbers) - 0.5);
        let turn = axis.normalize() * (6.3 * share(numbers));
        let linear: Matrix3<f64> = *Rotation3::new(turn).matrix();
        Pose { linear, translation: Vector3::from_fn(|_, _| 2.0 * reach * (share(numbers) - 0.5)) }
    };
    Configuration { pose_a: pose(0.0), pose_b: pose(reach) }
}

/// Every pair of levels in so many configurations; how many intervals were compared, and how many were narrow.
fn no_level_lies(a: &[Level], b: &[Level], configurations: u32, seed: u64) -> (u32, u32) {
    let whole = Pair::new(a[0].lod.shape(), b[0].lod.shape());
    let size = a[0].mesh.longest_side();
    let mut numbers = Numbers::new(seed);
    let (mut compared, mut narrow) = (0, 0);
    for _ in 0..configurations {
        let configuration = somehow(&mut numbers, 1.5 * size);
        let truth = whole.truth(&configuration);
        for level_a in a {
            for level_b in b {
                let levels = LodPair::new(&level_a.lod, &level_b.lod);
                let found = levels.distance(&configuration, 0.0);
                let told = format!("{found:?} of {} triangles, but {truth:?}", levels.triangles());
                assert!(found.lo <= truth.distance_hi && truth.distance_lo <= found.hi, "{told}");
                assert!(found.width() <= levels.most_width() * 1.001 + 1e-9 * size, "{told}");
                let early = levels.distance(&configuration, 0.05 * size);
                assert!(early.lo <= truth.distance_hi && truth.distance_lo <= early.hi, "early: {told}");
                for clearance in [0.5, 0.99, 1.01, 2.0].map(|x| x * (truth.distance_lo + 1e-3 * size)) {
                    match levels.clearance(&configuration, clearance) {
                        Answer::Clear => assert!(truth.distance_hi > clearance, "{clearance}: {told}"),
                        Answer::Closer => assert!(truth.distance_lo <= clearance, "{clearance}: {told}"),
                        Answer::Undecided => {}
                    }
                }
                compared += 1;
                narrow += u32::from(found.width() < 0.1 * size);
            }
        }
    }
    (compared, narrow)
}

#[test]
fn no_level_says_what_is_not_true() {
    for (name_a, name_b) in [("castle", "torus-knot"), ("gear", "sponge"), ("chair", "sphere")] {
        let (a, b) = (object(name_a, 900), object(name_b, 1200));
        let levels = |mesh: Mesh| ladder(&Arc::new(mesh), &[], &Unwatched).expect("nobody stops it");
        let (a, b) = (levels(a), levels(b));
        assert!(a.len() + b.len() >= 4, "{name_a}, {name_b}: {} and {} levels", a.len(), b.len());
        let (compared, narrow) = no_level_lies(&a, &b, 40, 7);
        assert!(compared >= 160 && narrow > compared / 4, "{narrow} of {compared} say something");
    }
}

#[test]
fn an_object_far_away_or_very_small_has_levels_too() {
    let ball = object("sphere", 500);
    for (scale, shift) in [(1e-30, 0.0), (1.0, 1e7), (1e12, 0.0)] {
        let moved: Vec<Point3<f64>> = ball.positions().iter().map(|p| p * scale + Vector3::repeat(shift)).collect();
        let moved = Mesh::new(moved, ball.triangles().to_vec()).expect("a mesh");
        let less = simplified(&moved, 120).expect("a mesh");
        assert!(less.triangles().len() <= 130, "{scale}, {shift}: {}", less.triangles().len());
        let certificate = Certificate::find(&moved, &less, &Unwatched).expect("nobody stops it");
        let [thickness, deviation] = certificate.worst().map(|x| x / scale);
        assert!(thickness > 1e-3 && thickness < 0.3 && deviation < 0.3, "{scale}, {shift}: {thickness} {deviation}");
        certificate.check(&moved, &less, &Unwatched).expect("it holds");
    }
}

#[test]
fn a_fault_planted_in_a_certificate_is_found() {
    let knot = object("torus-knot", 2000);
    let less = simplified(&knot, 250).expect("a mesh");
    let whole = Certificate::find(&knot, &less, &Unwatched).expect("nobody stops it");
    whole.check(&knot, &less, &Unwatched).expect("what was found holds");
    // No length is much larger than it must be, so none can be halved.
    let triangles = less.triangles().len();
    let found = |fault: &dyn Fn(&mut Certificate, usize)| {
        let broken = (0..triangles).step_by(10).filter(|&t| {
            let mut planted = whole.clone();
            fault(&mut planted, t);
            matches!(planted.check(&knot, &less, &Unwatched), Err(Doubt::Thickness(..) | Doubt::Deviation(..)))
        });
        broken.count() as f64 / triangles.div_ceil(10) as f64
    };
    assert_eq!(found(&|c, t| c.deviation[t] *= 0.5), 1.0, "deviations");
    let thickness = found(&|c, t| c.thickness[t] *= 0.5);
    // A neighbour may be thick enough for both.
    assert!(thickness > 0.6, "{thickness} of the faults in thickness are found");
    assert_eq!(found(&|c, _| c.thickness.iter_mut().for_each(|e| *e *= 0.9)), 1.0, "all of them a little");
    let other = object("torus-knot", 2200);
    assert!(matches!(whole.check(&other, &less, &Unwatched), Err(Doubt::OtherObject(_))));
    assert!(matches!(whole.check(&knot, &knot, &Unwatched), Err(Doubt::OtherMesh(_))));
    let short = Certificate { thickness: vec![0.0], ..whole };
    assert!(matches!(short.check(&knot, &less, &Unwatched), Err(Doubt::Lengths(_))));
}

#[test]
fn an_object_certifies_itself_to_rounding() {
    let box_ = object("box", 600);
    let own = Certificate::find(&box_, &box_, &Unwatched).expect("nobody stops it");
    assert!(own.worst().iter().all(|x| *x <= 1e-12 * box_.longest_side()), "{:?}", own.worst());
    // Many triangles in one plane: what is left of them is the same box, up to what the search leaves at their sides.
    let less = simplified(&box_, 12).expect("a mesh");
    let flat = Certificate::find(&box_, &less, &Unwatched).expect("nobody stops it");
    assert!(less.triangles().len() < 60 && flat.worst()[1] <= 0.02, "{} {:?}", less.triangles().len(), flat.worst());
}

fn soup() -> impl Strategy<Value = Mesh> {
    let coordinate = prop_oneof![(-8i8..8).prop_map(|x| f64::from(x) / 4.0), -2.0..2.0];
    let vertices = prop::collection::vec(prop::array::uniform3(coordinate), 9..40);
    vertices.prop_filter_map("no area", |v| {
        let triangles = (0..v.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
        Mesh::new(v.into_iter().map(Point3::from).collect(), triangles).ok()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any mesh may stand for any other; it is only more or less like it.
    #[test]
    fn any_mesh_stands_for_any_other_as_well_as_its_certificate_says(a in soup(), b in soup(), other in soup(), seed: u64) {
        let whole = |mesh: &Mesh| Level::whole(Arc::new(mesh.clone()));
        let stand_in = Level::certified(&a, other.clone(), &[], &Unwatched).expect("nobody stops it");
        let certificate = stand_in.certificate.as_ref().expect("it is certified");
        certificate.check(&a, &other, &Unwatched).expect("it holds");
        no_level_lies(&[whole(&a), stand_in], &[whole(&b)], 6, seed);
    }
}
