//! The hierarchy: axis-aligned boxes in the object's own frame, built once.

use ocb_triangles::Triangle;
use ocb_triangles::vector::Vector;
use opencollbench_plugin::Mesh;

/// A box: an inner node or a leaf.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Middle, object frame.
    pub center: Vector,
    /// Half of the side lengths.
    pub half: Vector,
    /// Leaf: its first triangle. Inner node: its first child; the second one follows it.
    pub first: u32,
    /// Leaf: how many triangles. Inner node: 0.
    pub count: u32,
}

impl Node {
    /// Whether there are triangles here and no children.
    #[inline(always)]
    pub fn is_leaf(&self) -> bool {
        self.count > 0
    }

    /// How large the box is, to decide which of two to open. The sum of the sides is as good as the volume and does not
    /// vanish for flat boxes.
    #[inline(always)]
    pub fn size(&self) -> f64 {
        self.half[0] + self.half[1] + self.half[2]
    }
}

/// A mesh as box-tree keeps it.
#[derive(Debug)]
pub struct Tree {
    /// The root is the first.
    pub nodes: Vec<Node>,
    /// Corners in the object frame, in the order of the leaves.
    pub triangles: Vec<Triangle>,
    /// Ids of `triangles`.
    pub ids: Vec<u32>,
}

/// Candidate planes per split. More find hardly better ones.
const BINS: usize = 16;

impl Tree {
    /// Builds the tree with at most `leaf_size` triangles in a leaf.
    pub fn build(mesh: &Mesh<'_>, leaf_size: usize) -> Self {
        let corners: Vec<Triangle> = (0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle)).collect();
        let bounds: Vec<Bounds> = corners.iter().map(Bounds::of).collect();
        let mut ids: Vec<u32> = (0..corners.len() as u32).collect();
        let mut nodes = vec![Node { center: [0.0; 3], half: [0.0; 3], first: 0, count: ids.len() as u32 }];
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            let (first, count) = (nodes[at].first as usize, nodes[at].count as usize);
            let here = &mut ids[first..first + count];
            let all = here.iter().fold(Bounds::NONE, |all, &id| all.around(&bounds[id as usize]));
            (nodes[at].center, nodes[at].half) = all.center_and_half();
            if count <= leaf_size {
                continue;
            }
            let left = split(here, &bounds);
            let child = nodes.len();
            let half = |first: usize, count: usize| Node { first: first as u32, count: count as u32, ..nodes[at] };
            let children = [half(first, left), half(first + left, count - left)];
            nodes.extend(children);
            (nodes[at].first, nodes[at].count) = (child as u32, 0);
            open.extend([child, child + 1]);
        }
        let triangles = ids.iter().map(|&id| corners[id as usize]).collect();
        Self { nodes, triangles, ids }
    }
}

/// Orders `ids` so that a good first part comes first, and says how long it is: at least one and not all.
///
/// The cost of a split is the surface area heuristic (Goldsmith and Salmon 1987), on planes through equal bins of the
/// middles (Wald 2007). It keeps slivers and long triangles from spoiling both halves, as splitting at the median does.
fn split(ids: &mut [u32], bounds: &[Bounds]) -> usize {
    let middles = ids.iter().fold(Bounds::NONE, |all, &id| all.around_point(bounds[id as usize].middle()));
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in 0..3 {
        let extent = middles.max[axis] - middles.min[axis];
        if extent <= 0.0 {
            continue;
        }
        let mut bins = [(0usize, Bounds::NONE); BINS];
        for &id in ids.iter() {
            let bin = &mut bins[bin_of(&bounds[id as usize], &middles, axis)];
            *bin = (bin.0 + 1, bin.1.around(&bounds[id as usize]));
        }
        let mut right = [(0usize, 0.0); BINS];
        let mut all = (0, Bounds::NONE);
        for bin in (1..BINS).rev() {
            all = (all.0 + bins[bin].0, all.1.around(&bins[bin].1));
            right[bin] = (all.0, all.0 as f64 * all.1.area());
        }
        let mut left = (0, Bounds::NONE);
        for plane in 1..BINS {
            left = (left.0 + bins[plane - 1].0, left.1.around(&bins[plane - 1].1));
            let cost = left.0 as f64 * left.1.area() + right[plane].1;
            if left.0 > 0 && right[plane].0 > 0 && best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, plane));
            }
        }
    }
    let Some((_, axis, plane)) = best else {
        // All middles in one point: any halves are as good as others.
        return ids.len() / 2;
    };
    let mut left = 0;
    for i in 0..ids.len() {
        if bin_of(&bounds[ids[i] as usize], &middles, axis) < plane {
            ids.swap(i, left);
            left += 1;
        }
    }
    left
}

fn bin_of(bounds: &Bounds, middles: &Bounds, axis: usize) -> usize {
    let place = (bounds.middle()[axis] - middles.min[axis]) / (middles.max[axis] - middles.min[axis]);
    ((place * BINS as f64) as usize).min(BINS - 1)
}

#[derive(Clone, Copy, Debug)]
struct Bounds {
    min: Vector,
    max: Vector,
}

impl Bounds {
    const NONE: Self = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };

    fn of(triangle: &Triangle) -> Self {
        triangle.iter().fold(Self::NONE, |all, &corner| all.around_point(corner))
    }

    fn around_point(self, p: Vector) -> Self {
        self.around(&Self { min: p, max: p })
    }

    fn around(self, other: &Self) -> Self {
        Self {
            min: core::array::from_fn(|axis| self.min[axis].min(other.min[axis])),
            max: core::array::from_fn(|axis| self.max[axis].max(other.max[axis])),
        }
    }

    fn middle(&self) -> Vector {
        core::array::from_fn(|axis| 0.5 * self.min[axis] + 0.5 * self.max[axis])
    }

    fn center_and_half(&self) -> (Vector, Vector) {
        let center = self.middle();
        (center, core::array::from_fn(|axis| (self.max[axis] - center[axis]).max(center[axis] - self.min[axis])))
    }

    fn area(&self) -> f64 {
        let side = |axis: usize| self.max[axis] - self.min[axis];
        side(0) * side(1) + side(1) * side(2) + side(2) * side(0)
    }
}
