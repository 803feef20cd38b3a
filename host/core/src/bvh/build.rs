//! Top-down construction: split along the longest axis of the box, so that all nodes but the uppermost are full.

use nalgebra::Vector3;

use super::obb;
use super::wide_node::{Child, LANES, WideNode};

/// The nodes over `triangles` (tree coordinates); node 0 holds the box around everything alone.
pub(super) fn build(triangles: &[[Vector3<f64>; 3]]) -> Vec<WideNode> {
    let mut ids: Vec<u32> = (0..triangles.len() as u32).collect();
    let centroids: Vec<Vector3<f64>> = triangles.iter().map(|t| (t[0] + t[1] + t[2]) / 3.0).collect();
    let mut builder = Builder { triangles, centroids, nodes: vec![WideNode::empty()] };
    let root = builder.child(&mut ids);
    builder.nodes[0].set(0, &root.0, root.1);
    if let Child::Triangle(triangle) = root.1 {
        builder.nodes[0].set_corners(0, &triangles[triangle as usize]);
    }
    builder.nodes
}

struct Builder<'a> {
    triangles: &'a [[Vector3<f64>; 3]],
    centroids: Vec<Vector3<f64>>,
    nodes: Vec<WideNode>,
}

impl Builder<'_> {
    /// Box and content of one lane.
    fn child(&mut self, ids: &mut [u32]) -> (obb::Obb, Child) {
        let fitted = obb::fit(self.triangles, ids);
        if let [only] = ids {
            return (fitted, Child::Triangle(*only));
        }
        // Children of a full size (a power of the node's width) leave no lane of the nodes below unused.
        let mut size = 1;
        while size * LANES < ids.len() {
            size *= LANES;
        }
        let index = self.nodes.len();
        self.nodes.push(WideNode::empty());
        let mut lane = 0;
        self.split(ids, size, index, &mut lane);
        (fitted, Child::Node(index as u32))
    }

    /// Distributes `ids` over lanes of node `index` in groups of `size`.
    fn split(&mut self, ids: &mut [u32], size: usize, index: usize, lane: &mut usize) {
        if ids.len() <= size {
            let (fitted, content) = self.child(ids);
            self.nodes[index].set(*lane, &fitted, content);
            if let Child::Triangle(triangle) = content {
                self.nodes[index].set_corners(*lane, &self.triangles[triangle as usize]);
            }
            *lane += 1;
            return;
        }
        let groups = ids.len().div_ceil(size);
        let middle = (groups / 2) * size;
        let axes = obb::principal_axes(self.triangles, ids);
        let spread = |axis: &Vector3<f64>| {
            let (lo, hi) = ids
                .iter()
                .map(|&t| axis.dot(&self.centroids[t as usize]))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
            hi - lo
        };
        let rows: [Vector3<f64>; 3] = std::array::from_fn(|i| axes.row(i).transpose());
        let axis = rows.iter().max_by(|x, y| spread(x).total_cmp(&spread(y))).copied().expect("three axes");
        let key = |t: u32| axis.dot(&self.centroids[t as usize]);
        // Equal keys are ordered by number, so that the tree does not depend on how the selection works.
        ids.select_nth_unstable_by(middle, |&x, &y| key(x).total_cmp(&key(y)).then(x.cmp(&y)));
        let (left, right) = ids.split_at_mut(middle);
        self.split(left, size, index, lane);
        self.split(right, size, index, lane);
    }
}
