//! The hierarchy of one object.

use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, add, dot};
use opencollbench_plugin::Mesh;

use crate::Volume;

/// A volume: an inner node or a leaf.
#[derive(Clone, Copy, Debug)]
pub struct Node<V> {
    /// In the object's frame.
    pub volume: V,
    /// Leaf: its triangle. Inner node: its first child; the second one follows it.
    pub(crate) first: u32,
    pub(crate) leaf: bool,
}

/// A mesh as a hierarchy.
#[derive(Debug)]
pub struct Tree<V> {
    /// The root is the first.
    pub(crate) nodes: Vec<Node<V>>,
    /// Corners in the object's frame, in the order of the leaves.
    pub(crate) triangles: Vec<Triangle>,
    /// Ids of `triangles`.
    pub(crate) ids: Vec<u32>,
    /// Length of the longest corner.
    pub(crate) radius: f64,
}

/// From here on triangles are halved in any order, so that no mesh makes a deep tree.
const DEEPEST: u32 = 64;

impl<V: Volume> Tree<V> {
    /// Builds the tree, top down.
    pub fn build(mesh: &Mesh<'_>) -> Self {
        let mut triangles: Vec<Triangle> = (0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle)).collect();
        let mut ids: Vec<u32> = (0..triangles.len() as u32).collect();
        let lengths = triangles.as_flattened().iter().map(|corner| length(*corner));
        let radius = lengths.fold(0.0, f64::max);
        let leaf = |range: &[Triangle], first: usize| Node {
            volume: V::around(range, radius),
            first: first as u32,
            leaf: range.len() == 1,
        };
        let mut nodes = Vec::with_capacity(2 * triangles.len());
        nodes.push(leaf(&triangles, 0));
        let mut open = vec![(0, 0, triangles.len(), 0)];
        while let Some((at, first, end, depth)) = open.pop() {
            if end - first <= 1 {
                continue;
            }
            let direction = V::split_along(&nodes[at as usize].volume, &triangles[first..end]);
            let mut middle = first + split(&mut triangles[first..end], &mut ids[first..end], direction);
            if depth >= DEEPEST || middle == first || middle == end {
                middle = usize::midpoint(first, end);
            }
            let child = nodes.len() as u32;
            nodes[at as usize].first = child;
            nodes.push(leaf(&triangles[first..middle], first));
            nodes.push(leaf(&triangles[middle..end], middle));
            open.extend([(child, first, middle, depth + 1), (child + 1, middle, end, depth + 1)]);
        }
        Self { nodes, triangles, ids, radius }
    }
}

/// Puts the triangles whose middles lie below the mean first, and says how many they are.
fn split(triangles: &mut [Triangle], ids: &mut [u32], direction: Vector) -> usize {
    let along = |t: &Triangle| dot(direction, add(add(t[0], t[1]), t[2]));
    let mean = triangles.iter().map(along).sum::<f64>() / triangles.len() as f64;
    let mut below = 0;
    for i in 0..triangles.len() {
        if along(&triangles[i]) < mean {
            triangles.swap(i, below);
            ids.swap(i, below);
            below += 1;
        }
    }
    below
}

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}
