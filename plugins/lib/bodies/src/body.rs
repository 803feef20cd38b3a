//! Is a mesh the surface of a convex body?
//!
//! It is, when no vertex lies in front of any of its triangles, each edge belongs to exactly two triangles, and no triangle
//! comes twice: then all triangles lie on the boundary of the hull, and a closed surface there is all of it. "In front"
//! allows for 32 roundings at the size of the object, which is what an answer may be off. A flat side that is cut finely and
//! not along the axes can carry more, because the planes of small triangles are less certain than their corners; such
//! a mesh is refused although it is convex for all practical purposes, because no proof is at hand.

use std::collections::HashSet;

use ocb_triangles::vector::{Vector, add, cross, dot, sub};

use crate::surface::Surface;
use crate::vertices::Vertices;

/// What a vertex may lie in front of a plane, as a share of the largest coordinate.
pub const TOLERANCE: f64 = 32.0 * 0.5 * f64::EPSILON;

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
    /// The body of a surface. Dents of the share `dent` of its size are taken for none.
    ///
    /// # Errors
    /// Why it is not convex, as the end of a sentence.
    pub fn new(surface: &Surface, dent: f64) -> Result<Self, String> {
        let points = &surface.points;
        let size = points.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
        let middle = points.iter().fold([0.0; 3], |sum, &p| add(sum, p)).map(|x| x / points.len() as f64);
        let vertices = Vertices::new(points.clone());
        let (mut near, mut sides, mut seen) = (0, Vec::new(), HashSet::new());
        for triangle in 0..surface.triangles.len() {
            let [p, q, r] = surface.corners(triangle);
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

/// Puts neighbours far apart, the same way every time.
fn scatter(sides: &mut [Side]) {
    let mut state = 1u64;
    for last in (1..sides.len()).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        sides.swap(last, (state >> 33) as usize % (last + 1));
    }
}
