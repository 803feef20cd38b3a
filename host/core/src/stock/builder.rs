//! Parts of an object, and how finely they are cut.

use nalgebra::{Point3, Vector3};

use crate::mesh::Mesh;

pub type Point = Point3<f64>;
pub type Vector = Vector3<f64>;

/// Closed parts in one vertex list; parts may overlap.
#[derive(Clone, Debug, Default)]
pub struct Soup {
    pub positions: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// Adds a closed, consistently wound part, turning it so that its triangles face outwards.
    pub fn add(&mut self, mut part: Soup) {
        if part.volume() < 0.0 {
            part.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let offset = self.positions.len() as u32;
        self.positions.append(&mut part.positions);
        self.triangles.extend(part.triangles.iter().map(|t| t.map(|i| i + offset)));
    }

    /// Adds a part moved by `place`; mirroring is fine.
    pub fn add_at(&mut self, mut part: Soup, place: impl Fn(Point) -> Point) {
        part.positions.iter_mut().for_each(|p| *p = place(*p));
        self.add(part);
    }

    /// Signed volume, positive when the triangles face outwards.
    fn volume(&self) -> f64 {
        let origin = self.positions[0];
        let six_volumes = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| self.positions[i as usize] - origin);
            a.dot(&b.cross(&c))
        };
        self.triangles.iter().map(six_volumes).sum::<f64>() / 6.0
    }

    /// Centred, bounding-box diagonal 1, coordinates rounded to f32.
    pub fn into_mesh(self) -> Mesh {
        let rough =
            Mesh::new(self.positions, self.triangles).expect("the maker gives finite points and real triangles");
        let (center, scale) = (rough.bounds().center(), rough.bounds().diagonal().recip());
        let unit = rough.positions().iter().map(|p| Point::from((p - center) * scale)).collect();
        Mesh::new(unit, rough.triangles().to_vec())
            .and_then(Mesh::to_f32_representable)
            .expect("scaling keeps triangles real")
    }
}

/// How finely to cut: edges per unit length. One value per part, see [`Detail::part`].
#[derive(Clone, Copy, Debug)]
pub struct Detail {
    density: f64,
    /// The wished count, for makers that leave small parts out of coarse objects.
    pub triangles: u32,
    phase: f64,
}

impl Detail {
    /// The detail of the next part. Each part rounds its step counts at another threshold; otherwise all equal parts
    /// would jump at once and the triangle count would have gaps.
    pub fn part(&mut self) -> Detail {
        self.phase = (self.phase + 0.618_033_988_749_894_8).fract();
        *self
    }

    /// Steps along a length, at least `least`.
    pub fn steps(&self, length: f64, least: usize) -> usize {
        ((length * self.density + self.phase) as usize).max(least)
    }

    /// Edges per unit length.
    pub fn density(&self) -> f64 {
        self.density
    }
}

/// Makes the object at the density whose triangle count is nearest to `triangles`.
///
/// The count grows about with the square of the density, so this walks by that rule first and then halves the bracket.
/// It does not grow evenly, though: a coarse object jumps, and may even lose triangles where its shape changes. What
/// the bracket misses there, a look at the densities around finds.
pub fn fit(triangles: u32, make: impl Fn(Detail) -> Soup) -> Soup {
    /// Half a percent is near enough.
    const NEAR: f64 = 0.005;
    let wish = f64::from(triangles);
    let mut best = (f64::INFINITY, 0.0, Soup::default());
    let try_density = |density: f64, best: &mut (f64, f64, Soup)| {
        let soup = make(Detail { density, triangles, phase: 0.0 });
        let miss = libm::log(soup.triangles.len() as f64 / wish);
        if miss.abs() < best.0 {
            *best = (miss.abs(), density, soup);
        }
        miss
    };
    let mut density = 10.0;
    let (mut too_few, mut too_many) = (0.0f64, f64::INFINITY);
    for _ in 0..40 {
        let miss = try_density(density, &mut best);
        if best.0 < NEAR || density < 1e-3 || too_many / too_few < 1.0001 {
            break;
        }
        if miss < 0.0 {
            too_few = too_few.max(density);
        } else {
            too_many = too_many.min(density);
        }
        density = if too_few > 0.0 && too_many.is_finite() {
            (too_few * too_many).sqrt()
        } else {
            density * libm::exp(-0.5 * miss).clamp(0.25, 4.0)
        };
    }
    let around = best.1;
    for k in (1..=40).flat_map(|k| [k, -k]) {
        if best.0 < 10.0 * NEAR {
            break;
        }
        try_density(around * libm::pow(1.01, f64::from(k)), &mut best);
    }
    best.2
}
