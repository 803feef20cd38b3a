//! The voxels that a surface passes through.

use ocb_fields::Bounds;
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, cross, dot, sub};
use opencollbench_plugin::Mesh;

/// By how much a voxel is taken larger when it is tested against a triangle, so that rounding leaves none out.
const LARGER: f64 = 1.0 + 1e-9;

/// An object as voxels and as points.
#[derive(Debug)]
pub struct Voxels {
    /// The corner of the first voxel.
    pub origin: Vector,
    /// The side of a voxel.
    pub size: f64,
    /// How many along each axis, with an empty one at both ends.
    counts: [usize; 3],
    /// One bit per voxel: the surface passes through it or through one of the 26 around it.
    near: Vec<u64>,
    /// The middles of the voxels that the surface passes through.
    pub points: Vec<Vector>,
    /// A ball around the points.
    pub middle: Vector,
    /// Its radius.
    pub radius: f64,
}

impl Voxels {
    /// Voxels of this share of the diagonal of the mesh's box.
    pub fn new(mesh: &Mesh<'_>, share: f64) -> Self {
        let bounds = Bounds::of(mesh);
        let sides = bounds.sides();
        let diagonal = dot(sides, sides).sqrt();
        // All vertices may lie in one point.
        let size = if diagonal > 0.0 { diagonal * share } else { 1.0 };
        let counts = sides.map(|side| (side / size) as usize + 3);
        let origin = bounds.min.map(|x| x - size);
        let middle = core::array::from_fn(|i| 0.5 * (bounds.min[i] + bounds.max[i]));
        let words = counts.iter().product::<usize>().div_ceil(64);
        let radius = 0.5 * diagonal + size;
        let mut voxels = Self { origin, size, counts, near: vec![0; words], points: Vec::new(), middle, radius };
        let mut surface = vec![0; words];
        for triangle in 0..mesh.triangles.len() {
            voxels.mark(&mesh.corners(triangle), &mut surface);
        }
        voxels.collect(&surface);
        voxels
    }

    /// Is a point, in voxels from the origin, in the map?
    #[inline(always)]
    pub fn has(&self, point: Vector) -> bool {
        if (0..3).any(|i| !(point[i] >= 0.0 && point[i] < self.counts[i] as f64)) {
            return false;
        }
        let bit = self.bit(point.map(|x| x as usize));
        self.near[bit / 64] >> (bit % 64) & 1 == 1
    }

    /// Is a ball, in voxels from the origin, wholly outside?
    pub fn outside(&self, middle: Vector, radius: f64) -> bool {
        let all = Bounds { min: [0.0; 3], max: self.counts.map(|n| n as f64) };
        all.squared_distance(middle) > radius * radius
    }

    #[inline(always)]
    fn bit(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.counts[1] + j) * self.counts[0] + i
    }

    /// Marks the voxels that a triangle meets: halves the block of voxels around it, and leaves out halves that it misses.
    fn mark(&self, triangle: &Triangle, surface: &mut [u64]) {
        let around = triangle.iter().fold(Bounds::NONE, |all, &p| all.with(p));
        let voxel = |x: f64, axis: usize| (x - self.origin[axis]) / self.size;
        let first = core::array::from_fn(|i| (voxel(around.min[i], i) - 1e-6) as usize);
        let last = core::array::from_fn(|i| ((voxel(around.max[i], i) + 1e-6) as usize).min(self.counts[i] - 2));
        let mut open = vec![[first, last]];
        while let Some([first, last]) = open.pop() {
            let side = |i: usize| (last[i] + 1 - first[i]) as f64 * 0.5 * self.size;
            let half: Vector = core::array::from_fn(side);
            let middle = core::array::from_fn(|i| self.origin[i] + first[i] as f64 * self.size + half[i]);
            if !meets(triangle, middle, half.map(|x| x * LARGER)) {
                continue;
            }
            let axis = (0..3).max_by_key(|&i| last[i] - first[i]).unwrap_or(0);
            if first == last {
                let bit = self.bit(first);
                surface[bit / 64] |= 1 << (bit % 64);
            } else {
                let cut = first[axis] + (last[axis] - first[axis]) / 2;
                let (mut low, mut high) = (last, first);
                (low[axis], high[axis]) = (cut, cut + 1);
                open.extend([[first, low], [high, last]]);
            }
        }
    }

    /// Makes points of the marked voxels, and the map of their surroundings.
    fn collect(&mut self, surface: &[u64]) {
        let [x, y, z] = self.counts;
        for k in 1..z - 1 {
            for j in 1..y - 1 {
                for i in 1..x - 1 {
                    let bit = self.bit([i, j, k]);
                    if surface[bit / 64] >> (bit % 64) & 1 == 0 {
                        continue;
                    }
                    let at = [i, j, k];
                    self.points.push(core::array::from_fn(|n| self.origin[n] + (at[n] as f64 + 0.5) * self.size));
                    for beside in 0..27 {
                        let step = [beside % 3, beside / 3 % 3, beside / 9];
                        let bit = self.bit(core::array::from_fn(|n| at[n] + step[n] - 1));
                        self.near[bit / 64] |= 1 << (bit % 64);
                    }
                }
            }
        }
    }
}

/// Does a triangle meet a box? By 13 directions, one of which separates them if they do not (Akenine-Moller 2001).
fn meets(triangle: &Triangle, middle: Vector, half: Vector) -> bool {
    let corners = triangle.map(|p| sub(p, middle));
    let edges = [sub(corners[1], corners[0]), sub(corners[2], corners[1]), sub(corners[0], corners[2])];
    let separates = |direction: Vector| {
        let along = corners.map(|p| dot(p, direction));
        let reach = (0..3).map(|i| half[i] * direction[i].abs()).sum::<f64>();
        along.iter().all(|&x| x > reach) || along.iter().all(|&x| x < -reach)
    };
    const AXES: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut crossed = edges.iter().flat_map(|&edge| AXES.map(|axis| cross(axis, edge)));
    !(AXES.into_iter().any(separates) || separates(cross(edges[0], edges[1])) || crossed.any(separates))
}
