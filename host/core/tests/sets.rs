//! Grid, steps, random placement and trajectory: certified, without duplicates, and what each is for.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::{Class, Method, Placed, Sampling, Separation};
use ocb_core::oracle::{Pair, Shape, U32};
use ocb_core::sampling::{Found, Plan, SamplingError, count};

fn stock(name: &str) -> Shape {
    Shape::new(Arc::new(ocb_core::stock::generate(name, 1000).expect("a stock object")))
}

/// A stock object of another size.
fn small(name: &str, scale: f64) -> Shape {
    let mesh = ocb_core::stock::generate(name, 500).expect("a stock object");
    let positions: Vec<Point3<f64>> = mesh.positions().iter().map(|p| p * scale).collect();
    let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize]);
    Shape::from_triangles(&mesh.triangles().iter().map(corners).collect::<Vec<_>>())
}

/// So coarse that every step of the ladder can be met.
fn octahedron() -> Shape {
    let corner = |axis: usize, sign: f64| Point3::from(Vector3::ith(axis, 0.5 * sign));
    let face = |i: u32| [0, 1, 2].map(|axis| corner(axis, if i >> axis & 1 == 0 { 1.0 } else { -1.0 }));
    Shape::from_triangles(&(0..8).map(face).collect::<Vec<_>>())
}

fn longest_side(shape: &Shape) -> f64 {
    let all = || shape.positions().iter().map(|p| p.coords);
    let (lo, hi) = (all().reduce(|x, y| x.inf(&y)), all().reduce(|x, y| x.sup(&y)));
    (hi.expect("vertices") - lo.expect("vertices")).amax()
}

fn found(plan: &Plan) -> Found {
    plan.gather((0..plan.units()).map(|unit| plan.place(unit)).collect())
}

fn sampled(count: u32, seed: u64) -> [Method; 2] {
    let sampling = Sampling::Count { count };
    [Method::Sphere { sampling, seed }, Method::Grid { sampling, seed }]
}

#[test]
fn every_step_is_certified_in_its_window() {
    let shape = octahedron();
    let pair = Pair::new(&shape, &shape);
    for method in sampled(60, 5) {
        let set = found(&Plan::new(&shape, &shape, &method, Separation::Ladder).expect("a plan"));
        assert!(set.placed.len() + set.missed as usize >= 55, "{} placed", set.placed.len());
        let mut reached = BTreeSet::new();
        for placed in &set.placed {
            let Some(Separation::Step { of_size }) = placed.wanted else { panic!("{:?}", placed.wanted) };
            let (truth, step) = (&placed.truth, of_size.abs() * pair.scene_size(&placed.configuration));
            assert_eq!(truth.hit, of_size < 0.0, "{placed:?}");
            if of_size > 0.0 {
                assert!(truth.distance_lo > step && truth.distance_hi <= 2.0 * step, "{step}: {truth:?}");
                assert_eq!(truth.class64, Class::Clear);
                reached.insert(of_size.to_bits());
            } else {
                assert_eq!(truth.class64, Class::Colliding, "{placed:?}");
                // An edge may be met at its very end; then the margin is less, and the record says so.
                if truth.margin > step && truth.margin <= 2.0 * step {
                    reached.insert(of_size.to_bits());
                }
            }
        }
        assert_eq!(reached.len(), Separation::LADDER.len(), "some step is never met");
    }
}

#[test]
fn a_depth_out_of_reach_is_recorded_as_what_it_is() {
    // The margin of fine triangles is less than their size.
    let shape = Shape::new(Arc::new(ocb_core::stock::generate("sphere", 20_000).expect("a stock object")));
    let pair = Pair::new(&shape, &shape);
    let method = &sampled(10, 0)[0];
    let set = found(&Plan::new(&shape, &shape, method, Separation::Step { of_size: -0.02 }).expect("a plan"));
    assert_eq!(set.placed.len(), 10);
    for placed in &set.placed {
        let step = 0.02 * pair.scene_size(&placed.configuration);
        assert!(placed.truth.hit && placed.truth.margin > 0.0 && placed.truth.margin < step, "{placed:?}");
        assert_eq!(placed.truth, pair.truth(&placed.configuration));
        let robust = pair.contact_margins(&placed.configuration).iter().map(|c| c.margin).fold(0.0, f64::max);
        assert_eq!(placed.truth.margin, robust);
    }
}

#[test]
fn bad_steps_are_refused() {
    let shape = stock("box");
    for of_size in [0.0, 1e-15, -1e-15, 0.11, -0.2, f64::NAN, f64::INFINITY] {
        let plan = Plan::new(&shape, &shape, &sampled(9, 0)[0], Separation::Step { of_size });
        assert!(matches!(plan, Err(SamplingError::Step(_))), "{of_size}");
    }
}

#[test]
fn the_grid_finds_certified_positions_each_once() {
    let (a, b) = (stock("chair"), small("sphere", 0.08));
    let pair = Pair::new(&a, &b);
    for distance in [0.0, 0.03] {
        let method = Method::Grid { sampling: Sampling::Count { count: 400 }, seed: 3 };
        let plan = Plan::new(&a, &b, &method, Separation::Relative { distance }).expect("a plan");
        let set = found(&plan);
        assert!((380..=400).contains(&set.placed.len()), "{} placed", set.placed.len());
        for placed in &set.placed {
            let tau = pair.tau(&placed.configuration, U32);
            let (lo, hi) = (placed.truth.distance_lo, placed.truth.distance_hi);
            let wanted = if distance == 0.0 { 3.0 * tau } else { distance * longest_side(&a) };
            let reach = tau.max(0.01 * distance * longest_side(&a));
            assert!(lo > wanted - reach && hi <= wanted + reach, "[{lo}, {hi}] instead of {wanted}");
        }
        let spacing = plan.spacing().expect("a grid has one");
        for unit in 0..plan.units().min(40) {
            let one = plan.place(unit).placed;
            assert_eq!(one, plan.place(unit).placed, "a unit is a function of its number");
            for (i, p) in one.iter().enumerate() {
                for q in &one[..i] {
                    let apart = p.configuration.pose_b.translation - q.configuration.pose_b.translation;
                    assert!(apart.norm() >= spacing / 4.0, "the same position twice");
                    assert_eq!(p.configuration.pose_b.linear, q.configuration.pose_b.linear);
                }
            }
        }
    }
}

#[test]
fn a_further_root_has_one_before_it() {
    let (a, b) = (stock("chair"), small("sphere", 0.08));
    let pair = Pair::new(&a, &b);
    let centre = |shape: &Shape| {
        let all = || shape.positions().iter().map(|p| p.coords);
        let (lo, hi) = (all().reduce(|x, y| x.inf(&y)), all().reduce(|x, y| x.sup(&y)));
        (hi.expect("vertices") + lo.expect("vertices")) / 2.0
    };
    let method = Method::Grid { sampling: Sampling::Count { count: 200 }, seed: 1 };
    let distance = 0.01;
    let set = found(&Plan::new(&a, &b, &method, Separation::Relative { distance }).expect("a plan"));
    let further: Vec<&Placed> = set.placed.iter().filter(|p| p.root_index > 0).collect();
    assert!(further.len() > 20, "{} of {}", further.len(), set.placed.len());
    for placed in further {
        let pose = placed.configuration.pose_b;
        let outward = (pose.translation + pose.linear * centre(&b) - centre(&a)).normalize();
        let blocked = (1..2000).any(|step| {
            let mut outer = placed.configuration;
            outer.pose_b.translation += outward * (0.002 * f64::from(step) * longest_side(&a));
            pair.truth(&outer).distance_lo <= placed.truth.distance_hi
        });
        assert!(blocked, "{placed:?}");
    }
}

#[test]
fn the_grid_covers_more_of_a_concave_object() {
    let (a, b) = (stock("chair"), small("sphere", 0.03));
    let covered = |method: &Method| {
        let set = found(&Plan::new(&a, &b, method, Separation::Relative { distance: 0.0 }).expect("a plan"));
        let triangles: BTreeSet<u32> = set.placed.iter().map(|p| p.truth.witness.triangle_a).collect();
        (set.placed.len(), triangles.len())
    };
    let [sphere, grid] = sampled(1500, 2).map(|method| covered(&method));
    assert!(grid.0 <= 1500 && sphere.0 <= 1500);
    assert!(grid.1 as f64 > 1.4 * sphere.1 as f64, "grid {grid:?}, sphere {sphere:?}: positions, triangles");
}

#[test]
fn the_wanted_share_of_random_poses_collides() {
    let (a, b) = (stock("torus-knot"), stock("box"));
    let pair = Pair::new(&a, &b);
    for hit_share in [0.1, 0.5] {
        let method = Method::Random { count: 1500, hit_share, seed: 4 };
        let plan = Plan::new(&a, &b, &method, Separation::Ladder).expect("a plan");
        let set = found(&plan);
        assert_eq!((set.placed.len(), set.missed), (1500, 0));
        let hits = set.placed.iter().filter(|p| p.truth.hit).count() as f64;
        assert!((hits / 1500.0 - hit_share).abs() < 0.02, "{hits} hits");
        let half = plan.box_side().expect("a cube") / 2.0;
        assert!(set.placed.iter().all(|p| p.configuration.pose_b.translation.amax() <= half + longest_side(&b)));
        assert_eq!(set.placed[7].truth, pair.truth(&set.placed[7].configuration));
    }
    // Concentric spheres of very different size never meet, wherever the small one is inside.
    let (a, b) = (stock("sphere"), small("sphere", 1e-3));
    let method = Method::Random { count: 10, hit_share: 0.9, seed: 0 };
    let plan = Plan::new(&a, &b, &method, Separation::Ladder);
    assert!(matches!(plan, Err(SamplingError::NoBox { .. })), "{plan:?}");
    for bad in [0.0, 1.0, -0.5, f64::NAN] {
        let method = Method::Random { count: 10, hit_share: bad, seed: 0 };
        assert!(matches!(count(&method), Err(SamplingError::HitShare(_))));
    }
}

#[test]
fn a_plan_that_is_stopped_looks_at_nothing_more() {
    let shape = stock("torus-knot");
    let sampling = Sampling::Count { count: 100 };
    for method in [Method::Grid { sampling, seed: 1 }, Method::Random { count: 100, hit_share: 0.3, seed: 1 }] {
        let separation = Separation::Relative { distance: 0.0 };
        for most in [0, 1, 50, 600] {
            let asked = Cell::new(0);
            let stopped = || asked.replace(asked.get() + 1) == most;
            let plan = Plan::unless_stopped(&shape, &shape, &method, separation, &stopped);
            // It would ask more than these times if it were not told.
            assert_eq!((plan.map(|_| ()), asked.get()), (Err(SamplingError::Stopped), most + 1));
        }
    }
}

#[test]
fn a_trajectory_is_a_full_turn_in_small_steps() {
    let shape = stock("chair");
    let method: Method = serde_json::from_str(r#"{"kind": "trajectory", "center_distance": 1.5}"#).expect("a method");
    assert_eq!(count(&method), Ok(5000));
    let plan = Plan::new(&shape, &shape, &method, Separation::Ladder).expect("a plan");
    let frames: Vec<Placed> = (0..plan.units()).step_by(250).flat_map(|unit| plan.place(unit).placed).collect();
    assert_eq!(frames.len(), 20);
    assert!((frames[0].configuration.pose_b.linear - Matrix3::identity()).amax() < 1e-15);
    let first = frames[0].configuration.pose_b.translation;
    assert!((first - Vector3::x() * (1.5 * longest_side(&shape))).amax() < 1e-12, "{first}");
    // Neighbouring frames differ by at most two turns of 360/5000 degrees.
    let next = plan.place(1).placed[0].configuration.pose_b.linear;
    let turned = ((next.trace() - 1.0) / 2.0).acos().to_degrees();
    assert!(turned > 0.07 && turned < 0.15, "{turned} degrees");
    // Half way both turns are done by 180 degrees: (x, y, z) goes to (-x, y, -z).
    let half = frames[10].configuration.pose_b.linear;
    assert!((half - Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, -1.0))).amax() < 1e-6, "{half}");
    for bad in [-1.0, f64::NAN] {
        assert!(matches!(
            count(&Method::Trajectory { center_distance: bad, count: 9 }),
            Err(SamplingError::CenterDistance(_))
        ));
    }
}
