//! glTF 2.0 binary.

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::Legend;
use crate::colormap;
use crate::heatmap::VertexValues;
use crate::mesh::{Aabb, Mesh};

/// The bare geometry: POSITION (f32) and indices (u32), in the mesh's order. three.js computes normals itself.
///
/// Of a small object far from the origin f32 would lose the detail. Its positions count from the middle of its box, which is the
/// node's translation.
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
    file.attribute("COLOR_0", VEC4, U16, &colors);
    let raw: Vec<u8> =
        values.values.iter().flat_map(|v| (v.unwrap_or(no_value(legend)) as f32).to_le_bytes()).collect();
    file.attribute("_VALUE", SCALAR, F32, &raw);
    let counts: Vec<u8> = values.counts.iter().flat_map(|&c| (c as f32).to_le_bytes()).collect();
    file.attribute("_COUNT", SCALAR, F32, &counts);
    file.finish("OpenCollBench heatmap", Some(json!({ "ocb": legend_json(legend) })))
}

/// `_VALUE` of a vertex without a value; the legend says it. glTF forbids NaN; no measure or statistic is negative, and
/// no difference is as low as the lowest number.
fn no_value(legend: &Legend) -> f64 {
    if legend.against.is_none() { -1.0 } else { f64::from(f32::MIN) }
}

fn legend_json(legend: &Legend) -> Value {
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

// The names and numbers of the glTF 2.0 specification, 3.6 and 3.7.
const SCALAR: &str = "SCALAR";
const VEC3: &str = "VEC3";
const VEC4: &str = "VEC4";
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const TRIANGLES: u32 = 4;

/// One mesh of one primitive, growing attribute by attribute. The tests read it with a library of its own.
struct File {
    accessors: Vec<Value>,
    views: Vec<Value>,
    attributes: serde_json::Map<String, Value>,
    indices: usize,
    /// The one buffer; every view in it starts at a multiple of 4.
    bytes: Vec<u8>,
    vertices: usize,
    /// From where positions count.
    translation: Option<Vector3<f64>>,
}

/// So many times as far from the origin as it is long, an object is far from it.
const FAR: f64 = 8.0;

fn translation(mesh: &Mesh) -> Option<Vector3<f64>> {
    let (Aabb { min, max }, long) = (mesh.bounds(), mesh.longest_side());
    let far = min.coords.amax().max(max.coords.amax()) > FAR * long;
    (far && !mesh.is_f32_representable()).then(|| min.coords + (max - min) / 2.0)
}

impl File {
    fn new(mesh: &Mesh) -> Self {
        Self {
            accessors: Vec::new(),
            views: Vec::new(),
            attributes: serde_json::Map::new(),
            indices: 0,
            bytes: Vec::new(),
            vertices: mesh.positions().len(),
            translation: translation(mesh),
        }
    }

    fn positions(&mut self, mesh: &Mesh) {
        let from = self.translation.unwrap_or_default();
        let single: Vec<[f32; 3]> =
            mesh.positions().iter().map(|p| (p.coords - from).map(|x| x as f32).into()).collect();
        // glTF wants the extent of all vertices as stored, used by a triangle or not.
        let lo = single.iter().fold([f32::INFINITY; 3], |a, p| [0, 1, 2].map(|k| a[k].min(p[k])));
        let hi = single.iter().fold([f32::NEG_INFINITY; 3], |a, p| [0, 1, 2].map(|k| a[k].max(p[k])));
        let bytes: Vec<u8> = single.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let accessor = self.attribute("POSITION", VEC3, F32, &bytes);
        self.accessors[accessor]["min"] = json!(lo);
        self.accessors[accessor]["max"] = json!(hi);
    }

    fn indices(&mut self, mesh: &Mesh) {
        let bytes: Vec<u8> = mesh.triangles().iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, None, ELEMENT_ARRAY_BUFFER);
        self.indices = self.accessor(view, 3 * mesh.triangles().len(), SCALAR, U32);
    }

    /// Whole numbers stand for shares of their largest value.
    fn attribute(&mut self, name: &str, kind: &str, component: u32, bytes: &[u8]) -> usize {
        let view = self.view(bytes, Some(bytes.len() / self.vertices), ARRAY_BUFFER);
        let accessor = self.accessor(view, self.vertices, kind, component);
        if component == U16 {
            self.accessors[accessor]["normalized"] = json!(true);
        }
        self.attributes.insert(name.into(), json!(accessor));
        accessor
    }

    fn view(&mut self, bytes: &[u8], stride: Option<usize>, target: u32) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteLength": bytes.len(), "byteOffset": offset, "target": target });
        if let Some(stride) = stride {
            view["byteStride"] = json!(stride);
        }
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, view: usize, count: usize, kind: &str, component: u32) -> usize {
        self.accessors.push(json!({ "bufferView": view, "count": count, "componentType": component, "type": kind }));
        self.accessors.len() - 1
    }

    /// Header, JSON chunk and binary chunk.
    fn finish(self, name: &str, extras: Option<Value>) -> Vec<u8> {
        let primitive = json!({ "attributes": self.attributes, "indices": self.indices, "mode": TRIANGLES });
        let mut mesh = json!({ "name": name, "primitives": [primitive] });
        if let Some(extras) = extras {
            mesh["extras"] = extras;
        }
        let mut node = json!({ "mesh": 0 });
        if let Some(translation) = self.translation {
            node["translation"] = json!(translation.as_slice());
        }
        let document = json!({
            "asset": { "version": "2.0", "generator": concat!("OpenCollBench ", env!("CARGO_PKG_VERSION")) },
            "accessors": self.accessors, "bufferViews": self.views, "buffers": [{ "byteLength": self.bytes.len() }],
            "meshes": [mesh], "nodes": [node], "scenes": [{ "nodes": [0] }], "scene": 0,
        });
        let mut json = document.to_string().into_bytes();
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
