//! Inputs that people reported as wrong answers of real libraries: numbers, their source, and what they saw.
//!
//! Numbers are facts; no word of a report is in here. Where a report describes its input without giving numbers, the numbers
//! are ours and the entry says so.

use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::mesh::{Mesh, MeshError};
use ocb_core::pose::Pose;
use serde::{Deserialize, Serialize};

use crate::Posed;

/// One reported failure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reported {
    /// Short name.
    pub id: String,
    /// Where it was reported.
    pub source: String,
    /// Address of the report.
    pub url: String,
    /// What was seen there.
    pub seen: String,
    /// The numbers are the report's own, and not made after its description.
    pub numbers_reported: bool,
    /// Object A.
    pub a: Part,
    /// Object B.
    pub b: Part,
    /// What is true of them.
    pub truth: Known,
}

/// Triangles with vertices of their own, three corners each.
pub type Part = Vec<[[f64; 3]; 3]>;

/// The exact answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Known {
    /// Do the surfaces meet?
    pub hit: bool,
    /// How far apart?
    pub distance: f64,
    /// How far every vertex may move while they still meet.
    pub margin: f64,
}

/// The files, by name.
const FILES: [&str; 52] = [
    include_str!("../failures/axom-152.json"),
    include_str!("../failures/bullet3-4318.json"),
    include_str!("../failures/cgal-2319.json"),
    include_str!("../failures/cgal-6384.json"),
    include_str!("../failures/cgal-6808.json"),
    include_str!("../failures/coal-134.json"),
    include_str!("../failures/coal-49.json"),
    include_str!("../failures/coal-53.json"),
    include_str!("../failures/coal-604.json"),
    include_str!("../failures/contours-1.json"),
    include_str!("../failures/convexbodyproximityqueries-17.json"),
    include_str!("../failures/directxmath-197.json"),
    include_str!("../failures/dolfinx-3653.json"),
    include_str!("../failures/drake-1668.json"),
    include_str!("../failures/fcl-106.json"),
    include_str!("../failures/fcl-293.json"),
    include_str!("../failures/fcl-319.json"),
    include_str!("../failures/fcl-492.json"),
    include_str!("../failures/fcl-493.json"),
    include_str!("../failures/flexible-gjk-8.json"),
    include_str!("../failures/geogram-10.json"),
    include_str!("../failures/geometry3sharp-85.json"),
    include_str!("../failures/gjk-c-5.json"),
    include_str!("../failures/jolt-2065.json"),
    include_str!("../failures/libccd-17.json"),
    include_str!("../failures/libccd-25.json"),
    include_str!("../failures/libccd-55.json"),
    include_str!("../failures/libccd-68.json"),
    include_str!("../failures/libigl-2381.json"),
    include_str!("../failures/libigl-2382.json"),
    include_str!("../failures/meshlib-5733.json"),
    include_str!("../failures/mujoco-warp-1430.json"),
    include_str!("../failures/ncollide-194.json"),
    include_str!("../failures/open3d-7539.json"),
    include_str!("../failures/opengjk-13.json"),
    include_str!("../failures/opengjk-3.json"),
    include_str!("../failures/opengjk-52.json"),
    include_str!("../failures/parry-107.json"),
    include_str!("../failures/parry-253.json"),
    include_str!("../failures/parry-70.json"),
    include_str!("../failures/parry-76.json"),
    include_str!("../failures/physx-610.json"),
    include_str!("../failures/pqp-4.json"),
    include_str!("../failures/python-fcl-54.json"),
    include_str!("../failures/pytorch3d-1045.json"),
    include_str!("../failures/svenstaro-bvh-44.json"),
    include_str!("../failures/three-bvh-csg-56.json"),
    include_str!("../failures/three-mesh-bvh-465.json"),
    include_str!("../failures/three-mesh-bvh-538.json"),
    include_str!("../failures/three-mesh-bvh-655.json"),
    include_str!("../failures/three-mesh-bvh-762.json"),
    include_str!("../failures/tinybvh-168.json"),
];

/// All of them, by name.
pub fn all() -> Vec<Reported> {
    FILES.iter().map(|text| serde_json::from_str(text).expect("a failure of ours")).collect()
}

impl Reported {
    /// As a question: both objects stand where their coordinates say.
    pub fn posed(&self) -> Result<Posed, MeshError> {
        Ok(Posed::new(&mesh(&self.a)?, &mesh(&self.b)?, Pose::identity()))
    }
}

fn mesh(part: &Part) -> Result<Arc<Mesh>, MeshError> {
    let corners: Vec<Point3<f64>> = part.iter().flatten().map(|&p| Point3::from(p)).collect();
    let triangles = (0..part.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::new(corners, triangles).map(Arc::new)
}

#[cfg(test)]
mod tests {
    use ocb_core::oracle::{Pair, Shape};

    use super::*;

    #[test]
    fn the_oracle_agrees_with_every_entry() {
        for reported in all() {
            let posed = reported.posed().unwrap_or_else(|e| panic!("{}: {e}", reported.id));
            let (a, b) = (Shape::new(posed.a.clone()), Shape::new(posed.b.clone()));
            let truth = Pair::new(&a, &b).tightest_truth(&posed.configuration);
            let Known { hit, distance, margin } = reported.truth;
            assert_eq!(truth.hit, hit, "{}: {truth:?}", reported.id);
            let (lo, hi) = (truth.distance_lo.next_down(), truth.distance_hi.next_up());
            assert!((lo..=hi).contains(&distance), "{}: {truth:?} without {distance:e}", reported.id);
            assert!(truth.margin >= margin * (1.0 - 1e-9), "{}: {truth:?} without {margin:e}", reported.id);
            assert!(reported.url.starts_with("https://"), "{}", reported.id);
        }
    }

    #[test]
    fn names_are_told_apart_and_in_order() {
        let ids: Vec<String> = all().into_iter().map(|r| r.id).collect();
        assert!(ids.windows(2).all(|w| w[0] < w[1]), "{ids:?}");
    }
}
