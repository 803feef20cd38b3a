//! A closed mesh with fewer triangles that is grown outwards, where its object sticks out of it, until it contains the object.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};
use ocb_advice::Watch;
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use rayon::prelude::*;

/// A corner moves by at most the reciprocal of this times as far as its triangles.
const SHARPEST: f64 = 0.3;
/// Where a triangle has to grow, it does by this share of the most at least, and by this share of what it has grown.
const STEP: f64 = 1.0 / 512.0;
const MORE: f64 = 0.25;
/// Around an object with more corners nothing is grown: it takes minutes.
const MOST_CORNERS: usize = 20_000;
/// After so many steps it is given up.
const MOST_STEPS: usize = 24;

/// A level whose triangles are moved outwards by `most` at most, so that its surface does not meet the object's and none of the
/// object's corners is outside; nothing where that is not enough, and when it was stopped. Whether it contains the object has to be
/// found out.
pub fn around(
    level: &Mesh,
    object: &Shape,
    corners: &[Point3<f64>],
    most: f64,
    watch: &dyn Watch,
) -> Option<Arc<Mesh>> {
    if corners.len() > MOST_CORNERS {
        return None;
    }
    let here = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
    let growing = Growing::of(level)?;
    // Corners of a level are corners of its object, and on its surface nothing is inside or outside.
    let mut by = vec![STEP * most; level.positions().len()];
    for _ in 0..MOST_STEPS {
        if watch.stopped() {
            return None;
        }
        let grown = growing.grown(&by)?;
        let shape = Shape::new(grown.clone());
        if !shape.is_closed() {
            return None;
        }
        let out = |corner: &Point3<f64>| {
            let point = Shape::from_triangles(&[[*corner; 3]]);
            let truth = Pair::new(&shape, &point).truth(&here);
            let inside = || Pair::new(&shape, &point).parts_of_b_in_a(&here) == Some(vec![true]);
            (truth.hit || !inside()).then_some((truth.witness.triangle_a, truth.distance_hi))
        };
        let mut more: Vec<(u32, f64)> = corners.par_iter().filter_map(out).collect();
        more.extend(Pair::new(&shape, object).contacts(&here).into_iter().map(|[triangle, _]| (triangle, 0.0)));
        if more.is_empty() {
            return Some(grown);
        }
        let mut step = vec![0.0_f64; by.len()];
        for (triangle, length) in more {
            for corner in level.triangles()[triangle as usize].map(|v| growing.first[v as usize] as usize) {
                step[corner] = step[corner].max(length.max(MORE * by[corner]) + STEP * most);
            }
        }
        by.iter_mut().zip(step).for_each(|(by, step)| *by += step);
        if by.iter().any(|by| *by > most) {
            return None;
        }
    }
    None
}

/// A mesh and the ways of its corners.
struct Growing<'a> {
    mesh: &'a Mesh,
    /// The first of the corners with the same coordinates, which a file may split.
    first: Vec<u32>,
    /// Which way a corner moves, and how far when its triangles move by 1.
    outwards: Vec<Vector3<f64>>,
}

impl<'a> Growing<'a> {
    /// Nothing for a mesh that encloses no volume.
    fn of(mesh: &'a Mesh) -> Option<Self> {
        let sign = match volume(mesh) {
            volume if volume > 0.0 => 1.0,
            volume if volume < 0.0 => -1.0,
            _ => return None,
        };
        let mut places = HashMap::new();
        let place = |(v, p): (u32, &Point3<f64>)| {
            let key = p.coords.data.0[0].map(|x| (x + 0.0).to_bits());
            *places.entry(key).or_insert(v)
        };
        let first: Vec<u32> = (0..).zip(mesh.positions()).map(place).collect();
        let mut normals: Vec<Vec<(Vector3<f64>, f64)>> = vec![Vec::new(); first.len()];
        for (t, corners) in (0..).zip(mesh.triangles()) {
            let points = mesh.corners(t);
            let normal = (points[1] - points[0]).cross(&(points[2] - points[0])).try_normalize(0.0);
            let Some(normal) = normal else { continue };
            for at in 0..3 {
                let [here, next, last] = [0, 1, 2].map(|step| points[(at + step) % 3]);
                let angle = (next - here).angle(&(last - here));
                normals[first[corners[at] as usize] as usize].push((normal * sign, angle));
            }
        }
        let outwards = normals.iter().map(|normals| outwards(normals)).collect();
        Some(Self { mesh, first, outwards })
    }

    /// Each first corner's triangles moved by so much.
    fn grown(&self, by: &[f64]) -> Option<Arc<Mesh>> {
        let moved = |(p, first): (&Point3<f64>, &u32)| p + self.outwards[*first as usize] * by[*first as usize];
        let positions = self.mesh.positions().iter().zip(&self.first).map(moved).collect();
        Mesh::new(positions, self.mesh.triangles().to_vec()).ok().map(Arc::new)
    }
}

/// The mean of the normals around a corner, each as heavy as its angle, so long that every triangle moves by 1 if the corner is
/// not too sharp.
fn outwards(normals: &[(Vector3<f64>, f64)]) -> Vector3<f64> {
    let mean: Vector3<f64> = normals.iter().map(|(normal, angle)| normal * *angle).sum();
    let Some(mean) = mean.try_normalize(0.0) else { return Vector3::zeros() };
    let least = normals.iter().map(|(normal, _)| normal.dot(&mean)).fold(1.0, f64::min);
    mean / least.max(SHARPEST)
}

/// Six times the volume; negative where triangles are turned inwards.
fn volume(mesh: &Mesh) -> f64 {
    let middle = mesh.bounds().center();
    let cone = |t: u32| {
        let [a, b, c] = mesh.corners(t).map(|p| p - middle);
        a.cross(&b).dot(&c)
    };
    (0..mesh.triangles().len() as u32).map(cone).sum()
}

#[cfg(test)]
mod tests {
    use ocb_advice::Unwatched;
    use ocb_core::scene::{Geometry, tessellate};

    use super::*;

    fn cuboid(size: [f64; 3]) -> Mesh {
        tessellate::outside(&Geometry::Box { size }, 0.0).expect("a box")
    }

    #[test]
    fn a_box_grows_where_the_object_sticks_out_and_hardly_elsewhere() {
        let object = Shape::new(Arc::new(cuboid([1.4, 1.98, 2.98])));
        let small = cuboid([1.0, 2.0, 3.0]);
        let turned = small.triangles().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let turned = Mesh::new(small.positions().to_vec(), turned).expect("a mesh");
        for mesh in [&small, &turned] {
            let grown = around(mesh, &object, object.positions(), 0.5, &Unwatched).expect("it can");
            let sides = grown.bounds().sides();
            assert!(sides.x > 1.4 && sides.x < 1.7, "{sides:?}");
            assert_eq!(around(mesh, &object, object.positions(), 0.1, &Unwatched), None);
        }
        // What moves a corner moves all sides at it, but a corner elsewhere stays.
        let bump = Shape::from_triangles(&[[[0.6, 0.9, 1.4], [0.4, 0.9, 1.4], [0.4, 0.8, 1.4]].map(Point3::from)]);
        let grown = around(&small, &bump, bump.positions(), 0.5, &Unwatched).expect("it can");
        let far = grown.positions().iter().filter(|p| p.x < 0.0 && p.y < 0.0 && p.z < 0.0);
        assert!(far.clone().count() > 0 && far.into_iter().all(|p| (p - Point3::new(-0.5, -1.0, -1.5)).norm() < 0.02));
        let flat = Mesh::new(vec![[0.0; 3].into(), [1.0, 0.0, 0.0].into(), [0.0, 1.0, 0.0].into()], vec![[0, 1, 2]]);
        assert_eq!(around(&flat.expect("a mesh"), &object, object.positions(), 1.0, &Unwatched), None);
    }
}
