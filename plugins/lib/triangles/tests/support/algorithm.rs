//! What every algorithm is put through: `algorithm!(terms)` in a test file makes a test of each check.

use opencollbench_plugin::{Algorithm, Collision, Contacts, Counts, Distance, Parameters, Pose};

use super::{Dice, Loaded, Scene, Soup, TRANSLATION, Truth, known_set};

/// The query that an algorithm is asked.
pub struct Terms<A> {
    /// It in all settings worth a test, the default first.
    pub variants: fn() -> Vec<A>,
    /// What its distances may be off beyond rounding, for objects of size 1; 0 for exact methods.
    pub blur: f64,
    /// Whether a distance query on objects that meet names a common point.
    pub common_points: bool,
    /// Of the known sets, every so many configurations.
    pub stride: usize,
}

impl<A: Algorithm> Terms<A> {
    /// For exact methods that answer in a few milliseconds.
    pub const fn exact(variants: fn() -> Vec<A>) -> Self {
        Self { variants, blur: 0.0, common_points: true, stride: 25 }
    }

    /// Every variant with an object.
    pub fn load(&self, soup: &Soup) -> Vec<Loaded<A>> {
        (self.variants)().into_iter().map(|algorithm| Loaded::with(algorithm, soup)).collect()
    }
}

/// An algorithm with some of its parameters set.
pub fn with<A: Parameters>(settings: &[(&str, f64)]) -> A {
    let mut algorithm = A::default();
    for (name, value) in settings {
        algorithm.set(name, *value).expect("the parameter exists");
    }
    algorithm
}

/// Makes a test of each check, or of those named.
macro_rules! algorithm {
    ($terms:expr) => {
        algorithm!($terms;
            algorithm: on_a_torus, on_scraps, on_itself, far_from_the_origin, with_rotations_not_quite, on_known_sets;
            ladder: at_every_gap, in_every_unit, in_odd_units_and_places, whatever_the_winding_and_the_order;
            extremes: tells_nothing_apart_that_meets, on_pairs_that_broke_others);
    };
    ($terms:expr; $($group:ident: $($check:ident),+);+ $(;)?) => {
        $($(#[test] fn $check() { support::$group::$check(&$terms); })+)+
    };
}

/// Asserts that all that can be asked about a scene is answered as the truth says.
pub fn agree<A: Distance + Contacts>(terms: &Terms<A>, loaded: &mut Loaded<A>, scene: &Scene<'_>, truth: &Truth) {
    let (pose_a, pose_b) = (&scene.pose_a, &scene.pose_b);
    let tolerance = scene.tau() + terms.blur * scene.a.size().max(scene.b.size());
    let hit = !truth.contacts.is_empty();
    assert_eq!(loaded.contacts(pose_a, pose_b), truth.contacts);

    let (mut tests_a, mut tests_b) = (vec![0; scene.a.triangles.len()], vec![0; scene.b.triangles.len()]);
    let mut counts = Counts { tests_a: &mut tests_a, tests_b: &mut tests_b, ..Counts::default() };
    let answer = loaded.collide(pose_a, pose_b);
    scene.check_collision(answer, hit, tolerance);
    if let Collision::Pair(a, b) = answer {
        assert!(truth.contacts.binary_search(&(a, b)).is_ok(), "{a} and {b} are no contact");
    }
    assert_eq!(loaded.collide_counting(pose_a, pose_b, &mut counts), answer, "the counted query");
    if let Collision::Pair(a, b) = answer {
        let tests = [counts.tests_a[a as usize], counts.tests_b[b as usize]];
        assert!(tests.iter().all(|tests| *tests > 0), "{a} and {b} meet and were counted {tests:?} times");
    }

    let near = loaded.distance(pose_a, pose_b);
    let expected = truth.distance;
    assert!((near.distance - expected).abs() <= tolerance, "{:e} instead of {expected:e}", near.distance);
    assert!(terms.blur > 0.0 || !hit || near.distance == 0.0, "{:e} where they meet", near.distance);
    if terms.common_points || near.distance > 0.0 {
        scene.check_witness(&near, tolerance);
    }
    assert_eq!(loaded.distance_counting(pose_a, pose_b, &mut counts), near, "the counted query");
    assert!(counts.bv_tests > 0 && counts.primitive_tests > 0, "nothing is counted");
    for tests in [counts.tests_a, counts.tests_b] {
        assert_eq!(tests.iter().map(|&tests| u64::from(tests)).sum::<u64>(), counts.primitive_tests);
    }
}

/// A mesh against itself, at all distances up to `reach`, both objects turned, then A and B swapped.
fn on<A: Distance + Contacts>(terms: &Terms<A>, soup: &Soup, reach: f64, rounds: usize) {
    let mut variants = terms.load(soup);
    let (mut dice, mut hits) = (Dice(2), 0);
    for round in 0..rounds {
        let (pose_a, pose_b) = (dice.pose(0.1), dice.pose(reach * round as f64 / rounds as f64));
        let scene = Scene::of(soup, pose_a, pose_b);
        for scene in [scene, scene.swapped()] {
            let truth = scene.truth();
            hits += usize::from(!truth.contacts.is_empty());
            variants.iter_mut().for_each(|loaded| agree(terms, loaded, &scene, &truth));
        }
    }
    assert!(hits > rounds / 5 && hits < 2 * rounds, "{hits} of {rounds} twice collide: this tests one side only");
}

pub fn on_a_torus<A: Distance + Contacts>(terms: &Terms<A>) {
    on(terms, &Soup::torus(16, 8), 5.0, 24);
}

pub fn on_scraps<A: Distance + Contacts>(terms: &Terms<A>) {
    on(terms, &Soup::scraps(), 1.5, 200);
}

/// In one pose, every triangle touches itself and its neighbours in their very corners.
pub fn on_itself<A: Distance + Contacts>(terms: &Terms<A>) {
    let soup = Soup::torus(10, 6);
    let pose = Dice(5).pose(3.0);
    let scene = Scene::of(&soup, pose, pose);
    let truth = scene.truth();
    for triangle in 0..soup.triangles.len() as u32 {
        assert!(truth.contacts.binary_search(&(triangle, triangle)).is_ok());
    }
    terms.load(&soup).iter_mut().for_each(|loaded| agree(terms, loaded, &scene, &truth));
}

/// Objects far from the world's origin lose no more digits than the pose itself has lost.
pub fn far_from_the_origin<A: Distance + Contacts>(terms: &Terms<A>) {
    let soup = Soup::torus(16, 8);
    let mut variants = terms.load(&soup);
    let mut dice = Dice(9);
    for _ in 0..20 {
        let (pose_a, pose_b) = (dice.pose(0.0), dice.pose(3.0));
        let [far_a, far_b] = [pose_a, pose_b].map(|mut pose| {
            TRANSLATION.iter().for_each(|&axis| pose.0[axis] += 1e6);
            pose
        });
        for loaded in &mut variants {
            let (here, there) = (loaded.distance(&pose_a, &pose_b).distance, loaded.distance(&far_a, &far_b).distance);
            assert!((here - there).abs() <= 1e6 * 4.0 * f64::EPSILON + terms.blur, "{there} instead of {here}");
        }
    }
}

/// Single precision poses and worse: culling must stay on the safe side of a rotation that is none.
pub fn with_rotations_not_quite<A: Distance + Contacts>(terms: &Terms<A>) {
    let soup = Soup::torus(16, 8);
    let mut variants = terms.load(&soup);
    let mut dice = Dice(11);
    for round in 0..24 {
        let [pose_a, pose_b] = [0.2, 1.8].map(|distance| {
            let mut pose = dice.pose(distance);
            for entry in [0, 1, 2, 4, 5, 6, 8, 9, 10] {
                pose.0[entry] += [1e-7, 1e-4, 1e-2][round % 3] * (dice.roll() - 0.5);
            }
            pose
        });
        let scene = Scene::of(&soup, pose_a, pose_b);
        let truth = scene.truth();
        variants.iter_mut().for_each(|loaded| agree(terms, loaded, &scene, &truth));
    }
}

/// Sets of configurations whose answers PQP, FCL, coal and others agree on.
pub fn on_known_sets<A: Distance + Contacts>(terms: &Terms<A>) {
    for (mesh, set) in ["bunny65k", "knot65k"].into_iter().flat_map(|mesh| ["W1", "W2", "W3"].map(|set| (mesh, set))) {
        let known = known_set(mesh, set);
        let mut loaded = Loaded::with((terms.variants)().swap_remove(0), &known.soup);
        for (i, pose) in known.poses.iter().enumerate().step_by(terms.stride) {
            let scene = Scene::of(&known.soup, Pose::IDENTITY, *pose);
            let tolerance = scene.tau() + terms.blur;
            scene.check_collision(loaded.collide(&Pose::IDENTITY, pose), set == "W3", tolerance);
            let near = loaded.distance(&Pose::IDENTITY, pose);
            if terms.common_points || near.distance > 0.0 {
                scene.check_witness(&near, tolerance);
            }
            let expected = known.distances.as_ref().map_or(0.0, |distances| distances[i]);
            let error = (near.distance - expected).abs();
            assert!(error <= 1e-12 * expected + terms.blur, "{mesh} {set} {i}: {} and {expected}", near.distance);
        }
    }
}
