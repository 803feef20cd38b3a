//! The vertex of an object that lies furthest in a direction: the support mapping.

use ocb_triangles::vector::{Vector, dot};

/// Vertices in a leaf.
const LEAF: usize = 8;

#[derive(Clone, Copy, Debug)]
struct Node {
    center: Vector,
    half: Vector,
    /// Leaf: its first vertex. Inner node: its first child; the second one follows it.
    first: u32,
    /// Leaf: how many vertices. Inner node: 0.
    count: u32,
}

/// Vertices under a hierarchy of boxes. Not walked from neighbour to neighbour: where many lie in one plane, no neighbour
/// is further than another, and a walk ends in the middle.
#[derive(Debug)]
pub struct Vertices {
    nodes: Vec<Node>,
    points: Vec<Vector>,
}

impl Vertices {
    /// Builds the hierarchy by halving along the longest side.
    pub fn new(mut points: Vec<Vector>) -> Self {
        let root = Node { center: [0.0; 3], half: [0.0; 3], first: 0, count: points.len() as u32 };
        let (mut nodes, mut open) = (vec![root], vec![0]);
        while let Some(at) = open.pop() {
            let (first, count) = (nodes[at].first as usize, nodes[at].count as usize);
            let here = &mut points[first..first + count];
            let limit = |axis: usize, pick: fn(f64, f64) -> f64| here.iter().map(|p| p[axis]).fold(here[0][axis], pick);
            let [low, high] = [f64::min, f64::max].map(|pick| [0, 1, 2].map(|axis| limit(axis, pick)));
            nodes[at].center = core::array::from_fn(|i| 0.5 * (low[i] + high[i]));
            nodes[at].half =
                core::array::from_fn(|i| (high[i] - nodes[at].center[i]).max(nodes[at].center[i] - low[i]));
            if count <= LEAF {
                continue;
            }
            let axis = (0..3).max_by(|&i, &j| nodes[at].half[i].total_cmp(&nodes[at].half[j])).unwrap_or(0);
            here.select_nth_unstable_by(count / 2, |p, q| p[axis].total_cmp(&q[axis]));
            let child = nodes.len();
            let half = |first: usize, count: usize| Node { first: first as u32, count: count as u32, ..root };
            nodes.extend([half(first, count / 2), half(first + count / 2, count - count / 2)]);
            (nodes[at].first, nodes[at].count) = (child as u32, 0);
            open.extend([child, child + 1]);
        }
        Self { nodes, points }
    }

    /// A vertex by its number.
    #[inline]
    pub fn get(&self, vertex: u32) -> Vector {
        self.points[vertex as usize]
    }

    /// The number of a vertex that lies furthest, and how many boxes were looked at. `near` is one that may be far, too.
    pub fn furthest(&self, direction: Vector, near: u32) -> (u32, u64) {
        let (mut best, mut furthest) = (near, dot(self.get(near), direction));
        let reach =
            |node: &Node| dot(node.center, direction) + (0..3).map(|i| node.half[i] * direction[i].abs()).sum::<f64>();
        let mut open = [(f64::INFINITY, 0u32); 64];
        let (mut depth, mut looked) = (1, 0);
        while depth > 0 {
            depth -= 1;
            let (bound, at) = open[depth];
            if bound <= furthest {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.count > 0 {
                for vertex in node.first..node.first + node.count {
                    let along = dot(self.get(vertex), direction);
                    if along > furthest {
                        (best, furthest) = (vertex, along);
                    }
                }
                continue;
            }
            looked += 2;
            let [one, other] = [node.first, node.first + 1].map(|child| (reach(&self.nodes[child as usize]), child));
            (open[depth], open[depth + 1]) = if one.0 > other.0 { (other, one) } else { (one, other) };
            depth += 2;
        }
        (best, looked)
    }
}
