//! One tree asked about a segment or a point.

use nalgebra::{Point3, Vector3};

use super::Tree;
use super::obb::Obb;
use super::wide_node::Slot;

impl Tree {
    /// Visits every triangle whose box comes within `slack` of a segment, until the visitor says stop (`false`).
    /// Lengths and points are the object's own.
    pub(crate) fn along(&self, start: &Point3<f64>, end: &Point3<f64>, slack: f64, mut visit: impl FnMut(u32) -> bool) {
        let (start, end, slack) = (self.local(start), self.local(end), slack / self.unit + ROUNDING);
        let mut stack = vec![self.root()];
        while let Some(slot) = stack.pop() {
            if !touches(&self.boxes[slot.number()].obb, &start, &end, slack) {
                continue;
            }
            match self.triangle(slot) {
                Some(triangle) if !visit(triangle) => return,
                Some(_) => {}
                None => {
                    let below = self.nodes[slot.node()].node(slot.lane());
                    stack.extend((0..self.nodes[below as usize].len()).map(|lane| Slot::new(below, lane)));
                }
            }
        }
    }

    /// Visits the triangles within `reach` of a point, nearer boxes first; what the visitor returns is the reach from
    /// there on. Lengths and the point are the object's own.
    pub(crate) fn around(&self, point: &Point3<f64>, slack: f64, mut reach: f64, mut visit: impl FnMut(u32) -> f64) {
        let (point, slack) = (self.local(point), slack / self.unit + ROUNDING);
        let mut stack = vec![(0.0, self.root())];
        while let Some((bound, slot)) = stack.pop() {
            if bound * self.unit > reach {
                continue;
            }
            if let Some(triangle) = self.triangle(slot) {
                reach = visit(triangle);
                continue;
            }
            let below = self.nodes[slot.node()].node(slot.lane());
            let node = &self.nodes[below as usize];
            let from = stack.len();
            stack.extend((0..node.len()).map(|lane| {
                let child = Slot::new(below, lane);
                (gap(&self.boxes[child.number()].obb, &point) - slack, child)
            }));
            stack[from..].sort_unstable_by(|x, y| y.0.total_cmp(&x.0));
        }
    }

    fn local(&self, point: &Point3<f64>) -> Vector3<f64> {
        (point - self.origin) / self.unit
    }
}

/// Boxes hold f32 numbers below 2; what f64 rounds in computing with them is far less than this.
const ROUNDING: f64 = 1e-12;

fn along_axis(b: &Obb, k: usize, x: &Vector3<f64>) -> f64 {
    (0..3).map(|i| f64::from(b.axes[k][i]) * (x[i] - f64::from(b.centre[i]))).sum()
}

/// May the segment come within `slack` of the box?
fn touches(b: &Obb, start: &Vector3<f64>, end: &Vector3<f64>, slack: f64) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for k in 0..3 {
        let (from, to) = (along_axis(b, k, start), along_axis(b, k, end));
        let half = f64::from(b.half[k]) + slack;
        let way = to - from;
        if way == 0.0 {
            if from.abs() > half {
                return false;
            }
        } else {
            let (one, other) = ((-half - from) / way, (half - from) / way);
            enter = enter.max(one.min(other));
            leave = leave.min(one.max(other));
        }
    }
    // `min` and `max` pass over NaN, so what makes no sense excludes nothing.
    enter <= leave
}

/// A lower bound of the distance of a point from a box whose axes are orthonormal up to f32 rounding.
fn gap(b: &Obb, point: &Vector3<f64>) -> f64 {
    let gaps = [0, 1, 2].map(|k| (along_axis(b, k, point).abs() - f64::from(b.half[k])).max(0.0));
    Vector3::from(gaps).norm() * (1.0 - 1e-6)
}
