//! STL, text and binary: triangles without shared vertices, which become shared here.
//!
//! Vertices at the same place are merged, in the order of their first use; the first one's coordinates stay. The same place
//! means equal coordinates, bit by bit but for the sign of a zero: exporters write 0 and -0 for the same corner. Normals
//! and attribute bytes are ignored; the order of the corners gives the winding.

mod binary;
#[cfg(test)]
mod tests;
mod text;

use std::collections::HashMap;

use nalgebra::Point3;

use super::read::surface::Surface;
use super::read::words::grouped;
use super::read::{Contents, Fault, ReadError};
pub use binary::{is_binary, is_cut_short};
pub use text::is_text;

/// Reads text in double precision, and the single precision of binary files exactly.
pub fn read(bytes: &[u8]) -> Result<Contents, ReadError> {
    let mut soup = Soup::default();
    let text = is_text(bytes) && !is_binary(bytes) && !is_cut_short(bytes);
    if text {
        text::read(bytes, &mut soup)?
    } else {
        binary::read(bytes, &mut soup)?
    }
    soup.finish()
}

/// Triangles while they are read.
#[derive(Default)]
struct Soup {
    surface: Surface,
    number_of: HashMap<[u64; 3], u32>,
    corners: usize,
}

impl Soup {
    /// Appends a triangle.
    fn facet(&mut self, corners: [[f64; 3]; 3]) -> Result<(), Fault> {
        let mut face = [0; 3];
        for (number, corner) in face.iter_mut().zip(corners) {
            // Adding zero makes -0 and 0 one place.
            let place = corner.map(|x| (x + 0.0).to_bits());
            *number = match self.number_of.get(&place) {
                Some(&known) => known,
                None => {
                    let new = self.surface.vertices() as u32;
                    self.surface.vertex(Point3::from(corner))?;
                    self.number_of.insert(place, new);
                    new
                }
            };
        }
        self.corners += 3;
        self.surface.face(&face)
    }

    fn finish(self) -> Result<Contents, ReadError> {
        if self.surface.triangles() == 0 {
            return Err(ReadError::Whole("the STL file has no facets; export a surface".into()));
        }
        let mut warnings = Vec::new();
        let vertices = self.surface.vertices();
        if vertices < self.corners {
            warnings.push(format!(
                "{} vertices of the triangles were merged into {}: those with equal coordinates are one vertex.",
                grouped(self.corners),
                grouped(vertices)
            ));
        }
        let mesh = self.surface.finish(&mut warnings)?;
        Ok((mesh, warnings))
    }
}
