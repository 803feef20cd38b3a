//! The two objects of a run, in the numbers that each algorithm gets.
//!
//! Algorithms in double precision get the numbers of the file. Those that declare single precision get each coordinate rounded
//! to it, and their answers are judged by the truth about these numbers. Where rounding changes no coordinate, both are one.

use std::sync::Arc;

use ocb_core::configuration::Placed;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::validation::Precision;

/// Both objects in the numbers of one precision.
pub struct Sides {
    /// Object A.
    pub mesh_a: Arc<Mesh>,
    /// Object B.
    pub mesh_b: Arc<Mesh>,
    /// Object A as the oracle sees it.
    pub a: Shape,
    /// Object B.
    pub b: Shape,
}

/// The two objects, and whether they are one.
pub struct Pairing {
    /// In the numbers of the files.
    pub exact: Sides,
    /// Rounded to single precision; absent where that changes no coordinate, or is not possible.
    pub rounded: Option<Sides>,
    /// Rounding leaves an object no triangle with area, so algorithms in single precision cannot be asked.
    pub flattened: bool,
    /// A and B are the same object.
    pub same: bool,
}

impl Sides {
    fn new(mesh_a: Arc<Mesh>, mesh_b: Arc<Mesh>) -> Self {
        Self { a: Shape::new(mesh_a.clone()), b: Shape::new(mesh_b.clone()), mesh_a, mesh_b }
    }

    /// For the oracle.
    pub fn pair(&self) -> Pair<'_> {
        Pair::new(&self.a, &self.b)
    }
}

impl Pairing {
    /// B is A where there is no second object.
    pub fn new(mesh_a: Arc<Mesh>, mesh_b: Option<Arc<Mesh>>) -> Self {
        let same = mesh_b.is_none();
        let mesh_b = mesh_b.unwrap_or_else(|| mesh_a.clone());
        let (mut rounded, mut flattened) = (None, false);
        if !(mesh_a.is_f32_representable() && mesh_b.is_f32_representable()) {
            match (rounding(&mesh_a), rounding(&mesh_b)) {
                (Some(a), Some(b)) => rounded = Some(Sides::new(a, b)),
                (None, _) | (_, None) => flattened = true,
            }
        }
        Self { exact: Sides::new(mesh_a, mesh_b), rounded, flattened, same }
    }

    /// The objects as an algorithm of this arithmetic gets them.
    pub fn seen_in(&self, precision: Precision) -> &Sides {
        match (precision, &self.rounded) {
            (Precision::Single, Some(rounded)) => rounded,
            (Precision::Single, None) | (Precision::Double, _) => &self.exact,
        }
    }

    /// The configuration with the truth about the rounded objects as well, where there are such.
    pub fn certified(&self, placed: Placed) -> Placed {
        Placed { rounded: self.rounded.as_ref().map(|it| it.pair().truth(&placed.configuration)), ..placed }
    }
}

/// The mesh in single precision; nothing where no triangle with area is left.
pub(crate) fn rounding(mesh: &Mesh) -> Option<Arc<Mesh>> {
    mesh.clone().to_f32_representable().ok().map(Arc::new)
}
