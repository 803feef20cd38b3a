//! A convex polyhedron as V-Clip walks on it: vertices, edges and faces, and the planes between their Voronoi regions.

use std::collections::HashMap;

use ocb_bodies::Surface;
use ocb_triangles::vector::{Vector, add_scaled, cross, dot, sub};

use crate::faces::{Facet, facets};

/// A vertex, an edge or a face, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Into [`Polyhedron::vertices`].
    Vertex(u32),
    /// Into [`Polyhedron::edges`].
    Edge(u32),
    /// Into [`Polyhedron::faces`].
    Face(u32),
}

/// An edge as seen from one of its ends.
#[derive(Clone, Copy, Debug)]
pub struct Spoke {
    pub edge: u32,
    /// The other end.
    pub to: u32,
    /// Away from the vertex, of length 1: the normal of the plane between the regions of vertex and edge.
    pub along: Vector,
}

/// An edge between two faces.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    pub ends: [u32; 2],
    /// From the first end to the second, of length 1.
    pub along: Vector,
    /// The first one has the edge in its own, counter-clockwise order.
    pub faces: [u32; 2],
    /// For each face, the normal of the plane between the regions of face and edge: in the face, and out of it.
    pub walls: [Vector; 2],
}

/// A side of a face.
#[derive(Clone, Copy, Debug)]
pub struct Rim {
    pub edge: u32,
    /// A point of the wall over this edge.
    pub base: Vector,
    /// The normal of that wall, out of the face.
    pub wall: Vector,
}

/// A face.
#[derive(Clone, Debug)]
pub struct Face {
    /// Outwards, of length 1.
    pub normal: Vector,
    /// A point of its plane.
    pub anchor: Vector,
    /// Three vertices, wide apart.
    pub wide: [u32; 3],
    /// How far the third of these is from the line through the others.
    pub width: f64,
    /// Its edges, counter-clockwise.
    pub rims: Vec<Rim>,
}

/// A convex polyhedron.
#[derive(Debug)]
pub struct Polyhedron {
    pub vertices: Vec<Vector>,
    pub edges: Vec<Edge>,
    pub faces: Vec<Face>,
    spokes: Vec<Spoke>,
    /// Where the spokes of each vertex begin, and the end of all.
    first: Vec<u32>,
}

impl Polyhedron {
    /// The polyhedron of a surface around `middle`. Vertices within `reach` of a plane lie in it.
    ///
    /// None where rounding leaves no polyhedron with convex edges.
    pub fn new(surface: &Surface, middle: Vector, reach: f64) -> Option<Self> {
        let facets = facets(surface, middle, reach)?;
        let (mut vertices, mut numbers) = (Vec::new(), HashMap::new());
        let mut number = |corner: u32| {
            *numbers.entry(corner).or_insert_with(|| {
                vertices.push(surface.points[corner as usize]);
                vertices.len() as u32 - 1
            })
        };
        let loops: Vec<Vec<u32>> = facets.iter().map(|f| f.corners.iter().map(|&c| number(c)).collect()).collect();
        let edges = edges(&vertices, &facets, &loops)?;
        if vertices.len() + loops.len() != edges.len() + 2 {
            return None;
        }
        let by_ends: HashMap<[u32; 2], u32> = (0..).zip(&edges).map(|(number, edge)| (edge.ends, number)).collect();
        let face = |(facet, corners): (&Facet, &Vec<u32>)| {
            let rims = sides(corners).map(|[from, to]| {
                let (edge, side) =
                    by_ends.get(&[from, to]).map_or_else(|| (by_ends[&[to, from]], 1), |&edge| (edge, 0));
                let Edge { ends: [base, _], walls, .. } = edges[edge as usize];
                Rim { edge, base: vertices[base as usize], wall: walls[side] }
            });
            let (wide, width) = wide(&vertices, corners);
            Face { normal: facet.normal, anchor: facet.anchor, wide, width, rims: rims.collect() }
        };
        let faces = facets.iter().zip(&loops).map(face).collect();
        let (spokes, first) = spokes(vertices.len(), &edges);
        Some(Self { vertices, edges, faces, spokes, first })
    }

    /// A vertex by its number.
    pub fn vertex(&self, vertex: u32) -> Vector {
        self.vertices[vertex as usize]
    }

    /// The edges at a vertex.
    pub fn spokes(&self, vertex: u32) -> &[Spoke] {
        let [from, to] = [vertex, vertex + 1].map(|at| self.first[at as usize] as usize);
        &self.spokes[from..to]
    }

    /// How far a point lies in front of the plane of a face.
    pub fn height(&self, face: u32, point: Vector) -> f64 {
        let face = &self.faces[face as usize];
        dot(face.normal, sub(point, face.anchor))
    }
}

/// The sides of a loop of corners.
fn sides(corners: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&from, &to)| [from, to])
}

/// Each edge once; none if one does not have two faces or is not convex.
fn edges(vertices: &[Vector], facets: &[Facet], loops: &[Vec<u32>]) -> Option<Vec<Edge>> {
    let mut open: HashMap<[u32; 2], u32> = HashMap::new();
    for (face, corners) in (0..).zip(loops) {
        for side in sides(corners) {
            if open.insert(side, face).is_some() {
                return None;
            }
        }
    }
    let mut edges = Vec::with_capacity(open.len() / 2);
    for (face, corners) in (0u32..).zip(loops) {
        for [from, to] in sides(corners) {
            let other = *open.get(&[to, from])?;
            if from > to {
                continue;
            }
            let way = sub(vertices[to as usize], vertices[from as usize]);
            let length = dot(way, way).sqrt();
            let along = way.map(|x| x / length);
            let [normal, across] = [face, other].map(|face| facets[face as usize].normal);
            let walls = [cross(along, normal), cross(across, along)];
            let convex = dot(walls[0], across) > 0.0 && dot(walls[1], normal) > 0.0;
            if !convex {
                return None;
            }
            edges.push(Edge { ends: [from, to], along, faces: [face, other], walls });
        }
    }
    Some(edges)
}

fn spokes(vertices: usize, edges: &[Edge]) -> (Vec<Spoke>, Vec<u32>) {
    let mut first = vec![0u32; vertices + 1];
    for end in edges.iter().flat_map(|edge| edge.ends) {
        first[end as usize + 1] += 1;
    }
    for vertex in 0..vertices {
        first[vertex + 1] += first[vertex];
    }
    let mut next = first.clone();
    let mut spokes = vec![Spoke { edge: 0, to: 0, along: [0.0; 3] }; 2 * edges.len()];
    for (number, edge) in (0..).zip(edges) {
        let [from, to] = edge.ends;
        for (at, to, along) in [(from, to, edge.along), (to, from, edge.along.map(|x| -x))] {
            spokes[next[at as usize] as usize] = Spoke { edge: number, to, along };
            next[at as usize] += 1;
        }
    }
    (spokes, first)
}

/// Three corners of a large triangle, whose plane is more certain than that of neighbours, and how far the third is from the
/// line through the others.
fn wide(vertices: &[Vector], corners: &[u32]) -> ([u32; 3], f64) {
    let at = |corner: u32| vertices[corner as usize];
    let furthest = |from: &dyn Fn(Vector) -> f64| {
        corners.iter().copied().max_by(|&c, &d| from(at(c)).total_cmp(&from(at(d)))).unwrap_or(corners[0])
    };
    let apart = |from: u32| furthest(&|p| dot(sub(p, at(from)), sub(p, at(from))));
    let one = apart(corners[0]);
    let other = apart(one);
    let way = sub(at(other), at(one));
    let off = |p: Vector| {
        let from = sub(p, at(one));
        let across = add_scaled(from, -dot(from, way) / dot(way, way), way);
        dot(across, across)
    };
    let third = furthest(&off);
    ([one, other, third], off(at(third)).sqrt())
}
