//! Where a scene places its meshes.

use nalgebra::{Matrix4, Point3};

use super::fault::Fault;
use super::surface::Surface;
use super::words::bounded;

/// An affine transform from a node's frame to the frame of the file: the product of the matrices from the root to the node,
/// in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    matrix: Matrix4<f64>,
    /// Does it move anything? Without a transform coordinates stay bit for bit, signed zeros included.
    moves: bool,
    /// Is it a mirror image?
    mirrors: bool,
}

impl Placing {
    /// Where everything stays in its place.
    pub fn none() -> Self {
        Self { matrix: Matrix4::identity(), moves: false, mirrors: false }
    }

    /// A node in this frame, with a local transform: column vectors are multiplied from the left.
    pub fn within(&self, local: &Matrix4<f64>) -> Self {
        if *local == Matrix4::identity() {
            return *self;
        }
        let matrix = if self.moves { self.matrix * local } else { *local };
        Self { matrix, moves: true, mirrors: matrix.fixed_view::<3, 3>(0, 0).determinant() < 0.0 }
    }

    /// A point of the node in the frame of the file.
    pub fn of(&self, point: Point3<f64>) -> Point3<f64> {
        if !self.moves {
            return point;
        }
        let m = &self.matrix;
        let row = |i: usize| m[(i, 0)] * point.x + m[(i, 1)] * point.y + m[(i, 2)] * point.z + m[(i, 3)];
        Point3::new(row(0), row(1), row(2))
    }

    /// Appends vertices of a node to the surface; the number of the first one there.
    pub fn vertices(&self, points: impl Iterator<Item = Point3<f64>>, surface: &mut Surface) -> Result<u32, Fault> {
        let first = surface.vertices() as u32;
        for point in points {
            let placed = self.of(point);
            for &x in placed.coords.iter() {
                bounded(x, || format!("{x:e}"))?;
            }
            surface.vertex(placed)?;
        }
        Ok(first)
    }

    /// Appends a face over these vertices. A mirror image of a face is wound the other way, so that its outside stays
    /// outside.
    pub fn face(&self, corners: &mut [u32], surface: &mut Surface) -> Result<(), Fault> {
        if self.mirrors && corners.len() > 1 {
            corners[1..].reverse();
        }
        surface.face(corners)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn inner_transforms_apply_first_and_none_keeps_the_bits() {
        let shift = Matrix4::new_translation(&Vector3::new(1.0, 2.0, 3.0));
        let scale = Matrix4::new_nonuniform_scaling(&Vector3::new(-2.0, 1.0, 1.0));
        let placed = Placing::none().within(&shift).within(&scale);
        assert_eq!(placed.of(Point3::new(1.0, 1.0, 1.0)), Point3::new(-1.0, 3.0, 4.0));
        assert!(placed.mirrors);
        assert!(!placed.within(&scale).mirrors);
        let kept = Placing::none().within(&Matrix4::identity()).of(Point3::new(-0.0, 0.0, -0.0));
        assert_eq!(kept.coords.map(f64::to_bits), Vector3::new(-0.0, 0.0, -0.0).map(f64::to_bits));
    }
}
