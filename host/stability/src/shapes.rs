//! Small objects that the families are made of.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};
use ocb_core::mesh::{Mesh, MeshError};

/// A point.
pub type Point = Point3<f64>;
/// Three corners.
pub type Triangle = [Point; 3];

/// Triangles over a vertex list, not yet a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soup {
    /// Vertices.
    pub positions: Vec<Point>,
    /// Vertex numbers of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// Triangles with vertices of their own.
    pub fn of(triangles: &[Triangle]) -> Self {
        let numbers = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        Self { positions: triangles.concat(), triangles: numbers.collect() }
    }

    /// What stands in a mesh.
    pub fn from_mesh(mesh: &Mesh) -> Self {
        Self { positions: mesh.positions().to_vec(), triangles: mesh.triangles().to_vec() }
    }

    /// A mesh with these very numbers.
    pub fn exact(self) -> Result<Arc<Mesh>, MeshError> {
        Mesh::new(self.positions, self.triangles).map(Arc::new)
    }

    /// A mesh in single precision, as files have it.
    pub fn mesh(self) -> Result<Arc<Mesh>, MeshError> {
        Mesh::new(self.positions, self.triangles)?.to_f32_representable().map(Arc::new)
    }

    /// Every vertex elsewhere.
    #[must_use]
    pub fn map(mut self, place: impl FnMut(Point) -> Point) -> Self {
        self.positions = self.positions.into_iter().map(place).collect();
        self
    }

    /// With the triangles of another one.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
        self
    }

    /// Every triangle cut into four at the middles of its edges.
    #[must_use]
    pub fn subdivided(self) -> Self {
        let Self { mut positions, triangles } = self;
        let mut middles = HashMap::new();
        let mut cut = Vec::with_capacity(4 * triangles.len());
        for [a, b, c] in triangles {
            let mut middle = |i: u32, j: u32| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    positions.push(nalgebra::center(&positions[i as usize], &positions[j as usize]));
                    positions.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            cut.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        Self { positions, triangles: cut }
    }
}

/// One triangle as a mesh.
pub fn single(triangle: Triangle) -> Result<Arc<Mesh>, MeshError> {
    Soup::of(&[triangle]).mesh()
}

/// A box around the origin, two triangles a side.
pub fn cuboid(half: Vector3<f64>) -> Soup {
    let corner = |i: u32| Vector3::from_fn(|k, _| if i >> k & 1 == 1 { half[k] } else { -half[k] });
    let sides: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Soup { positions: (0..8).map(|i| corner(i).into()).collect(), triangles }
}

/// A ball of radius 1: an octahedron, subdivided so often.
pub fn ball(times: u32) -> Soup {
    let axes: Vec<Point> = (0..6)
        .map(|i| Point::from(Vector3::from_fn(|k, _| if k == i / 2 { 1.0 - 2.0 * (i % 2) as f64 } else { 0.0 })))
        .collect();
    let triangles = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let mut soup = Soup { positions: axes, triangles };
    for _ in 0..times {
        soup = soup.subdivided().map(|p| Point::from(p.coords.normalize()));
    }
    soup
}

/// `n` square blades side by side, one unit high and wide, at distances of `pitch`.
pub fn comb(n: usize, pitch: f64) -> Soup {
    let blade = |i: usize| {
        let z = pitch * i as f64;
        let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Point::new(x, y, z));
        Soup::of(&[[a, b, c], [a, c, d]])
    };
    (0..n).map(blade).fold(Soup::default(), Soup::and)
}

/// The normal of a triangle, length 1.
pub fn normal(t: &Triangle) -> Vector3<f64> {
    (t[1] - t[0]).cross(&(t[2] - t[0])).normalize()
}
