//! Writing PLY.

use crate::mesh::Mesh;

/// The mesh as binary little-endian PLY with positions of double precision; [`read`](crate::mesh::read()) gives back the same mesh,
/// bit for bit. The same mesh gives the same bytes.
pub fn write(mesh: &Mesh) -> Vec<u8> {
    let (positions, triangles) = (mesh.positions(), mesh.triangles());
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        positions.len(),
        triangles.len()
    )
    .into_bytes();
    bytes.reserve(24 * positions.len() + 13 * triangles.len());
    for coordinate in positions.iter().flat_map(|p| [p.x, p.y, p.z]) {
        bytes.extend(coordinate.to_le_bytes());
    }
    for triangle in triangles {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|corner| corner.to_le_bytes()));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use crate::{mesh, stock};

    #[test]
    fn a_written_mesh_is_read_back_bit_for_bit() {
        let knot = stock::generate("torus-knot", 600).expect("a stock object");
        let bytes = super::write(&knot);
        assert_eq!(mesh::read(&bytes).expect("a mesh").mesh, knot);
    }
}
