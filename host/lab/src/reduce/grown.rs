//! A closed mesh whose triangles are moved outwards, so that it may contain what it was made from.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};
use ocb_core::mesh::Mesh;

/// A corner moves by at most the reciprocal of this times as far as its triangles.
const SHARPEST: f64 = 0.3;

/// Every triangle moves outwards by this length, as far as its corners have neighbours that let them; nothing for a mesh that
/// encloses no volume. Whether it contains anything has to be found out.
pub fn grown(mesh: &Mesh, by: f64) -> Option<Mesh> {
    let outwards = match volume(mesh) {
        volume if volume > 0.0 => 1.0,
        volume if volume < 0.0 => -1.0,
        _ => return None,
    };
    // Corners with the same coordinates are one, also where a file splits them.
    let key = |v: u32| mesh.positions()[v as usize].coords.data.0[0].map(|x| (x + 0.0).to_bits());
    let mut around: HashMap<[u64; 3], Vec<(Vector3<f64>, f64)>> = HashMap::new();
    for (t, corners) in (0..).zip(mesh.triangles()) {
        let points = mesh.corners(t);
        let Some(normal) = (points[1] - points[0]).cross(&(points[2] - points[0])).try_normalize(0.0) else { continue };
        for at in 0..3 {
            let [here, next, last] = [0, 1, 2].map(|step| points[(at + step) % 3]);
            around.entry(key(corners[at])).or_default().push((normal * outwards, (next - here).angle(&(last - here))));
        }
    }
    let moved = |v: u32| {
        let normals = around.get(&key(v)).map_or(&[][..], Vec::as_slice);
        let mean: Vector3<f64> = normals.iter().map(|(normal, angle)| normal * *angle).sum();
        let Some(mean) = mean.try_normalize(0.0) else { return mesh.positions()[v as usize] };
        let least = normals.iter().map(|(normal, _)| normal.dot(&mean)).fold(1.0, f64::min);
        mesh.positions()[v as usize] + mean * (by / least.max(SHARPEST))
    };
    let positions: Vec<Point3<f64>> = (0..mesh.positions().len() as u32).map(moved).collect();
    Mesh::new(positions, mesh.triangles().to_vec()).ok()
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
    use ocb_core::scene::{Geometry, tessellate};

    use super::*;

    #[test]
    fn a_box_grows_on_all_sides_whichever_way_its_triangles_are_turned() {
        let cuboid = tessellate::outside(&Geometry::Box { size: [1.0, 2.0, 3.0] }, 0.0).expect("a box");
        let turned = cuboid.triangles().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let turned = Mesh::new(cuboid.positions().to_vec(), turned).expect("a mesh");
        for mesh in [cuboid, turned] {
            let sides = grown(&mesh, 0.25).expect("it encloses a volume").bounds().sides();
            // Corners of a box have triangles of unequal number on their sides, so some move a little too far.
            for (side, least) in sides.iter().zip([1.5, 2.5, 3.5]) {
                assert!(*side >= least - 1e-9 && *side < least + 0.2, "{sides:?}");
            }
        }
        let flat = Mesh::new(vec![[0.0; 3].into(), [1.0, 0.0, 0.0].into(), [0.0, 1.0, 0.0].into()], vec![[0, 1, 2]]);
        assert_eq!(grown(&flat.expect("a mesh"), 1.0), None);
    }
}
