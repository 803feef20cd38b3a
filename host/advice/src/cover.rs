//! Covering a triangle by neighbourhoods of a mesh's triangles: branch and bound over pieces of it.
//!
//! For a piece (a triangle with corners `v`) and *one* triangle `S`, the distance to `S` is a convex function, so no point
//! of the piece is further from `S` than its farthest corner: the piece lies within `max over v of d(v, S)` of `S`. A piece
//! for which that is too much is cut into four, along the middles of its sides.
//!
//! # Rounding
//!
//! `u` is 2^-53 and `K` the largest absolute coordinate of both meshes. [`Rounding::up`] makes of a computed number one
//! that is certainly not less than the true distance of any point of the true piece:
//!
//! * The middle of two corners is rounded, by at most `u K` in a coordinate, so the true corners of a piece after `n` cuts
//!   are at most `sqrt(3) n u K` from the computed ones (a middle of two errors is no larger than the larger one). A true
//!   point is a convex combination of true corners; the same combination of computed ones is as near, and convexity
//!   speaks of that. With `n <= 20` ([`DEEPEST`]): below `35 u K`.
//! * The nearest point in `S` is computed as weights in [0, 1] of sum at most 1 times edges, so an exact point of `S`
//!   belongs to those weights whatever the rounding that found them; the differences `p - a`, `b - a`, `c - a` (at most
//!   `2 K` each) and the combination of them are rounded by at most `u` times their size each, together below
//!   `16 u K` per coordinate, below `28 u K` in length.
//! * The squares, their sum and the root are rounded by a factor of at most `1 + 4 u`; a square below the normal range
//!   (2^-1022) is lost, which makes a length wrong by less than 2^-510, below 1e-153.
//!
//! So `(1 + 8 u) d + 64 u K + 1e-150` is enough, and the additions in it are rounded by less than what the `1 + 8 u` and
//! `64` have left over.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::{Point3, center};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::U64;

use crate::target::Target;

/// So often a piece is cut at most: a millionth of the triangle's sides.
const DEEPEST: u32 = 20;

/// What roundings may add to computed lengths.
#[derive(Clone, Copy)]
pub(crate) struct Rounding(f64);

impl Rounding {
    pub(crate) fn of(meshes: [&Mesh; 2]) -> Self {
        let largest = |m: &Mesh| m.positions().iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
        Self(64.0 * U64 * largest(meshes[0]).max(largest(meshes[1])) + 1e-150)
    }

    /// Not less than the true length, see the module.
    pub(crate) fn up(self, computed: f64) -> f64 {
        computed * (1.0 + 8.0 * U64) + self.0
    }
}

/// How tight a cover shall be.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// Lengths below this are never made smaller.
    pub(crate) enough: f64,
    /// Nor those at most so many times what a point of the triangle was found to need.
    pub(crate) factor: f64,
    /// And so many cuts are the most.
    pub(crate) cuts: u32,
}

struct Piece {
    corners: [Point3<f64>; 3],
    depth: u32,
    place: usize,
    excess: f64,
}

/// Covers a triangle by the target's; `owner(triangle, length)` is told for each piece in whose neighbourhood it lies and
/// how wide that must be, as computed.
pub(crate) fn cover(target: &Target, corners: [Point3<f64>; 3], effort: Effort, mut owner: impl FnMut(u32, f64)) {
    let piece = |corners: [Point3<f64>; 3], depth: u32, hint: usize| {
        let best = target.best(&corners, hint);
        Piece { corners, depth, place: best.place, excess: best.excess }
    };
    let first = piece(corners, 0, 0);
    let needed = |p: &Point3<f64>, hint: usize| target.best(std::slice::from_ref(p), hint).excess;
    let mut least = corners.iter().map(|p| needed(p, first.place)).fold(0.0, f64::max);
    let mut pieces = BinaryHeap::from([first]);
    for _ in 0..effort.cuts {
        let Some(worst) = pieces.peek() else { break };
        if worst.excess <= effort.enough.max(effort.factor * least) || worst.depth == DEEPEST {
            break;
        }
        let Some(Piece { corners, depth, place, .. }) = pieces.pop() else { break };
        let (middles, four) = quarters(&corners);
        least = middles.iter().map(|p| needed(p, place)).fold(least, f64::max);
        pieces.extend(four.map(|corners| piece(corners, depth + 1, place)));
    }
    pieces.into_iter().for_each(|p| owner(target.id(p.place), p.excess));
}

/// Is every point of a triangle within the allowance of one of the target's, or within `spare` of any? Where that cannot
/// be shown: a corner that is beyond all of them, or of the smallest piece that remained.
pub(crate) fn is_covered(
    target: &Target,
    corners: [Point3<f64>; 3],
    spare: f64,
    rounding: Rounding,
) -> Result<(), Point3<f64>> {
    let within = |points: &[Point3<f64>], place: usize| {
        rounding.up(target.farthest(points, place)) <= target.allowance(place).max(spare)
    };
    let mut pieces = vec![(corners, 0, 0)];
    while let Some((corners, depth, hint)) = pieces.pop() {
        let best = target.best(&corners, hint);
        if within(&corners, best.place) {
            continue;
        }
        let beyond = |p: &&Point3<f64>| {
            let point = std::slice::from_ref(*p);
            !within(point, target.best(point, best.place).place)
        };
        if let Some(corner) = corners.iter().find(beyond) {
            return Err(*corner);
        }
        if depth == DEEPEST {
            return Err(corners[0]);
        }
        pieces.extend(quarters(&corners).1.map(|corners| (corners, depth + 1, best.place)));
    }
    Ok(())
}

/// The middles of the sides, and the four similar triangles between them and the corners.
fn quarters([a, b, c]: &[Point3<f64>; 3]) -> ([Point3<f64>; 3], [[Point3<f64>; 3]; 4]) {
    let (ab, bc, ca) = (center(a, b), center(b, c), center(c, a));
    ([ab, bc, ca], [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]])
}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> Ordering {
        self.excess.total_cmp(&other.excess)
    }
}

impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Piece {}
