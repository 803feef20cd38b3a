//! The nodes of a scene, from its roots down, and the triangles of their meshes.

use std::collections::HashMap;

use nalgebra::{Matrix4, Point3, Quaternion, Translation3, UnitQuaternion};

use super::data::{Buffers, entry};
use super::document::{Document, Node, Primitive};
use crate::mesh::read::limits::{MAX_TRIANGLES, MAX_VERTICES};
use crate::mesh::read::placing::Placing;
use crate::mesh::read::surface::Surface;
use crate::mesh::read::{Contents, Fault, Place, ReadError};

/// Most primitives that nodes place, empty ones included.
const MOST_PRIMITIVES: usize = 1_000_000;
const TWICE: &str = "it is reached twice, but a node has one parent; export the object again";
const TWICE_BELOW: &str = "a node below is reached twice, but a node has one parent; export the object again";

/// The default scene, or the first one; all nodes without a parent where the file has no scenes.
pub fn flatten(document: &Document<'_>, buffers: &Buffers<'_>, warnings: Vec<String>) -> Result<Contents, ReadError> {
    let mut flat = Flat { document, buffers, surface: Surface::default(), primitives: 0, not_read: NotRead::default() };
    let roots = roots(document)?;
    if roots.len() > document.nodes.len() {
        return Err(Place::Entry("scenes".into()).has(TWICE_BELOW));
    }
    let mut open: Vec<(u32, Placing)> = roots.into_iter().rev().map(|root| (root, Placing::none())).collect();
    let mut seen = vec![false; document.nodes.len()];
    while let Some((index, parent)) = open.pop() {
        let at = entry("nodes", index);
        let node = document.nodes.get(index as usize);
        let node = node.ok_or_else(|| at.clone().has("it is named, but not there; export the object again"))?;
        if std::mem::replace(&mut seen[index as usize], true) {
            return Err(at.has(TWICE));
        }
        // Refused here, lists that name a node a million times take no memory.
        if open.len() + node.children.len() > document.nodes.len() {
            return Err(at.has(TWICE_BELOW));
        }
        let placing = parent.within(&local(node));
        flat.node(index, node, &placing)?;
        open.extend(node.children.iter().rev().map(|&child| (child, placing)));
    }
    flat.finish(warnings)
}

fn roots(document: &Document<'_>) -> Result<Vec<u32>, ReadError> {
    if document.scenes.is_empty() {
        let mut is_child = vec![false; document.nodes.len()];
        for &child in document.nodes.iter().flat_map(|node| &node.children) {
            if let Some(known) = is_child.get_mut(child as usize) {
                *known = true;
            }
        }
        return Ok((0u32..).zip(is_child).filter(|&(_, is_child)| !is_child).map(|(i, _)| i).collect());
    }
    let index = document.scene.unwrap_or(0);
    let scene = document.scenes.get(index as usize);
    let scene =
        scene.ok_or_else(|| entry("scenes", index).has("it is named, but not there; export the object again"))?;
    Ok(scene.nodes.clone())
}

/// A node's own transform.
fn local(node: &Node) -> Matrix4<f64> {
    if let Some(matrix) = &node.matrix {
        return Matrix4::from_column_slice(&matrix[..]);
    }
    let mut matrix = Matrix4::identity();
    if let Some(by) = node.translation {
        matrix *= Translation3::from(by).to_homogeneous();
    }
    if let Some([x, y, z, w]) = node.rotation.filter(|r| *r != [0.0, 0.0, 0.0, 1.0]) {
        matrix *= UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_homogeneous();
    }
    if let Some([x, y, z]) = node.scale {
        matrix *= Matrix4::from_diagonal(&[x, y, z, 1.0].into());
    }
    matrix
}

/// What a scene has besides triangles.
#[derive(Default)]
struct NotRead {
    /// Points and lines, and primitives without positions.
    primitives: usize,
    skins: usize,
    morphs: usize,
}

struct Flat<'a> {
    document: &'a Document<'a>,
    buffers: &'a Buffers<'a>,
    surface: Surface,
    primitives: usize,
    not_read: NotRead,
}

impl Flat<'_> {
    fn node(&mut self, index: u32, node: &Node, placing: &Placing) -> Result<(), ReadError> {
        if node.extensions.instancing.is_some() {
            return Err(entry("nodes", index)
                .has("its instances (EXT_mesh_gpu_instancing) are not read; export each instance as a node"));
        }
        let Some(number) = node.mesh else { return Ok(()) };
        let mesh = self.document.meshes.get(number as usize);
        let mesh =
            mesh.ok_or_else(|| entry("meshes", number).has("it is named, but not there; export the object again"))?;
        self.not_read.skins += usize::from(node.skin.is_some());
        // Primitives that differ in their material alone share their vertices.
        let mut first_of = HashMap::new();
        for primitive in &mesh.primitives {
            self.primitives += 1;
            if self.primitives > MOST_PRIMITIVES {
                return Err(entry("nodes", index).has(format!(
                    "the scene places more than {MOST_PRIMITIVES} primitives; join them into fewer meshes"
                )));
            }
            self.primitive(number, primitive, placing, &mut first_of)?;
        }
        Ok(())
    }

    /// `first_of` holds the first vertex and the number of vertices of each accessor of positions of the mesh at hand.
    fn primitive(
        &mut self,
        mesh: u32,
        primitive: &Primitive,
        placing: &Placing,
        first_of: &mut HashMap<u32, (u32, usize)>,
    ) -> Result<(), ReadError> {
        if primitive.extensions.draco.is_some() {
            return Err(entry("meshes", mesh)
                .has("it is compressed by Draco, which is not read; export the object without compression"));
        }
        let (Some(position), 4..=6) = (primitive.attributes.position, primitive.mode) else {
            self.not_read.primitives += 1;
            return Ok(());
        };
        self.not_read.morphs += usize::from(primitive.targets.is_some());
        let (first, count) = match first_of.get(&position) {
            Some(&known) => known,
            None => {
                let points = self.buffers.elements::<3>(position, "VEC3", (MAX_VERTICES, Fault::TooManyVertices))?;
                let added = placing.vertices(points.iter().map(|&p| Point3::from(p)), &mut self.surface);
                let first = added.map_err(|fault| entry("accessors", position).has(fault))?;
                *first_of.entry(position).insert_entry((first, points.len())).get()
            }
        };
        let (at, corners) = match primitive.indices {
            None => (entry("accessors", position), (0..count as u32).map(f64::from).collect()),
            Some(indices) => {
                let most = (3 * MAX_TRIANGLES, Fault::TooManyTriangles);
                let corners = self.buffers.elements::<1>(indices, "SCALAR", most)?;
                (entry("accessors", indices), corners.into_iter().map(|[i]| i).collect::<Vec<f64>>())
            }
        };
        if let Some(&index) = corners.iter().find(|&&i| !(i >= 0.0 && i < count as f64)) {
            return Err(at.has(Fault::NoSuchVertex { index: index as i64, vertices: count }));
        }
        if primitive.mode == 4 && corners.len() % 3 != 0 {
            let found = corners.len();
            return Err(at.has(format!("triangles have 3 corners each, but here are {found}; export the object again")));
        }
        for mut triangle in triangles(&corners, primitive.mode) {
            triangle.iter_mut().for_each(|corner| *corner += first);
            placing.face(&mut triangle, &mut self.surface).map_err(|fault| at.clone().has(fault))?;
        }
        Ok(())
    }

    fn finish(self, mut warnings: Vec<String>) -> Result<Contents, ReadError> {
        if self.surface.triangles() == 0 {
            return Err(ReadError::Whole(
                "the scene of the glTF file shows no triangles; export it with its meshes".into(),
            ));
        }
        if self.document.scenes.len() > 1 {
            let count = self.document.scenes.len();
            warnings.push(format!("Read scene {} (from 0) of {count} scenes.", self.document.scene.unwrap_or(0)));
        }
        let NotRead { primitives, skins, morphs } = self.not_read;
        for (count, what) in [
            (primitives, "primitive(s) without triangles: points and lines are not surfaces"),
            (skins, "skin(s): the meshes are in the pose they were bound in"),
            (morphs, "set(s) of morph targets: the meshes are in their basic shape"),
        ] {
            if count > 0 {
                warnings.push(format!("Skipped {count} {what}."));
            }
        }
        for name in self.document.unknown_extensions().take(4) {
            warnings.push(format!("The file requires the extension '{name}', which is not read."));
        }
        Ok((self.surface.finish(&mut warnings)?, warnings))
    }
}

/// The triangles of a list (mode 4), a strip (5) or a fan (6), as the specification winds them.
fn triangles(corners: &[f64], mode: u32) -> impl Iterator<Item = [u32; 3]> {
    let count = if mode == 4 { corners.len() / 3 } else { corners.len().saturating_sub(2) };
    (0..count).map(move |i| {
        let places = match mode {
            4 => [3 * i, 3 * i + 1, 3 * i + 2],
            5 => [i, i + 1 + i % 2, i + 2 - i % 2],
            _ => [i + 1, i + 2, 0],
        };
        places.map(|k| corners[k] as u32)
    })
}
