//! The reference that judges every algorithm: slow if it must, never wrong.
//!
//! # What "the truth" is (semantics S1)
//!
//! A plugin is handed numbers: vertex coordinates and, for each object, a 4x4 matrix. The truth is what **those numbers**
//! say, computed as on paper with unlimited precision:
//!
//! * A vertex `v` stands at `M v`, where each entry of `M` and each coordinate of `v` is the exact value of the f64
//!   number given. Nothing is rounded, no matrix is "repaired" into a perfect rotation, and the two poses are never
//!   multiplied together beforehand. So the truth favours no way of computing: not the order of additions, not fused
//!   multiply-add, not one object's frame over the other's.
//! * A triangle is everything between its three corners, edges and corners included (a *closed* set). A triangle without
//!   area is a segment or a point, and counts like any other.
//! * Two objects **collide** when a triangle of one and a triangle of the other share at least one point. Touching is
//!   colliding. One object wholly inside the other, without touching its surface, does *not* collide: a mesh is a skin,
//!   nothing is assumed about its inside.
//! * The **distance** is the smallest length between a point of one and a point of the other; 0 when they collide.
//!
//! A program that computes in f64 or f32 cannot always see this truth, because its own roundings move every point a
//! little. [`Truth`](crate::configuration::Truth) therefore carries, beside the answer, how far the configuration is from
//! changing it: `distance_lo` when apart, `margin` when colliding. Where that is no more than
//! `tau = 32 u S` (`u` is 2^-53 for f64 and 2^-24 for f32; `S` the size of the scene's coordinates, see
//! [`Pair::scene_size`]), the class is `Grazing` and the answer is reported but not scored.
//!
//! # How it is found
//!
//! f64 arithmetic with certified error bounds decides nearly everything ([`closest`], `filter`); what it cannot decide goes
//! to exact integers ([`exact`]). No code is shared with any plugin.

mod closest;
mod exact;
mod exact_vector;
mod rational;
mod triangle;

use std::sync::Arc;

use nalgebra::Point3;

use crate::configuration::{Class, Configuration, Truth, Witness};
use crate::mesh::Mesh;
use exact::ExactPair;
use triangle::Triangle;

/// A mesh made ready for the oracle; built once per object.
#[derive(Debug)]
pub struct Shape {
    mesh: Arc<Mesh>,
    /// Largest absolute coordinate.
    largest: f64,
}

impl Shape {
    /// Builds the hierarchy.
    pub fn new(mesh: Arc<Mesh>) -> Self {
        let largest = mesh.positions().iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
        Self { mesh, largest }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    fn corners(&self, triangle: u32) -> [Point3<f64>; 3] {
        self.mesh.triangles()[triangle as usize].map(|v| self.mesh.positions()[v as usize])
    }
}

/// Two shapes about which the oracle answers.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    a: &'a Shape,
    b: &'a Shape,
}

impl<'a> Pair<'a> {
    /// `a` and `b` may be the same shape.
    pub fn new(a: &'a Shape, b: &'a Shape) -> Self {
        Self { a, b }
    }

    /// Object A.
    pub fn a(&self) -> &'a Shape {
        self.a
    }

    /// Object B.
    pub fn b(&self) -> &'a Shape {
        self.b
    }

    /// S, the size of the scene's coordinates: the largest absolute coordinate of A, plus that of B, plus that of the
    /// translations. Rounding errors of an honest program are a few `u S`.
    pub fn scene_size(&self, configuration: &Configuration) -> f64 {
        let translation = configuration.pose_a.translation.amax().max(configuration.pose_b.translation.amax());
        self.a.largest + self.b.largest + translation
    }

    /// Half-width of the band in which an answer is not scored: `32 u S`.
    pub fn tau(&self, configuration: &Configuration, unit_roundoff: f64) -> f64 {
        32.0 * unit_roundoff * self.scene_size(configuration)
    }

    /// Do the surfaces meet?
    pub fn hit(&self, configuration: &Configuration) -> bool {
        self.all_pairs().any(|pair| self.exact(configuration, pair).hit())
    }

    /// Everything the oracle knows about one configuration.
    pub fn truth(&self, configuration: &Configuration) -> Truth {
        let (mut lo, mut hi, mut witness) = (f64::INFINITY, f64::INFINITY, None);
        for pair in self.all_pairs() {
            let (l, h) = self.exact(configuration, pair).distance();
            lo = lo.min(l);
            if h < hi {
                hi = h;
                witness = Some(pair);
            }
        }
        let [triangle_a, triangle_b] = witness.expect("a mesh has at least one triangle");
        let near = closest::closest(
            &Triangle::mapped(&configuration.pose_a, &self.a.corners(triangle_a), 1.0),
            &Triangle::mapped(&configuration.pose_b, &self.b.corners(triangle_b), 1.0),
        );
        let class = |u: f64| if lo > self.tau(configuration, u) { Class::Clear } else { Class::Grazing };
        Truth {
            hit: hi == 0.0,
            distance_lo: lo,
            distance_hi: hi,
            margin: 0.0,
            class64: class(U64),
            class32: class(U32),
            witness: Witness { point_a: near.point_a.into(), point_b: near.point_b.into(), triangle_a, triangle_b },
            exact_used: true,
        }
    }

    /// All pairs of triangles (A, B) that meet, in ascending order.
    pub fn contacts(&self, configuration: &Configuration) -> Vec<[u32; 2]> {
        self.all_pairs().filter(|&pair| self.exact(configuration, pair).hit()).collect()
    }

    fn exact(&self, configuration: &Configuration, [i, j]: [u32; 2]) -> ExactPair {
        ExactPair::new(&configuration.pose_a, &self.a.corners(i), &configuration.pose_b, &self.b.corners(j))
    }

    fn all_pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        let count = |s: &Shape| s.mesh.triangles().len() as u32;
        let (n, m) = (count(self.a), count(self.b));
        (0..n).flat_map(move |i| (0..m).map(move |j| [i, j]))
    }
}

/// Unit roundoff of f64.
pub const U64: f64 = 1.0 / (1u64 << 53) as f64;
/// Unit roundoff of f32.
pub const U32: f64 = 1.0 / (1u64 << 24) as f64;
