//! The algorithm of Gilbert, Johnson and Keerthi: from one point of the difference of two bodies to nearer and nearer ones.

use ocb_triangles::vector::{Vector, add, dot, norm_1, rotate, sub};
use ocb_triangles::{Closest, Frame, Triangle};
use opencollbench_plugin::Count;

use crate::body::Body;
use crate::simplex::{Difference, Simplex};

/// What is less than so many roundings at the size of the scene is nothing.
const NOTHING: f64 = 4.0 * 0.5 * f64::EPSILON;
/// More steps than polyhedra of any size have needed by far; what is reached then is answered.
const STEPS: u32 = 500;

/// How a search ended.
#[derive(Clone, Copy, Debug)]
pub enum Found {
    /// The bodies, not only their surfaces, have a point in common.
    Meeting,
    /// They have none, and this is where they are nearest.
    Apart(Closest),
}

/// One query, with the count of its work.
pub struct Pair<'a, C> {
    a: &'a Body,
    b: &'a Body,
    frame: Frame,
    /// Distances of this size are rounding.
    nothing: f64,
    /// The latest support vertices.
    near: [u32; 2],
    work: &'a mut C,
}

impl<'a, C: Count> Pair<'a, C> {
    /// Two bodies in their frame.
    pub fn new(a: &'a Body, b: &'a Body, frame: Frame, work: &'a mut C) -> Self {
        let nothing = NOTHING * (a.size + b.size + norm_1(frame.offset));
        Self { a, b, frame, nothing, near: [0; 2], work }
    }

    /// Do the bodies meet? Ends with the first plane between them.
    pub fn meet(&mut self) -> bool {
        self.search(true).is_none()
    }

    /// Where are the bodies nearest?
    pub fn nearest(&mut self) -> Found {
        let Some(simplex) = self.search(false) else { return Found::Meeting };
        let corners = |side: usize| {
            let corner = |i: usize| simplex.0[i.min(simplex.0.len() - 1)].vertices[side];
            [0, 1, 2].map(corner)
        };
        // The last points tell which corner, edge or face is nearest; how far it is follows from the vertices themselves.
        let a: Triangle = corners(0).map(|vertex| self.place_a(vertex));
        let b: Triangle = corners(1).map(|vertex| self.place_b(vertex));
        let closest = ocb_triangles::distance(&a, &b);
        if closest.squared > 0.0 { Found::Apart(closest) } else { Found::Meeting }
    }

    /// How far the one body is from the surface of the other that holds it; 0 or less when neither holds the other.
    pub fn room(&mut self) -> f64 {
        let columns = |m: [Vector; 3]| [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]]);
        let (from_a, from_b) = (self.frame.rotation_a, self.frame.rotation_b);
        let (to_a, to_b) = (columns(from_a), columns(from_b));
        let there = rotate(&to_a, self.frame.offset);
        let back = rotate(&to_b, self.frame.offset.map(|x| -x));
        // A side of A, seen from B's frame, and the other way around.
        let of_b = self.room_in(self.a, self.b, |normal| rotate(&to_b, rotate(&from_a, normal)), there);
        if of_b > 0.0 {
            of_b
        } else {
            self.room_in(self.b, self.a, |normal| rotate(&to_a, rotate(&from_b, normal)), back)
        }
    }

    /// The least distance of the sides of `outer` from `inner`, whose origin lies at `offset`; or the first below 0.
    fn room_in(&mut self, outer: &Body, inner: &Body, turn: impl Fn(Vector) -> Vector, offset: Vector) -> f64 {
        let (mut least, mut near) = (f64::INFINITY, 0);
        for side in &outer.sides {
            let normal = turn(side.normal);
            let (furthest, looked) = inner.vertices.furthest(normal, near);
            near = furthest;
            self.work.bv_tests(looked);
            let room = side.offset - dot(side.normal, offset) - dot(normal, inner.vertices.get(near));
            least = least.min(room);
            if least <= 0.0 {
                break;
            }
        }
        least
    }

    /// The simplex that is nearest to the origin, or none when the origin is inside. `first` is content with one whose plane
    /// passes between the bodies.
    fn search(&mut self, first: bool) -> Option<Simplex> {
        let middle = add(rotate(&self.frame.rotation_b, self.b.middle), self.frame.offset);
        let between = sub(rotate(&self.frame.rotation_a, self.a.middle), middle);
        let mut simplex = Simplex(vec![self.support(between)]);
        let mut nearest = simplex.0[0].point;
        for _ in 0..STEPS {
            let distance = dot(nearest, nearest).sqrt();
            if distance <= self.nothing {
                return None;
            }
            let next = self.support(nearest);
            // All of the difference lies beyond the plane through the new point.
            let at_least = dot(nearest, next.point) / distance;
            let again = simplex.0.iter().any(|known| known.vertices == next.vertices);
            if (first && at_least > self.nothing) || distance - at_least <= 0.5 * self.nothing || again {
                break;
            }
            let mut larger = simplex.clone();
            larger.0.push(next);
            let nearer = larger.reduce()?;
            if dot(nearer, nearer) >= distance * distance {
                break;
            }
            (simplex, nearest) = (larger, nearer);
        }
        Some(simplex)
    }

    /// The point of A minus B that lies furthest against a direction.
    fn support(&mut self, against: Vector) -> Difference {
        let transposed =
            |m: &[Vector; 3], v: Vector| [0, 1, 2].map(|i| m[0][i] * v[0] + m[1][i] * v[1] + m[2][i] * v[2]);
        let towards = transposed(&self.frame.rotation_a, against.map(|x| -x));
        let (a, looked_a) = self.a.vertices.furthest(towards, self.near[0]);
        let (b, looked_b) = self.b.vertices.furthest(transposed(&self.frame.rotation_b, against), self.near[1]);
        self.near = [a, b];
        self.work.bv_tests(looked_a + looked_b);
        Difference { point: sub(self.place_a(a), self.place_b(b)), vertices: [a, b] }
    }

    fn place_a(&self, vertex: u32) -> Vector {
        rotate(&self.frame.rotation_a, self.a.vertices.get(vertex))
    }

    fn place_b(&self, vertex: u32) -> Vector {
        add(rotate(&self.frame.rotation_b, self.b.vertices.get(vertex)), self.frame.offset)
    }
}
