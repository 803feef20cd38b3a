//! V-Clip and GJK along a motion, and on the same queries in random order: `taskset -c 1 cargo bench -p ocb-v-clip`.
//!
//! One line per object: microseconds per query, the least of five passes, and what the order of the motion is worth.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use std::hint::black_box;
use std::time::Instant;

use ocb_bodies::{Body, Pair, Surface};
use ocb_triangles::Frame;
use ocb_v_clip::VClip;
use opencollbench_plugin::{Pose, Uncounted};
use support::algorithm::with;
use support::convex::{cut_box, ellipsoid, prism};
use support::{Dice, Loaded, Soup, TRANSLATION};

/// Queries of a motion.
const STEPS: usize = 4000;
const PASSES: usize = 5;

/// B tumbles around A, 0.2 degrees a step, and comes closer and goes away again.
fn motion() -> Vec<Pose> {
    let pose = |step: usize| {
        let t = step as f64 * 0.2f64.to_radians();
        let ((s, c), (u, v)) = ((0.7 * t).sin_cos(), t.sin_cos());
        let reach = 2.1 + 0.3 * (0.4 * t).sin();
        let mut pose = Pose::IDENTITY;
        pose.0[..3].copy_from_slice(&[c, -s, 0.0]);
        pose.0[4..7].copy_from_slice(&[s * v, c * v, -u]);
        pose.0[8..11].copy_from_slice(&[s * u, c * u, v]);
        TRANSLATION.iter().zip([reach * v, reach * u, 0.2]).for_each(|(&at, x)| pose.0[at] = x);
        pose
    };
    (0..STEPS).map(pose).collect()
}

fn shuffled(poses: &[Pose]) -> Vec<Pose> {
    let (mut poses, mut dice) = (poses.to_vec(), Dice(3));
    for last in (1..poses.len()).rev() {
        poses.swap(last, dice.pick(0, last as i32 + 1) as usize);
    }
    poses
}

/// Microseconds per query.
fn time(poses: &[Pose], mut query: impl FnMut(&Pose)) -> f64 {
    let pass = |_| {
        let start = Instant::now();
        poses.iter().for_each(&mut query);
        start.elapsed().as_secs_f64() * 1e6 / poses.len() as f64
    };
    (0..PASSES).map(pass).fold(f64::INFINITY, f64::min)
}

fn main() {
    let objects: [(&str, Soup); 6] = [
        ("box, 12 triangles", cut_box(1, [0.6, 0.5, 0.9])),
        ("box, 4,800 triangles", cut_box(20, [0.6, 0.5, 0.9])),
        ("cylinder, 156 triangles", prism(40, 0.5, 0.8, 1.0)),
        ("ellipsoid, 128 triangles", ellipsoid(4, [1.0, 0.8, 0.7])),
        ("ellipsoid, 2,048 triangles", ellipsoid(16, [1.0, 0.8, 0.7])),
        ("ellipsoid, 32,768 triangles", ellipsoid(64, [1.0, 0.8, 0.7])),
    ];
    let motion = motion();
    let random = shuffled(&motion);
    println!(
        "{:<28} {:>16} {:>16} {:>7} | {:>10} {:>10} {:>7} | {:>10}",
        "microseconds per query", "v-clip in order", "shuffled", "ratio", "GJK", "shuffled", "ratio", "GJK/v-clip"
    );
    for (name, soup) in &objects {
        let body = Surface::of(&soup.view()).and_then(|surface| Body::new(&surface, 0.0)).expect("it is convex");
        let mut loaded = Loaded::with(with::<VClip>(&[]), soup);
        let mut walk = |pose: &Pose| {
            black_box(loaded.distance(&Pose::IDENTITY, pose));
        };
        let v_clip = [&motion, &random].map(|poses| time(poses, &mut walk));
        let gjk = [&motion, &random].map(|poses| {
            time(poses, |pose| {
                let identity = Pose::IDENTITY;
                let frame =
                    Frame::new(identity.rotation(), identity.translation(), pose.rotation(), pose.translation());
                black_box(Pair::new(&body, &body, frame, &mut Uncounted).nearest());
            })
        });
        println!(
            "{name:<28} {:>16.3} {:>16.3} {:>7.2} | {:>10.3} {:>10.3} {:>7.2} | {:>10.2}",
            v_clip[0],
            v_clip[1],
            v_clip[1] / v_clip[0],
            gjk[0],
            gjk[1],
            gjk[1] / gjk[0],
            gjk[0] / v_clip[0]
        );
    }
}
