//! Inside or outside a closed surface: the parity of the crossings along a ray, certified.
//!
//! A point off the surface is inside when a ray from it crosses the surface an odd number of times, whichever ray. The
//! ray has an integer direction, so that f64 with error bounds and exact integers speak of the same one: what f64 cannot
//! decide about a triangle, integers do. A ray that runs exactly through an edge says nothing, and the next one is asked.

use nalgebra::{Matrix3, Point3, Vector3};

use super::exact::ExactPair;
use super::filter::certain_crossing;
use super::scene::Scene;
use super::triangle::Triangle;
use super::{Shape, U64};
use crate::bvh::power_of_two_above;
use crate::configuration::Containment;
use crate::numbers::Numbers;
use crate::pose::Pose;

/// Poses further than this from a rotation (largest entry of `M^T M - 1`) are not taken back to the object's frame.
const MOST_DEVIATION: f64 = 1e-6;

/// Is part of one object inside the other? `None` when one of them is not closed. The surfaces must not meet.
pub(super) fn containment(scene: &Scene) -> Option<Containment> {
    let (a, b) = (scene.pair.a, scene.pair.b);
    if !(a.topology.closed && b.topology.closed) {
        return None;
    }
    let (pose_a, pose_b) = (&scene.configuration.pose_a, &scene.configuration.pose_b);
    let b_in_a = enclosed(&Solid::new(scene, a, pose_a), b, pose_b).any(|inside| inside);
    let a_in_b = enclosed(&Solid::new(scene, b, pose_b), a, pose_a).any(|inside| inside);
    Some(match (a_in_b, b_in_a) {
        (false, false) => Containment::Apart,
        (true, false) => Containment::AInB,
        (false, true) => Containment::BInA,
        (true, true) => Containment::Both,
    })
}

/// Of each part of B that hangs together: is it inside A, which is closed? The surfaces must not meet.
pub(super) fn parts_of_b_in_a(scene: &Scene) -> Vec<bool> {
    let solid = Solid::new(scene, scene.pair.a, &scene.configuration.pose_a);
    enclosed(&solid, scene.pair.b, &scene.configuration.pose_b).collect()
}

/// The surfaces do not meet, so one vertex tells where all that hangs together with it is.
fn enclosed<'s>(solid: &'s Solid<'s>, object: &'s Shape, pose: &'s Pose) -> impl Iterator<Item = bool> + 's {
    object.part_vertices().map(move |vertex| solid.encloses(pose, vertex))
}

/// A closed object where a configuration puts it.
pub(super) struct Solid<'s> {
    shape: &'s Shape,
    pose: &'s Pose,
    unit: f64,
    /// Numbers are in a range where f64 says anything.
    sensible: bool,
    /// The pose is a rotation up to rounding, so that its transpose leads back and the hierarchy can be used.
    rigid: bool,
}

impl<'s> Solid<'s> {
    pub(super) fn new(scene: &'s Scene, shape: &'s Shape, pose: &'s Pose) -> Self {
        let deviation = pose.linear.transpose() * pose.linear - Matrix3::identity();
        // Written so that NaN is none.
        let rigid = deviation.iter().all(|x| x.abs() <= MOST_DEVIATION);
        Self { shape, pose, unit: scene.unit, sensible: scene.frame.is_some(), rigid }
    }

    /// Is a vertex of the other object strictly inside? It must not lie on the surface.
    pub(super) fn encloses(&self, pose: &Pose, vertex: &Point3<f64>) -> bool {
        let near = self.near(pose, vertex);
        if near.as_ref().is_some_and(|near| near.certainly_outside(self.shape)) {
            return false;
        }
        directions()
            .find_map(|direction| self.parity(pose, vertex, near.as_ref(), direction))
            .expect("a ray through no edge is found at last")
    }

    /// The distance of a point, given as three equal corners in the scene's unit, from the surface (lower bound).
    pub(super) fn clearance(&self, pose: &Pose, vertex: &Point3<f64>) -> f64 {
        let point = Triangle::mapped(pose, &[*vertex; 3], 1.0 / self.unit);
        let mut least = f64::INFINITY;
        let mut look = |t: u32| {
            least = least.min(super::closest::closest(&point, &self.triangle(t)).lo);
            least * self.unit
        };
        match self.near(pose, vertex) {
            Some(near) => self.shape.tree.around(&near.point, near.slack, f64::INFINITY, look),
            None => self.all().for_each(|t| {
                look(t);
            }),
        }
        least
    }

    fn triangle(&self, t: u32) -> Triangle {
        Triangle::mapped(self.pose, &self.shape.corners(t), 1.0 / self.unit)
    }

    fn all(&self) -> impl Iterator<Item = u32> {
        0..self.shape.triangles().len() as u32
    }

    /// Odd number of crossings along the ray; `None` when it runs through an edge.
    fn parity(&self, pose: &Pose, vertex: &Point3<f64>, near: Option<&Near>, direction: [i32; 3]) -> Option<bool> {
        let filter = self.sensible.then(|| Segment::new(self, pose, vertex, direction));
        let mut inside = Some(false);
        let look = |t: u32| {
            let certain = filter.as_ref().and_then(|s| certain_crossing(&s.start, &s.end, s.error, &self.triangle(t)));
            let crosses = certain.or_else(|| {
                ExactPair::new(pose, &[*vertex; 3], self.pose, &self.shape.corners(t)).ray_crosses(direction)
            });
            inside = inside.zip(crosses).map(|(inside, crosses)| inside ^ crosses);
            inside.is_some()
        };
        match near {
            Some(near) => {
                let way = self.pose.linear.transpose() * direction_vector(direction).normalize();
                let end = near.point + way * (2.0 * near.farthest(self.shape));
                self.shape.tree.along(&near.point, &end, near.slack, look);
            }
            None => {
                let _ = self.all().all(look);
            }
        }
        inside
    }

    /// The point seen from the object; `None` when it cannot be told.
    fn near(&self, pose: &Pose, vertex: &Point3<f64>) -> Option<Near> {
        if !(self.sensible && self.rigid) {
            return None;
        }
        let world = pose.apply(vertex);
        let from = world.coords - self.pose.translation;
        let point = Point3::from(self.pose.linear.transpose() * from);
        // The transpose is the inverse up to the deviation; the rest is what f64 rounds, generously.
        let lengths = from.norm() + self.shape.largest;
        let magnitude = world.coords.amax() + self.pose.translation.amax() + pose.translation.amax() + lengths;
        let slack = 8.0 * MOST_DEVIATION * lengths + 256.0 * U64 * magnitude;
        slack.is_finite().then_some(Near { point, slack })
    }
}

/// A point in the frame of the closed object.
struct Near {
    point: Point3<f64>,
    /// It is off by at most so much.
    slack: f64,
}

impl Near {
    fn certainly_outside(&self, shape: &Shape) -> bool {
        let off = (self.point - shape.topology.centre).abs() - shape.topology.half;
        off.max() > self.slack
    }

    /// No point of the object is further than this.
    fn farthest(&self, shape: &Shape) -> f64 {
        (self.point - shape.topology.centre).norm() + shape.topology.half.norm() * 1.01 + 2.0 * self.slack
    }
}

/// A ray up to a point behind the object, in the scene's unit.
struct Segment {
    start: Vector3<f64>,
    end: Vector3<f64>,
    error: f64,
}

impl Segment {
    fn new(solid: &Solid, pose: &Pose, vertex: &Point3<f64>, direction: [i32; 3]) -> Self {
        let point = Triangle::mapped(pose, &[*vertex; 3], 1.0 / solid.unit);
        let start = point.vertices[0];
        let way = direction_vector(direction);
        let reach = |shape: &Shape, pose: &Pose| {
            let rows: f64 = pose.linear.iter().map(|x| x.abs()).sum();
            2.0 * rows * shape.largest + 2.0 * pose.translation.norm()
        };
        let length = (reach(solid.shape, solid.pose) / solid.unit + 2.0 * start.norm()) / way.norm();
        // A power of two, so that the way is rounded once, when it is added.
        let end = start + way * (2.0 * power_of_two_above(length));
        Self { start, end, error: point.error + 2.0 * U64 * (start.amax() + end.amax()) }
    }
}

fn direction_vector(direction: [i32; 3]) -> Vector3<f64> {
    Vector3::from(direction.map(f64::from))
}

/// Directions without end, none of them special.
fn directions() -> impl Iterator<Item = [i32; 3]> {
    let mut numbers = Numbers::new(0x0cb_5eed);
    std::iter::repeat_with(move || {
        let bits = numbers.bits();
        // Odd numbers of 16 bits: never 0.
        [0, 16, 32].map(|shift| (((bits >> shift) as i32 & 0xffff) - 0x8000) | 1)
    })
}
