//! Objects.

use ocb_core::mesh::{FileFormat, LengthUnit};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::Visibility;

/// An object as the lists show it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ObjectInfo {
    /// Stable id: `stock:<name>` for stock objects, otherwise a UUID.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Triangle count.
    pub triangles: u32,
    /// Vertex count.
    pub vertices: u32,
    /// Axis-aligned bounding box: minimum x y z, maximum x y z.
    pub bounds: [f64; 6],
    /// SHA-256 (hex) of the mesh (positions, then triangles, little-endian).
    pub sha256: String,
    /// Where it comes from and under which terms.
    pub terms: String,
    /// Ships with the service.
    pub stock: bool,
    /// Every edge has exactly two triangles.
    pub closed: bool,
    /// Format of the file that it was read from; absent for generated objects, and for those added before it was recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<FileFormat>,
    /// Unit of the coordinates, where the file states one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// What single precision changes; absent where it holds all coordinates exactly.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounding: Option<Rounding>,
    /// What was noticed and mended while reading (one sentence each).
    pub warnings: Vec<String>,
    /// When it was added.
    pub created_us: i64,
    /// Who sees it.
    #[serde(default)]
    #[schema(required = true)]
    pub visibility: Visibility,
    /// Added by the caller, who decides who sees it.
    #[serde(default)]
    #[schema(required = true)]
    pub mine: bool,
}

/// What rounding the coordinates to single precision does to an object. Algorithms in single precision get the rounded
/// coordinates, all others those of the file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Rounding {
    /// A coordinate changes by so much at most.
    pub moves: f64,
    /// Triangles with area that lose it.
    pub collapsed: u32,
    /// No triangle with area is left, so algorithms in single precision cannot be asked.
    pub flattens: bool,
}
