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
//!   nothing is assumed about its inside. For meshes that are closed, whether a part of one lies inside the other is
//!   answered apart ([`Truth::containment`]); a scene may ask for solid bodies
//!   ([`Semantics::Solid`](crate::query::Semantics)), and then it counts as colliding.
//! * The **distance** is the smallest length between a point of one and a point of the other; 0 when they collide.
//!
//! A program that computes in f64 or f32 cannot always see this truth, because its own roundings move every point a
//! little. [`Truth`] therefore carries, beside the answer, how far the configuration is from
//! changing it: `distance_lo` when apart, `margin` when colliding. Where that is no more than
//! `tau = 32 u S` (`u` is 2^-53 for f64 and 2^-24 for f32; `S` the size of the scene's coordinates, see
//! [`Pair::scene_size`]), the class is `Grazing` and the answer is reported but not scored.
//!
//! # How it is found
//!
//! f64 arithmetic with certified error bounds decides nearly everything (`closest`, `filter`); what it cannot decide goes
//! to exact integers (`exact`). No code is shared with any plugin.

mod claims;
mod closest;
mod contacts;
mod exact;
mod exact_margin;
mod exact_ray;
mod exact_vector;
pub(crate) mod filter;
mod inside;
mod margin;
mod nearest;
mod rational;
pub(crate) mod scene;
mod straddle;
#[cfg(test)]
mod tests;
mod topology;
pub(crate) mod triangle;

use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use crate::bvh::Tree;
use crate::configuration::{Class, Configuration, Containment, Truth, Witness};
use crate::mesh::Mesh;
use crate::query::Semantics;
pub use claims::Side;
pub(crate) use closest::{closest, closest_points};
use nearest::{Effort, Nearest};
use scene::Scene;
use topology::Topology;

/// Changes whenever an answer does: another truth, another witness, a narrower interval.
pub const VERSION: u32 = 4;

/// Unit roundoff of f64.
pub const U64: f64 = 1.0 / (1u64 << 53) as f64;
/// Unit roundoff of f32.
pub const U32: f64 = 1.0 / (1u64 << 24) as f64;

/// Largest absolute coordinate of a vertex.
pub fn largest_coordinate(positions: &[Point3<f64>]) -> f64 {
    positions.iter().map(|p| p.coords.amax()).fold(0.0, f64::max)
}

/// [`Pair::scene_size`] for two objects of which only the largest coordinates are known.
pub fn scene_size(largest: [f64; 2], configuration: &Configuration) -> f64 {
    let translation = configuration.pose_a.translation.amax().max(configuration.pose_b.translation.amax());
    largest[0] + largest[1] + translation
}

/// Triangles made ready for the oracle; built once per object.
#[derive(Clone, Debug)]
pub struct Shape {
    soup: Soup,
    tree: Tree,
    topology: Topology,
    /// Largest absolute coordinate.
    largest: f64,
}

/// A mesh, or triangles that need not be one.
#[derive(Clone, Debug)]
enum Soup {
    Mesh(Arc<Mesh>),
    Loose { positions: Vec<Point3<f64>>, triangles: Vec<[u32; 3]> },
}

impl Shape {
    /// Builds the hierarchy over a mesh.
    pub fn new(mesh: Arc<Mesh>) -> Self {
        Self::of(Soup::Mesh(mesh))
    }

    /// Builds the hierarchy over single triangles, which may all be without area (no [`Mesh`] is).
    ///
    /// # Panics
    /// When there is none, or a coordinate is not finite.
    pub fn from_triangles(triangles: &[[Point3<f64>; 3]]) -> Self {
        assert!(!triangles.is_empty(), "a shape needs a triangle");
        let positions: Vec<Point3<f64>> = triangles.iter().flatten().copied().collect();
        assert!(positions.iter().all(|p| p.iter().all(|x| x.is_finite())), "coordinates must be finite");
        let triangles = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        Self::of(Soup::Loose { positions, triangles })
    }

    fn of(soup: Soup) -> Self {
        let (positions, triangles) = soup.parts();
        let largest = largest_coordinate(positions);
        let tree = Tree::new(positions, triangles);
        let topology = Topology::new(positions, triangles);
        Self { soup, tree, topology, largest }
    }

    /// Vertex coordinates.
    pub fn positions(&self) -> &[Point3<f64>] {
        self.soup.parts().0
    }

    /// Vertex indices per triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.soup.parts().1
    }

    /// Largest absolute coordinate.
    pub(crate) fn largest(&self) -> f64 {
        self.largest
    }

    /// Does it enclose a volume? Every edge belongs to an even number of triangles; corners with the same coordinates are
    /// one vertex. Only of closed objects it can be said what lies inside.
    pub fn is_closed(&self) -> bool {
        self.topology.closed
    }

    /// A vertex of each part that hangs together. Corners with the same coordinates are one vertex.
    pub fn part_vertices(&self) -> impl Iterator<Item = &Point3<f64>> {
        self.topology.components.iter().map(|part| &self.positions()[part[0] as usize])
    }

    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    pub(crate) fn corners(&self, triangle: u32) -> [Point3<f64>; 3] {
        self.triangles()[triangle as usize].map(|v| self.positions()[v as usize])
    }
}

impl Soup {
    fn parts(&self) -> (&[Point3<f64>], &[[u32; 3]]) {
        match self {
            Soup::Mesh(mesh) => (mesh.positions(), mesh.triangles()),
            Soup::Loose { positions, triangles } => (positions, triangles),
        }
    }
}

/// A meeting pair of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Triangle of A, triangle of B.
    pub pair: [u32; 2],
    /// Every vertex may move so far and the two still cross (certified lower bound); 0 when they only touch.
    pub margin: f64,
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
        scene_size([self.a.largest, self.b.largest], configuration)
    }

    /// Half-width of the band in which an answer is not scored: `32 u S`, plus [`Pose::bend`](crate::pose::Pose::bend) times S
    /// where a linear part is slightly off a rotation.
    pub fn tau(&self, configuration: &Configuration, unit_roundoff: f64) -> f64 {
        let bend = configuration.pose_a.bend().max(configuration.pose_b.bend());
        (32.0 * unit_roundoff + bend) * self.scene_size(configuration)
    }

    /// Do the surfaces meet?
    pub fn hit(&self, configuration: &Configuration) -> bool {
        Scene::with(self, configuration, |scene| {
            let mut hit = false;
            contacts::each(scene, |_, _, _, _| {
                hit = true;
                false
            });
            hit
        })
    }

    /// All pairs of triangles (A, B) that meet, in ascending order.
    pub fn contacts(&self, configuration: &Configuration) -> Vec<[u32; 2]> {
        let mut pairs = Vec::new();
        Scene::with(self, configuration, |scene| {
            contacts::each(scene, |pair, _, _, _| {
                pairs.push(pair);
                true
            });
        });
        pairs.sort_unstable();
        pairs
    }

    /// Largest number of contacts that a correct program may count: the pairs of triangles within this distance.
    pub fn most_contacts(&self, configuration: &Configuration, tau: f64) -> u64 {
        Scene::with(self, configuration, |scene| contacts::count_within(scene, tau / scene.unit))
    }

    /// Everything the oracle knows about one configuration; the interval is some ten `u S` wide.
    pub fn truth(&self, configuration: &Configuration) -> Truth {
        self.truth_near(configuration, None)
    }

    /// The same where anything is near; `None` when the objects are certainly further apart than the band of single
    /// precision, of whose distance nothing more is asked. Cheaper than the distance of objects far apart.
    pub fn truth_unless_clear(&self, configuration: &Configuration) -> Option<Truth> {
        Scene::with(self, configuration, |scene| {
            let near = contacts::within(scene, self.tau(configuration, U32) / scene.unit)?;
            Some(self.describe(scene, nearest::nearest(scene, Some(near), Effort::Enough), Effort::Enough))
        })
    }

    /// Is part of one object inside the other? `None` when one of them is not closed. The surfaces must not meet.
    pub fn containment(&self, configuration: &Configuration) -> Option<Containment> {
        Scene::with(self, configuration, inside::containment)
    }

    /// Of each part of B that hangs together ([`Shape::part_vertices`]): is it inside A? `None` when A is not closed; B need not be.
    /// The surfaces must not meet.
    pub fn parts_of_b_in_a(&self, configuration: &Configuration) -> Option<Vec<bool>> {
        self.a.is_closed().then(|| Scene::with(self, configuration, inside::parts_of_b_in_a))
    }

    /// [`Pair::truth`], when a pair of triangles is known to be near.
    pub(crate) fn truth_near(&self, configuration: &Configuration, start: Option<[u32; 2]>) -> Truth {
        self.truth_with(configuration, start, Effort::Enough)
    }

    /// The same from few pairs of triangles (at least one), when all others are known to be at least `beyond` apart.
    pub(crate) fn truth_among(&self, configuration: &Configuration, pairs: &[[u32; 2]], beyond: f64) -> Truth {
        Scene::with(self, configuration, |scene| {
            self.describe(scene, nearest::nearest_among(scene, pairs, beyond / scene.unit), Effort::Enough)
        })
    }

    /// As [`Pair::truth`], always by exact arithmetic: the distance between neighbouring f64 numbers, and the margin of
    /// the best crossing pair rounded down to one.
    pub fn tightest_truth(&self, configuration: &Configuration) -> Truth {
        self.truth_with(configuration, None, Effort::Tightest)
    }

    fn truth_with(&self, configuration: &Configuration, start: Option<[u32; 2]>, effort: Effort) -> Truth {
        Scene::with(self, configuration, |scene| self.describe(scene, nearest::nearest(scene, start, effort), effort))
    }

    /// The truth of what a scene asks. For solid bodies one of which is inside the other, the surfaces may be far apart
    /// and still the answer is a collision at distance 0, which holds until the surfaces meet: that is its margin.
    pub fn asked(&self, configuration: &Configuration, truth: &Truth, semantics: Semantics) -> Truth {
        if !truth.is_inside(semantics) {
            return *truth;
        }
        // Every vertex may move, those of either surface by half the way between them.
        let margin = truth.distance_lo / 2.0;
        let class = |unit_roundoff: f64| {
            if margin > self.tau(configuration, unit_roundoff) { Class::Colliding } else { Class::Grazing }
        };
        let (class64, class32) = (class(U64), class(U32));
        Truth { hit: true, distance_lo: 0.0, distance_hi: 0.0, margin, class64, class32, ..*truth }
    }

    fn describe(&self, scene: &Scene, found: Nearest, effort: Effort) -> Truth {
        let (witness, margin, exact_used) = if found.hit {
            deepest_crossing(scene, &found, effort)
        } else {
            let (a, b) = scene.triangles(found.pair);
            let near = closest::closest(&a, &b);
            (witness(scene, found.pair, near.point_a, near.point_b), 0.0, found.exact_used)
        };
        let (lo, hi) = (found.lo * scene.unit, found.hi * scene.unit);
        let class = |unit_roundoff: f64| {
            let tau = self.tau(scene.configuration, unit_roundoff);
            if !found.hit && lo > tau {
                Class::Clear
            } else if found.hit && margin > tau {
                Class::Colliding
            } else {
                Class::Grazing
            }
        };
        Truth {
            hit: found.hit,
            distance_lo: lo,
            distance_hi: hi,
            margin,
            class64: class(U64),
            class32: class(U32),
            containment: if found.hit { None } else { inside::containment(scene) },
            witness,
            exact_used,
        }
    }
}

/// Meeting pairs whose corners the second bound of the margin looks at.
const REMEMBERED: usize = 16;

/// The meeting pair with the largest margin, that margin, and whether any contact needed exact arithmetic.
fn deepest_crossing(scene: &Scene, found: &Nearest, effort: Effort) -> (Witness, f64, bool) {
    // Margins in the objects' lengths.
    let mut best: (f64, [u32; 2], Option<Vector3<f64>>) = (0.0, found.pair, None);
    let mut exact_used = found.exact_used;
    let mut some = Vec::new();
    contacts::each(scene, |pair, a, b, exact| {
        exact_used |= exact;
        let crossing = margin::crossing(a, b);
        let margin = match effort {
            Effort::Enough => crossing.map_or(0.0, |c| c.margin * scene.unit),
            Effort::Tightest => scene.exact(pair).margin(),
        };
        // Equal margins: the first pair in order, so that the answer does not depend on the hierarchy.
        if margin > best.0 || (margin == best.0 && pair < best.1) {
            best = (margin, pair, crossing.map(|c| c.point));
        }
        if some.len() < REMEMBERED {
            some.push(pair);
        }
        true
    });
    let (mut margin, pair, point) = best;
    // Where no pair of triangles crosses robustly, the meshes still may.
    if margin <= scene.pair.tau(scene.configuration, U32) {
        margin = margin.max(straddle::margin(scene, &some) * scene.unit);
    }
    let point = point.unwrap_or_else(|| {
        let (a, b) = scene.triangles(pair);
        let near = closest::closest(&a, &b);
        (near.point_a + near.point_b) / 2.0
    });
    (witness(scene, pair, point, point), margin, exact_used || effort == Effort::Tightest)
}

fn witness(scene: &Scene, [triangle_a, triangle_b]: [u32; 2], a: Vector3<f64>, b: Vector3<f64>) -> Witness {
    Witness { point_a: (a * scene.unit).into(), point_b: (b * scene.unit).into(), triangle_a, triangle_b }
}
