//! Meshes, poses and known sets for the tests of the plugins. Included by path, so each test uses a part of it.
#![allow(dead_code, reason = "each test binary uses a part")]

use std::path::{Path, PathBuf};

use opencollbench_plugin::{
    Algorithm, Collision, ContactList, Contacts, Count, Distance, Mesh, Placed, Pose, Separation, Uncounted, raw,
};

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

/// One object, ready for queries.
pub struct Loaded<A: Algorithm> {
    pub algorithm: A,
    pub object: A::Object,
}

impl<A: Algorithm> Loaded<A> {
    pub fn new(soup: &Soup) -> Self {
        Self::with(A::default(), soup)
    }

    pub fn with(mut algorithm: A, soup: &Soup) -> Self {
        let object = algorithm.load_mesh(soup.view()).expect("the mesh loads");
        Self { algorithm, object }
    }

    pub fn collide(&mut self, pose_a: &Pose, pose_b: &Pose) -> Collision {
        self.collide_counting(pose_a, pose_b, &mut Uncounted)
    }

    pub fn collide_counting(&mut self, pose_a: &Pose, pose_b: &Pose, work: &mut impl Count) -> Collision {
        let object = &self.object;
        let (a, b) = (Placed { object, pose: pose_a }, Placed { object, pose: pose_b });
        self.algorithm.collide(a, b, work).expect("an answer")
    }
}

impl<A: Distance> Loaded<A> {
    pub fn distance(&mut self, pose_a: &Pose, pose_b: &Pose) -> Separation {
        self.distance_counting(pose_a, pose_b, &mut Uncounted)
    }

    pub fn distance_counting(&mut self, pose_a: &Pose, pose_b: &Pose, work: &mut impl Count) -> Separation {
        let object = &self.object;
        let (a, b) = (Placed { object, pose: pose_a }, Placed { object, pose: pose_b });
        self.algorithm.distance(a, b, work).expect("an answer")
    }
}

/// Takes what a contact list has written into the spare room of a vector.
pub fn fill(room: &mut Vec<raw::contacts::Contact>, total: usize) {
    assert!(room.is_empty() && total <= room.capacity(), "{total} contacts");
    // SAFETY: the list has written its first `total` places.
    unsafe { room.set_len(total) };
}

impl<A: Contacts> Loaded<A> {
    /// All contacts in ascending order.
    pub fn contacts(&mut self, pose_a: &Pose, pose_b: &Pose) -> Vec<(u32, u32)> {
        let object = &self.object;
        let (a, b) = (Placed { object, pose: pose_a }, Placed { object, pose: pose_b });
        let mut room: Vec<_> = Vec::with_capacity(1 << 20);
        let mut found = ContactList::new(room.spare_capacity_mut());
        self.algorithm.contacts(a, b, &mut found, &mut Uncounted).expect("an answer");
        let total = found.total() as usize;
        fill(&mut room, total);
        let mut pairs: Vec<(u32, u32)> = room.iter().map(|c: &raw::contacts::Contact| (c.a, c.b)).collect();
        pairs.sort_unstable();
        pairs
    }
}

/// All pairs of triangles in the world frame: what the tests believe.
///
/// Not the plugin brute-force, although it would do: two plugins in one program both export the entry point.
pub struct Reference<'a>(pub &'a Soup);

impl Reference<'_> {
    fn pairs(&self, pose_a: &Pose, pose_b: &Pose, mut visit: impl FnMut([u32; 2], &[[f64; 3]; 3], &[[f64; 3]; 3])) {
        let all = |pose| (0..self.0.triangles.len() as u32).map(move |i| (i, in_world(self.0, i, pose)));
        let in_b: Vec<_> = all(pose_b).collect();
        for (a, in_a) in all(pose_a) {
            for (b, in_b) in &in_b {
                visit([a, *b], &in_a, in_b);
            }
        }
    }

    /// All contacts in ascending order.
    pub fn contacts(&self, pose_a: &Pose, pose_b: &Pose) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        self.pairs(pose_a, pose_b, |[a, b], in_a, in_b| {
            if ocb_triangles::meet(in_a, in_b) {
                found.push((a, b));
            }
        });
        found
    }

    /// The minimum distance.
    pub fn distance(&self, pose_a: &Pose, pose_b: &Pose) -> f64 {
        let mut squared = f64::INFINITY;
        self.pairs(pose_a, pose_b, |_, in_a, in_b| {
            if let Some(closest) = ocb_triangles::distance_below(in_a, in_b, squared) {
                squared = closest.squared;
            }
        });
        squared.sqrt()
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

/// A point moved by a pose.
pub fn apply(pose: &Pose, p: [f64; 3]) -> [f64; 3] {
    let (r, t) = (pose.rotation(), pose.translation());
    std::array::from_fn(|i| r[i][0] * p[0] + r[i][1] * p[1] + r[i][2] * p[2] + t[i])
}

/// A triangle of a mesh in the world.
pub fn in_world(soup: &Soup, triangle: u32, pose: &Pose) -> [[f64; 3]; 3] {
    soup.view().corners(triangle as usize).map(|p| apply(pose, p))
}

/// Asserts that a hit names a pair of triangles that meet, and that a miss is expected.
pub fn check_collision(soup: &Soup, pose_a: &Pose, pose_b: &Pose, answer: Collision, expected: bool) {
    match answer {
        Collision::Apart => assert!(!expected, "missed the collision at {pose_a:?} {pose_b:?}"),
        Collision::Somewhere => panic!("no pair is named"),
        Collision::Pair(a, b) => {
            assert!(expected, "{a} and {b} do not meet at {pose_a:?} {pose_b:?}");
            let gap = ocb_triangles::distance(&in_world(soup, a, pose_a), &in_world(soup, b, pose_b)).squared.sqrt();
            assert!(gap <= 32.0 * f64::EPSILON, "{a} and {b} are {gap} apart");
        }
    }
}

/// Asserts that the witness points lie on the triangles named and realise the distance, to a tolerance.
pub fn check_witness(soup: &Soup, pose_a: &Pose, pose_b: &Pose, answer: &Separation, tau: f64) {
    let [point_a, point_b] = answer.points.expect("points");
    let [a, b] = answer.triangles.expect("triangles");
    for (point, triangle, pose) in [(point_a, a, pose_a), (point_b, b, pose_b)] {
        let off = ocb_triangles::distance(&[point; 3], &in_world(soup, triangle, pose)).squared.sqrt();
        assert!(off <= tau, "a witness point is {off} off its triangle {triangle}");
    }
    let gap = (0..3).map(|i| (point_a[i] - point_b[i]).powi(2)).sum::<f64>().sqrt();
    assert!((gap - answer.distance).abs() <= tau, "the witness points are {gap} apart, not {}", answer.distance);
}

/// A set of configurations whose answers several independent libraries agree on.
pub struct KnownSet {
    pub soup: Soup,
    /// Placements of B in A's frame.
    pub poses: Vec<Pose>,
    /// Their distances; none for a set in which all collide.
    pub distances: Option<Vec<f64>>,
}

/// A file of the project's shared data.
fn shared(folder: &str, name: &str) -> PathBuf {
    let root = std::env::var_os("OCB_SHARED")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared"), PathBuf::from);
    root.join(folder).join(name)
}

/// What is in a file of the project's shared data.
pub fn shared_file(folder: &str, name: &str) -> Vec<u8> {
    read(&shared(folder, name))
}

fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|error| {
        panic!(
            "this needs {}: {error}. Put the project's shared data (folders `meshes` and `configurations`) in the folder \
             `shared` beside the repository, or say where it is by the environment variable OCB_SHARED",
            path.display()
        )
    })
}

/// A mesh of the project's shared data.
pub fn known_mesh(mesh: &str) -> Soup {
    let text = read(&shared("meshes", &format!("{mesh}.obj")));
    let mut soup = Soup { positions: Vec::new(), triangles: Vec::new() };
    for line in String::from_utf8_lossy(&text).lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                // The coordinates are those of single precision, written with as many digits as that needs.
                let mut number = || {
                    let single: Option<f32> = words.next().and_then(|word| word.parse().ok());
                    f64::from(single.expect("a coordinate"))
                };
                soup.positions.push([number(), number(), number()]);
            }
            Some("f") => {
                let mut index = || {
                    let word = words.next().and_then(|word| word.split('/').next()).expect("a corner");
                    word.parse::<u32>().expect("a vertex number") - 1
                };
                soup.triangles.push([index(), index(), index()]);
            }
            _ => {}
        }
    }
    soup
}

/// The poses of a set of the project's shared data, and their distances if they are known; none if there is no such set.
pub fn known_poses(mesh: &str, set: &str) -> Option<(Vec<Pose>, Option<Vec<f64>>)> {
    let file = |end: &str| shared("configurations", &format!("{mesh}.{set}{end}"));
    let numbers = |path: PathBuf| -> Option<Vec<f64>> {
        path.exists().then(|| read(&path).as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
    };
    let poses = numbers(file(".f64"))?.as_chunks::<16>().0.iter().map(|m| Pose(*m)).collect();
    Some((poses, numbers(file(".distance.f64"))))
}

/// Reads `<mesh>.<set>` from the project's shared data.
pub fn known_set(mesh: &str, set: &str) -> KnownSet {
    let soup = known_mesh(mesh);
    let (poses, distances) = known_poses(mesh, set).unwrap_or_else(|| panic!("{mesh}.{set} is not in the shared data"));
    assert_eq!(poses.len(), 1000, "{mesh}.{set} is not the set that this test knows");
    KnownSet { soup, poses, distances }
}

/// What a distance may be off: 32 roundings at the size of the scene, as the project judges plugins.
pub fn tau(soup: &Soup, pose_b: &Pose) -> f64 {
    let size = soup.positions.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let shift = pose_b.translation().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    32.0 * f64::EPSILON / 2.0 * (2.0 * size + shift)
}
