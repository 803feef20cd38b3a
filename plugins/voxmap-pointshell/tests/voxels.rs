//! On which side the answers err, and how far.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_voxmap_pointshell::VoxmapPointshell;
use opencollbench_plugin::{Algorithm, Collision, Placed, Pose, Refusal, Uncounted};
use support::{Dice, Loaded, Scene, Soup};

/// Of the README: no false alarm is further apart than so many voxels.
const BOUND: f64 = 4.34;

fn diagonal(soup: &Soup) -> f64 {
    let side = |i: usize| {
        let all = soup.positions.iter().map(|p| p[i]);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    (0..3).map(|i| side(i).powi(2)).sum::<f64>().sqrt()
}

/// Poses of an object and itself, so far apart, and the true distances.
fn scenes(soup: &Soup, seed: u64, turned: f64, apart: impl IntoIterator<Item = f64>) -> Vec<(Pose, Pose, f64)> {
    let mut dice = Dice(seed);
    let mut scene = |apart: f64| {
        let (pose_a, pose_b) = (dice.pose(turned), dice.pose(apart));
        (pose_a, pose_b, Scene::of(soup, pose_a, pose_b).truth().distance)
    };
    apart.into_iter().map(&mut scene).collect()
}

fn check(soup: &Soup, reach: f64, rounds: usize) -> Vec<usize> {
    let scenes = scenes(soup, 9, 0.1, (0..rounds).map(|round| reach * round as f64 / rounds as f64));
    let mut alarms = Vec::new();
    for voxel in [0.05, 0.02, 0.005] {
        let mut map = Loaded::with(VoxmapPointshell::with_voxel(voxel), soup);
        let (mut hits, mut wrong, mut farthest) = (0, 0, 0.0);
        for &(ref pose_a, ref pose_b, truth) in &scenes {
            let answer = map.collide(pose_a, pose_b) != Collision::Apart;
            assert!(answer || truth > 0.0, "a collision is missed at {pose_a:?} {pose_b:?}");
            hits += usize::from(answer);
            if answer && truth > 0.0 {
                (wrong, farthest) = (wrong + 1, truth.max(farthest));
            }
        }
        println!("voxel {voxel}: {wrong} false alarms, at {:.2} voxels", farthest / (voxel * diagonal(soup)));
        assert!(farthest <= BOUND * voxel * diagonal(soup), "{voxel}: a false alarm at {farthest}");
        assert!(hits > rounds / 6 && hits < rounds, "{hits} of {rounds} collide: this tests one side only");
        alarms.push(wrong);
    }
    alarms
}

#[test]
fn no_collision_is_missed_and_false_alarms_are_near_and_fewer_with_smaller_voxels() {
    let alarms = check(&Soup::torus(16, 8), 4.0, 60);
    assert!(alarms[0] > alarms[1] && alarms[1] > alarms[2], "{alarms:?}");
}

#[test]
fn the_same_on_scraps_without_area() {
    check(&Soup::scraps(), 1.2, 60);
}

/// A map for a clearance calls "near" all that is within it, and nothing that is more than 5.2 voxels further away.
#[test]
fn a_map_for_a_clearance_misses_nothing_within_it() {
    let soup = Soup::torus(16, 8);
    let scenes = scenes(&soup, 5, 0.1, (0..60).map(|round| 1.5 + 3.0 * f64::from(round) / 60.0));
    for (voxel, clearance) in [(0.05, 0.1), (0.05, 0.6), (0.02, 0.25)] {
        let mut map = Loaded::with(VoxmapPointshell::with_voxel(voxel).beyond(clearance), &soup);
        let (mut within, mut beyond) = (0, 0);
        for (pose_a, pose_b, truth) in &scenes {
            let near = map.collide(pose_a, pose_b) != Collision::Apart;
            assert!(near || *truth > clearance, "{truth} is within {clearance}, and missed with {voxel}");
            assert!(
                !near || *truth <= clearance + 5.2 * voxel * diagonal(&soup),
                "{truth} for {clearance} with {voxel}"
            );
            within += usize::from(near && *truth > 0.0);
            beyond += usize::from(!near);
        }
        assert!(within > 3 && beyond > 3, "{within} and {beyond} of {}: this tests one side only", scenes.len());
    }
    let too_far = VoxmapPointshell::with_voxel(0.01).beyond(1.0).load_mesh(soup.view());
    assert!(matches!(&too_far, Err(Refusal::Error(why)) if why.contains("no further than 16")), "{too_far:?}");
}

/// The voxels of a large object are large, too: whichever is given first, its map is asked.
#[test]
fn objects_of_different_size_may_come_in_either_order() {
    let small = Soup::torus(16, 8);
    let large = small.moved(8.0, 0.0);
    let mut algorithm = VoxmapPointshell::default();
    let small = algorithm.load_mesh(small.view()).expect("the mesh loads");
    let large = algorithm.load_mesh(large.view()).expect("the mesh loads");
    let mut ask = |pose: &Pose| {
        let (a, b) = (Placed { object: &small, pose }, Placed { object: &large, pose: &Pose::IDENTITY });
        let one = algorithm.collide(a, b, &mut Uncounted).expect("an answer");
        assert_eq!(algorithm.collide(b, a, &mut Uncounted).expect("an answer"), one);
        one
    };
    let mut pose = Pose::IDENTITY;
    for (x, expected) in [(0.0, false), (8.0 - 2.4, true), (8.0, false), (8.0 + 3.2, true), (30.0, false)] {
        pose.0[3] = x;
        assert_eq!(ask(&pose) != Collision::Apart, expected, "at {x}");
    }
}

#[test]
fn what_is_far_apart_is_told_by_one_test() {
    let mut counts = opencollbench_plugin::Counts::default();
    let mut pose = Pose::IDENTITY;
    pose.0[7] = 10.0;
    let mut map = Loaded::<VoxmapPointshell>::new(&Soup::torus(16, 8));
    assert_eq!(map.collide_counting(&Pose::IDENTITY, &pose, &mut counts), Collision::Apart);
    assert_eq!(counts.bv_tests, 1);
}
