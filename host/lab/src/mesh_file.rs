//! The file in which a mesh is stored and sent to measuring machines: magic, counts (u32), coordinates (f64), indices (u32), all
//! little-endian.

use nalgebra::Point3;
use ocb_core::mesh::Mesh;

use crate::{LabError, Result};

const MAGIC: &[u8; 8] = b"OCBMESH1";

/// The bytes of a mesh.
pub fn to_bytes(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend((mesh.positions().len() as u32).to_le_bytes());
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    bytes.extend(
        mesh.positions().iter().flat_map(|p| p.coords.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>()),
    );
    bytes.extend(mesh.triangles().iter().flatten().flat_map(|i| i.to_le_bytes()));
    bytes
}

/// The mesh in these bytes; an error when they are damaged.
pub fn from_bytes(bytes: &[u8]) -> Result<Mesh> {
    let damaged = || LabError::Fault("A stored mesh is damaged; restore the blobs from a backup.".into());
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(damaged)?;
    let (vertices, rest) = rest.split_first_chunk::<4>().ok_or_else(damaged)?;
    let (triangles, rest) = rest.split_first_chunk::<4>().ok_or_else(damaged)?;
    let (vertices, triangles) = (u32::from_le_bytes(*vertices) as usize, u32::from_le_bytes(*triangles) as usize);
    if rest.len() != vertices * 24 + triangles * 12 {
        return Err(damaged());
    }
    let (positions, indices) = rest.split_at(vertices * 24);
    let coordinate = |c: &[u8]| f64::from_le_bytes(c.try_into().expect("eight bytes"));
    let index = |c: &[u8]| u32::from_le_bytes(c.try_into().expect("four bytes"));
    let point = |c: &[u8]| Point3::new(coordinate(&c[..8]), coordinate(&c[8..16]), coordinate(&c[16..]));
    let corners = |c: &[u8]| [index(&c[..4]), index(&c[4..8]), index(&c[8..])];
    Mesh::new(positions.chunks_exact(24).map(point).collect(), indices.chunks_exact(12).map(corners).collect())
        .map_err(|_| damaged())
}

#[test]
fn a_mesh_comes_back_bit_for_bit() {
    let mesh = ocb_core::stock::generate("box", 500).unwrap();
    assert_eq!(from_bytes(&to_bytes(&mesh)).unwrap(), mesh);
    assert!(from_bytes(&to_bytes(&mesh)[1..]).is_err());
}
