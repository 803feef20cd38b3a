//! glTF 2.0 binary.

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Stride, Target, View};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::{Checked, USize64};
use gltf_json::{Accessor, Index, Root};
use serde_json::{json, value::RawValue};

use super::Legend;
use crate::colormap;
use crate::heatmap::VertexValues;
use crate::mesh::Mesh;

/// The bare geometry: POSITION (f32) and indices (u32), in the mesh's order. three.js computes normals itself.
pub fn geometry(mesh: &Mesh) -> Vec<u8> {
    let mut file = File::new(mesh);
    file.positions(mesh);
    file.indices(mesh);
    file.finish("OpenCollBench object", None)
}

/// Geometry with a heatmap on it.
///
/// Besides [`geometry`]: `COLOR_0` (u16 normalised, **linear** light as glTF asks, grey where there is no value),
/// `_VALUE` (f32, NaN-free: see `no_value`) and `_COUNT` (f32, values that went in). `extras.ocb` of the mesh holds the
/// legend.
pub fn heatmap(mesh: &Mesh, values: &VertexValues, legend: &Legend) -> Vec<u8> {
    let mut file = File::new(mesh);
    file.positions(mesh);
    file.indices(mesh);
    let colors: Vec<u8> = values
        .values
        .iter()
        .flat_map(|&v| {
            let [r, g, b] = colormap::color(legend.colormap, legend.scale, v, legend.range).map(linear_u16);
            [r, g, b, u16::MAX]
        })
        .flat_map(u16::to_le_bytes)
        .collect();
    file.attribute(Semantic::Colors(0), Type::Vec4, ComponentType::U16, true, &colors);
    let raw: Vec<u8> =
        values.values.iter().flat_map(|v| (v.unwrap_or(no_value(legend)) as f32).to_le_bytes()).collect();
    file.attribute(Semantic::Extras("VALUE".into()), Type::Scalar, ComponentType::F32, false, &raw);
    let counts: Vec<u8> = values.counts.iter().flat_map(|&c| (c as f32).to_le_bytes()).collect();
    file.attribute(Semantic::Extras("COUNT".into()), Type::Scalar, ComponentType::F32, false, &counts);
    file.finish("OpenCollBench heatmap", Some(json!({ "ocb": legend_json(legend) })))
}

/// `_VALUE` of a vertex without a value; the legend says it. glTF forbids NaN; no measure or statistic is negative, and
/// no difference is as low as the lowest number.
fn no_value(legend: &Legend) -> f64 {
    if legend.against.is_none() { -1.0 } else { f64::from(f32::MIN) }
}

fn legend_json(legend: &Legend) -> serde_json::Value {
    let mut known = json!({
        "run": legend.run, "algorithm": legend.algorithm, "measure": legend.measure, "statistic": legend.statistic,
        "outliers": legend.outliers, "unit": legend.unit, "range": legend.range, "scale": legend.scale,
        "colormap": legend.colormap, "n": legend.n, "no_value": no_value(legend),
    });
    for (key, value) in [("against", &legend.against), ("where", &legend.selection)] {
        if let Some(value) = value {
            known[key] = json!(value);
        }
    }
    known
}

/// An sRGB component as linear light, 0 to 65535 (IEC 61966-2-1).
fn linear_u16(component: u8) -> u16 {
    let s = f64::from(component) / 255.0;
    let linear = if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) };
    (linear * 65535.0).round() as u16
}

/// One mesh of one primitive, growing attribute by attribute.
struct File {
    root: Root,
    primitive: Primitive,
    /// The one buffer; every view in it starts at a multiple of 4.
    bytes: Vec<u8>,
    buffer: Index<gltf_json::Buffer>,
    vertices: usize,
}

impl File {
    fn new(mesh: &Mesh) -> Self {
        let mut root = Root::default();
        root.asset.generator = Some(concat!("OpenCollBench ", env!("CARGO_PKG_VERSION")).into());
        let buffer = root.push(gltf_json::Buffer {
            byte_length: USize64(0),
            name: None,
            uri: None,
            extensions: None,
            extras: None,
        });
        let primitive = Primitive {
            attributes: Default::default(),
            extensions: None,
            extras: None,
            indices: None,
            material: None,
            mode: Checked::Valid(Mode::Triangles),
            targets: None,
        };
        Self { root, primitive, bytes: Vec::new(), buffer, vertices: mesh.positions().len() }
    }

    fn positions(&mut self, mesh: &Mesh) {
        let single: Vec<[f32; 3]> = mesh.positions().iter().map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
        // glTF wants the extent of all vertices as stored, used by a triangle or not.
        let lo = single.iter().fold([f32::INFINITY; 3], |a, p| [0, 1, 2].map(|k| a[k].min(p[k])));
        let hi = single.iter().fold([f32::NEG_INFINITY; 3], |a, p| [0, 1, 2].map(|k| a[k].max(p[k])));
        let bytes: Vec<u8> = single.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let accessor = self.attribute(Semantic::Positions, Type::Vec3, ComponentType::F32, false, &bytes);
        let accessor = &mut self.root.accessors[accessor.value()];
        accessor.min = Some(json!(lo));
        accessor.max = Some(json!(hi));
    }

    fn indices(&mut self, mesh: &Mesh) {
        let bytes: Vec<u8> = mesh.triangles().iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, None, Target::ElementArrayBuffer);
        let count = 3 * mesh.triangles().len();
        self.primitive.indices = Some(self.accessor(view, count, Type::Scalar, ComponentType::U32, false));
    }

    fn attribute(
        &mut self,
        name: Semantic,
        kind: Type,
        component: ComponentType,
        normalized: bool,
        bytes: &[u8],
    ) -> Index<Accessor> {
        let view = self.view(bytes, Some(bytes.len() / self.vertices), Target::ArrayBuffer);
        let accessor = self.accessor(view, self.vertices, kind, component, normalized);
        self.primitive.attributes.insert(Checked::Valid(name), accessor);
        accessor
    }

    fn view(&mut self, bytes: &[u8], stride: Option<usize>, target: Target) -> Index<View> {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.root.push(View {
            buffer: self.buffer,
            byte_length: bytes.len().into(),
            byte_offset: Some(offset.into()),
            byte_stride: stride.map(Stride),
            name: None,
            target: Some(Checked::Valid(target)),
            extensions: None,
            extras: None,
        })
    }

    fn accessor(
        &mut self,
        view: Index<View>,
        count: usize,
        kind: Type,
        component: ComponentType,
        normalized: bool,
    ) -> Index<Accessor> {
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: count.into(),
            component_type: Checked::Valid(GenericComponentType(component)),
            type_: Checked::Valid(kind),
            min: None,
            max: None,
            name: None,
            normalized,
            sparse: None,
            extensions: None,
            extras: None,
        })
    }

    /// Header, JSON chunk and binary chunk.
    fn finish(mut self, name: &str, extras: Option<serde_json::Value>) -> Vec<u8> {
        self.root.buffers[self.buffer.value()].byte_length = self.bytes.len().into();
        let extras = extras.map(|e| RawValue::from_string(e.to_string()).expect("just serialised"));
        let mesh = self.root.push(gltf_json::Mesh {
            extensions: None,
            extras,
            name: Some(name.into()),
            primitives: vec![self.primitive],
            weights: None,
        });
        let node = self.root.push(gltf_json::Node { mesh: Some(mesh), ..Default::default() });
        let scene = self.root.push(gltf_json::Scene { extensions: None, extras: None, name: None, nodes: vec![node] });
        self.root.scene = Some(scene);

        let mut json = self.root.to_vec().expect("the document holds only strings and finite numbers");
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut glb = Vec::with_capacity(28 + json.len() + self.bytes.len());
        let word = |n: usize| u32::try_from(n).expect("a mesh within the caps stays below 4 GiB").to_le_bytes();
        glb.extend(b"glTF");
        glb.extend(word(2));
        glb.extend(word(28 + json.len() + self.bytes.len()));
        glb.extend(word(json.len()));
        glb.extend(b"JSON");
        glb.extend(json);
        glb.extend(word(self.bytes.len()));
        glb.extend(b"BIN\0");
        glb.extend(self.bytes);
        glb
    }
}
