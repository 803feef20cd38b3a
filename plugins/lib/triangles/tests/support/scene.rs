//! Two objects in their poses, what all pairs of their triangles say, and whether an answer agrees.

use ocb_triangles::{Frame, Triangle, distance, distance_below, meet};
use opencollbench_plugin::{Collision, Pose, Separation};

use super::Soup;

/// Two objects where a query puts them.
#[derive(Clone, Copy)]
pub struct Scene<'s> {
    pub a: &'s Soup,
    pub b: &'s Soup,
    pub pose_a: Pose,
    pub pose_b: Pose,
}

/// What all pairs of triangles say: what the tests believe.
///
/// Not the plugin brute-force, although it would do: two plugins in one program both export the entry point.
pub struct Truth {
    /// In ascending order.
    pub contacts: Vec<(u32, u32)>,
    pub distance: f64,
}

impl<'s> Scene<'s> {
    /// An object against itself.
    pub fn of(soup: &'s Soup, pose_a: Pose, pose_b: Pose) -> Self {
        Self { a: soup, b: soup, pose_a, pose_b }
    }

    pub fn swapped(self) -> Self {
        Self { a: self.b, b: self.a, pose_a: self.pose_b, pose_b: self.pose_a }
    }

    fn frame(&self) -> Frame {
        let (a, b) = (&self.pose_a, &self.pose_b);
        Frame::new(a.rotation(), a.translation(), b.rotation(), b.translation())
    }

    pub fn truth(&self) -> Truth {
        let frame = self.frame();
        let corners = |soup: &Soup, place: &dyn Fn(&Triangle) -> Triangle| -> Vec<Triangle> {
            (0..soup.triangles.len()).map(|triangle| place(&soup.view().corners(triangle))).collect()
        };
        let (of_a, of_b) = (corners(self.a, &|t| frame.place_a(t)), corners(self.b, &|t| frame.place_b(t)));
        let (mut contacts, mut squared) = (Vec::new(), f64::INFINITY);
        for (i, a) in of_a.iter().enumerate() {
            for (j, b) in of_b.iter().enumerate() {
                if meet(a, b) {
                    contacts.push((i as u32, j as u32));
                }
                squared = distance_below(a, b, squared).map_or(squared, |closest| closest.squared);
            }
        }
        Truth { contacts, distance: squared.sqrt() }
    }

    /// What a distance may be off: 32 roundings at the size of the scene, as the project judges plugins.
    pub fn tau(&self) -> f64 {
        let offset = self.frame().offset.into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        32.0 * f64::EPSILON / 2.0 * (self.a.size() + self.b.size() + offset)
    }

    /// Triangles in the frame of the query.
    fn placed(&self, a: u32, b: u32) -> [Triangle; 2] {
        let frame = self.frame();
        [frame.place_a(&self.a.view().corners(a as usize)), frame.place_b(&self.b.view().corners(b as usize))]
    }

    /// Asserts that a hit names a pair of triangles that meet up to a tolerance, and that a miss is expected.
    pub fn check_collision(&self, answer: Collision, expected: bool, tolerance: f64) {
        let (pose_a, pose_b) = (&self.pose_a, &self.pose_b);
        match answer {
            Collision::Apart => assert!(!expected, "missed the collision at {pose_a:?} {pose_b:?}"),
            Collision::Somewhere => panic!("no pair is named"),
            Collision::Pair(a, b) => {
                assert!(expected, "{a} and {b} do not meet at {pose_a:?} {pose_b:?}");
                let [in_a, in_b] = self.placed(a, b);
                let gap = distance(&in_a, &in_b).squared.sqrt();
                assert!(gap <= tolerance, "{a} and {b} are {gap} apart");
            }
        }
    }

    /// Asserts that the witness points lie on the triangles named and realise the distance, up to a tolerance.
    pub fn check_witness(&self, answer: &Separation, tolerance: f64) {
        let origin = self.frame().origin;
        let points = answer.points.expect("points");
        let [a, b] = answer.triangles.expect("triangles");
        for (point, triangle) in points.iter().zip(self.placed(a, b)) {
            let point: [f64; 3] = std::array::from_fn(|i| point[i] - origin[i]);
            let off = distance(&[point; 3], &triangle).squared.sqrt();
            assert!(off <= tolerance, "a witness point is {off} off its triangle");
        }
        let gap = (0..3).map(|i| (points[0][i] - points[1][i]).powi(2)).sum::<f64>().sqrt();
        let distance = answer.distance;
        assert!((gap - distance).abs() <= tolerance, "the witness points are {gap} apart, not {distance}");
    }
}
