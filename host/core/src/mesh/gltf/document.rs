//! The JSON of a glTF document, as far as it says where triangles are. Names are those of the specification.

use std::borrow::Cow;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::container::Parts;
use crate::mesh::read::words::shown;
use crate::mesh::read::{Place, ReadError};

/// Most values (entries of lists and objects) of a document; a node with its matrix has some thirty.
const MOST_VALUES: usize = 4_000_000;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Document<'a> {
    #[serde(borrow)]
    asset: Asset<'a>,
    pub scene: Option<u32>,
    #[serde(default)]
    pub scenes: Vec<Scene>,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Mesh>,
    #[serde(default)]
    pub accessors: Vec<Accessor<'a>>,
    #[serde(default)]
    pub buffer_views: Vec<View>,
    #[serde(default)]
    pub buffers: Vec<Buffer<'a>>,
    #[serde(default, borrow)]
    extensions_required: Vec<Cow<'a, str>>,
}

#[derive(Deserialize)]
struct Asset<'a> {
    #[serde(borrow)]
    version: Cow<'a, str>,
}

#[derive(Deserialize)]
pub struct Scene {
    #[serde(default)]
    pub nodes: Vec<u32>,
}

/// A frame within that of its parent: the matrix (by columns), or rotation (x, y, z, w) and scale before translation.
#[derive(Deserialize)]
pub struct Node {
    #[serde(default)]
    pub children: Vec<u32>,
    pub mesh: Option<u32>,
    pub skin: Option<u32>,
    pub matrix: Option<Box<[f64; 16]>>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    #[serde(default)]
    pub extensions: NodeExtensions,
}

#[derive(Default, Deserialize)]
pub struct NodeExtensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instancing: Option<IgnoredAny>,
}

#[derive(Deserialize)]
pub struct Mesh {
    pub primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
pub struct Primitive {
    pub attributes: Attributes,
    pub indices: Option<u32>,
    #[serde(default = "triangles")]
    pub mode: u32,
    pub targets: Option<IgnoredAny>,
    #[serde(default)]
    pub extensions: PrimitiveExtensions,
}

fn triangles() -> u32 {
    4
}

#[derive(Deserialize)]
pub struct Attributes {
    #[serde(rename = "POSITION")]
    pub position: Option<u32>,
}

#[derive(Default, Deserialize)]
pub struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub draco: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Accessor<'a> {
    pub buffer_view: Option<u32>,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    pub count: u64,
    #[serde(rename = "type", borrow)]
    pub kind: Cow<'a, str>,
    pub sparse: Option<Box<Sparse>>,
}

/// Elements that differ from those of the view.
#[derive(Deserialize)]
pub struct Sparse {
    pub count: u64,
    pub indices: SparsePart,
    pub values: SparsePart,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SparsePart {
    pub buffer_view: u32,
    #[serde(default)]
    pub byte_offset: u64,
    /// Of the indices; values have the type of their accessor.
    pub component_type: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct View {
    pub buffer: u32,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: Option<u64>,
    #[serde(default)]
    pub extensions: ViewExtensions,
}

#[derive(Default, Deserialize)]
pub struct ViewExtensions {
    #[serde(rename = "EXT_meshopt_compression", alias = "KHR_meshopt_compression")]
    pub meshopt: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Buffer<'a> {
    #[serde(borrow)]
    pub uri: Option<Cow<'a, str>>,
    pub byte_length: u64,
}

impl Document<'_> {
    /// Extensions that the file calls required and that may change the surface.
    pub fn unknown_extensions(&self) -> impl Iterator<Item = String> {
        const HARMLESS: [&str; 5] =
            ["KHR_materials_", "KHR_texture_", "KHR_lights_", "KHR_mesh_quantization", "EXT_texture_"];
        let known = |name: &str| HARMLESS.iter().any(|harmless| name.starts_with(harmless));
        self.extensions_required.iter().filter(move |name| !known(name)).map(|name| shown(name))
    }
}

/// Reads the document of a file.
pub fn read<'a>(parts: &Parts<'a>) -> Result<Document<'a>, ReadError> {
    let at = |byte: usize| match parts.json_at {
        Some(start) => Place::Byte(start + byte),
        None => Place::Line(1 + parts.json[..byte].iter().filter(|&&b| b == b'\n').count()),
    };
    if let Some(byte) = too_many_values(parts.json) {
        return Err(
            at(byte).has(format!("more than {MOST_VALUES} values in the document; join its nodes into fewer meshes"))
        );
    }
    let document: Document = serde_json::from_slice(parts.json).map_err(|e| {
        let said = e.to_string();
        let reason: String =
            said.split(" at line ").next().unwrap_or_default().chars().filter(|c| !c.is_control()).take(120).collect();
        let start = parts
            .json
            .split_inclusive(|&b| b == b'\n')
            .take(e.line().saturating_sub(1))
            .map(<[u8]>::len)
            .sum::<usize>();
        let what = if e.is_data() { "this is no glTF document" } else { "this is no complete JSON" };
        at((start + e.column().saturating_sub(1)).min(parts.json.len()))
            .has(format!("{what} ({reason}); export the object again"))
    })?;
    if !document.asset.version.starts_with("2.") {
        let version = shown(&document.asset.version);
        return Err(Place::Entry("asset.version".into())
            .has(format!("version '{version}' is not read; export the object as glTF 2.0")));
    }
    Ok(document)
}

/// The byte of the first value too many. Counted before parsing, since an entry takes more room in memory than in the file.
fn too_many_values(json: &[u8]) -> Option<usize> {
    let (mut values, mut inside, mut escaped) = (0, false, false);
    for (at, &byte) in json.iter().enumerate() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if inside => escaped = true,
            b'"' => inside = !inside,
            b',' | b'{' | b'[' if !inside => values += 1,
            _ => {}
        }
        if values > MOST_VALUES {
            return Some(at);
        }
    }
    None
}
