//! Checking what an algorithm claims, in constant time: one pair of triangles, one point on one triangle.

use nalgebra::Point3;

use super::closest::closest;
use super::filter;
use super::scene::Scene;
use super::triangle::Triangle;
use super::{Contact, Pair, contacts, margin};
use crate::configuration::Configuration;

/// Which object of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The first.
    A,
    /// The second.
    B,
}

impl Pair<'_> {
    /// Certified interval of the distance between triangle `pair[0]` of A and `pair[1]` of B; `(0, 0)` exactly when they
    /// meet.
    ///
    /// # Panics
    /// When a triangle does not exist.
    pub fn triangle_distance(&self, configuration: &Configuration, pair: [u32; 2]) -> (f64, f64) {
        Scene::with(self, configuration, |scene| {
            let (a, b) = scene.triangles(pair);
            let near = closest(&a, &b);
            if near.lo > 0.0 {
                return (near.lo * scene.unit, near.hi * scene.unit);
            }
            match filter::hit(&a, &b) {
                Some(true) => (0.0, 0.0),
                Some(false) | None => scene.exact(pair).distance(),
            }
        })
    }

    /// How far a point in the world certainly is from a triangle (lower bound); 0 when it may lie on it.
    ///
    /// # Panics
    /// When the triangle does not exist.
    pub fn off_triangle(&self, configuration: &Configuration, side: Side, triangle: u32, point: &Point3<f64>) -> f64 {
        let (shape, pose) = match side {
            Side::A => (self.a, &configuration.pose_a),
            Side::B => (self.b, &configuration.pose_b),
        };
        let triangle = Triangle::mapped(pose, &shape.corners(triangle), 1.0);
        let point = Triangle { vertices: [point.coords; 3], error: 0.0 };
        closest(&point, &triangle).lo
    }

    /// All pairs of triangles that meet, in ascending order, with the margin of each (0 when it only touches).
    pub fn contact_margins(&self, configuration: &Configuration) -> Vec<Contact> {
        let mut found = Vec::new();
        Scene::with(self, configuration, |scene| {
            contacts::each(scene, |pair, a, b, _| {
                let margin = margin::crossing(a, b).map_or(0.0, |c| c.margin * scene.unit);
                found.push(Contact { pair, margin });
                true
            });
        });
        found.sort_unstable_by_key(|c| c.pair);
        found
    }
}
