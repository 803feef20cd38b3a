//! Convex hulls of an object's parts, as V-HACD cuts it (Mamou and Ghorbel, ICIP 2009).

use std::panic::{AssertUnwindSafe, catch_unwind};

use nalgebra::{Point3, Vector3};
use ocb_core::mesh::Mesh;
use ocb_core::scene::around::mean;
use ocb_methods::convex_parts::decompose;
use rayon::prelude::*;

use crate::ladder::simplified;
use crate::proxy::{hull, hull_of, planes};

/// How often an object is cut in two at most: into 4 parts, and into 16.
const DEPTHS: [u32; 2] = [2, 4];
/// Voxels along its longest side.
const RESOLUTION: u32 = 64;
/// Objects of more triangles are not cut: it takes minutes.
const MOST_TO_CUT: usize = 200_000;
/// So many triangles has a hull that is made simpler.
const SIMPLE: usize = 48;

/// Of each way of cutting: the hulls of all parts, which together hold the surface, and simpler bodies around these.
pub(crate) fn hulls_of_parts(object: &Mesh) -> Vec<Vec<Mesh>> {
    if object.triangles().len() > MOST_TO_CUT {
        return Vec::new();
    }
    // A library that panics costs its own parts.
    let cut = |depth: &u32| catch_unwind(AssertUnwindSafe(|| parts(object, *depth))).ok().flatten();
    let cuts: Vec<Vec<Mesh>> = DEPTHS.par_iter().filter_map(cut).collect();
    cuts.into_iter().flat_map(|hulls| [hulls.iter().map(simpler).collect(), hulls]).collect()
}

/// Nothing where a part is flat.
fn parts(object: &Mesh, depth: u32) -> Option<Vec<Mesh>> {
    let positions: Vec<[f64; 3]> = object.positions().iter().map(|p| [p.x, p.y, p.z]).collect();
    let view = opencollbench_plugin::Mesh { positions: &positions, triangles: object.triangles() };
    let corners = decompose(&view, depth, RESOLUTION).into_iter().map(|part| part.points);
    corners.map(|corners| hull_of(corners.iter().map(|p| Point3::new(p.x, p.y, p.z)))).collect()
}

/// A convex body with fewer triangles, just so large that it contains the hull; the hull itself where there is none.
fn simpler(whole: &Mesh) -> Mesh {
    let fewer = || {
        let fewer = hull(&simplified(whole, SIMPLE)?)?;
        let middle = Point3::from(mean(fewer.positions())?);
        let planes = planes(&fewer);
        let beyond = |p: &Point3<f64>| {
            let share =
                |(normal, on): &(Vector3<f64>, Point3<f64>)| normal.dot(&(p - middle)) / normal.dot(&(on - middle));
            planes.iter().map(share).fold(1.0, f64::max)
        };
        let by = whole.positions().iter().map(beyond).fold(1.0, f64::max);
        let positions = fewer.positions().iter().map(|p| middle + (p - middle) * by).collect();
        Mesh::new(positions, fewer.triangles().to_vec()).ok()
    };
    fewer().filter(|fewer| fewer.triangles().len() < whole.triangles().len()).unwrap_or_else(|| whole.clone())
}

#[cfg(test)]
mod tests {
    use ocb_core::stock;

    use super::*;

    #[test]
    fn simpler_bodies_contain_their_hulls() {
        let knot = stock::generate("torus-knot", 3000).expect("a knot");
        let cuts = hulls_of_parts(&knot);
        let sizes: Vec<[usize; 2]> =
            cuts.iter().map(|hulls| [hulls.len(), hulls.iter().map(|hull| hull.triangles().len()).sum()]).collect();
        assert_eq!(sizes.len(), 2 * DEPTHS.len());
        for [simple, whole] in cuts.as_chunks::<2>().0 {
            assert_eq!(simple.len(), whole.len());
            for (simple, whole) in simple.iter().zip(whole) {
                assert!(simple.triangles().len() <= whole.triangles().len().min(2 * SIMPLE), "{sizes:?}");
                for t in 0..simple.triangles().len() as u32 {
                    let [a, b, c] = simple.corners(t);
                    let normal = (b - a).cross(&(c - a)).normalize();
                    let beyond = whole.positions().iter().map(|p| normal.dot(&(p - a))).fold(f64::MIN, f64::max);
                    assert!(beyond < 1e-9 * knot.longest_side(), "{beyond}");
                }
            }
        }
        assert!(sizes[0][0] <= 4 && sizes[2][0] > 4 && sizes[2][0] <= 16, "{sizes:?}");
    }
}
