//! The voxels that a surface passes through.

use ocb_fields::Bounds;
use ocb_triangles::Triangle;
use ocb_triangles::vector::{Vector, cross, dot, sub};
use opencollbench_plugin::Mesh;

/// By how much a voxel is taken larger when it is tested against a triangle, so that rounding leaves none out.
const LARGER: f64 = 1.0 + 1e-9;

/// A point lies so far from the surface whose voxel it is the middle of, at most, in voxels: half a diagonal.
const OFF: f64 = 0.866_025_403_784_44;
/// No map reaches further than so many voxels: each point costs the cube of it.
const FARTHEST: f64 = 16.0;

/// An object as voxels and as points.
#[derive(Debug)]
pub struct Voxels {
    /// The corner of the first voxel.
    pub origin: Vector,
    /// The side of a voxel.
    pub size: f64,
    /// How many along each axis, with empty ones at both ends.
    counts: [usize; 3],
    /// How many are empty at each end.
    margin: usize,
    /// One bit per voxel: the surface passes through it or, without a clearance, through one of the 26 around it.
    near: Vec<u64>,
    /// The middles of the voxels that the surface passes through.
    pub points: Vec<Vector>,
    /// A ball around the points.
    pub middle: Vector,
    /// Its radius.
    pub radius: f64,
}

impl Voxels {
    /// Voxels of this share of the diagonal of the mesh's box, and a map that no point of another object's shell misses that
    /// is within the clearance, if that has no larger voxels. A clearance of too many voxels is refused, in one sentence.
    pub fn new(mesh: &Mesh<'_>, share: f64, clearance: f64) -> Result<Self, String> {
        let bounds = Bounds::of(mesh);
        let sides = bounds.sides();
        let diagonal = dot(sides, sides).sqrt();
        // All vertices may lie in one point.
        let size = if diagonal > 0.0 { diagonal * share } else { 1.0 };
        let reach = clearance / size;
        if reach > FARTHEST {
            return Err(format!("the clearance is {reach:.0} voxels, and a map reaches no further than {FARTHEST}"));
        }
        let around = around(reach + OFF);
        let margin = around.iter().map(|step| step[0]).max().unwrap_or(0) as usize;
        let counts = sides.map(|side| (side / size) as usize + 1 + 2 * margin);
        let origin = bounds.min.map(|x| x - margin as f64 * size);
        let middle = core::array::from_fn(|i| 0.5 * (bounds.min[i] + bounds.max[i]));
        let words = counts.iter().product::<usize>().div_ceil(64);
        let radius = 0.5 * diagonal + size;
        let near = vec![0; words];
        let mut voxels = Self { origin, size, counts, margin, near, points: Vec::new(), middle, radius };
        let mut surface = vec![0; words];
        for triangle in 0..mesh.triangles.len() {
            voxels.mark(&mesh.corners(triangle), &mut surface);
        }
        voxels.collect(&surface, &around);
        Ok(voxels)
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
        let last =
            core::array::from_fn(|i| ((voxel(around.max[i], i) + 1e-6) as usize).min(self.counts[i] - 1 - self.margin));
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

    /// Makes points of the marked voxels, and the map of what is `around` them.
    fn collect(&mut self, surface: &[u64], around: &[[isize; 3]]) {
        let [x, y, z] = self.counts.map(|n| self.margin..n - self.margin);
        for k in z {
            for j in y.clone() {
                for i in x.clone() {
                    let bit = self.bit([i, j, k]);
                    if surface[bit / 64] >> (bit % 64) & 1 == 0 {
                        continue;
                    }
                    let at = [i, j, k];
                    self.points.push(core::array::from_fn(|n| self.origin[n] + (at[n] as f64 + 0.5) * self.size));
                    for step in around {
                        let bit = self.bit(core::array::from_fn(|n| at[n].wrapping_add_signed(step[n])));
                        self.near[bit / 64] |= 1 << (bit % 64);
                    }
                }
            }
        }
    }
}

/// The steps from a voxel to all that a point may lie in which is within `reach` voxels of it.
fn around(reach: f64) -> Vec<[isize; 3]> {
    let far = reach as isize + 1;
    let gap = |step: isize| (step.abs() - 1).max(0) as f64;
    let steps = (-far..=far).flat_map(|k| (-far..=far).flat_map(move |j| (-far..=far).map(move |i| [i, j, k])));
    // A little more, so that rounding leaves none out.
    steps.filter(|step| step.iter().map(|&s| gap(s).powi(2)).sum::<f64>() <= (reach * LARGER).powi(2)).collect()
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
