//! Moving B along a ray until it is the wanted distance from A.

use nalgebra::{Matrix3, Point3, Vector3};

use crate::configuration::{Configuration, Placed};
use crate::mesh::Mesh;
use crate::oracle::{Pair, U32};
use crate::pose::Pose;

/// The first position on the ray whose certified distance is the wanted one; `None` when there is none.
pub(super) fn place(
    pair: &Pair,
    direction: &Vector3<f64>,
    rotation: &Matrix3<f64>,
    relative_distance: f64,
) -> Option<Placed> {
    let (centre_a, radius_a) = ball(pair.a().mesh());
    let (centre_b, radius_b) = ball(pair.b().mesh());
    let target = relative_distance * longest_side(pair.a().mesh());
    let start = (radius_a + radius_b) * 1.001 + target;
    let mut travelled = 0.0;
    for _ in 0..10_000 {
        let centre = centre_a.coords + direction * (start - travelled);
        let pose_b = Pose { linear: *rotation, translation: centre - rotation * centre_b.coords };
        let configuration = Configuration { pose_a: Pose::identity(), pose_b };
        let tau = pair.tau(&configuration, U32);
        let wanted = if relative_distance == 0.0 { 3.0 * tau } else { target };
        let truth = pair.truth(&configuration);
        if truth.distance_lo > wanted - tau && truth.distance_hi <= wanted + tau {
            return Some(Placed { configuration, truth, root_index: 0 });
        }
        if travelled > 2.0 * start || truth.hit {
            return None;
        }
        travelled += truth.distance_lo - wanted;
    }
    None
}

fn longest_side(mesh: &Mesh) -> f64 {
    let (lo, hi) = bounds(mesh);
    (hi - lo).amax()
}

fn bounds(mesh: &Mesh) -> (Point3<f64>, Point3<f64>) {
    mesh.positions().iter().fold((mesh.positions()[0], mesh.positions()[0]), |(lo, hi), p| (lo.inf(p), hi.sup(p)))
}

/// Centre of the bounding box and the largest distance of a vertex from it.
fn ball(mesh: &Mesh) -> (Point3<f64>, f64) {
    let (lo, hi) = bounds(mesh);
    let centre = nalgebra::center(&lo, &hi);
    (centre, mesh.positions().iter().map(|p| (p - centre).norm()).fold(0.0, f64::max))
}
