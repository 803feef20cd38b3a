//! Both trees of spheres at once.

use std::f64::consts::PI;

use ocb_fields::{Ball, BallNode, BallTree};
use ocb_triangles::Frame;
use ocb_triangles::vector::{Vector, add, dot, rotate, sub};
use opencollbench_plugin::{Count, Placed};

use super::InnerSpheres;

/// Two nodes and how far they are apart; negative when they overlap.
pub type Pair = (f64, [u32; 2]);

/// One query.
pub struct Traversal<'a> {
    a: &'a BallTree,
    b: &'a BallTree,
    /// From B's frame to A's.
    rotation: [Vector; 3],
    offset: Vector,
}

impl<'a> Traversal<'a> {
    pub fn new(a: Placed<'a, InnerSpheres>, b: Placed<'a, InnerSpheres>) -> Self {
        let frame = Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation());
        let columns = |m: [Vector; 3]| [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]]);
        let (of_a, of_b) = (columns(frame.rotation_a), columns(frame.rotation_b));
        let rotation = of_a.map(|row| of_b.map(|column| dot(row, column)));
        Self { a: a.object, b: b.object, rotation, offset: rotate(&of_a, frame.offset) }
    }

    /// Is a sphere of A so near to a sphere of B?
    pub fn within(&self, reach: f64, open: &mut Vec<Pair>, work: &mut impl Count) -> bool {
        self.below([reach; 2], open, work) <= reach
    }

    /// How far apart are the spheres of both objects? 0 when some meet.
    pub fn distance(&self, open: &mut Vec<Pair>, work: &mut impl Count) -> f64 {
        self.below([f64::INFINITY, 0.0], open, work).max(0.0)
    }

    /// The smallest gap between two spheres if it is at most `limit`; one that is `enough` is as good as any other.
    fn below(&self, [limit, enough]: [f64; 2], open: &mut Vec<Pair>, work: &mut impl Count) -> f64 {
        let (mut best, mut within) = (f64::INFINITY, limit);
        open.clear();
        open.push((self.gap([0, 0]), [0, 0]));
        work.bv_tests(1);
        while let Some((gap, pair)) = open.pop() {
            if gap > within || gap >= best {
                continue;
            }
            let Some(children) = self.children(pair) else {
                (best, within) = (gap, gap.min(within));
                if best <= enough {
                    break;
                }
                continue;
            };
            work.bv_tests(2);
            let [one, other] = children.map(|pair| (self.gap(pair), pair));
            // The nearer one is opened first: it lies on top.
            open.extend(if one.0 < other.0 { [other, one] } else { [one, other] });
        }
        best
    }

    /// The sum over all pairs of spheres. Those of one object do not overlap, so nothing is counted twice.
    pub fn common_volume(&self, open: &mut Vec<Pair>) -> f64 {
        let mut volume = 0.0;
        open.clear();
        open.push((self.gap([0, 0]), [0, 0]));
        while let Some((gap, pair)) = open.pop() {
            if gap >= 0.0 {
                continue;
            }
            match self.children(pair) {
                Some(children) => open.extend(children.map(|pair| (self.gap(pair), pair))),
                None => volume += common(self.nodes(pair).map(|node| node.ball.radius), gap),
            }
        }
        volume
    }

    #[inline]
    fn nodes(&self, [a, b]: [u32; 2]) -> [&BallNode; 2] {
        [&self.a.nodes[a as usize], &self.b.nodes[b as usize]]
    }

    #[inline]
    fn gap(&self, pair: [u32; 2]) -> f64 {
        let [Ball { center: a, radius }, Ball { center: b, radius: other }] = self.nodes(pair).map(|node| node.ball);
        let between = sub(add(rotate(&self.rotation, b), self.offset), a);
        dot(between, between).sqrt() - radius - other
    }

    /// The pairs below: the larger of the two is opened. None for two spheres.
    #[inline]
    fn children(&self, pair: [u32; 2]) -> Option<[[u32; 2]; 2]> {
        let [a, b] = self.nodes(pair);
        match (a.count > 0, b.count > 0) {
            (true, true) => None,
            (false, other) if other || a.ball.radius >= b.ball.radius => {
                Some([[a.first, pair[1]], [a.first + 1, pair[1]]])
            }
            _ => Some([[pair[0], b.first], [pair[0], b.first + 1]]),
        }
    }
}

/// The volume that two balls of these radii have in common, which overlap by `-gap`.
fn common([r, s]: [f64; 2], gap: f64) -> f64 {
    let (depth, distance, smaller) = (-gap, r + s + gap, r.min(s));
    if depth >= 2.0 * smaller {
        return 4.0 / 3.0 * PI * smaller.powi(3);
    }
    // Two caps, in one formula.
    PI * depth.powi(2) * (distance.powi(2) + 2.0 * distance * (r + s) - 3.0 * (r - s).powi(2)) / (12.0 * distance)
}
