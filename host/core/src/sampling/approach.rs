//! Moving B along a ray until it is the wanted distance from A.
//!
//! Not by many distance queries (conservative advancement) but by one search over pairs of boxes ordered by *the way after
//! which they come within the wanted distance*. For two triangles, the distance along the way is a convex function, so
//! Newton's iteration from a lower bound runs to its first root without passing it. The position found is then judged
//! by the oracle like any other; where that does not confirm it, conservative advancement on certified distances
//! decides.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::{Matrix3, Point3, Vector3};

use crate::bvh::{BestFirst, Frame};
use crate::configuration::{Configuration, Placed, Truth};
use crate::oracle::{Pair, Shape, U32, closest_points};
use crate::pose::Pose;

/// What all rays of a plan share.
#[derive(Clone, Debug)]
pub(super) struct Approach<'a> {
    pair: Pair<'a>,
    centre_a: Point3<f64>,
    centre_b: Point3<f64>,
    /// Distance of the centres at which B starts; the surfaces are then further apart than the target.
    start: f64,
    /// The wanted distance; `None` for relative distance 0, whose target depends on the precision band.
    target: Option<f64>,
}
