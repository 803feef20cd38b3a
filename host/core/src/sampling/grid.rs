//! The grid method: in every rotation B stands at each node of a grid around A and is moved to the wanted separation
//! [Trenkel 2007]. It reaches what no ray from outside does: positions inside concavities, and further roots.
//!
//! At a fixed rotation the distance of the surfaces is the distance of B's translation from a body (all translations in
//! which they meet), so from a free node the way straight toward A's nearest point is the shortest one, and the
//! positions lie on the surface of that body, about one to a cell. A node counts when that way stays in the ball around
//! its cell; nodes that are further away, not free or too near are left to others. Two positions of one rotation that
//! are within a quarter of the spacing are one: that of the node that comes first.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::approach::{ball, bounds};
use super::low_discrepancy::{mix, placement, share};
use super::paper_pattern::{Pattern, Rows, turns};
use super::placer::{Descent, Placer, Target};
use super::{Found, SamplingError};
use crate::configuration::{Configuration, Placed, Sampling, Separation};
use crate::oracle::Shape;
use crate::pose::Pose;

/// No rotation has more nodes than this.
pub(super) const MAX_NODES: u64 = 1 << 20;
/// A position is accepted within this many spacings of its node: half the diagonal of a cell.
const REACH: f64 = 0.866;
/// Rotations tried to find out how many positions one gives.
const PILOT: u64 = 8;
/// Positions of one rotation when a number is wanted: few, so that there are many rotations.
const EACH: f64 = 6.0;
/// Largest arc of the spacing when a number is wanted: concavities are found from nearby.
const WIDEST: f64 = PI / 9.0;
/// So many more than wanted are looked for, because the pilot may be wrong.
const SPARE: f64 = 1.04;

/// The rotations and nodes of the grid method.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    placer: Placer<'a>,
    pattern: Option<Pattern>,
    rotations: u64,
    /// One node of so many is visited in each rotation.
    stride: u64,
    spacing: f64,
    wanted: Option<usize>,
    seed: u64,
    centre_a: Vector3<f64>,
    half_a: Vector3<f64>,
    centre_b: Vector3<f64>,
    half_b: Vector3<f64>,
    largest: f64,
}

impl<'a> Plan<'a> {
    /// The grid's spacing is the arc of move-by on a sphere of both objects' radii (as the sphere method's directions
    /// would have it), the rotations are those of rotate-by. For a number N both angles are the one that would give N
    /// configurations of the sphere method, `(32 pi^3 / N)^(1/5)`, the spacing's at most 20 degrees; every rotation visits
    /// a share of its nodes, drawn anew, and the number of rotations follows from how many positions the first ones give.
    pub(super) fn new(
        a: &'a Shape,
        b: &'a Shape,
        sampling: &Sampling,
        separation: Separation,
        seed: u64,
        stopped: &dyn Fn() -> bool,
    ) -> Result<Self, SamplingError> {
        let placer = Placer::new(a, b, separation)?;
        let largest = a.largest() + b.largest();
        let radius = ball(a).1 + ball(b).1 + placer.most(largest);
        let (rotations, arc) = match *sampling {
            Sampling::Count { count } => {
                let arc = libm::pow(32.0 * PI * PI * PI / f64::from(count), 0.2);
                (PILOT, arc.min(WIDEST))
            }
            Sampling::Steps { rotate, move_by } | Sampling::PaperCompat { rotate, move_by } => {
                (Rows::new(rotate).len() * turns(rotate), move_by.to_radians())
            }
        };
        let box_of = |shape| {
            let (lo, hi) = bounds(shape);
            (nalgebra::center(&lo, &hi).coords, (hi - lo) / 2.0)
        };
        let ((centre_a, half_a), (centre_b, half_b)) = (box_of(a), box_of(b));
        let mut plan = Self {
            placer,
            pattern: match *sampling {
                Sampling::PaperCompat { rotate, move_by } => Some(Pattern::new(rotate, move_by)),
                Sampling::Steps { .. } | Sampling::Count { .. } => None,
            },
            rotations,
            stride: 1,
            spacing: arc * radius,
            wanted: None,
            seed,
            centre_a,
            half_a,
            centre_b,
            half_b,
            largest,
        };
        let nodes = plan.nodes(&Matrix3::identity()).1;
        let nodes = nodes.iter().product::<u64>();
        if nodes > MAX_NODES {
            return Err(SamplingError::TooFine(nodes));
        }
        if let Sampling::Count { count } = *sampling {
            let mut found = 0;
            for rotation in 0..PILOT {
                found += plan.place_unless(rotation, stopped).ok_or(SamplingError::Stopped)?.placed.len();
            }
            let all = (found as f64 / PILOT as f64).max(0.1);
            plan.stride = (all / EACH).round().max(1.0) as u64;
            plan.rotations = (f64::from(count) * plan.stride as f64 / all * SPARE).ceil() as u64;
            plan.wanted = Some(count as usize);
        }
        Ok(plan)
    }

    pub(super) fn rotations(&self) -> u64 {
        self.rotations
    }

    pub(super) fn spacing(&self) -> f64 {
        self.spacing
    }

    /// All positions of one rotation, in the order of their nodes.
    pub(super) fn place(&self, number: u64) -> Found {
        self.place_unless(number, &|| false).unwrap_or_default()
    }

    /// The same; `None` when it was stopped.
    fn place_unless(&self, number: u64, stopped: &dyn Fn() -> bool) -> Option<Found> {
        let (seed, (offset, rotation)) = match &self.pattern {
            Some(pattern) => (0, (Vector3::repeat(0.5), pattern.sample(number).1)),
            None => (self.seed, placement(number, self.seed)),
        };
        let (corner, [nx, ny, nz]) = self.nodes(&rotation);
        let turned_centre = rotation * self.centre_b;
        let near = self.spacing / 4.0;
        let mut kept: Vec<(Target, Descent)> = Vec::new();
        for node in (0..nx * ny * nz).filter(|node| mix(number, *node).is_multiple_of(self.stride)) {
            if stopped() {
                return None;
            }
            let cell = Vector3::new((node % nx) as f64, (node / nx % ny) as f64, (node / nx / ny) as f64);
            let translation = corner + (cell + offset) * self.spacing - turned_centre;
            let start = Configuration { pose_a: Pose::identity(), pose_b: Pose { linear: rotation, translation } };
            let target = Target { index: number + node, place: share(mix(seed, number), node) };
            if let Some(descent) = self.placer.descend(target, &start, REACH * self.spacing) {
                let at = descent.placed.configuration.pose_b.translation;
                let goal = self.placer.goal_number(target);
                let known = kept.iter().any(|(other, d)| {
                    let apart = d.placed.configuration.pose_b.translation - at;
                    self.placer.goal_number(*other) == goal && apart.norm() < near
                });
                if !known {
                    kept.push((target, descent));
                }
            }
        }
        let mut found = Found::default();
        for (target, descent) in kept {
            if stopped() {
                return None;
            }
            let from_centre = descent.placed.configuration.pose_b.translation + turned_centre - self.centre_a;
            match self.placer.arrive(target, &descent, &from_centre, 0.01 * self.spacing) {
                Some(placed) => found.placed.push(placed),
                None => found.missed += 1,
            }
        }
        Some(found)
    }

    /// The corner of the region in which the centre of B's box may be near enough, and the nodes along its sides.
    fn nodes(&self, rotation: &Matrix3<f64>) -> (Vector3<f64>, [u64; 3]) {
        let half_b = rotation.abs() * self.half_b;
        let size = self.largest + self.centre_a.amax() + self.half_a.amax() + half_b.amax() + self.centre_b.amax();
        let margin = self.placer.most(2.0 * size) + REACH * self.spacing;
        let half = self.half_a + half_b + Vector3::repeat(margin);
        let along = |side: f64| (2.0 * side / self.spacing).ceil().max(1.0) as u64;
        (self.centre_a - half, [along(half.x), along(half.y), along(half.z)])
    }

    /// Leaves out so many, evenly, that as many as wanted remain.
    pub(super) fn thin(&self, placed: &mut Vec<Placed>) {
        if let Some(wanted) = self.wanted
            && placed.len() > wanted
        {
            let all = placed.len();
            *placed = (0..wanted).map(|i| placed[(i as u128 * all as u128 / wanted as u128) as usize]).collect();
        }
    }
}
