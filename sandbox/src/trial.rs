//! The trial file: what the runner is started for, sealed against every writer but the supervisor before it starts.

use ocb_core::query::Semantics;
use serde::{Deserialize, Serialize};

use crate::launcher::Objects;
use crate::protocol::answer;

/// Head of the trial file: what the runner needs to know beside the meshes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialHead {
    /// Id of the algorithm.
    pub algorithm: String,
    /// Parameters by name.
    pub parameters: Vec<(String, f64)>,
    /// What counts as an object.
    pub semantics: Semantics,
    /// How many triangles A and B have, for tests per triangle; absent for a scene of many objects.
    pub triangles: Option<[u32; 2]>,
}

/// Where a mesh lies in the trial file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshPlace {
    /// Number of vertices.
    pub vertices: u32,
    /// Number of triangles.
    pub triangles: u32,
    /// Byte offset of the positions, 3 f64 each.
    pub positions_at: usize,
    /// Byte offset of the triangles, 3 u32 each.
    pub triangles_at: usize,
}

/// What the trial file holds: its head from the start, and each mesh from the moment on at which it is to be built, so that
/// nothing can be prepared for it before.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Length of the head, head.
    pub head: Vec<u8>,
    /// The meshes.
    pub meshes: Vec<Part>,
    /// How many triangles A and B have; the same mesh may be both. 0 for a scene, in which nothing is counted.
    pub triangles: [u32; 2],
    /// Bytes of the whole file.
    pub len: usize,
    /// Bytes of the answer file.
    pub answer_bytes: usize,
}

/// A stretch of the trial file that is not there from the start.
#[derive(Clone, Debug)]
pub struct Part {
    /// Where, each array at a multiple of 64.
    pub place: MeshPlace,
    /// What comes there, from the positions on.
    pub bytes: Vec<u8>,
}

impl Sheet {
    /// A trial without objects.
    pub fn empty(algorithm: &str, parameters: &[(String, f64)]) -> Self {
        Self::new(algorithm, parameters, Semantics::Surface, &Objects::Scene(&[]))
    }

    /// The trial of these objects, each part at a multiple of 64 bytes.
    pub fn new(algorithm: &str, parameters: &[(String, f64)], semantics: Semantics, objects: &Objects<'_>) -> Self {
        const HEAD_ROOM: usize = 1 << 10;
        let align = |n: usize| n.next_multiple_of(64);
        let named = algorithm.len() + parameters.iter().map(|(name, _)| name.len() + 64).sum::<usize>();
        // JSON writes one byte in six at worst.
        let mut at = align(8 + HEAD_ROOM + 6 * named);
        let mut parts: Vec<Part> = Vec::new();
        for mesh in objects.meshes() {
            let positions_at = at;
            let triangles_at = align(positions_at + 24 * mesh.positions().len());
            at = align(triangles_at + 12 * mesh.triangles().len());
            let (vertices, triangles) = (mesh.positions().len() as u32, mesh.triangles().len() as u32);
            let place = MeshPlace { vertices, triangles, positions_at, triangles_at };
            let mut bytes = vec![0; at - positions_at];
            let coordinates = mesh.positions().iter().flat_map(|p| [p.x, p.y, p.z]);
            for (to, x) in bytes.chunks_exact_mut(8).zip(coordinates) {
                to.copy_from_slice(&x.to_le_bytes());
            }
            let corners = mesh.triangles().iter().flatten();
            for (to, corner) in bytes[triangles_at - positions_at..].chunks_exact_mut(4).zip(corners) {
                to.copy_from_slice(&corner.to_le_bytes());
            }
            parts.push(Part { place, bytes });
        }
        let triangles = match (objects, &parts[..]) {
            (Objects::Pair(..), [a, .., b]) => Some([a, b].map(|part| part.place.triangles)),
            (Objects::Pair(..), [a]) => Some([a.place.triangles; 2]),
            _ => None,
        };
        let head = TrialHead { algorithm: algorithm.into(), parameters: parameters.to_vec(), semantics, triangles };
        let triangles = triangles.unwrap_or_default();
        let json = serde_json::to_vec(&head).expect("plain data is always JSON");
        let head = [&(json.len() as u64).to_le_bytes()[..], &json].concat();
        Sheet { head, meshes: parts, triangles, len: at, answer_bytes: answer::bytes(triangles) }
    }

    /// Bytes for a program that does one piece of work: their number, then they.
    pub fn of_bytes(bytes: &[u8], answer_bytes: usize) -> Self {
        let head = [&(bytes.len() as u64).to_le_bytes()[..], bytes].concat();
        let len = head.len().next_multiple_of(64);
        Sheet { head, meshes: Vec::new(), triangles: [0; 2], len, answer_bytes }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;
    use ocb_core::mesh::Mesh;

    use super::*;

    #[test]
    fn a_trial_says_where_its_meshes_lie() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]].map(Point3::from).to_vec();
        let mesh = Mesh::new(corners, vec![[0, 1, 2]]).unwrap();
        let parameters = [("\u{1}\"é".repeat(30), 0.5)];
        let sheet = Sheet::new("box-tree", &parameters, Semantics::Surface, &Objects::Pair(&mesh, Some(&mesh)));
        let mut bytes = vec![0; sheet.len];
        bytes[..sheet.head.len()].copy_from_slice(&sheet.head);
        for part in &sheet.meshes {
            bytes[part.place.positions_at..][..part.bytes.len()].copy_from_slice(&part.bytes);
        }
        let len = u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
        let head: TrialHead = serde_json::from_slice(&bytes[8..8 + len]).unwrap();
        assert_eq!(
            (head.algorithm.as_str(), &head.parameters[..], head.triangles),
            ("box-tree", &parameters[..], Some([1, 1]))
        );
        assert_eq!(sheet.meshes.len(), 2);
        for Part { place, .. } in sheet.meshes {
            assert!(place.positions_at.is_multiple_of(64) && place.positions_at >= 8 + len);
            assert!(place.triangles_at >= place.positions_at + 24 * 3);
            let y = &bytes[place.positions_at + 7 * 8..][..8];
            assert_eq!(y, 2.0f64.to_le_bytes());
            assert_eq!(bytes[place.triangles_at..][..12], [0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
        }
    }
}
