//! Axis-aligned boxes.

use nalgebra::{Point3, Vector3};

/// An axis-aligned box, given by its corners; exact, because it only copies coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest x, y, z.
    pub min: Point3<f64>,
    /// Largest x, y, z.
    pub max: Point3<f64>,
}

impl Aabb {
    /// The smallest box around points; `None` when there are none.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a Point3<f64>>) -> Option<Self> {
        let mut points = points.into_iter();
        let &first = points.next()?;
        Some(points.fold(Self { min: first, max: first }, |b, p| Self {
            min: b.min.coords.inf(&p.coords).into(),
            max: b.max.coords.sup(&p.coords).into(),
        }))
    }

    /// Lengths of the sides.
    pub fn sides(&self) -> Vector3<f64> {
        self.max - self.min
    }

    /// Length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        self.sides().norm()
    }

    /// The middle.
    pub fn center(&self) -> Point3<f64> {
        nalgebra::center(&self.min, &self.max)
    }
}
