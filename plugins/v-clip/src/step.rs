//! One step of V-Clip from each kind of pair of features: where one feature leaves the Voronoi region of the other, or the
//! distance decreases towards a neighbour, that neighbour replaces it.

use ocb_triangles::segments;
use ocb_triangles::vector::{Vector, add, add_scaled, dot, rotate, sub};

use crate::clip::Clip;
use crate::polyhedron::{Feature, Polyhedron};

/// One polyhedron, and the other one in its frame.
pub struct View<'a> {
    pub own: &'a Polyhedron,
    pub other: &'a Polyhedron,
    /// From the other's frame to the own one.
    pub turn: [Vector; 3],
    pub shift: Vector,
}

/// What a pair of features leads to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// The own feature is replaced.
    Own(Feature),
    /// The other's feature is replaced.
    Other(Feature),
    /// These features are nearest.
    Stay,
    /// The edge goes through the face.
    Crossing,
    /// The vertex lies behind all faces.
    Inside,
}

impl View<'_> {
    /// A vertex of the other one.
    fn place(&self, vertex: u32) -> Vector {
        add(rotate(&self.turn, self.other.vertex(vertex)), self.shift)
    }

    fn place_ends(&self, edge: u32) -> [Vector; 2] {
        self.other.edges[edge as usize].ends.map(|end| self.place(end))
    }

    /// Both are vertices: the edge of the own one towards the other one.
    pub fn vertex_vertex(&self, own: u32, other: u32) -> Option<Feature> {
        let from = sub(self.place(other), self.own.vertex(own));
        let mut most = (0.0, None);
        for spoke in self.own.spokes(own) {
            let beyond = dot(from, spoke.along);
            if beyond > most.0 {
                most = (beyond, Some(Feature::Edge(spoke.edge)));
            }
        }
        most.1
    }

    /// The own one is a vertex, the other one an edge; `back` is the view from the other side.
    pub fn vertex_edge(&self, back: &View<'_>, vertex: u32, edge: u32) -> Step {
        if let Some(feature) = back.leaves_edge(edge, back.place(vertex)) {
            return Step::Other(feature);
        }
        let at = self.own.vertex(vertex);
        let [tail, head] = self.place_ends(edge).map(|end| sub(end, at));
        let mut clip = Clip::new();
        for spoke in self.own.spokes(vertex) {
            if !clip.cut(-dot(tail, spoke.along), -dot(head, spoke.along), Feature::Edge(spoke.edge)) {
                return Step::Own(Feature::Edge(spoke.edge));
            }
        }
        let way = sub(head, tail);
        clip.nearer(|_, at| dot(way, add_scaled(tail, at, way))).map_or(Step::Stay, Step::Own)
    }

    /// The neighbour of an own edge in whose direction a point leaves the region of the edge.
    fn leaves_edge(&self, edge: u32, point: Vector) -> Option<Feature> {
        let edge = &self.own.edges[edge as usize];
        let [tail, head] = edge.ends.map(|end| self.own.vertex(end));
        let from_tail = sub(point, tail);
        if dot(from_tail, edge.along) < 0.0 {
            return Some(Feature::Vertex(edge.ends[0]));
        }
        if dot(sub(point, head), edge.along) > 0.0 {
            return Some(Feature::Vertex(edge.ends[1]));
        }
        let face = (0..2).find(|&side| dot(from_tail, edge.walls[side]) < 0.0)?;
        Some(Feature::Face(edge.faces[face]))
    }

    /// Both are edges: the neighbour of the own one towards the other one.
    pub fn edge_edge(&self, own: u32, other: u32) -> Option<Feature> {
        let edge = &self.own.edges[own as usize];
        let [tail, head] = self.place_ends(other);
        let way = sub(head, tail);
        let slope = |feature: Feature, at: f64| {
            let point = add_scaled(tail, at, way);
            match feature {
                Feature::Vertex(vertex) => dot(way, sub(point, self.own.vertex(vertex))),
                Feature::Edge(_) => 0.0,
                Feature::Face(face) => {
                    let rise = dot(way, self.own.faces[face as usize].normal);
                    if self.own.height(face, point) < 0.0 { -rise } else { rise }
                }
            }
        };
        let mut clip = Clip::new();
        for (end, sign) in [(0, 1.0), (1, -1.0)] {
            let base = self.own.vertex(edge.ends[end]);
            let inside = |point: Vector| sign * dot(sub(point, base), edge.along);
            let vertex = Feature::Vertex(edge.ends[end]);
            if !clip.cut(inside(tail), inside(head), vertex) {
                return Some(vertex);
            }
        }
        if let Some(vertex) = clip.nearer(slope) {
            return Some(vertex);
        }
        let base = self.own.vertex(edge.ends[0]);
        for (face, wall) in edge.faces.into_iter().zip(edge.walls) {
            if !clip.cut(dot(sub(tail, base), wall), dot(sub(head, base), wall), Feature::Face(face)) {
                return Some(Feature::Face(face));
            }
        }
        clip.nearer(slope)
    }

    /// The own one is a face, the other one a vertex.
    pub fn face_vertex(&self, face: u32, vertex: u32) -> Step {
        let point = self.place(vertex);
        let mut most = (0.0, None);
        for rim in &self.own.faces[face as usize].rims {
            let beyond = dot(sub(point, rim.base), rim.wall);
            if beyond > most.0 {
                most = (beyond, Some(Feature::Edge(rim.edge)));
            }
        }
        if let Some(edge) = most.1 {
            return Step::Own(edge);
        }
        let height = self.own.height(face, point);
        let mut nearest = (height.abs(), None);
        for spoke in self.other.spokes(vertex) {
            let next = self.own.height(face, self.place(spoke.to)) * height.signum();
            if next < nearest.0 {
                nearest = (next, Some(Feature::Edge(spoke.edge)));
            }
        }
        match nearest.1 {
            Some(edge) => Step::Other(edge),
            None if height >= 0.0 => Step::Stay,
            None => self.out_of_the_minimum(point),
        }
    }

    /// A point behind a face, where no neighbour is nearer to its plane: another face may have it in front.
    fn out_of_the_minimum(&self, point: Vector) -> Step {
        let mut best = (0.0, Step::Inside);
        for face in 0..self.own.faces.len() as u32 {
            let height = self.own.height(face, point);
            if height > best.0 {
                best = (height, Step::Own(Feature::Face(face)));
            }
        }
        best.1
    }

    /// The own one is a face, the other one an edge.
    pub fn face_edge(&self, face: u32, edge: u32) -> Step {
        let [tail, head] = self.place_ends(edge);
        let mut clip = Clip::new();
        for rim in &self.own.faces[face as usize].rims {
            let inside = |point: Vector| -dot(sub(point, rim.base), rim.wall);
            if !clip.cut(inside(tail), inside(head), Feature::Edge(rim.edge)) {
                return Step::Own(self.nearest_rim(face, [tail, head]));
            }
        }
        if clip.is_empty() {
            return Step::Own(self.nearest_rim(face, [tail, head]));
        }
        let [from, to] = [tail, head].map(|end| self.own.height(face, end));
        let heights = clip.span.map(|at| if at == 1.0 { to } else { from + at * (to - from) });
        if heights[0] < 0.0 && heights[1] > 0.0 || heights[0] > 0.0 && heights[1] < 0.0 {
            return Step::Crossing;
        }
        let end = usize::from(heights[1].abs() < heights[0].abs());
        let vertex = Feature::Vertex(self.other.edges[edge as usize].ends[end]);
        clip.by[end].map_or(Step::Other(vertex), Step::Own)
    }

    /// The edge of a face that is nearest to a segment beside the face.
    fn nearest_rim(&self, face: u32, segment: [Vector; 2]) -> Feature {
        let mut nearest = (f64::INFINITY, 0);
        for rim in &self.own.faces[face as usize].rims {
            let ends = self.own.edges[rim.edge as usize].ends.map(|end| self.own.vertex(end));
            let squared = segments(ends, segment).squared;
            if squared < nearest.0 {
                nearest = (squared, rim.edge);
            }
        }
        Feature::Edge(nearest.1)
    }
}
