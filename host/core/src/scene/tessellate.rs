//! Primitives as triangles: a closed convex polyhedron inside the shape, or one around it, both within a stated bound of it.
//!
//! A ball becomes rings and meridians, with a ring on its equator. If the planes of all facets of the polyhedron with its vertices
//! on the unit sphere are at least `d` from the centre, then a point of the ball is at most `1 - d` from that polyhedron, and the
//! polyhedron that is larger by `1 / d` contains the ball and is at most `1 / d - 1` away from it. A capsule is the sum of a
//! segment and a ball, and the sum of the segment and either polyhedron keeps these bounds. A cylinder is a prism over a regular
//! polygon. A box is exact.

use nalgebra::{Point3, Vector3};

use super::Geometry;
use crate::mesh::{Mesh, MeshError};

/// The share of the radius that [`default_bound`] allows: about 1,900 triangles for a ball.
const USUAL: f64 = 0.005;
/// Rings from the equator to a pole at most: about a million triangles for a ball.
const MOST_RINGS: u32 = 250;
/// Sides of a cylinder at most.
const MOST_SIDES: u32 = 100_000;
/// An outer polyhedron is larger by this share, so that rounding its vertices leaves the shape inside.
const ROUNDING: f64 = 1e-14;

/// Why there is no polyhedron.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TessellateError {
    /// The geometry is a mesh.
    #[error("a mesh consists of triangles already")]
    IsMesh,
    /// Too many triangles would be needed.
    #[error("a bound of {0:e} would need too many triangles")]
    TooFine(f64),
    /// A size is not positive, or too large or small for its triangles.
    #[error("its sizes make no object: {0}")]
    NoMesh(#[from] MeshError),
}

/// On which side of the surface the vertices are.
#[derive(Clone, Copy)]
enum Side {
    Inside,
    Outside,
}

impl Side {
    /// By how much to scale what has its vertices on the surface, and how far it is then from it, as shares; `d` is the smallest
    /// distance of a facet.
    fn scale(self, d: f64) -> [f64; 2] {
        match self {
            Self::Inside => [1.0, 1.0 - d],
            Self::Outside => [(1.0 + ROUNDING) / d, (1.0 + ROUNDING) / d - 1.0],
        }
    }
}

/// The bound that is used when none is asked for, in the unit of the scene: 0.5 % of the radius, 0 for a box.
pub fn default_bound(geometry: &Geometry) -> f64 {
    match geometry {
        Geometry::Mesh { .. } | Geometry::Box { .. } => 0.0,
        Geometry::Sphere { radius } | Geometry::Cylinder { radius, .. } | Geometry::Capsule { radius, .. } => {
            USUAL * radius
        }
    }
}

/// A polyhedron inside the shape; no point of the shape is further from it than `bound`.
///
/// # Errors
/// For a mesh, and for a bound that would need too many triangles.
pub fn inside(geometry: &Geometry, bound: f64) -> Result<Mesh, TessellateError> {
    tessellate(geometry, bound, Side::Inside)
}

/// A polyhedron around the shape; no point of it is further from the shape than `bound`.
///
/// # Errors
/// As for [`inside`].
pub fn outside(geometry: &Geometry, bound: f64) -> Result<Mesh, TessellateError> {
    tessellate(geometry, bound, Side::Outside)
}

fn tessellate(geometry: &Geometry, bound: f64, side: Side) -> Result<Mesh, TessellateError> {
    match *geometry {
        Geometry::Mesh { .. } => Err(TessellateError::IsMesh),
        Geometry::Box { size } => cuboid(size),
        Geometry::Sphere { radius } => ball(radius, 0.0, bound, side),
        Geometry::Capsule { radius, length } => ball(radius, length, bound, side),
        Geometry::Cylinder { radius, length } => cylinder(radius, length, bound, side),
    }
}

fn cuboid(size: [f64; 3]) -> Result<Mesh, TessellateError> {
    let corner =
        |i: usize| Point3::from([0, 1, 2].map(|axis| if i >> axis & 1 == 1 { size[axis] } else { -size[axis] } / 2.0));
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Ok(Mesh::new((0..8).map(corner).collect(), triangles)?)
}

/// A regular polygon's corner on the unit circle.
fn corner(i: u32, n: u32) -> [f64; 2] {
    let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(n)).sin_cos();
    [cos, sin]
}

fn cylinder(radius: f64, length: f64, bound: f64, side: Side) -> Result<Mesh, TessellateError> {
    let shares = |n: u32| side.scale((std::f64::consts::PI / f64::from(n)).cos());
    let fits = |n: &u32| shares(*n)[1] * radius <= bound;
    let n = (8..=MOST_SIDES).find(fits).ok_or(TessellateError::TooFine(bound))?;
    let [scale, _] = shares(n);
    let ring = |z: f64| {
        (0..n).map(move |i| {
            let [x, y] = corner(i, n);
            Point3::new(x * scale * radius, y * scale * radius, z)
        })
    };
    let mut positions: Vec<Point3<f64>> = ring(-length / 2.0).chain(ring(length / 2.0)).collect();
    positions.extend([Point3::new(0.0, 0.0, -length / 2.0), Point3::new(0.0, 0.0, length / 2.0)]);
    let mut triangles = Vec::with_capacity(4 * n as usize);
    for i in 0..n {
        let j = (i + 1) % n;
        triangles.extend([[i, j, n + j], [i, n + j, n + i], [2 * n, j, i], [2 * n + 1, n + i, n + j]]);
    }
    Ok(Mesh::new(positions, triangles)?)
}

/// A ball, or a capsule: its halves are that far apart along z.
fn ball(radius: f64, length: f64, bound: f64, side: Side) -> Result<Mesh, TessellateError> {
    for rings in 2..=MOST_RINGS {
        // So many that a facet at the equator is about a square; the estimate avoids tessellations that are far too coarse.
        if side.scale(1.0 - 0.1 / f64::from(rings * rings))[1] * radius > bound {
            continue;
        }
        let (unit, triangles) = unit_ball(rings);
        let nearest = |[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|i| unit[*i as usize]);
            let normal: Vector3<f64> = (b - a).cross(&(c - a));
            normal.dot(&a) / normal.norm()
        };
        let d = triangles.iter().map(nearest).fold(1.0, f64::min);
        let [scale, share] = side.scale(d);
        if share * radius <= bound {
            return moved(&unit, triangles, scale * radius, length);
        }
    }
    Err(TessellateError::TooFine(bound))
}

/// Its upper half up, its lower half down, and a band between.
fn moved(unit: &[Vector3<f64>], triangles: Vec<[u32; 3]>, radius: f64, length: f64) -> Result<Mesh, TessellateError> {
    let place = |p: &Vector3<f64>, up: f64| Point3::from(p * radius + Vector3::z() * (up * length / 2.0));
    if length == 0.0 {
        return Ok(Mesh::new(unit.iter().map(|p| place(p, 0.0)).collect(), triangles)?);
    }
    let count = unit.len() as u32;
    // The equator is there twice: as the upper half's rim, and behind all others as the lower half's.
    let equator: Vec<u32> = (0..count).filter(|i| unit[*i as usize].z == 0.0).collect();
    let lower = |i: u32| equator.iter().position(|on| *on == i).map_or(i, |at| count + at as u32);
    let mut positions: Vec<Point3<f64>> = unit.iter().map(|p| place(p, if p.z < 0.0 { -1.0 } else { 1.0 })).collect();
    positions.extend(equator.iter().map(|i| place(&unit[*i as usize], -1.0)));
    let is_lower = |t: &[u32; 3]| t.iter().any(|i| unit[*i as usize].z < 0.0);
    let mut all: Vec<[u32; 3]> = triangles.into_iter().map(|t| if is_lower(&t) { t.map(lower) } else { t }).collect();
    let n = equator.len() as u32;
    for at in 0..n {
        let next = (at + 1) % n;
        let [a, b, c, d] = [count + at, count + next, equator[next as usize], equator[at as usize]];
        all.extend([[a, b, c], [a, c, d]]);
    }
    Ok(Mesh::new(positions, all)?)
}

/// Vertices on the unit sphere: the south pole, rings of equal latitude from south to north with one on the equator, the north pole.
fn unit_ball(rings: u32) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let (n, circles) = (4 * rings, 2 * rings - 1);
    let mut positions = vec![-Vector3::z()];
    for circle in 1..=circles {
        let latitude = std::f64::consts::FRAC_PI_2 * (f64::from(circle) / f64::from(rings) - 1.0);
        let (z, r) = if circle == rings { (0.0, 1.0) } else { latitude.sin_cos() };
        positions.extend((0..n).map(|i| {
            let [x, y] = corner(i, n);
            Vector3::new(x * r, y * r, z)
        }));
    }
    positions.push(Vector3::z());
    let at = |circle: u32, i: u32| 1 + (circle - 1) * n + i % n;
    let north = positions.len() as u32 - 1;
    let mut triangles = Vec::new();
    for i in 0..n {
        triangles.push([0, at(1, i + 1), at(1, i)]);
        for circle in 1..circles {
            let [a, b, c, d] = [at(circle, i), at(circle, i + 1), at(circle + 1, i + 1), at(circle + 1, i)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        triangles.push([north, at(circles, i), at(circles, i + 1)]);
    }
    (positions, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance of a point from the shape's surface, below 0 inside.
    fn off(geometry: &Geometry, p: &Point3<f64>) -> f64 {
        match *geometry {
            Geometry::Sphere { radius } => p.coords.norm() - radius,
            Geometry::Capsule { radius, length } => {
                let along = p.z.clamp(-length / 2.0, length / 2.0);
                (p - Point3::new(0.0, 0.0, along)).norm() - radius
            }
            Geometry::Cylinder { radius, length } => {
                let [aside, above] = [p.x.hypot(p.y) - radius, p.z.abs() - length / 2.0];
                if aside.max(above) > 0.0 { aside.max(0.0).hypot(above.max(0.0)) } else { aside.max(above) }
            }
            Geometry::Mesh { .. } | Geometry::Box { .. } => panic!("no curved shape"),
        }
    }

    /// Points all over the triangles, their corners too.
    fn samples(mesh: &Mesh) -> impl Iterator<Item = Point3<f64>> {
        mesh.triangles().iter().flat_map(|triangle| {
            let [a, b, c] = triangle.map(|i| mesh.positions()[i as usize]);
            let steps = (0..=8).flat_map(|i| (0..=8 - i).map(move |j| [f64::from(i) / 8.0, f64::from(j) / 8.0]));
            steps.map(move |[s, t]| a + (b - a) * s + (c - a) * t)
        })
    }

    fn shapes() -> [Geometry; 5] {
        [
            Geometry::Sphere { radius: 2.0 },
            Geometry::Cylinder { radius: 0.5, length: 3.0 },
            Geometry::Cylinder { radius: 3.0, length: 0.01 },
            Geometry::Capsule { radius: 0.5, length: 3.0 },
            Geometry::Capsule { radius: 2.0, length: 0.0 },
        ]
    }

    #[test]
    fn polyhedra_are_on_their_side_and_within_the_bound() {
        for shape in shapes() {
            let usual = default_bound(&shape);
            for bound in [usual, usual / 10.0] {
                let [inner, outer] = [inside(&shape, bound), outside(&shape, bound)].map(|mesh| mesh.unwrap());
                for p in samples(&inner) {
                    let off = off(&shape, &p);
                    assert!(off <= 1e-12 && off >= -bound - 1e-12, "{shape:?} {bound}: {off}");
                }
                for p in samples(&outer) {
                    let off = off(&shape, &p);
                    assert!(off >= 0.0 && off <= bound, "{shape:?} {bound}: {off}");
                }
            }
        }
    }

    #[test]
    fn polyhedra_are_closed_and_turned_outward() {
        let boxes = [Geometry::Box { size: [1.0, 2.0, 3.0] }];
        for shape in shapes().iter().chain(&boxes) {
            let mesh = outside(shape, default_bound(shape)).unwrap();
            let mut edges: Vec<[u32; 2]> =
                mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
            edges.sort_unstable();
            for edge in &edges {
                let back = [edge[1], edge[0]];
                assert!(edges.binary_search(&back).is_ok(), "{shape:?}: {edge:?} has no other side");
            }
            assert!(edges.windows(2).all(|two| two[0] != two[1]), "{shape:?}");
            let volume: f64 = mesh
                .triangles()
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|i| mesh.positions()[i as usize].coords);
                    a.dot(&b.cross(&c)) / 6.0
                })
                .sum();
            let pi = std::f64::consts::PI;
            let exact = match *shape {
                Geometry::Sphere { radius } => 4.0 / 3.0 * pi * radius.powi(3),
                Geometry::Capsule { radius, length } => 4.0 / 3.0 * pi * radius.powi(3) + pi * radius * radius * length,
                Geometry::Cylinder { radius, length } => pi * radius * radius * length,
                Geometry::Box { size: [a, b, c] } => a * b * c,
                Geometry::Mesh { .. } => 0.0,
            };
            assert!(volume >= exact - 1e-12 && volume < 1.02 * exact, "{shape:?}: {volume} for {exact}");
        }
    }

    #[test]
    fn what_cannot_be_made_is_refused() {
        let ball = Geometry::Sphere { radius: 1.0 };
        assert_eq!(inside(&ball, 1e-9), Err(TessellateError::TooFine(1e-9)));
        assert!(inside(&Geometry::Mesh { sha256: String::new(), solid: false }, 0.1).is_err());
        assert!(inside(&Geometry::Box { size: [0.0; 3] }, 0.1).is_err());
    }
}
