//! Vertices and faces while a file is read.

use nalgebra::Point3;

use super::fault::Fault;
use super::limits::{MAX_CORNERS, MAX_TRIANGLES, MAX_VERTICES};
use super::polygon::Cutter;
use crate::mesh::{Mesh, MeshError};

/// Vertices and triangles of a file, within the limits that hold for every format.
#[derive(Default)]
pub struct Surface {
    positions: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
    cutter: Cutter,
    /// Faces whose cut into triangles is a guess.
    guessed: usize,
    /// Faces with fewer than three corners.
    flat: usize,
}

impl Surface {
    /// Over vertices that are all known.
    pub fn over(positions: Vec<Point3<f64>>) -> Self {
        Self { positions, ..Self::default() }
    }

    /// How many vertices there are.
    pub fn vertices(&self) -> usize {
        self.positions.len()
    }

    /// How many triangles there are.
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Appends a vertex, whose coordinates are finite and within bounds.
    pub fn vertex(&mut self, position: Point3<f64>) -> Result<(), Fault> {
        if self.positions.len() == MAX_VERTICES {
            return Err(Fault::TooManyVertices);
        }
        self.positions.push(position);
        Ok(())
    }

    /// Appends the triangles of a face over vertices that are known: n-2 for n corners, wound as the face is. A face with
    /// fewer than three corners is skipped and counted.
    pub fn face(&mut self, corners: &[u32]) -> Result<(), Fault> {
        if let Some(&index) = corners.iter().find(|&&i| i as usize >= self.positions.len()) {
            return Err(Fault::NoSuchVertex { index: i64::from(index), vertices: self.positions.len() });
        }
        if corners.len() > MAX_CORNERS {
            return Err(Fault::TooManyCorners(corners.len()));
        }
        if corners.len() < 3 {
            self.flat += 1;
            return Ok(());
        }
        if self.triangles.len() + corners.len() - 2 > MAX_TRIANGLES {
            return Err(Fault::TooManyTriangles);
        }
        if !self.cutter.cut(&self.positions, corners, &mut self.triangles) {
            self.guessed += 1;
        }
        Ok(())
    }

    /// The mesh. Vertices keep their numbers and triangles the order of their faces; what was skipped or is odd is added
    /// to the warnings.
    pub fn finish(self, warnings: &mut Vec<String>) -> Result<Mesh, MeshError> {
        if self.flat > 0 {
            warnings.push(format!("Skipped {} face(s) with fewer than 3 corners.", self.flat));
        }
        if self.guessed > 0 {
            warnings.push(format!(
                "{} face(s) with more than 3 corners cross or fold over themselves; their cut into triangles is a guess.",
                self.guessed
            ));
        }
        let vertices = self.positions.len();
        let mut used = vec![false; vertices];
        self.triangles.iter().flatten().for_each(|&i| used[i as usize] = true);
        let unused = used.iter().filter(|&&u| !u).count();
        if unused > 0 {
            warnings
                .push(format!("{unused} of {vertices} vertices are not used by any face; they keep their numbers."));
        }
        let mesh = Mesh::new(self.positions, self.triangles)?;
        if mesh.degenerate_triangles() > 0 {
            warnings.push(format!(
                "{} of {} triangles have zero area; they are kept.",
                mesh.degenerate_triangles(),
                mesh.triangles().len()
            ));
        }
        Ok(mesh)
    }
}
