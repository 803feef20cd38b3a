//! What the spheres are, and how far from the truth their answers are.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use ocb_inner_spheres::InnerSpheres;
use ocb_triangles::vector::{Vector, dot, sub};
use opencollbench_plugin::{Algorithm, Collision, Placed, Pose, Refusal, Uncounted};
use support::{Dice, Loaded, Scene, Soup};

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

fn loaded(soup: &Soup, spheres: usize) -> Loaded<InnerSpheres> {
    Loaded::with(InnerSpheres::with_spheres(spheres), soup)
}

/// A cube with this half side.
fn cube(half: f64) -> Soup {
    let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    Soup {
        positions: (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|x| half * f64::from(2 * x - 1))).collect(),
        triangles: sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
    }
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

/// The largest distance of a vertex or a triangle's middle from the spheres: what they leave out.
fn left_out(soup: &Soup, object: &<InnerSpheres as Algorithm>::Object) -> f64 {
    let middles = (0..soup.triangles.len()).map(|i| {
        let [a, b, c] = soup.view().corners(i);
        std::array::from_fn(|i| (a[i] + b[i] + c[i]) / 3.0)
    });
    let from_spheres = |p: Vector| {
        object.balls.iter().map(|ball| length(sub(p, ball.center)) - ball.radius).fold(f64::INFINITY, f64::min)
    };
    soup.positions.iter().copied().chain(middles).map(from_spheres).fold(0.0, f64::max)
}

#[test]
fn spheres_lie_inside_and_do_not_overlap() {
    let soup = Soup::torus(16, 8);
    let object = loaded(&soup, 300).a;
    assert_eq!(object.balls.len(), 300);
    for (i, ball) in object.balls.iter().enumerate() {
        let all =
            (0..soup.triangles.len()).map(|t| ocb_triangles::distance(&[ball.center; 3], &soup.view().corners(t)));
        let clear = all.map(|closest| closest.squared.sqrt()).fold(f64::INFINITY, f64::min);
        assert!(0.0 < ball.radius && ball.radius <= clear, "{ball:?} reaches through the surface at {clear}");
        // Of a bumpy torus: inside its tube.
        let ring = length([ball.center[0], ball.center[1], 0.0]) - 1.0;
        assert!(length([ring, ball.center[2], 0.0]) < 0.41, "{ball:?} is outside");
        for other in &object.balls[..i] {
            assert!(length(sub(ball.center, other.center)) >= ball.radius + other.radius - 1e-12);
        }
    }
}

/// The bound of the README: never below the truth, and above it by no more than both objects' spheres leave out.
#[test]
fn the_distance_errs_upwards_within_what_is_left_out_and_less_with_more_spheres() {
    let soup = Soup::torus(16, 8);
    let scenes = scenes(&soup, 4, 0.3, [3.2; 20]);
    let mut errors = Vec::new();
    for spheres in [32, 256, 2048] {
        let mut tree = loaded(&soup, spheres);
        let left_out = left_out(&soup, &tree.a);
        // Between the points that it was measured at, the surface reaches on by at most half an edge.
        let bound = 2.0 * (left_out + 0.2);
        let mut sum = 0.0;
        for (pose_a, pose_b, truth) in &scenes {
            let distance = tree.distance(pose_a, pose_b).distance;
            for (reach, near) in [(0.9 * distance, distance == 0.0), (1.1 * distance, true)] {
                let (a, b) = (Placed { object: &tree.a, pose: pose_a }, Placed { object: &tree.a, pose: pose_b });
                assert_eq!(tree.algorithm.within(a, b, reach, &mut Uncounted), near, "{distance} within {reach}");
            }
            let error = distance - truth;
            assert!(error >= -1e-12 && error <= bound, "{spheres} spheres: {error} of {bound}");
            sum += error;
        }
        println!("{spheres} spheres: {left_out:.4} left out, mean error {:.4}", sum / 20.0);
        errors.push([left_out, sum]);
    }
    for pair in errors.windows(2) {
        assert!(pair[1][0] < 0.8 * pair[0][0] && pair[1][1] < 0.8 * pair[0][1], "{errors:?}");
    }
}

#[test]
fn no_false_alarms_all_deep_collisions_and_fewer_misses_with_more_spheres() {
    let soup = Soup::torus(16, 8);
    let scenes = scenes(&soup, 6, 0.1, (0..40).map(|round| 3.0 * f64::from(round) / 40.0));
    let mut missed = Vec::new();
    for spheres in [32, 256, 2048] {
        let (mut tree, mut misses, mut hits) = (loaded(&soup, spheres), 0, 0);
        for &(ref pose_a, ref pose_b, truth) in &scenes {
            let expected = truth == 0.0;
            let answer = tree.collide(pose_a, pose_b) != Collision::Apart;
            assert!(expected || !answer, "a false alarm at {pose_a:?} {pose_b:?}");
            assert_eq!(answer, tree.distance(pose_a, pose_b).distance == 0.0);
            hits += usize::from(answer);
            misses += usize::from(expected && !answer);
        }
        assert!(hits > 10, "{hits}");
        missed.push(misses);
        // A quarter of the tube deep, in the direction of the ring.
        let mut deep = Pose::IDENTITY;
        deep.0[3] = 0.15;
        assert_ne!(tree.collide(&Pose::IDENTITY, &deep), Collision::Apart);
        deep.0[3] = 10.0;
        assert_eq!(tree.collide(&Pose::IDENTITY, &deep), Collision::Apart);
    }
    println!("misses {missed:?}");
    assert!(missed[0] >= missed[1] && missed[1] >= missed[2] && missed[0] > missed[2], "{missed:?}");
}

/// Cubes with side 2, one moved by 1: half of each is common, 4 of 8.
#[test]
fn the_common_volume_comes_up_to_the_true_one_from_below() {
    let soup = cube(1.0);
    let mut pose = Pose::IDENTITY;
    pose.0[3] = 1.0;
    let volume = |spheres| {
        let Loaded { mut algorithm, a: object, .. } = loaded(&soup, spheres);
        let placed = |pose| Placed { object: &object, pose };
        algorithm.common_volume(placed(&Pose::IDENTITY), placed(&pose))
    };
    let volumes = [64, 512, 4096].map(volume);
    println!("{volumes:?} of 4");
    assert!(volumes[0] < volumes[1] && volumes[1] < volumes[2] && volumes[2] < 4.0, "{volumes:?}");
    assert!(volumes[2] > 2.0, "{volumes:?}");
}

#[test]
fn an_open_mesh_is_refused_in_one_sentence() {
    let mut soup = Soup::torus(8, 4);
    soup.triangles.pop();
    let refusal = InnerSpheres::default().load_mesh(soup.view()).expect_err("a refusal");
    let Refusal::Error(sentence) = refusal else { panic!("{refusal:?}") };
    assert!(sentence.contains("need a closed one, and 3 edges"), "{sentence}");
    // Closed, but flat: a triangle from both sides.
    let flat = Soup { positions: soup.positions, triangles: vec![[0, 1, 9], [9, 1, 0]] };
    let refusal = InnerSpheres::default().load_mesh(flat.view()).expect_err("a refusal");
    assert!(matches!(refusal, Refusal::Error(sentence) if sentence.contains("so thin")));
}
