//! Meshes made here, and numbers that look random.

use opencollbench_plugin::{Mesh, Pose};

/// A mesh that owns its arrays.
#[derive(Clone, Debug)]
pub struct Soup {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Soup {
    pub fn view(&self) -> Mesh<'_> {
        Mesh { positions: &self.positions, triangles: &self.triangles }
    }

    /// Triangles that share no vertices.
    pub fn of(triangles: &[[[f64; 3]; 3]]) -> Self {
        let ids = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Self { positions: triangles.as_flattened().to_vec(), triangles: ids }
    }

    /// The same triangles elsewhere and in another unit.
    pub fn moved(&self, unit: f64, offset: f64) -> Self {
        let positions = self.positions.iter().map(|p| p.map(|x| x * unit + offset)).collect();
        Self { positions, triangles: self.triangles.clone() }
    }

    /// The largest coordinate.
    pub fn size(&self) -> f64 {
        self.positions.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// A bumpy torus: curved, concave, with triangles of many sizes.
    pub fn torus(around: usize, across: usize) -> Self {
        let at = |i: usize, j: usize| (j % across * around + i % around) as u32;
        let mut soup = Self { positions: Vec::new(), triangles: Vec::new() };
        for j in 0..across {
            for i in 0..around {
                let (u, v) = (
                    i as f64 / around as f64 * std::f64::consts::TAU,
                    j as f64 / across as f64 * std::f64::consts::TAU,
                );
                let r = 0.3 + 0.1 * (3.0 * u).sin() * (2.0 * v).cos();
                let ring = 1.0 + r * v.cos();
                soup.positions.push([ring * u.cos(), ring * u.sin(), r * v.sin()]);
                soup.triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                soup.triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        soup
    }

    /// A triangle from both sides, a point and a segment: what a polygon soup may contain.
    pub fn scraps() -> Self {
        Self {
            positions: vec![
                [0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.4, 0.4, 0.4],
                [0.2, 0.2, -0.5],
                [0.2, 0.2, 0.0],
                [0.2, 0.2, 0.8],
            ],
            triangles: vec![[0, 1, 2], [2, 1, 0], [3, 3, 3], [4, 5, 6]],
        }
    }
}

/// Numbers in [0, 1) that look random and are the same every time (SplitMix64).
pub struct Dice(pub u64);

impl Dice {
    pub fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A whole number, `first` or larger and less than `end`.
    pub fn pick(&mut self, first: i32, end: i32) -> i32 {
        first + (self.roll() * f64::from(end - first)) as i32
    }

    /// Any rotation, and a translation of this length in any direction.
    pub fn pose(&mut self, distance: f64) -> Pose {
        let mut normal = || (self.roll() + self.roll() + self.roll() + self.roll() - 2.0) + 1e-3;
        let q = [normal(), normal(), normal(), normal()];
        let t = [normal(), normal(), normal()];
        let n = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let [w, x, y, z] = q.map(|v| v / n);
        let s = distance / t.iter().map(|x| x * x).sum::<f64>().sqrt();
        Pose([
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
            t[0] * s,
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
            t[1] * s,
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
            t[2] * s,
            0.0,
            0.0,
            0.0,
            1.0,
        ])
    }
}

/// Where a pose matrix keeps its translation.
pub const TRANSLATION: [usize; 3] = [3, 7, 11];

/// A point moved by a pose.
pub fn apply(pose: &Pose, p: [f64; 3]) -> [f64; 3] {
    let (r, t) = (pose.rotation(), pose.translation());
    std::array::from_fn(|i| r[i][0] * p[0] + r[i][1] * p[1] + r[i][2] * p[2] + t[i])
}
