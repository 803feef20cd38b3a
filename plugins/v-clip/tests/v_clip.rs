//! V-Clip against all pairs of triangles and against GJK.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_bodies::{Body, Found, Pair, Surface};
use ocb_triangles::Frame;
use ocb_v_clip::VClip;
use opencollbench_plugin::{Algorithm, Collision, Distance, Placed, Pose, Uncounted};
use support::convex::{cut_box, ellipsoid, prism};
use support::{Dice, Loaded, Scene, Soup};

#[test]
fn exploratory() {
    let soups = [
        ellipsoid(5, [1.0, 0.7, 0.4]),
        cut_box(3, [0.6, 0.5, 0.9]),
        ellipsoid(1, [1.0; 3]),
        prism(24, 0.5, 0.7, 1.0),
        prism(12, 0.6, 0.6, 0.0),
        cut_box(1, [1.0, 1e-9, 1e-3]),
    ];
    let mut dice = Dice(7);
    for a in &soups {
        for b in &soups {
            let mut loaded = Loaded::two(VClip::default(), a, b);
            let mut cold = Loaded::two(support::algorithm::with::<VClip>(&[("coherence", 0.0)]), a, b);
            let [ga, gb] = [a, b].map(|s| Body::new(&Surface::of(&s.view()).unwrap(), 0.0).unwrap());
            let (mut wrong, mut hits) = (0, 0);
            for round in 0..3000 {
                let (pa, pb) = (dice.pose(0.3), dice.pose(f64::from(round % 100) * 0.025));
                let scene = Scene { a, b, pose_a: pa, pose_b: pb };
                let tau = scene.tau();
                let frame = Frame::new(pa.rotation(), pa.translation(), pb.rotation(), pb.translation());
                let mut none = Uncounted;
                let mut pair = Pair::new(&ga, &gb, frame, &mut none);
                let expected = match pair.nearest() {
                    Found::Apart(c) => c.squared.sqrt(),
                    Found::Meeting => pair.room().max(0.0),
                };
                for l in [&mut loaded, &mut cold] {
                    let got = l.distance(&pa, &pb).distance;
                    if (got - expected).abs() > tau {
                        wrong += 1;
                        if wrong < 4 {
                            unsafe { std::env::set_var("DBG", "1") };
                            let n = l.distance(&pa, &pb);
                            println!("{n:?}");
                            unsafe { std::env::remove_var("DBG") };
                            println!("truth {}", scene.truth().distance);
                            println!("{got} {expected} {}", (got - expected) / tau);
                        }
                    }
                }
                hits += usize::from(expected == 0.0);
            }
            println!(
                "{} {}: wrong {wrong} hits {hits} {:?} cold {:?}",
                a.positions.len(),
                b.positions.len(),
                loaded.algorithm.work(),
                cold.algorithm.work()
            );
        }
    }
}
