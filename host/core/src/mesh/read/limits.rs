//! How much of a file is read, the same for every format.

/// Longest file that is read, in bytes.
pub const MAX_BYTES: usize = 256 << 20;
/// Most vertices in a file.
pub const MAX_VERTICES: usize = 5_000_000;
/// Most triangles in a file, after its polygons are cut and its instances are placed.
pub const MAX_TRIANGLES: usize = 10_000_000;
/// Longest line of a text in bytes, continuation lines included.
pub const MAX_LINE_BYTES: usize = 1 << 20;
/// Most corners of one face.
pub const MAX_CORNERS: usize = 10_000;
