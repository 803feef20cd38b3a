//! What single precision tells apart is apart: against all pairs of triangles, in the very numbers that the leaves compare,
//! at extreme sizes, ratios and places, where the objects touch in a point or nearly so.

use ocb_fast::{Fast, Object};
use ocb_triangles::{Frame, Triangle, distance_below, meet};
use opencollbench_plugin::{
    Algorithm, ContactList, Contacts, Distance, Mesh, Parameters, Placed, Pose, Uncounted, raw,
};
use proptest::prelude::*;

#[path = "../../common/tests/support/mod.rs"]
mod support;

fn load(fast: &mut Fast, triangles: &[Triangle]) -> Object {
    let ids: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    fast.load_mesh(Mesh { positions: triangles.as_flattened(), triangles: &ids }).expect("the mesh loads")
}

fn contacts(fast: &mut Fast, a: Placed<'_, Fast>, b: Placed<'_, Fast>) -> Vec<[u32; 2]> {
    let mut room: Vec<raw::contacts::Contact> = Vec::with_capacity(1 << 10);
    let mut found = ContactList::new(room.spare_capacity_mut());
    fast.contacts(a, b, &mut found, &mut Uncounted).expect("an answer");
    let total = found.total() as usize;
    support::fill(&mut room, total);
    let mut pairs: Vec<[u32; 2]> = room.iter().map(|contact| [contact.a, contact.b]).collect();
    pairs.sort_unstable();
    pairs
}

/// Small triangles in a cube of side 2, some of them slivers.
fn soup() -> impl Strategy<Value = Vec<Triangle>> {
    let number = || -1.0..1.0f64;
    let triangle = ([number(), number(), number()], proptest::array::uniform6(number()), 0..4u8);
    let triangle = triangle.prop_map(|(at, span, kind)| {
        let thin = [1.0, 1.0, 1e-3, 1e-7][kind as usize];
        let corner = |i: usize, size: f64| std::array::from_fn(|k| at[k] + 0.3 * size * span[3 * i + k]);
        let (p, q) = (corner(0, 1.0), corner(1, thin));
        [at, p, q]
    });
    proptest::collection::vec(triangle, 1..24)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..Default::default() })]

    #[test]
    fn nothing_is_told_apart_that_meets(
        (of_a, of_b) in (soup(), soup()),
        (unit, ratio) in (-60..60i32, -30..30i32),
        (far_a, far_b) in (-3..12i32, -3..12i32),
        gap in prop::sample::select(vec![0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-2, 1.0]),
        side in prop::bool::ANY,
        seed in 0..u64::MAX,
    ) {
        // Each object in its own unit, and away from its origin by up to ten times its size.
        let size_a = 2f64.powi(unit);
        let size_b = size_a * 2f64.powi(ratio);
        let placed = |soup: &[Triangle], size: f64, far: i32| -> Vec<Triangle> {
            let offset = if far < 0 { 0.0 } else { size * f64::from(far) };
            soup.iter().map(|t| t.map(|p| p.map(|x| x * size + offset))).collect()
        };
        let (of_a, of_b) = (placed(&of_a, size_a, far_a), placed(&of_b, size_b, far_b));
        let mut dice = support::Dice(seed);
        let (pose_a, mut pose_b) = (dice.pose(size_a), dice.pose(0.0));
        // A corner of B comes to the middle of a triangle of A, or so far from it.
        let world = |pose: &Pose, p: [f64; 3]| support::apply(pose, p);
        let target = of_a[seed as usize % of_a.len()];
        let target = world(&pose_a, std::array::from_fn(|k| (target[0][k] + target[1][k] + target[2][k]) / 3.0));
        let corner = world(&pose_b, of_b[(seed >> 8) as usize % of_b.len()][0]);
        let away = gap * size_a.min(size_b) * if side { 1.0 } else { -1.0 };
        for (k, axis) in [3, 7, 11].into_iter().enumerate() {
            pose_b.0[axis] = target[k] - corner[k] + away;
        }
        let frame = Frame::new(pose_a.rotation(), pose_a.translation(), pose_b.rotation(), pose_b.translation());
        let (mut expected, mut squared) = (Vec::new(), f64::INFINITY);
        for (i, a) in of_a.iter().enumerate() {
            for (j, b) in of_b.iter().enumerate() {
                let (a, b) = (frame.place_a(a), frame.place_b(b));
                if meet(&a, &b) {
                    expected.push([i as u32, j as u32]);
                }
                squared = distance_below(&a, &b, squared).map_or(squared, |closest| closest.squared);
            }
        }
        for width in [1.0, 8.0, 16.0] {
            let mut fast = Fast::default();
            fast.set("width", width).expect("the parameter exists");
            let (a, b) = (load(&mut fast, &of_a), load(&mut fast, &of_b));
            let (a, b) = (Placed { object: &a, pose: &pose_a }, Placed { object: &b, pose: &pose_b });
            prop_assert_eq!(&contacts(&mut fast, a, b), &expected, "width {}", width);
            let near = fast.distance(a, b, &mut Uncounted).expect("an answer").distance;
            let tau = 16.0 * f64::EPSILON * 16.0 * size_a.max(size_b);
            prop_assert!((near - squared.sqrt()).abs() <= tau, "{} instead of {}", near, squared.sqrt());
        }
    }
}
