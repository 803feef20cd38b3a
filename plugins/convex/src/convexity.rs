//! Is a mesh the surface of a convex body?
//!
//! It is, when no vertex lies in front of any of its triangles, each edge belongs to exactly two triangles, and no triangle
//! comes twice: then all triangles lie on the boundary of the hull, and a closed surface there is all of it. "In front"
//! allows for 32 roundings at the size of the object, which is what an answer may be off. A flat side that is cut finely and
//! not along the axes can carry more, because the planes of small triangles are less certain than their corners; such
//! a mesh is refused although it is convex for all practical purposes, because no proof is at hand.

use std::collections::{HashMap, HashSet};

use ocb_triangles::vector::{Vector, add, cross, dot, sub};
use opencollbench_plugin::Mesh;

use crate::vertices::Vertices;

/// What a vertex may lie in front of a plane, in units of the largest coordinate.
const TOLERANCE: f64 = 32.0 * 0.5 * f64::EPSILON;

/// Points p with normal . p <= offset.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Outwards, of length 1.
    pub normal: Vector,
    /// Of the plane from the origin.
    pub offset: f64,
}

/// A convex object.
#[derive(Debug)]
pub struct Body {
    /// Its vertices, each place once.
    pub vertices: Vertices,
    /// Its planes, each once, in an order that has nothing to do with where they are.
    pub sides: Vec<Side>,
    /// A point inside.
    pub middle: Vector,
    /// The largest coordinate.
    pub size: f64,
}

impl Body {
    /// The body, or why the mesh has none. Dents of the share `dent` of its size are taken for none.
    pub fn new(mesh: &Mesh<'_>, dent: f64) -> Result<Self, String> {
        let (points, triangles) = weld(mesh);
        closed(&triangles)?;
        let size = points.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
        let middle = points.iter().fold([0.0; 3], |sum, &p| add(sum, p)).map(|x| x / points.len() as f64);
        let corners: Vec<[Vector; 3]> = triangles.iter().map(|t| t.map(|vertex| points[vertex as usize])).collect();
        let vertices = Vertices::new(points);
        let (mut near, mut sides, mut seen) = (0, Vec::new(), HashSet::new());
        for (triangle, [p, q, r]) in corners.into_iter().enumerate() {
            let normal = cross(sub(q, p), sub(r, p));
            let length = dot(normal, normal).sqrt();
            if length == 0.0 {
                return Err(format!("triangle {triangle} of this one has no area"));
            }
            // The triangles may be wound either way.
            let outwards = dot(normal, sub(p, middle)).signum() / length;
            let normal = normal.map(|x| x * outwards);
            near = vertices.furthest(normal, near).0;
            let before = dot(normal, sub(vertices.get(near), p));
            if before > TOLERANCE.max(dent) * size {
                return Err(format!("a vertex of this one lies {before:.3e} in front of its triangle {triangle}"));
            }
            if dot(normal, sub(p, middle)) <= TOLERANCE * size {
                return Err("this one is flat".into());
            }
            let offset = dot(normal, p);
            if seen.insert([normal[0], normal[1], normal[2], offset].map(|x| (x + 0.0).to_bits())) {
                sides.push(Side { normal, offset });
            }
        }
        scatter(&mut sides);
        Ok(Self { vertices, sides, middle, size })
    }
}

/// Vertices that triangles use, each place once, and the triangles by their numbers.
fn weld(mesh: &Mesh<'_>) -> (Vec<Vector>, Vec<[u32; 3]>) {
    let (mut points, mut numbers) = (Vec::new(), HashMap::new());
    let mut number = |vertex: u32| {
        let point = mesh.positions[vertex as usize];
        *numbers.entry(point.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            points.push(point);
            points.len() as u32 - 1
        })
    };
    let triangles = mesh.triangles.iter().map(|t| t.map(&mut number)).collect();
    (points, triangles)
}

/// Does each edge belong to two triangles, and is each triangle there once?
fn closed(triangles: &[[u32; 3]]) -> Result<(), String> {
    let edges = triangles.iter().flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut edges: Vec<_> = edges.map(|(from, to)| (from.min(to), from.max(to))).collect();
    edges.sort_unstable();
    if let Some(edge) = edges.chunk_by(|one, other| one == other).find(|same| same.len() != 2) {
        return Err(format!("an edge of this one belongs to {} triangles and not to 2", edge.len()));
    }
    let mut seen = HashSet::new();
    let again = triangles.iter().position(|&(mut triangle)| {
        triangle.sort_unstable();
        !seen.insert(triangle)
    });
    again.map_or(Ok(()), |triangle| Err(format!("triangle {triangle} of this one comes twice")))
}

/// Puts neighbours far apart, the same way every time.
fn scatter(sides: &mut [Side]) {
    let mut state = 1u64;
    for last in (1..sides.len()).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        sides.swap(last, (state >> 33) as usize % (last + 1));
    }
}
