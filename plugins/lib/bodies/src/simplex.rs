//! Up to four points of the difference of two bodies, and the point between them that is nearest to the origin.

use ocb_triangles::vector::{Vector, add_scaled, cross, dot, norm_1, sub};

/// A vertex of A minus a vertex of B.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    /// A's minus B's.
    pub point: Vector,
    /// Their numbers.
    pub vertices: [u32; 2],
}

/// One to four points.
#[derive(Clone, Debug)]
pub struct Simplex(pub Vec<Difference>);

/// The nearest point of a point, a segment or a triangle of the simplex.
struct Nearest {
    squared: f64,
    point: Vector,
    /// Which points it lies between.
    between: Vec<Difference>,
}

impl Nearest {
    fn new(point: Vector, between: &[Difference]) -> Self {
        Self { squared: dot(point, point), point, between: between.to_vec() }
    }

    fn or(self, other: Self) -> Self {
        if other.squared < self.squared { other } else { self }
    }
}

impl Simplex {
    /// The point that is nearest to the origin, or none when the origin is inside. Points that it does not lie between are
    /// dropped.
    pub fn reduce(&mut self) -> Option<Vector> {
        let nearest = match self.0.as_slice() {
            &[a, b, c, d] => {
                let faces = [([a, b, c], d), ([a, b, d], c), ([a, c, d], b), ([b, c, d], a)];
                let mut seen =
                    faces.into_iter().filter(|(face, apex)| sees(face, apex)).map(|(face, _)| triangle(face));
                let first = seen.next()?;
                seen.fold(first, Nearest::or)
            }
            &[a, b, c] => triangle([a, b, c]),
            &[a, b] => segment([a, b]),
            other => Nearest::new(other[0].point, other),
        };
        self.0 = nearest.between;
        Some(nearest.point)
    }
}

/// Does a face have the origin before it, the rest of the tetrahedron being behind? A flat tetrahedron has nothing behind.
fn sees(face: &[Difference; 3], apex: &Difference) -> bool {
    let [p, q, r] = face.map(|d| d.point);
    let normal = cross(sub(q, p), sub(r, p));
    let up = sub(apex.point, p);
    let (apex, origin) = (dot(normal, up), -dot(normal, p));
    apex.abs() <= 8.0 * f64::EPSILON * norm_1(normal) * norm_1(up) || apex * origin <= 0.0
}

fn triangle(t: [Difference; 3]) -> Nearest {
    let [p, q, r] = t.map(|d| d.point);
    let edges = [sub(q, p), sub(r, q), sub(p, r)];
    let normal = cross(edges[0], edges[1]);
    let area = dot(normal, normal);
    let within = |corner: Vector, edge: Vector| dot(cross(normal, edge), corner) <= 0.0;
    if area > 0.0 && within(p, edges[0]) && within(q, edges[1]) && within(r, edges[2]) {
        let foot = dot(normal, p) / area;
        return Nearest::new(normal.map(|x| x * foot), &t);
    }
    segment([t[0], t[1]]).or(segment([t[1], t[2]])).or(segment([t[2], t[0]]))
}

fn segment([a, b]: [Difference; 2]) -> Nearest {
    let edge = sub(b.point, a.point);
    let (along, length) = (-dot(a.point, edge), dot(edge, edge));
    if along <= 0.0 {
        Nearest::new(a.point, &[a])
    } else if along >= length {
        Nearest::new(b.point, &[b])
    } else {
        Nearest::new(add_scaled(a.point, along / length, edge), &[a, b])
    }
}
