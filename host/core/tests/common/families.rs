//! Pairs of triangles of the kinds that make trouble, as many as wanted.
//!
//! A case is drawn in three steps: how the triangles stand to each other in the world, by which poses they get there, and
//! a dress that changes no answer or all alike (unit of length, order of vertices, who is A).

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::pose::Pose;

use super::random::Random;

/// Three corners.
pub type Triangle = [Point3<f64>; 3];

/// One triangle of A, one of B, and where they stand.
#[derive(Clone, Debug)]
pub struct Case {
    /// How it was drawn.
    pub family: [&'static str; 2],
    /// In A's coordinates.
    pub a: Triangle,
    /// In B's coordinates.
    pub b: Triangle,
    /// Where both stand.
    pub configuration: Configuration,
}

type Family = (&'static str, fn(&mut Random) -> (Triangle, Triangle));
type Placing = (&'static str, fn(&mut Random, Triangle, Triangle) -> (Triangle, Triangle, Configuration));

/// The first two are coarse; some of the last have no area.
const FAMILIES: [Family; 11] = [
    ("anywhere", |r| (anywhere(r), anywhere(r))),
    ("small integers", |r| (integers(r), integers(r))),
    ("vertex near face", vertex_near_face),
    ("edge near edge", edge_near_edge),
    ("coplanar", coplanar),
    ("nearly parallel", nearly_parallel),
    ("sliver", |r| (sliver(r), if r.coin() { sliver(r) } else { anywhere(r) })),
    ("common vertex", common_vertex),
    ("common edge", common_edge),
    ("crossing deep", crossing_deep),
    ("no area", no_area),
];

const PLACINGS: [Placing; 7] = [
    ("still", |_, a, b| (a, b, Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() })),
    ("moved together", |r, a, b| {
        let pose = r.pose(2.0);
        (a, b, Configuration { pose_a: pose, pose_b: pose })
    }),
    ("mapped together", |r, a, b| {
        let pose = affine(r);
        (a, b, Configuration { pose_a: pose, pose_b: pose })
    }),
    ("B moved", |r, a, b| {
        let pose_b = r.pose(2.0);
        (a, back(&pose_b, b), Configuration { pose_a: Pose::identity(), pose_b })
    }),
    ("both moved", |r, a, b| {
        let (pose_a, pose_b) = (r.pose(2.0), r.pose(2.0));
        (back(&pose_a, a), back(&pose_b, b), Configuration { pose_a, pose_b })
    }),
    ("both mapped", |r, a, b| {
        let (pose_a, pose_b) = (affine(r), affine(r));
        (back(&pose_a, a), back(&pose_b, b), Configuration { pose_a, pose_b })
    }),
    ("quarter turns and mirrors", |r, a, b| {
        let pose_b = Pose { linear: signed_permutation(r), translation: Vector3::zeros() };
        (a, back(&pose_b, b), Configuration { pose_a: Pose::identity(), pose_b })
    }),
];

impl Case {
    /// Case `number` of all; a function of its number.
    pub fn draw(number: u64) -> Self {
        let mut random = Random::of(0x0c_b0, number);
        let random = &mut random;
        let (family, make) = FAMILIES[random.below(FAMILIES.len())];
        let (placing, place) = PLACINGS[random.below(PLACINGS.len())];
        let (a, b) = make(random);
        // Single precision, as files have it, for every fourth.
        let (a, b) = if random.below(4) == 0 { (a.map(single), b.map(single)) } else { (a, b) };
        let (a, b, configuration) = place(random, a, b);
        let mut case = Self { family: [family, placing], a, b, configuration };
        if random.below(4) == 0 {
            case.translate_together(random.vector() * 10f64.powi(random.integer(2, 6)));
        }
        if random.below(3) == 0 {
            case.scale(2f64.powi(random.integer(-20, 20)));
        }
        if random.below(6) == 0 {
            case.other_unit_of_b(2f64.powi(random.integer(-20, 20)));
        }
        let (shift, turned) = (random.below(3), random.coin());
        case.a = std::array::from_fn(|i| case.a[(if turned { 2 - i } else { i } + shift) % 3]);
        if random.coin() { case.swapped() } else { case }
    }

    /// A is B and B is A.
    pub fn swapped(self) -> Self {
        let Configuration { pose_a, pose_b } = self.configuration;
        Self { a: self.b, b: self.a, configuration: Configuration { pose_a: pose_b, pose_b: pose_a }, ..self }
    }

    /// Everything in another unit of length; exact for powers of two.
    pub fn scale(&mut self, factor: f64) {
        (self.a, self.b) = (self.a.map(|p| p * factor), self.b.map(|p| p * factor));
        self.configuration.pose_a.translation *= factor;
        self.configuration.pose_b.translation *= factor;
    }

    /// B's coordinates alone in another unit; the pose makes good for it, so the world does not change.
    fn other_unit_of_b(&mut self, factor: f64) {
        self.b = self.b.map(|p| p * factor);
        self.configuration.pose_b.linear /= factor;
    }

    fn translate_together(&mut self, by: Vector3<f64>) {
        self.configuration.pose_a.translation += by;
        self.configuration.pose_b.translation += by;
    }
}

/// The point to single precision.
fn single(p: Point3<f64>) -> Point3<f64> {
    p.map(|x| f64::from(x as f32))
}

/// A power of ten from 10^-15 to 10^-1.
fn tiny(r: &mut Random) -> f64 {
    10f64.powi(-r.integer(1, 15))
}

fn anywhere(r: &mut Random) -> Triangle {
    std::array::from_fn(|_| r.point())
}

fn integers(r: &mut Random) -> Triangle {
    std::array::from_fn(|_| Point3::from(Vector3::from_fn(|_, _| f64::from(r.integer(-2, 2)))))
}

/// A point of a triangle; at times of an edge, or a corner.
fn inside(r: &mut Random, t: &Triangle) -> Point3<f64> {
    let (mut u, mut v) = (r.unit(), r.unit());
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    match r.below(6) {
        0 => v = 0.0,
        1 => (u, v) = (0.0, 0.0),
        _ => {}
    }
    t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v
}

fn normal(t: &Triangle) -> Vector3<f64> {
    (t[1] - t[0]).cross(&(t[2] - t[0])).try_normalize(0.0).unwrap_or_else(Vector3::z)
}

/// A corner of B just before A's face, or just through it.
fn vertex_near_face(r: &mut Random) -> (Triangle, Triangle) {
    let a = anywhere(r);
    let n = normal(&a) * if r.coin() { 1.0 } else { -1.0 };
    let tip = inside(r, &a) + n * if r.below(8) == 0 { 0.0 } else { tiny(r) };
    let side = if r.coin() { n } else { -n };
    let mut away = || {
        let v = r.vector();
        tip + if v.dot(&side) < 0.0 { -v } else { v }
    };
    (a, [tip, away(), away()])
}

fn edge_near_edge(r: &mut Random) -> (Triangle, Triangle) {
    let (centre, u, v) = (r.point(), r.vector(), r.vector());
    let n = u.cross(&v).try_normalize(0.0).unwrap_or_else(Vector3::z);
    let gap = n * if r.coin() { tiny(r) } else { -tiny(r) };
    let (s, t) = (r.unit(), r.unit());
    let a = [centre - u * s, centre + u * (1.0 - s), centre - n + r.vector() * 0.5];
    let b = [centre - v * t + gap, centre + v * (1.0 - t) + gap, centre + n + r.vector() * 0.5];
    (a, b)
}

/// On a grid in one plane, which a linear map may tilt and so round.
fn coplanar(r: &mut Random) -> (Triangle, Triangle) {
    let tilt = if r.coin() { r.rotation() } else { Matrix3::identity() };
    let mut on_grid = || {
        std::array::from_fn(|_| {
            let at = |r: &mut Random| f64::from(r.integer(-8, 8)) / 8.0;
            Point3::from(tilt * Vector3::new(at(r), at(r), 0.0))
        })
    };
    (on_grid(), on_grid())
}

fn nearly_parallel(r: &mut Random) -> (Triangle, Triangle) {
    let a = anywhere(r);
    let n = normal(&a);
    let (gap, angle) = (if r.coin() { tiny(r) } else { 0.0 }, tiny(r));
    let shift = (a[1] - a[0]) * r.signed() + (a[2] - a[0]) * r.signed();
    let b = a.map(|p| p + shift + n * (gap + angle * r.signed()));
    (a, b)
}

/// Two corners so close that the triangle is hardly one.
fn sliver(r: &mut Random) -> Triangle {
    let (p, q) = (r.point(), r.point());
    [p, q, p + (q - p) * if r.coin() { r.unit() } else { 0.0 } + r.vector() * tiny(r)]
}

fn common_vertex(r: &mut Random) -> (Triangle, Triangle) {
    let (a, b) = (anywhere(r), anywhere(r));
    (a, [a[0], b[1], b[2]])
}

fn common_edge(r: &mut Random) -> (Triangle, Triangle) {
    let a = anywhere(r);
    (a, [a[1], a[0], r.point()])
}

/// An edge of B through the middle of A.
fn crossing_deep(r: &mut Random) -> (Triangle, Triangle) {
    let a = anywhere(r);
    let middle = inside(r, &a);
    let v = r.vector();
    (a, [middle - v, middle + v * r.unit(), r.point()])
}

/// A segment or a point.
fn no_area(r: &mut Random) -> (Triangle, Triangle) {
    let a = if r.coin() { integers(r) } else { anywhere(r) };
    let p = inside(r, &a);
    let q = if r.coin() { r.point() } else { a[r.below(3)] };
    let flat = match r.below(4) {
        0 => [p, p, p],
        1 => [q, p, p],
        2 => [p, q, nalgebra::center(&p, &q)],
        _ => [p, Point3::from(p.coords * 2.0), Point3::origin()],
    };
    (a, flat)
}

fn affine(r: &mut Random) -> Pose {
    // Not too flat, so that going back and forth loses little.
    loop {
        let linear = Matrix3::from_fn(|_, _| r.signed());
        if linear.determinant().abs() > 0.05 {
            return Pose { linear, translation: r.vector() };
        }
    }
}

fn signed_permutation(r: &mut Random) -> Matrix3<f64> {
    let (first, step) = (r.below(3), r.integer(1, 2) as usize);
    let signs: [f64; 3] = std::array::from_fn(|_| if r.coin() { 1.0 } else { -1.0 });
    Matrix3::from_fn(|i, j| if j == (first + i * step) % 3 { signs[i] } else { 0.0 })
}

/// Where the corners must be so that the pose puts them where they are; up to rounding.
fn back(pose: &Pose, t: Triangle) -> Triangle {
    let inverse = pose.linear.try_inverse().expect("an invertible map");
    t.map(|p| Point3::from(inverse * (p.coords - pose.translation)))
}
