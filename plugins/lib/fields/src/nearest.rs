//! How far is a point from a surface? A hierarchy of boxes over the triangles.

use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add_scaled, cross, dot, sub};
use opencollbench_plugin::Mesh;

use crate::Bounds;

/// Triangles in a leaf.
const LEAF: usize = 4;

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// Leaf: its first triangle. Inner node: its first child; the second one follows it.
    first: u32,
    /// Leaf: how many triangles. Inner node: 0.
    count: u32,
}

/// A surface that can be asked for its distance from a point.
#[derive(Debug)]
pub struct Nearest {
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
}

impl Nearest {
    /// Builds the hierarchy by halving the triangles along the longest side of their box.
    pub fn new(mesh: &Mesh<'_>) -> Self {
        let mut triangles: Vec<Triangle> = (0..mesh.triangles.len()).map(|i| mesh.corners(i)).collect();
        let root = Node { bounds: Bounds::NONE, first: 0, count: triangles.len() as u32 };
        let (mut nodes, mut open) = (vec![root], vec![0]);
        while let Some(at) = open.pop() {
            let (first, count) = (nodes[at].first as usize, nodes[at].count as usize);
            let here = &mut triangles[first..first + count];
            let bounds = here.iter().flatten().fold(Bounds::NONE, |all, &p| all.with(p));
            nodes[at].bounds = bounds;
            if count <= LEAF {
                continue;
            }
            let axis = bounds.longest_axis();
            let middle = |t: &Triangle| t[0][axis] + t[1][axis] + t[2][axis];
            here.select_nth_unstable_by(count / 2, |a, b| middle(a).total_cmp(&middle(b)));
            let child = nodes.len();
            let half = |first: usize, count: usize| Node { bounds, first: first as u32, count: count as u32 };
            nodes.extend([half(first, count / 2), half(first + count / 2, count - count / 2)]);
            (nodes[at].first, nodes[at].count) = (child as u32, 0);
            open.extend([child, child + 1]);
        }
        Self { nodes, triangles }
    }

    /// The distance of `point` from the surface, or at most `slack` more.
    ///
    /// `near` is a triangle (by its place in here) that is likely to be near; it is replaced by the one that was found,
    /// which is likely to be near the next point.
    pub fn distance(&self, point: Vector, slack: f64, near: &mut usize) -> f64 {
        let mut best = point_to_triangle(point, &self.triangles[*near]).sqrt();
        let within = |best: f64| (best - slack).max(0.0).powi(2);
        // Each level leaves one sibling open, and halving makes the tree as deep as the logarithm of its size.
        let mut open = [(0.0, 0u32); 64];
        let mut depth = 1;
        while depth > 0 {
            depth -= 1;
            let (bound, at) = open[depth];
            if bound >= within(best) {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.count > 0 {
                for i in node.first as usize..(node.first + node.count) as usize {
                    let distance = point_to_triangle(point, &self.triangles[i]).sqrt();
                    if distance < best {
                        (best, *near) = (distance, i);
                    }
                }
                continue;
            }
            let bound = |child: u32| (self.nodes[child as usize].bounds.squared_distance(point), child);
            let (left, right) = (bound(node.first), bound(node.first + 1));
            let (nearer, farther) = if left.0 < right.0 { (left, right) } else { (right, left) };
            (open[depth], open[depth + 1]) = (farther, nearer);
            depth += 2;
        }
        best
    }
}

/// The squared distance of a point from a triangle, which may be a segment or a point.
pub fn point_to_triangle(p: Vector, t: &Triangle) -> f64 {
    let edges = [sub(t[1], t[0]), sub(t[2], t[1]), sub(t[0], t[2])];
    let to = t.map(|corner| sub(p, corner));
    let normal = cross(edges[0], edges[1]);
    let area = dot(normal, normal);
    if area > 0.0 && (0..3).all(|i| dot(cross(normal, edges[i]), to[i]) >= 0.0) {
        return dot(normal, to[0]).powi(2) / area;
    }
    let to_edge = |i: usize| {
        let length = dot(edges[i], edges[i]);
        let along = if length > 0.0 { (dot(to[i], edges[i]) / length).clamp(0.0, 1.0) } else { 0.0 };
        let gap = add_scaled(to[i], -along, edges[i]);
        dot(gap, gap)
    };
    to_edge(0).min(to_edge(1)).min(to_edge(2))
}
