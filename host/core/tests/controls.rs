//! Control questions: both truths, certified and scored, near the set's own questions, and another draw for every seed.

use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::configuration::{Class, ConfigurationSet, Containment, Method, Placed, Sampling, Separation};
use ocb_core::oracle::{Pair, Shape, U32};
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling::controls::{Control, Plan, alike, count};

fn stock(name: &str, scale: f64) -> Shape {
    let mesh = ocb_core::stock::generate(name, 1000).expect("a stock object");
    let positions: Vec<Point3<f64>> = mesh.positions().iter().map(|p| p * scale).collect();
    let mesh = ocb_core::mesh::Mesh::new(positions, mesh.triangles().to_vec()).expect("a mesh");
    Shape::new(Arc::new(mesh))
}

fn set(a: &Shape, b: &Shape, method: Method, separation: Option<Separation>) -> ConfigurationSet {
    let wanted = separation.unwrap_or(Separation::Relative { distance: 0.0 });
    let plan = ocb_core::sampling::Plan::new(a, b, &method, wanted).expect("a plan");
    let placed = plan.gather((0..plan.units()).map(|unit| plan.place(unit)).collect()).placed;
    ConfigurationSet { method, separation, longest_side: 1.0, placed, missed_rays: 0, box_side: None, spacing: None }
}

fn sphere(count: u32) -> Method {
    Method::Sphere { sampling: Sampling::Count { count }, seed: 3 }
}

fn drawn(plan: &Plan, of: &ConfigurationSet, n: u64) -> Vec<Control> {
    (0..n).filter_map(|number| plan.draw(number, 0..of.placed.len())).collect()
}

/// All are certified and scored, within their bounds; how many cross?
fn crossing(pair: &Pair, plan: &Plan, of: &ConfigurationSet, controls: &[Control], semantics: Semantics) -> usize {
    for control in controls {
        let Placed { configuration, truth, .. } = &control.placed;
        assert_eq!(*truth, pair.truth(configuration));
        let asked = pair.asked(configuration, truth, semantics);
        let class = if asked.hit { Class::Colliding } else { Class::Clear };
        assert_eq!([asked.class64, asked.class32], [class; 2], "{control:?}");
        let [least, most] = plan.range(pair.scene_size(configuration));
        if asked.hit {
            assert!(asked.margin > 2.0 * pair.tau(configuration, U32), "{control:?}");
        } else {
            assert!(asked.distance_lo > 0.89 * least && asked.distance_hi < 1.1 * most, "{least} {most} {truth:?}");
        }
        let from = &of.placed[control.from as usize].configuration;
        assert_eq!((configuration.pose_a, configuration.pose_b.linear), (from.pose_a, from.pose_b.linear));
    }
    controls.iter().filter(|c| pair.asked(&c.placed.configuration, &c.placed.truth, semantics).hit).count()
}

#[test]
fn a_fifth_of_all_questions_are_controls() {
    let counts = [1, 96, 97, 5000, 40_000, 1_000_000].map(count);
    assert_eq!(counts, [24, 24, 25, 1250, 10_000, 10_000]);
}

#[test]
fn half_of_the_controls_cross_whatever_the_set_holds() {
    let relative = |distance| Some(Separation::Relative { distance });
    let step = |of_size| Some(Separation::Step { of_size });
    let random = |hit_share| Method::Random { count: 100, hit_share, seed: 1 };
    let trajectory = |center_distance| Method::Trajectory { center_distance, count: 100 };
    for (a, b) in [("torus-knot", "torus-knot"), ("chair", "sphere")] {
        let (a, b) = (stock(a, 1.0), stock(b, 0.3));
        let pair = Pair::new(&a, &b);
        for (method, separation) in [
            (sphere(100), relative(0.0)),
            (sphere(100), relative(0.01)),
            (sphere(100), relative(2.0)),
            (sphere(100), step(1e-10)),
            (sphere(100), step(-1e-3)),
            (sphere(100), Some(Separation::Ladder)),
            (random(0.1), None),
            (random(0.6), None),
            (trajectory(0.4), None),
            (trajectory(1.5), None),
        ] {
            let name = format!("{method:?} {separation:?}");
            let set = set(&a, &b, method, separation);
            for (query, share) in [(Query::CollisionFirst, 2), (Query::Proximity, 4)] {
                let plan = Plan::new(pair, &set, query, Semantics::Surface, 11);
                let controls = drawn(&plan, &set, 40);
                let hits = crossing(&pair, &plan, &set, &controls, Semantics::Surface);
                assert!(controls.len() == 40 && hits == 40 / share, "{name}: {hits} of {}", controls.len());
                let alike = alike(&pair, &controls, query, Semantics::Surface);
                assert!(alike as usize <= 20, "{name}: one answer is right on {alike}");
            }
        }
    }
}

#[test]
fn every_prefix_has_both_and_another_seed_asks_others() {
    let shape = stock("torus-knot", 1.0);
    let pair = Pair::new(&shape, &shape);
    let set = set(&shape, &shape, sphere(60), Some(Separation::Relative { distance: 0.01 }));
    let plan = |seed| Plan::new(pair, &set, Query::CollisionFirst, Semantics::Surface, seed);
    let (first, again, other) = (plan(1), plan(1), plan(2));
    let all = drawn(&first, &set, 24);
    assert_eq!(all, drawn(&again, &set, 24));
    assert!(all.iter().zip(drawn(&other, &set, 24)).all(|(x, y)| x.placed.configuration != y.placed.configuration));
    // A longer draw begins with the shorter one, and so does a later number alone.
    assert_eq!(drawn(&first, &set, 9), all[..9]);
    assert_eq!(first.draw(17, 0..60), Some(all[17]));
    for n in 1..=24 {
        let hits = all[..n].iter().filter(|c| c.placed.truth.hit).count();
        assert!(hits.abs_diff(n - hits) <= 1, "{hits} of {n}");
    }
    // The order within a pair is drawn, too.
    let seconds = all.chunks(2).filter(|pair| pair[1].placed.truth.hit).count();
    assert!((1..12).contains(&seconds), "{seconds}");
    // Departing from one part of the set, as a trajectory asks for it.
    assert!((0..20).filter_map(|k| first.draw(k, 7..11)).all(|c| (7..11).contains(&c.from)));
}

#[test]
fn a_body_inside_the_other_collides_where_solid_ones_are_asked_for() {
    let (a, b) = (stock("sphere", 1.0), stock("box", 0.05));
    let pair = Pair::new(&a, &b);
    let mut set = set(&a, &b, sphere(20), Some(Separation::Relative { distance: 0.1 }));
    for placed in &mut set.placed {
        placed.configuration.pose_b.translation *= 0.1;
        placed.truth = pair.truth(&placed.configuration);
        assert_eq!(placed.truth.containment, Some(Containment::BInA));
    }
    for semantics in [Semantics::Surface, Semantics::Solid] {
        let plan = Plan::new(pair, &set, Query::CollisionFirst, semantics, 5);
        let controls = drawn(&plan, &set, 30);
        assert_eq!((controls.len(), crossing(&pair, &plan, &set, &controls, semantics)), (30, 15));
    }
}

/// Two segments meet in a point at most.
#[test]
fn what_cannot_cross_is_asked_apart() {
    let segment = |x: f64| [[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 0.5, 0.0]].map(Point3::from);
    let (a, b) = (Shape::from_triangles(&[segment(0.0), segment(0.5)]), Shape::from_triangles(&[segment(0.1)]));
    let pair = Pair::new(&a, &b);
    let set = set(&a, &b, sphere(20), Some(Separation::Relative { distance: 0.1 }));
    let plan = Plan::new(pair, &set, Query::CollisionFirst, Semantics::Surface, 5);
    let controls = drawn(&plan, &set, 24);
    assert_eq!((controls.len(), crossing(&pair, &plan, &set, &controls, Semantics::Surface)), (24, 0));
    assert_eq!(alike(&pair, &controls, Query::CollisionFirst, Semantics::Surface), 24);
}
