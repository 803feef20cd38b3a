//! The points of one object in the field of the other.

use ocb_fields::BallNode;
use ocb_triangles::Frame;
use ocb_triangles::vector::{Vector, add, dot, rotate};
use opencollbench_plugin::{Count, Placed};

use crate::DistanceField;
use crate::field::{Field, Value};

/// A node of the tree of points, and less than which no point below it has.
pub type Next = (f64, u32);

/// Does a point of `shell` lie inside the object of `field`, or so near that the surfaces may meet?
pub fn meet(
    field: Placed<'_, DistanceField>,
    shell: Placed<'_, DistanceField>,
    open: &mut Vec<Next>,
    work: &mut impl Count,
) -> bool {
    let query = Query::new(field, shell);
    query.least(query.touching, open, work).0 <= query.touching
}

/// The least distance of a point of `shell` from the object of `field`, 0 where they are taken to meet. None when it lies
/// beyond the field.
pub fn distance(
    field: Placed<'_, DistanceField>,
    shell: Placed<'_, DistanceField>,
    open: &mut Vec<Next>,
    work: &mut impl Count,
) -> Option<f64> {
    let query = Query::new(field, shell);
    let (least, beyond) = query.least(f64::INFINITY, open, work);
    if least <= query.touching { Some(0.0) } else { (least <= beyond).then_some(least) }
}

struct Query<'a> {
    field: &'a Field,
    shell: &'a Field,
    rotation: [Vector; 3],
    offset: Vector,
    /// The largest value that counts as touching. Below 0 is inside; the surface of an open object has no sides, and a
    /// point that it passes has the value 0 only in exact fields and where points are.
    touching: f64,
}

impl<'a> Query<'a> {
    fn new(field: Placed<'a, DistanceField>, shell: Placed<'a, DistanceField>) -> Self {
        let (to, from) = (field.pose, shell.pose);
        let frame = Frame::new(to.rotation(), to.translation(), from.rotation(), from.translation());
        let columns = |m: [Vector; 3]| [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]]);
        let (to, from) = (columns(frame.rotation_a), columns(frame.rotation_b));
        let touching = if field.object.closed { 0.0 } else { field.object.error + shell.object.reach };
        Self {
            field: field.object,
            shell: shell.object,
            rotation: to.map(|row| from.map(|column| dot(row, column))),
            offset: rotate(&to, frame.offset),
            touching,
        }
    }

    fn at(&self, point: Vector) -> Value {
        self.field.at(add(rotate(&self.rotation, point), self.offset))
    }

    /// The least value of a point, if it is at most `limit`; and the least of what is known of those beyond the field. Ends
    /// with the first that touches.
    fn least(&self, limit: f64, open: &mut Vec<Next>, work: &mut impl Count) -> (f64, f64) {
        let (mut best, mut beyond) = (f64::INFINITY, f64::INFINITY);
        open.clear();
        open.push((f64::NEG_INFINITY, 0));
        while let Some((bound, at)) = open.pop() {
            if bound > limit || bound >= best.min(beyond) {
                continue;
            }
            let node = &self.shell.points.nodes[at as usize];
            if node.count > 0 {
                let points = &self.shell.points.balls[node.first as usize..(node.first + node.count) as usize];
                work.bv_tests(points.len() as u64);
                for point in points {
                    match self.at(point.center) {
                        Value::Known(value) => best = best.min(value),
                        Value::AtLeast(value) => beyond = beyond.min(value),
                    }
                }
                if best <= self.touching {
                    break;
                }
                continue;
            }
            work.bv_tests(2);
            let [one, other] = [node.first, node.first + 1].map(|child| self.bound(child));
            // The nearer one is opened first: it lies on top.
            open.extend(if one.0 < other.0 { [other, one] } else { [one, other] });
        }
        (best, beyond)
    }

    /// Distances change by no more than the way between two points.
    fn bound(&self, child: u32) -> Next {
        let BallNode { ball, .. } = self.shell.points.nodes[child as usize];
        let (Value::Known(value) | Value::AtLeast(value)) = self.at(ball.center);
        (value - ball.radius, child)
    }
}
