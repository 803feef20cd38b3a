//! The sphere method: as many configurations as promised, each certified, each at the first root of its ray.

mod common;

use std::sync::Arc;

use ocb_core::configuration::{Class, Method, Placed, Sampling, Separation};
use ocb_core::oracle::{Pair, Shape, U32, U64};
use ocb_core::sampling::{self, MAX_CONFIGURATIONS, Plan, SamplingError};

fn stock(name: &str) -> Shape {
    Shape::new(Arc::new(ocb_core::stock::generate(name, 2000).expect("a stock object")))
}

const COUNT: Sampling = Sampling::Count { count: 300 };

fn sphere<'a>(a: &'a Shape, b: &'a Shape, sampling: Sampling, distance: f64, seed: u64) -> Plan<'a> {
    Plan::new(a, b, &Method::Sphere { sampling, seed }, Separation::Relative { distance }).expect("a plan")
}

fn at(plan: &Plan, unit: u64) -> Option<Placed> {
    plan.place(unit).placed.pop()
}

fn count(sampling: &Sampling) -> Result<u64, SamplingError> {
    sampling::count(&Method::Sphere { sampling: *sampling, seed: 0 })
}

#[test]
fn the_number_is_known_before() {
    let steps = |rotate, move_by| count(&Sampling::Steps { rotate, move_by });
    // 3 + 9 + 14 + 17 + 18 + 17 + 14 + 9 + 3 = 104 places by 20 degrees, for directions and for axes; 18 turns.
    assert_eq!(steps(20.0, 20.0), Ok(104 * 104 * 18));
    assert_eq!(count(&Sampling::PaperCompat { rotate: 20.0, move_by: 20.0 }), steps(20.0, 20.0));
    // Two rows of three places by 90 degrees.
    assert_eq!(steps(90.0, 90.0), Ok(6 * 6 * 4));
    assert_eq!(count(&Sampling::Count { count: 17 }), Ok(17));
    assert_eq!(count(&Sampling::Count { count: 0 }), Err(SamplingError::NoConfigurations));
    assert_eq!(count(&Sampling::Count { count: 1_000_000_000 }), Err(SamplingError::TooMany(1_000_000_000)));
    assert!(matches!(steps(1.0, 1.0), Err(SamplingError::TooMany(n)) if n > MAX_CONFIGURATIONS));
    for bad in [0.0, -20.0, 180.5, f64::NAN, f64::INFINITY] {
        assert!(matches!(steps(bad, 20.0), Err(SamplingError::Degrees { name: "rotate-by", .. })), "{bad}");
        assert!(matches!(steps(20.0, bad), Err(SamplingError::Degrees { name: "move-by", .. })), "{bad}");
    }
    let shape = stock("sphere");
    for bad in [-0.1, f64::NAN, f64::INFINITY] {
        let method = Method::Sphere { sampling: COUNT, seed: 0 };
        let plan = Plan::new(&shape, &shape, &method, Separation::Relative { distance: bad });
        assert!(matches!(plan, Err(SamplingError::RelativeDistance(_))));
    }
}

fn check(pair: &Pair, placed: &Placed, wanted: f64) {
    let tau = pair.tau(&placed.configuration, U32);
    let (lo, hi) = (placed.truth.distance_lo, placed.truth.distance_hi);
    if wanted == 0.0 {
        assert!(lo > 2.0 * tau && hi <= 4.0 * tau, "[{lo}, {hi}] is not in (2, 4] times {tau}");
    } else {
        let reach = tau.max(0.01 * wanted);
        assert!(lo > wanted - reach && hi <= wanted + reach, "[{lo}, {hi}] instead of {wanted}");
    }
    assert_eq!((placed.truth.class64, placed.truth.class32), (Class::Clear, Class::Clear));
    // What the search was told to be near does not change the truth.
    let again = pair.truth(&placed.configuration);
    assert!(again.distance_lo <= hi && lo <= again.distance_hi);
    let r = placed.configuration.pose_b.linear;
    assert!((r.transpose() * r - nalgebra::Matrix3::identity()).amax() < 5e-16, "{r} is no rotation");
}

#[test]
fn every_configuration_is_certified_at_the_wanted_distance() {
    for (a, b) in [("torus-knot", "torus-knot"), ("sphere", "box")] {
        let (a, b) = (stock(a), stock(b));
        let pair = Pair::new(&a, &b);
        let bounds = a.positions().iter().map(|p| p.coords);
        let (lo, hi) = (bounds.clone().reduce(|x, y| x.inf(&y)), bounds.reduce(|x, y| x.sup(&y)));
        let longest = (hi.expect("vertices") - lo.expect("vertices")).amax();
        for distance in [0.0, 0.001, 0.2, 1.5] {
            let plan = sphere(&a, &b, COUNT, distance, 7);
            let placed: Vec<Placed> = (0..plan.units()).filter_map(|i| at(&plan, i)).collect();
            // Both objects are around their centres, except that a ray may pass the knot's hole.
            assert!(placed.len() > 290, "{} placed", placed.len());
            placed.iter().for_each(|p| check(&pair, p, distance * longest));
        }
    }
}

/// Of answers that may miss the truth by tau, one number is right for few questions of a set.
#[test]
fn no_distance_is_right_for_much_of_a_set() {
    let shape = stock("torus-knot");
    let pair = Pair::new(&shape, &shape);
    // Where the window is much wider than the band of single precision, and where it is a step of that band.
    for (separation, most) in [
        (Separation::Relative { distance: 0.2 }, 0.03),
        (Separation::Relative { distance: 0.01 }, 0.35),
        (Separation::Step { of_size: 1e-3 }, 0.03),
        (Separation::Step { of_size: 1e-10 }, 0.03),
    ] {
        let plan = Plan::new(&shape, &shape, &Method::Sphere { sampling: COUNT, seed: 5 }, separation).expect("a plan");
        let placed: Vec<Placed> = (0..plan.units()).filter_map(|i| at(&plan, i)).collect();
        assert!(placed.len() > 290, "{} placed", placed.len());
        // Steps far below single precision are asked of double precision alone.
        let unit = if matches!(separation, Separation::Step { of_size } if of_size < 1e-6) { U64 } else { U32 };
        let right = |distance: f64| {
            let right = |p: &&Placed| (p.truth.distance_lo - distance).abs() <= pair.tau(&p.configuration, unit);
            placed.iter().filter(right).count()
        };
        let best = placed.iter().map(|p| right(p.truth.distance_lo)).max().expect("some");
        assert!((best as f64) < most * placed.len() as f64, "{separation:?}: {best} of {}", placed.len());
    }
}

#[test]
fn nothing_is_nearer_before_on_the_ray() {
    let shape = stock("torus-knot");
    let pair = Pair::new(&shape, &shape);
    for distance in [0.0, 0.05] {
        let plan = sphere(&shape, &shape, COUNT, distance, 3);
        for placed in (0..40).filter_map(|i| at(&plan, i)) {
            // Back along the ray the distance must always be at least the one that was reached.
            let back = placed.configuration.pose_b.translation.normalize();
            for step in 1..40 {
                let mut earlier = placed.configuration;
                earlier.pose_b.translation += back * (0.04 * f64::from(step));
                let truth = pair.truth(&earlier);
                let tau = pair.tau(&earlier, U32);
                assert!(truth.distance_hi >= placed.truth.distance_lo - 2.0 * tau, "{step}: {truth:?}");
            }
        }
    }
}

#[test]
fn a_configuration_is_a_function_of_its_number() {
    let shape = stock("torus-knot");
    for sampling in [COUNT, Sampling::PaperCompat { rotate: 60.0, move_by: 60.0 }] {
        let plan = |seed| sphere(&shape, &shape, sampling, 0.0, seed);
        let (first, second, other) = (plan(1), plan(1), plan(2));
        for i in (0..first.units()).rev().step_by(29) {
            assert_eq!(at(&first, i), at(&second, i));
            let same = at(&first, i) == at(&other, i);
            assert_eq!(same, matches!(sampling, Sampling::PaperCompat { .. }), "only low-discrepancy sets have a seed");
        }
    }
    // A smaller set is the beginning of a larger one.
    let few = sphere(&shape, &shape, Sampling::Count { count: 10 }, 0.0, 1);
    let many = sphere(&shape, &shape, COUNT, 0.0, 1);
    assert_eq!(at(&few, 9), at(&many, 9));
}

#[test]
fn a_ray_that_meets_nothing_gives_nothing() {
    // Two far rings of small triangles around the centre line: a small B passes between them on many rays.
    let ring = |x: f64| {
        (0..6).map(move |k| {
            let (s, c) = (f64::from(k) * 1.047).sin_cos();
            [[x, s, c], [x, s + 0.01, c], [x, s, c + 0.01]].map(nalgebra::Point3::from)
        })
    };
    let a = Shape::from_triangles(&ring(-1.0).chain(ring(1.0)).collect::<Vec<_>>());
    let b = Shape::from_triangles(&[[[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0]].map(nalgebra::Point3::from)]);
    let plan = sphere(&a, &b, COUNT, 0.0, 0);
    let placed = (0..plan.units()).filter_map(|i| at(&plan, i)).count();
    assert!(placed < 100, "{placed} of 300 rays end at twelve small triangles");
}
