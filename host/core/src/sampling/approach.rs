//! Moving B along a ray until it is the wanted distance from A.
//!
//! Not by many distance queries (conservative advancement) but by one search over pairs of boxes, ordered by *the way
//! after which they come within the wanted distance*. For two triangles the distance along the way is a convex function,
//! so Newton's iteration from a lower bound runs to the first root without passing it. The position found is then
//! judged by the oracle like any other; where that does not confirm it, conservative advancement on certified distances
//! decides.

use nalgebra::{Matrix3, Point3, Vector3};

use super::window::Window;
use crate::bvh::{BestFirst, Frame};
use crate::configuration::{Configuration, Placed, Separation, Truth};
use crate::oracle::{Pair, Shape, closest_points};
use crate::pose::Pose;

/// What all rays of a plan share.
#[derive(Clone, Debug)]
pub(super) struct Approach<'a> {
    pair: Pair<'a>,
    centre_a: Point3<f64>,
    centre_b: Point3<f64>,
    /// Distance of the centres at which B starts: the surfaces are then further apart than wanted.
    start: f64,
    window: Window,
}

/// The first position on the ray, and what the search for it proved.
struct Found {
    root: Root,
    /// All pairs of triangles that are not among these are at least `floor` apart everywhere before `way`.
    pairs: Vec<[u32; 2]>,
    floor: f64,
    way: f64,
}

impl Found {
    /// A lower bound of the distance of all other pairs after a way.
    fn beyond(&self, way: f64) -> f64 {
        self.floor - (way - self.way).max(0.0)
    }
}

/// A position on the ray.
#[derive(Clone, Copy)]
struct Root {
    way: f64,
    /// Change of the distance per way there; negative.
    slope: f64,
}

/// One ray: B's rotation, and where it stands after a way.
struct Ray<'r> {
    /// With the place that this ray aims at.
    window: Window,
    direction: &'r Vector3<f64>,
    rotation: &'r Matrix3<f64>,
    /// B's translation at the start.
    from: Vector3<f64>,
    /// The way after which B has left on the other side.
    length: f64,
}

impl Ray<'_> {
    fn configuration(&self, way: f64) -> Configuration {
        let pose_b = Pose { linear: *self.rotation, translation: self.from - self.direction * way };
        Configuration { pose_a: Pose::identity(), pose_b }
    }
}

impl<'a> Approach<'a> {
    pub(super) fn new(a: &'a Shape, b: &'a Shape, separation: Separation) -> Self {
        let (centre_a, radius_a) = ball(a);
        let (centre_b, radius_b) = ball(b);
        let bounds = bounds(a);
        let pair = Pair::new(a, b);
        let window = Window::new(separation, (bounds.1 - bounds.0).amax());
        // A little further than needed, so that even the band of f32 is passed on the way. Steps are shares of S, which
        // grows with the translation: for the largest step, it is less than this at the start.
        let size = 6.0 * (a.largest() + b.largest());
        let start = (radius_a + radius_b) * 1.01 + window.most(size);
        Self { pair, centre_a, centre_b, start, window }
    }

    /// The first position on the ray at this place of the window, certified; `None` when there is none.
    pub(super) fn place(&self, direction: &Vector3<f64>, rotation: &Matrix3<f64>, place: f64) -> Option<Placed> {
        let from = self.centre_a.coords + direction * self.start - rotation * self.centre_b.coords;
        let ray = Ray { window: self.window.at(place), direction, rotation, from, length: 2.0 * self.start };
        let found = self.first_root(&ray)?;
        let mut root = found.root;
        // The matrix is rounded and the wanted distance changes with the way: a correction or two may be needed.
        for _ in 0..4 {
            let configuration = ray.configuration(root.way);
            let truth = self.pair.truth_among(&configuration, &found.pairs, found.beyond(root.way));
            let (wanted, tau) = self.wanted(&ray, &configuration);
            if within(&truth, wanted, tau) {
                return Some(Placed {
                    configuration,
                    truth,
                    rounded: None,
                    root_index: 0,
                    wanted: Some(self.window.separation),
                });
            }
            if truth.distance_lo < wanted - 2.0 * tau {
                break; // another pair is nearer: not the first root after all
            }
            root.way += ((truth.distance_lo + truth.distance_hi) / 2.0 - wanted) / -root.slope;
        }
        self.advance(&ray)
    }

    /// The wanted distance in a configuration, and how far it may be missed.
    fn wanted(&self, ray: &Ray, configuration: &Configuration) -> (f64, f64) {
        ray.window.aim(self.pair.scene_size(configuration))
    }

    /// The smallest way after which some pair of triangles is the wanted distance apart.
    ///
    /// What is not visited was proven to be further apart up to there, so the search is half of the certificate.
    fn first_root(&self, ray: &Ray) -> Option<Found> {
        let (a, b) = (self.pair.a(), self.pair.b());
        let start = ray.configuration(0.0);
        let size = self.pair.scene_size(&start).max(self.start) * 4.0;
        let frame = Frame::new(a.tree(), &start.pose_a, b.tree(), &start.pose_b, size)?;
        // The band grows with the translation, which is longest at an end of the ray.
        let floor = [0.0, ray.length].map(|way| {
            let (wanted, tau) = self.wanted(ray, &ray.configuration(way));
            wanted + 0.01 * tau
        });
        let floor = floor[0].max(floor[1]);
        let aim = frame.aim(&start.pose_a, &start.pose_b, &-ray.direction, floor / frame.unit);
        let mut pairs = Vec::new();
        let mut queue = BestFirst::default();
        let (root_a, root_b) = frame.roots();
        queue.push(0.0, root_a, root_b);
        let mut best: Option<Root> = None;
        let mut limit = ray.length / frame.unit;
        // Any root bounds the first one: the sooner one is known, the fewer boxes wait in the queue.
        if let Some((bound, pair)) = frame.nearby_along(&aim)
            && let Some(root) = self.root_of_pair(ray, pair, f64::from(bound) * frame.unit, ray.length)
        {
            limit = root.way / frame.unit;
            best = Some(root);
            pairs.push(pair);
        }
        while let Some((bound, slot_a, slot_b)) = queue.pop() {
            if f64::from(bound) >= limit {
                break;
            }
            if let Some(pair) = frame.triangles(slot_a, slot_b) {
                pairs.push(pair);
                let found = self.root_of_pair(ray, pair, f64::from(bound) * frame.unit, limit * frame.unit);
                if let Some(root) = found {
                    limit = root.way / frame.unit;
                    best = Some(root);
                }
                continue;
            }
            frame.expand_along(&aim, slot_a, slot_b, |a, b, enter| {
                if f64::from(enter) < limit {
                    queue.push(enter.max(bound), a, b);
                }
            });
        }
        let root = best?;
        Some(Found { root, pairs, floor, way: root.way })
    }

    /// Where two triangles are first the wanted distance apart, after `from` and before `limit`.
    fn root_of_pair(&self, ray: &Ray, [i, j]: [u32; 2], from: f64, limit: f64) -> Option<Root> {
        let triangle_a = self.pair.a().corners(i);
        let origin = triangle_a[0];
        let a = triangle_a.map(|p| p - origin);
        let at_start = Pose { linear: *ray.rotation, translation: ray.from - origin.coords };
        let b = self.pair.b().corners(j).map(|p| at_start.apply(&p).coords);
        let mut way = from;
        for _ in 0..60 {
            let moved = b.map(|v| v - ray.direction * way);
            let (pa, pb) = closest_points(&a, &moved);
            let between = pb - pa;
            let distance = between.norm();
            let (wanted, tau) = self.wanted(ray, &ray.configuration(way));
            let excess = distance - wanted;
            // B moves against the direction.
            let slope = -between.dot(ray.direction) / distance;
            if excess.abs() <= 1e-7 * tau {
                return (slope < 0.0).then_some(Root { way, slope });
            }
            if slope.is_nan() || slope >= -1e-9 {
                return None; // it never comes nearer than this
            }
            way -= excess / slope;
            if way >= limit {
                return None;
            }
        }
        None
    }

    /// Conservative advancement: as far as the certified distance allows, again and again.
    fn advance(&self, ray: &Ray) -> Option<Placed> {
        let mut way = 0.0;
        let mut near = None;
        for _ in 0..2_000 {
            let configuration = ray.configuration(way);
            let truth = self.pair.truth_near(&configuration, near);
            let (wanted, tau) = self.wanted(ray, &configuration);
            if within(&truth, wanted, tau) {
                return Some(Placed {
                    configuration,
                    truth,
                    rounded: None,
                    root_index: 0,
                    wanted: Some(self.window.separation),
                });
            }
            way += truth.distance_lo - wanted;
            if truth.hit || way > ray.length {
                return None;
            }
            near = Some([truth.witness.triangle_a, truth.witness.triangle_b]);
        }
        None
    }
}

/// Is the whole certified interval within `(wanted - tau, wanted + tau]`?
pub(super) fn within(truth: &Truth, wanted: f64, tau: f64) -> bool {
    truth.distance_lo > wanted - tau && truth.distance_hi <= wanted + tau
}

pub(super) fn bounds(shape: &Shape) -> (Point3<f64>, Point3<f64>) {
    let first = shape.corners(0)[0];
    let used = shape.triangles().iter().flatten().map(|&v| shape.positions()[v as usize]);
    used.fold((first, first), |(lo, hi), p| (lo.inf(&p), hi.sup(&p)))
}

/// Centre of the bounding box and the largest distance of a vertex from it.
pub(super) fn ball(shape: &Shape) -> (Point3<f64>, f64) {
    let (lo, hi) = bounds(shape);
    let centre = nalgebra::center(&lo, &hi);
    let used = shape.triangles().iter().flatten().map(|&v| shape.positions()[v as usize]);
    (centre, used.map(|p| (p - centre).norm()).fold(0.0, f64::max))
}
