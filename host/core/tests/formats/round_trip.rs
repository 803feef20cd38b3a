//! A random mesh, written in each format and read back.

use nalgebra::Point3;
use ocb_core::mesh::{Mesh, read};
use proptest::prelude::*;

use crate::write::{DIALECTS, Dialect};

/// Coordinates as bits: signed zeros count, except where STL merges them.
fn bits(mesh: &Mesh, zero: f64) -> Vec<[u64; 3]> {
    mesh.positions().iter().map(|p| [p.x, p.y, p.z].map(|x| (x + zero).to_bits())).collect()
}

/// The triangles as coordinates.
fn soup(mesh: &Mesh) -> Vec<[[u64; 3]; 3]> {
    let corner = |p: Point3<f64>| [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
    (0..mesh.triangles().len() as u32).map(|t| mesh.corners(t).map(corner)).collect()
}

fn check(dialect: Dialect, mesh: &Mesh) {
    let read = read(&dialect.write(mesh)).unwrap_or_else(|e| panic!("{dialect:?}: {e}"));
    assert_eq!(read.format, dialect.format());
    if dialect.has_vertices() {
        // Adding -0 changes nothing.
        assert_eq!(bits(&read.mesh, -0.0), bits(mesh, -0.0), "{dialect:?}");
        assert_eq!(read.mesh.triangles(), mesh.triangles(), "{dialect:?}");
        return;
    }
    assert_eq!(soup(&read.mesh), soup(mesh), "{dialect:?}");
    // Each place is one vertex, all are used, and the numbers follow from first use.
    let mut places = bits(&read.mesh, 0.0);
    places.sort_unstable();
    places.dedup();
    assert_eq!(places.len(), read.mesh.positions().len(), "{dialect:?}");
    let mut next = 0;
    for &i in read.mesh.triangles().iter().flatten() {
        assert!(i <= next, "{dialect:?}");
        next = next.max(i + 1);
    }
    assert_eq!(next as usize, places.len(), "{dialect:?}");
}

/// Numbers of every size, exact zeros of either sign among them.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -1e18..1e18f64,
        3 => -1.0..1.0f64,
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, 0.1, 1e18, 5e-324, -1e-40]),
    ]
}

proptest! {
    #[test]
    fn every_format_gives_back_the_mesh_bit_by_bit(
        coordinates in prop::collection::vec(prop::array::uniform3(coordinate()), 3..40),
        corners in prop::collection::vec(prop::array::uniform3(any::<prop::sample::Index>()), 1..60),
    ) {
        let positions: Vec<_> = coordinates.iter().map(|&c| Point3::from(c)).collect();
        let triangles: Vec<_> = corners.iter().map(|t| t.map(|i| i.index(positions.len()) as u32)).collect();
        let Ok(double) = Mesh::new(positions, triangles) else { return Ok(()) };
        let single = double.clone().to_f32_representable();
        for dialect in DIALECTS {
            if !dialect.is_single() {
                check(dialect, &double);
            } else if let Ok(single) = &single
                && single.positions().iter().all(|p| p.iter().all(|x| x.abs() <= 1e18))
            {
                check(dialect, single);
            }
        }
    }
}
