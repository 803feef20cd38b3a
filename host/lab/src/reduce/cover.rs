//! Do convex polyhedra cover a mesh?
//!
//! A triangle is cut along the planes of one polyhedron after the other; what is behind all planes of one is covered, and it is
//! covered as a whole when nothing is left.

use nalgebra::{Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::scene::around;
use rayon::prelude::*;

use super::body::ROUNDING;

/// A triangle that is cut into more pieces than this is taken for uncovered.
const MOST_PIECES: usize = 10_000;

/// Points that are certainly inside a closed polyhedron: those behind all planes of its triangles.
struct Region {
    planes: Vec<Plane>,
    min: Vector3<f64>,
    max: Vector3<f64>,
}

/// An outward normal, and how far along it the points behind the plane may be.
struct Plane {
    normal: Vector3<f64>,
    most: f64,
}

/// A convex polygon.
type Polygon = Vec<Point3<f64>>;

/// Is all of a mesh certainly in the union of these bodies, in the same frame?
pub fn covers(parts: &[Shape], mesh: &Shape) -> bool {
    let largest = |shape: &Shape| shape.positions().iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
    let rounding = ROUNDING * parts.iter().chain([mesh]).map(largest).fold(0.0, f64::max);
    let regions: Vec<Region> = parts.iter().filter_map(|part| Region::of(part, rounding)).collect();
    let covered = |corners: &[u32; 3]| is_covered(corners.map(|v| mesh.positions()[v as usize]), &regions);
    mesh.triangles().par_iter().all(covered)
}

fn is_covered(triangle: [Point3<f64>; 3], regions: &[Region]) -> bool {
    let mut left: Vec<Polygon> = vec![triangle.to_vec()];
    for region in regions.iter().filter(|region| region.is_near(&triangle)) {
        left = left.into_iter().flat_map(|polygon| region.without(polygon)).collect();
        if left.is_empty() {
            return true;
        }
        if left.len() > MOST_PIECES {
            return false;
        }
    }
    false
}

impl Region {
    /// No triangle is in it, so that all of it is inside when its middle is. Nothing for what is no such polyhedron.
    fn of(part: &Shape, rounding: f64) -> Option<Self> {
        let plane = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|v| part.positions()[v as usize]);
            let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
            Some(Plane { most: normal.dot(&a.coords) - rounding, normal })
        };
        let planes: Vec<Plane> = part.triangles().iter().filter_map(plane).collect();
        let middle = Point3::from(around::mean(part.positions())?);
        let here = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
        let behind = planes.iter().all(|plane| plane.beyond(&middle) < -rounding);
        let inside = || Pair::new(part, &Shape::from_triangles(&[[middle; 3]])).parts_of_b_in_a(&here);
        let corners = || part.positions().iter().map(|p| p.coords);
        let (min, max) = (corners().reduce(|a, b| a.inf(&b))?, corners().reduce(|a, b| a.sup(&b))?);
        (behind && inside() == Some(vec![true])).then_some(Self { planes, min, max })
    }

    fn is_near(&self, triangle: &[Point3<f64>; 3]) -> bool {
        let [a, b, c] = triangle.map(|p| p.coords);
        let (min, max) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
        (0..3).all(|axis| min[axis] <= self.max[axis] && self.min[axis] <= max[axis])
    }

    /// What of a polygon is not in it.
    fn without(&self, polygon: Polygon) -> Vec<Polygon> {
        let (mut inside, mut outside) = (polygon.clone(), Vec::new());
        for plane in &self.planes {
            let [behind, beyond] = plane.cut(inside);
            outside.extend(beyond);
            match behind {
                Some(behind) => inside = behind,
                // Nothing of it is inside: better in one piece.
                None => return vec![polygon],
            }
        }
        outside
    }
}

impl Plane {
    /// How far a point is beyond it.
    fn beyond(&self, p: &Point3<f64>) -> f64 {
        self.normal.dot(&p.coords) - self.most
    }

    /// What of a polygon is behind it, and what is beyond it.
    fn cut(&self, polygon: Polygon) -> [Option<Polygon>; 2] {
        let beyond: Vec<f64> = polygon.iter().map(|p| self.beyond(p)).collect();
        if beyond.iter().all(|x| *x <= 0.0) {
            return [Some(polygon), None];
        }
        if beyond.iter().all(|x| *x > 0.0) {
            return [None, Some(polygon)];
        }
        let mut sides = [Polygon::new(), Polygon::new()];
        for at in 0..polygon.len() {
            let next = (at + 1) % polygon.len();
            let [from, to] = [beyond[at], beyond[next]];
            sides[usize::from(from > 0.0)].push(polygon[at]);
            if (from > 0.0) != (to > 0.0) {
                let crossing = polygon[at] + (polygon[next] - polygon[at]) * (from / (from - to));
                sides.iter_mut().for_each(|side| side.push(crossing));
            }
        }
        sides.map(Some)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use ocb_core::mesh::Mesh;
    use ocb_core::scene::{Geometry, tessellate};
    use ocb_core::stock;
    use proptest::prelude::*;

    use super::*;

    fn cuboid(size: [f64; 3], at: [f64; 3]) -> Mesh {
        let cuboid = tessellate::outside(&Geometry::Box { size }, 0.0).expect("a box");
        let moved = cuboid.positions().iter().map(|p| p + Vector3::from(at)).collect();
        Mesh::new(moved, cuboid.triangles().to_vec()).expect("a mesh")
    }

    fn shapes(meshes: impl IntoIterator<Item = Mesh>) -> Vec<Shape> {
        meshes.into_iter().map(|mesh| Shape::new(Arc::new(mesh))).collect()
    }

    #[test]
    fn parts_that_overlap_cover_what_none_of_them_holds() {
        let ball = Shape::new(Arc::new(stock::generate("sphere", 500).expect("a sphere")));
        let side = 2.2 * ball.positions().iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
        let half = |sign: f64, width: f64| cuboid([width * side, side, side], [sign * 0.25 * side, 0.0, 0.0]);
        assert!(covers(&shapes([half(-1.0, 0.501), half(1.0, 0.501)]), &ball));
        // A gap between both, one of them missing, and one that is turned inside out.
        assert!(!covers(&shapes([half(-1.0, 0.499), half(1.0, 0.499)]), &ball));
        assert!(!covers(&shapes([half(1.0, 0.501)]), &ball) && !covers(&[], &ball));
        let right = half(1.0, 0.501);
        let turned = right.triangles().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let turned = Mesh::new(right.positions().to_vec(), turned).expect("a mesh");
        assert!(!covers(&shapes([half(-1.0, 0.501), turned]), &ball));
        // Each triangle twice: by the parity of crossings nothing is inside.
        let twice = [right.triangles(), right.triangles()].concat();
        let twice = Mesh::new(right.positions().to_vec(), twice).expect("a mesh");
        assert!(!covers(&shapes([half(-1.0, 0.501), twice]), &ball));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        /// A triangle among boxes: where a point of it is outside all of them, it is not called covered; and where none of many
        /// points is, larger boxes cover it.
        #[test]
        fn what_is_called_covered_has_no_point_outside(
            corners in prop::array::uniform3(prop::array::uniform3(-1.0..1.0f64)),
            boxes in prop::collection::vec((prop::array::uniform3(0.5..2.5f64), prop::array::uniform3(-0.8..0.8f64)), 1..6),
        ) {
            let triangle = corners.map(Point3::from);
            prop_assume!((triangle[1] - triangle[0]).cross(&(triangle[2] - triangle[0])).norm() > 1e-3);
            let mesh = Shape::from_triangles(&[triangle]);
            let parts = shapes(boxes.iter().map(|(size, at)| cuboid(*size, *at)));
            let in_some = |p: Point3<f64>| {
                let inside = |(size, at): &([f64; 3], [f64; 3])| (0..3).all(|k| (p[k] - at[k]).abs() <= size[k] / 2.0);
                boxes.iter().any(inside)
            };
            let steps = 60;
            let sampled = (0..=steps).flat_map(|i| (0..=steps - i).map(move |j| [i, j])).all(|[i, j]| {
                let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(steps));
                in_some(triangle[0] + (triangle[1] - triangle[0]) * u + (triangle[2] - triangle[0]) * v)
            });
            let called = covers(&parts, &mesh);
            prop_assert!(sampled || !called);
            // Larger by more than the points are apart.
            let larger = shapes(boxes.iter().map(|(size, at)| cuboid(size.map(|x| x + 0.1), *at)));
            prop_assert!(!sampled || covers(&larger, &mesh));
        }
    }
}
