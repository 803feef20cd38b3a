//! A mesh as something to be near: which of its triangles covers a small piece of surface best.

use nalgebra::{Point3, Vector3};
use ocb_core::mesh::Mesh;

/// Triangles in one leaf.
const LEAF: usize = 4;

/// Triangles under a tree of boxes, each with an allowance: how far from it counts as near.
pub(crate) struct Target {
    corners: Vec<[Point3<f64>; 3]>,
    ids: Vec<u32>,
    allowance: Vec<f64>,
    nodes: Vec<Node>,
}

struct Node {
    min: Point3<f64>,
    max: Point3<f64>,
    /// The largest allowance below.
    allowance: f64,
    /// Triangles `first..last`; the children of an inner node are the next one and `right`.
    first: u32,
    last: u32,
    right: u32,
}

/// A triangle, and how far the farthest corner of a piece lies beyond its allowance, as f64 computes it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Best {
    pub(crate) place: usize,
    pub(crate) excess: f64,
}

impl Target {
    /// `allowance` is one length per triangle, or nothing for none.
    pub(crate) fn new(mesh: &Mesh, allowance: &[f64]) -> Self {
        let mut ids: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        let centroids: Vec<Point3<f64>> = ids.iter().map(|&t| centroid(&mesh.corners(t))).collect();
        let mut target = Self { corners: Vec::new(), ids: Vec::new(), allowance: Vec::new(), nodes: Vec::new() };
        let of = |t: u32| allowance.get(t as usize).copied().unwrap_or(0.0);
        target.build(mesh, &centroids, &of, &mut ids);
        target
    }

    fn build(&mut self, mesh: &Mesh, centroids: &[Point3<f64>], of: &impl Fn(u32) -> f64, ids: &mut [u32]) {
        let points = || ids.iter().flat_map(|&t| mesh.corners(t));
        let (min, max) = extent(points());
        let allowance = ids.iter().map(|&t| of(t)).fold(0.0, f64::max);
        let first = self.corners.len() as u32;
        let number = self.nodes.len();
        self.nodes.push(Node { min, max, allowance, first, last: first, right: 0 });
        if ids.len() <= LEAF {
            for &t in ids.iter() {
                self.corners.push(mesh.corners(t));
                self.ids.push(t);
                self.allowance.push(of(t));
            }
            self.nodes[number].last = self.corners.len() as u32;
            return;
        }
        let (low, high) = extent(ids.iter().map(|&t| centroids[t as usize]));
        let axis = (high - low).imax();
        let middle = ids.len() / 2;
        // Equal places are ordered by number, so that the tree does not depend on how the selection works.
        ids.select_nth_unstable_by(middle, |&s, &t| {
            centroids[s as usize][axis].total_cmp(&centroids[t as usize][axis]).then(s.cmp(&t))
        });
        let (left, right) = ids.split_at_mut(middle);
        self.build(mesh, centroids, of, left);
        self.nodes[number].right = self.nodes.len() as u32;
        self.build(mesh, centroids, of, right);
    }

    /// The number in its mesh of the triangle at a place.
    pub(crate) fn id(&self, place: usize) -> u32 {
        self.ids[place]
    }

    /// How far from the triangle at a place counts as near.
    pub(crate) fn allowance(&self, place: usize) -> f64 {
        self.allowance[place]
    }

    /// How far the farthest of some points is from the triangle at a place.
    pub(crate) fn farthest(&self, points: &[Point3<f64>], place: usize) -> f64 {
        points.iter().map(|p| squared_distance(p, &self.corners[place])).fold(0.0, f64::max).sqrt()
    }

    fn excess(&self, points: &[Point3<f64>], place: usize) -> f64 {
        self.farthest(points, place) - self.allowance[place]
    }

    /// The triangle beyond which the farthest of some points lies least; `hint` is believed to be a good one.
    pub(crate) fn best(&self, points: &[Point3<f64>], hint: usize) -> Best {
        let mut best = Best { place: hint, excess: self.excess(points, hint) };
        let mut waiting = [(0u32, 0.0f64); 64];
        waiting[0] = (0, self.bound(0, points));
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (number, bound) = waiting[count];
            if bound >= best.excess {
                continue;
            }
            let node = &self.nodes[number as usize];
            if node.right == 0 {
                for place in node.first as usize..node.last as usize {
                    let excess = self.excess(points, place);
                    if excess < best.excess {
                        best = Best { place, excess };
                    }
                }
                continue;
            }
            let (left, right) = (number + 1, node.right);
            let (x, y) = ((left, self.bound(left, points)), (right, self.bound(right, points)));
            // The nearer one is looked at first. A tree that halves is never deeper than 32.
            let (far, near) = if x.1 <= y.1 { (y, x) } else { (x, y) };
            waiting[count] = far;
            waiting[count + 1] = near;
            count += 2;
        }
        best
    }

    /// No triangle below a node is exceeded by less, up to rounding: this only steers, so rounding can cost a better
    /// triangle and never makes a length wrong.
    fn bound(&self, number: u32, points: &[Point3<f64>]) -> f64 {
        let node = &self.nodes[number as usize];
        let farthest = points.iter().map(|p| {
            let out = (node.min - p).sup(&(p - node.max)).sup(&Vector3::zeros());
            out.norm_squared()
        });
        farthest.fold(0.0, f64::max).sqrt() - node.allowance
    }
}

fn centroid([a, b, c]: &[Point3<f64>; 3]) -> Point3<f64> {
    Point3::from((a.coords + b.coords + c.coords) / 3.0)
}

fn extent(points: impl Iterator<Item = Point3<f64>>) -> (Point3<f64>, Point3<f64>) {
    let none = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let (min, max) = points.fold(none, |(lo, hi), p| (lo.inf(&p.coords), hi.sup(&p.coords)));
    (min.into(), max.into())
}

/// Squared length from a point to a point of a triangle that is the nearest one up to rounding, and a convex combination
/// of the corners whatever the rounding (regions as in Ericson, Real-Time Collision Detection, 5.1.5).
fn squared_distance(p: &Point3<f64>, [a, b, c]: &[Point3<f64>; 3]) -> f64 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return ap.norm_squared();
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return bp.norm_squared();
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return cp.norm_squared();
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (ap - ab * share(d1, d1 - d3)).norm_squared();
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (ap - ac * share(d2, d2 - d6)).norm_squared();
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return (bp - (c - b) * share(d4 - d3, (d4 - d3) + (d5 - d6))).norm_squared();
    }
    let sum = va + vb + vc;
    let v = share(vb, sum);
    let w = share(vc, sum).min(1.0 - v);
    (ap - ab * v - ac * w).norm_squared()
}

/// A quotient in [0, 1], whatever its parts.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { (part / whole).clamp(0.0, 1.0) } else { 0.0 }
}
