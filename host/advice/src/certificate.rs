//! How well a mesh stands for an object: two lengths per triangle, found and checked.

use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::lod::{Lod, LodError};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::Shape;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::cover::{Effort, Rounding, cover, is_covered};
use crate::target::Target;
use crate::watch::Watch;

/// Changes whenever the same meshes get other lengths.
pub const VERSION: u32 = 1;

/// Share of a typical deviation, and of the object's longest side, below which lengths are not made smaller.
const ENOUGH: (f64, f64) = (0.2, 1e-6);
/// Times what a point was found to need.
const FACTOR: f64 = 1.25;
/// Points whose deviation is looked at for the typical one.
const LOOKED_AT: usize = 512;

/// What is known of a level of detail; holds for every placement of the object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// [`VERSION`] of who made it.
    pub version: u32,
    /// Content hash of the object ([`Mesh::sha256`]).
    pub object: String,
    /// Content hash of the mesh that stands for it.
    pub reduced: String,
    /// For each triangle of that mesh: every point of the object lies within this of some triangle.
    pub thickness: Vec<f64>,
    /// For each triangle of that mesh: each of its points lies within this of the object.
    pub deviation: Vec<f64>,
}

/// A certificate as a file, with where to find what it speaks of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Paper {
    /// The object, as it was named.
    pub object_file: String,
    /// The reduced object, beside the certificate.
    pub file: String,
    /// What is certified.
    #[serde(flatten)]
    pub certificate: Certificate,
}

/// Why a certificate is not believed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Doubt {
    /// It speaks of another object.
    #[error("the certificate speaks of another object: its content hash is {0}")]
    OtherObject(String),
    /// It speaks of another mesh.
    #[error("the certificate speaks of another reduced mesh: its content hash is {0}")]
    OtherMesh(String),
    /// Its lengths are none.
    #[error(transparent)]
    Lengths(#[from] LodError),
    /// A point of the object is too far away.
    #[error("the point {1} of the object's triangle {0} is not within the thickness of any triangle")]
    Thickness(u32, Point3<f64>),
    /// A point of the reduced mesh is too far away.
    #[error("the point {1} of the reduced triangle {0} is not within its deviation of the object")]
    Deviation(u32, Point3<f64>),
    /// Nobody wants the rest.
    #[error("it was stopped")]
    Stopped,
}

impl Certificate {
    /// Finds the lengths; `None` when it was stopped.
    pub fn find(object: &Mesh, reduced: &Mesh, watch: &dyn Watch) -> Option<Self> {
        let rounding = Rounding::of([object, reduced]);
        let (on_object, on_reduced) = (Target::new(object, &[]), Target::new(reduced, &[]));
        let enough = enough(object, &on_reduced);
        let effort = |from: &Mesh, to: &Mesh| {
            let each = to.triangles().len() / from.triangles().len();
            Effort { enough, factor: FACTOR, cuts: 12 + 4 * each as u32 }
        };
        let all = |from: &Mesh, to: &Target, effort: Effort| -> Option<Vec<Vec<(u32, f64)>>> {
            let numbers = 0..from.triangles().len() as u32;
            let one = |triangle| {
                let mut owners = Vec::new();
                cover(to, from.corners(triangle), effort, |owner, length| owners.push((owner, length)));
                (!watch.stopped()).then_some(owners)
            };
            numbers.into_par_iter().map(one).collect()
        };
        // Twice: once for what is computed here, once more so that whoever checks has something left for his roundings.
        let up = |length: f64| rounding.up(rounding.up(length));
        let mut thickness = vec![0.0f64; reduced.triangles().len()];
        for (owner, length) in all(object, &on_reduced, effort(object, reduced))?.into_iter().flatten() {
            let own = &mut thickness[owner as usize];
            *own = own.max(up(length));
        }
        let farthest = |owners: Vec<(u32, f64)>| up(owners.iter().map(|(_, length)| *length).fold(0.0, f64::max));
        let deviation = all(reduced, &on_object, effort(reduced, object))?.into_iter().map(farthest).collect();
        Some(Self { version: VERSION, object: object.sha256(), reduced: reduced.sha256(), thickness, deviation })
    }

    /// Shows that the lengths hold, by another search than the one that found them: it knows what to show.
    pub fn check(&self, object: &Mesh, reduced: &Mesh, watch: &dyn Watch) -> Result<(), Doubt> {
        if object.sha256() != self.object {
            return Err(Doubt::OtherObject(self.object.clone()));
        }
        if reduced.sha256() != self.reduced {
            return Err(Doubt::OtherMesh(self.reduced.clone()));
        }
        self.lod(Arc::new(reduced.clone()))?;
        let rounding = Rounding::of([object, reduced]);
        let covered = |from: &Mesh, to: &Target, triangle: u32, spare: f64, doubt: fn(u32, Point3<f64>) -> Doubt| {
            if watch.stopped() {
                return Err(Doubt::Stopped);
            }
            is_covered(to, from.corners(triangle), spare, rounding).map_err(|point| doubt(triangle, point))
        };
        let to = Target::new(reduced, &self.thickness);
        let all = (0..object.triangles().len() as u32).into_par_iter();
        all.try_for_each(|t| covered(object, &to, t, 0.0, Doubt::Thickness))?;
        // Here the length belongs to the triangle that is covered, the same towards all of the object.
        let to = Target::new(object, &[]);
        let all = self.deviation.par_iter().enumerate();
        all.try_for_each(|(t, &g)| covered(reduced, &to, t as u32, g, Doubt::Deviation))
    }

    /// The level of detail that it certifies.
    pub fn lod(&self, reduced: Arc<Mesh>) -> Result<Lod, LodError> {
        Lod::new(Shape::new(reduced), &self.thickness, &self.deviation)
    }

    /// The largest thickness and the largest deviation.
    pub fn worst(&self) -> [f64; 2] {
        [&self.thickness, &self.deviation].map(|lengths| lengths.iter().copied().fold(0.0, f64::max))
    }
}

/// Below what lengths need not be made smaller: a share of what some of the object's corners deviate in the mean.
fn enough(object: &Mesh, reduced: &Target) -> f64 {
    let step = object.triangles().len().div_ceil(LOOKED_AT);
    let corners: Vec<Point3<f64>> =
        object.triangles().iter().step_by(step).map(|t| object.positions()[t[0] as usize]).collect();
    let sum: f64 = corners.iter().map(|p| reduced.best(std::slice::from_ref(p), 0).excess).sum();
    (ENOUGH.0 * sum / corners.len() as f64).max(ENOUGH.1 * object.longest_side())
}
