//! The objects of a run as they are measured.

use std::sync::Arc;

use ocb_core::mesh::Mesh;
use ocb_core::oracle::Shape;

/// The two objects, and whether they are one.
pub struct Pairing {
    /// Object A.
    pub mesh_a: Arc<Mesh>,
    /// Object B.
    pub mesh_b: Arc<Mesh>,
    /// Object A as the oracle sees it.
    pub a: Shape,
    /// Object B.
    pub b: Shape,
    /// A and B are the same object.
    pub same: bool,
}
