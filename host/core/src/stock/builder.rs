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
    ///
    /// That rounding also hides the last bits of sine and cosine, which differ between machines' libraries.
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
/// The count grows about with the square of the density, and not quite evenly, so this walks by that rule first and
/// then halves the bracket.
pub fn fit(triangles: u32, make: impl Fn(Detail) -> Soup) -> Soup {
    let wish = f64::from(triangles);
    let at = |density: f64| make(Detail { density, triangles, phase: 0.0 });
    let miss = |soup: &Soup| (soup.triangles.len() as f64 / wish).ln();
    let mut density = 10.0;
    let mut best = at(density);
    let (mut too_few, mut too_many) = (None::<f64>, None::<f64>);
    let mut soup_miss = miss(&best);
    for _ in 0..40 {
        // Half a percent is near enough.
        if miss(&best).abs() < 0.005 {
            break;
        }
        if soup_miss < 0.0 {
            too_few = Some(too_few.map_or(density, |d| d.max(density)));
        } else {
            too_many = Some(too_many.map_or(density, |d| d.min(density)));
        }
        density = match (too_few, too_many) {
            (Some(few), Some(many)) => (few * many).sqrt(),
            _ => density * (-0.5 * soup_miss).exp().clamp(0.25, 4.0),
        };
        if density < 1e-3 {
            break;
        }
        let soup = at(density);
        soup_miss = miss(&soup);
        if soup_miss.abs() < miss(&best).abs() {
            best = soup;
        }
    }
    best
}
