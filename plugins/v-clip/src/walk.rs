//! The walk from pair to pair of features, until no neighbour is nearer.

use ocb_triangles::vector::{Vector, add_scaled, cross, dot, rotate, sub, transposed};
use ocb_triangles::{Closest, Frame, segments};

use crate::polyhedron::{Feature, Polyhedron};
use crate::step::{Step, View};

/// How a walk ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At the nearest features.
    Nearest,
    /// An edge of one polyhedron goes through a face of the other.
    Crossing,
    /// A vertex of one polyhedron lies inside the other.
    Inside,
    /// It came back to a pair that it had left: rounding has led it in a circle.
    Circle,
}

/// One query.
pub struct Walk<'a> {
    polyhedra: [&'a Polyhedron; 2],
    views: [View<'a>; 2],
    frame: Frame,
    /// The features of A and of B.
    pub at: [Feature; 2],
    /// Pairs of features looked at.
    pub steps: u64,
}

impl<'a> Walk<'a> {
    /// Begins at a pair of features, which are not both faces.
    pub fn new(polyhedra: [&'a Polyhedron; 2], frame: Frame, at: [Feature; 2]) -> Self {
        let [a, b] = polyhedra;
        let [to_a, to_b] = [transposed(&frame.rotation_a), transposed(&frame.rotation_b)];
        // Rows of the one times columns of the other.
        let turn = to_a.map(|row| rotate(&to_b, row));
        let in_a = View { own: a, other: b, turn, shift: rotate(&to_a, frame.offset) };
        let back = rotate(&to_b, frame.offset).map(|x| -x);
        let in_b = View { own: b, other: a, turn: transposed(&turn), shift: back };
        Self { polyhedra, views: [in_a, in_b], frame, at, steps: 0 }
    }

    /// Walks to the end.
    pub fn run(&mut self) -> Ending {
        // The next pair depends only on this one, so a pair that comes twice comes for ever (R. P. Brent, BIT 20, 1980).
        let (mut landmark, mut until) = (self.at, 8);
        loop {
            self.steps += 1;
            match self.step() {
                Step::Own(feature) => self.at[0] = feature,
                Step::Other(feature) => self.at[1] = feature,
                Step::Stay => return Ending::Nearest,
                Step::Crossing => return Ending::Crossing,
                Step::Inside => return Ending::Inside,
            }
            if self.at == landmark {
                return Ending::Circle;
            }
            if self.steps == until {
                (landmark, until) = (self.at, 2 * until);
            }
        }
    }

    /// One step; "own" is A.
    fn step(&self) -> Step {
        use Feature::{Edge, Face, Vertex};
        let [a, b] = &self.views;
        let both = |own: Option<Feature>, other: &dyn Fn() -> Option<Feature>| {
            own.map(Step::Own).or_else(|| other().map(Step::Other)).unwrap_or(Step::Stay)
        };
        match self.at {
            [Vertex(v), Vertex(w)] => both(a.vertex_vertex(v, w), &|| b.vertex_vertex(w, v)),
            [Edge(e), Edge(f)] => both(a.edge_edge(e, f), &|| b.edge_edge(f, e)),
            [Vertex(v), Edge(e)] => a.vertex_edge(b, v, e),
            [Edge(e), Vertex(v)] => swapped(b.vertex_edge(a, v, e)),
            [Face(f), Vertex(v)] => a.face_vertex(f, v),
            [Vertex(v), Face(f)] => swapped(b.face_vertex(f, v)),
            [Face(f), Edge(e)] => a.face_edge(f, e),
            [Edge(e), Face(f)] => swapped(b.face_edge(f, e)),
            [Face(_), Face(_)] => unreachable!("no step leads to two faces"),
        }
    }

    /// The distance of the features and where they have it, from their vertices where the poses put them. `rounding` is that
    /// of a coordinate.
    ///
    /// None if a face is so narrow that rounding its corners turns its plane too far.
    pub fn closest(&self, rounding: f64) -> Option<Closest> {
        let [a, b] = self.at;
        match (self.ends(0, a), self.ends(1, b)) {
            (Some(a), Some(b)) => Some(segments(a, b)),
            (None, Some([p, _])) => {
                self.foot(0, a, p, rounding).map(|(squared, foot)| Closest { squared, a: foot, b: p })
            }
            (Some([p, _]), None) => {
                self.foot(1, b, p, rounding).map(|(squared, foot)| Closest { squared, a: p, b: foot })
            }
            (None, None) => unreachable!("no step leads to two faces"),
        }
    }

    /// The ends of an edge, or a vertex twice.
    fn ends(&self, side: usize, feature: Feature) -> Option<[Vector; 2]> {
        let polyhedron = self.polyhedra[side];
        let ends = match feature {
            Feature::Vertex(vertex) => [vertex; 2],
            Feature::Edge(edge) => polyhedron.edges[edge as usize].ends,
            Feature::Face(_) => return None,
        };
        Some(ends.map(|vertex| self.place(side, vertex)))
    }

    fn place(&self, side: usize, vertex: u32) -> Vector {
        let corner = [self.polyhedra[side].vertex(vertex); 3];
        if side == 0 { self.frame.place_a(&corner)[0] } else { self.frame.place_b(&corner)[0] }
    }

    /// The square of the distance of a point from the plane of a face, and its foot there.
    fn foot(&self, side: usize, feature: Feature, point: Vector, rounding: f64) -> Option<(f64, Vector)> {
        let Feature::Face(face) = feature else { unreachable!("only a face has no ends") };
        let face = &self.polyhedra[side].faces[face as usize];
        let [p, q, r] = face.wide.map(|vertex| self.place(side, vertex));
        let (way, to) = (sub(q, p), sub(r, p));
        // Of near parallel vectors the cross product would lose digits.
        let across = add_scaled(to, -dot(to, way) / dot(way, way), way);
        let normal = cross(way, across);
        let size = dot(normal, normal);
        let height = dot(normal, sub(point, p));
        let squared = height * height / size;
        // The foot moves by the distance times the angle, which is a rounding of a corner over the width.
        let certain = squared.sqrt() * rounding < face.width * face.width;
        certain.then(|| (squared, add_scaled(point, -height / size, normal)))
    }
}

/// A step as the other side sees it.
fn swapped(step: Step) -> Step {
    match step {
        Step::Own(feature) => Step::Other(feature),
        Step::Other(feature) => Step::Own(feature),
        step => step,
    }
}
