//! Writes a mesh in each format, for tests: positions in f64, rounded to f32 where the format has only that.
#![allow(dead_code, reason = "each test binary uses its own part")]

use std::fmt::Write;

use nalgebra::Point3;
use ocb_core::mesh::{FileFormat, Mesh, obj};

/// A cube of 12 triangles.
pub fn cube() -> Mesh {
    let positions = (0..8).map(|i| Point3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh::new(positions, triangles).expect("a cube")
}

/// A way to write a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dialect {
    Obj,
    StlText,
    StlBinary,
    PlyText,
    PlyLittleEndian,
    PlyBigEndian,
    Off,
    Gltf,
    Glb,
    Collada,
}

pub const DIALECTS: [Dialect; 10] = [
    Dialect::Obj,
    Dialect::StlText,
    Dialect::StlBinary,
    Dialect::PlyText,
    Dialect::PlyLittleEndian,
    Dialect::PlyBigEndian,
    Dialect::Off,
    Dialect::Gltf,
    Dialect::Glb,
    Dialect::Collada,
];

impl Dialect {
    /// The format that the reader must recognise.
    pub fn format(self) -> FileFormat {
        match self {
            Self::Obj => FileFormat::Obj,
            Self::StlText | Self::StlBinary => FileFormat::Stl,
            Self::PlyText | Self::PlyLittleEndian | Self::PlyBigEndian => FileFormat::Ply,
            Self::Off => FileFormat::Off,
            Self::Gltf => FileFormat::Gltf,
            Self::Glb => FileFormat::Glb,
            Self::Collada => FileFormat::Collada,
        }
    }

    /// Does it keep coordinates in single precision alone?
    pub fn is_single(self) -> bool {
        matches!(self, Self::StlBinary | Self::Gltf | Self::Glb)
    }

    /// Does it keep the vertices, or only the corners of each triangle?
    pub fn has_vertices(self) -> bool {
        self.format() != FileFormat::Stl
    }

    pub fn write(self, mesh: &Mesh) -> Vec<u8> {
        match self {
            Self::Obj => obj::write(mesh).into_bytes(),
            Self::StlText => stl_text(mesh).into_bytes(),
            Self::StlBinary => stl_binary(mesh),
            Self::PlyText => ply_text(mesh).into_bytes(),
            Self::PlyLittleEndian => ply_binary(mesh, false),
            Self::PlyBigEndian => ply_binary(mesh, true),
            Self::Off => off(mesh).into_bytes(),
            Self::Gltf => gltf(mesh).into_bytes(),
            Self::Glb => glb(mesh),
            Self::Collada => collada(mesh).into_bytes(),
        }
    }
}

fn stl_text(mesh: &Mesh) -> String {
    let mut text = "solid mesh\n".to_owned();
    for t in 0..mesh.triangles().len() as u32 {
        text += "facet normal 0 0 0\nouter loop\n";
        for p in mesh.corners(t) {
            let _ = writeln!(text, "vertex {} {} {}", p.x, p.y, p.z);
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid mesh\n"
}

fn stl_binary(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for t in 0..mesh.triangles().len() as u32 {
        bytes.extend([0; 12]);
        bytes.extend(mesh.corners(t).iter().flat_map(|p| <[f64; 3]>::from(*p)).flat_map(|x| (x as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ply_header(mesh: &Mesh, format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\n\
         property list uchar uint vertex_indices\nend_header\n",
        mesh.positions().len(),
        mesh.triangles().len()
    )
}

fn ply_text(mesh: &Mesh) -> String {
    ply_header(mesh, "ascii") + &rows(mesh)
}

fn ply_binary(mesh: &Mesh, big_endian: bool) -> Vec<u8> {
    let mut bytes =
        ply_header(mesh, if big_endian { "binary_big_endian" } else { "binary_little_endian" }).into_bytes();
    for x in mesh.positions().iter().flat_map(|p| <[f64; 3]>::from(*p)) {
        bytes.extend(if big_endian { x.to_be_bytes() } else { x.to_le_bytes() });
    }
    for triangle in mesh.triangles() {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|i| if big_endian { i.to_be_bytes() } else { i.to_le_bytes() }));
    }
    bytes
}

/// Vertices, then triangles with the number of their corners.
fn rows(mesh: &Mesh) -> String {
    let mut text = String::new();
    for p in mesh.positions() {
        let _ = writeln!(text, "{} {} {}", p.x, p.y, p.z);
    }
    for [a, b, c] in mesh.triangles() {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

fn off(mesh: &Mesh) -> String {
    format!("OFF\n{} {} 0\n{}", mesh.positions().len(), mesh.triangles().len(), rows(mesh))
}

/// Positions (f32), then indices (u32).
fn gltf_data(mesh: &Mesh) -> Vec<u8> {
    let positions = mesh.positions().iter().flat_map(|p| <[f64; 3]>::from(*p)).flat_map(|x| (x as f32).to_le_bytes());
    positions.chain(mesh.triangles().iter().flatten().flat_map(|i| i.to_le_bytes())).collect()
}

fn gltf_document(mesh: &Mesh, uri: &str) -> String {
    let (vertices, corners) = (mesh.positions().len(), 3 * mesh.triangles().len());
    let (first, second) = (12 * vertices, 4 * corners);
    let extent = |start: f64, pick: fn(f64, f64) -> f64| {
        let [x, y, z] = mesh.positions().iter().fold([start; 3], |a, p| [0, 1, 2].map(|k| pick(a[k], p[k])));
        format!("[{x},{y},{z}]")
    };
    let (min, max) = (extent(f64::INFINITY, f64::min), extent(f64::NEG_INFINITY, f64::max));
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":{vertices},"type":"VEC3","min":{min},"max":{max}}},{{"bufferView":1,"componentType":5125,"count":{corners},"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteLength":{first}}},{{"buffer":0,"byteOffset":{first},"byteLength":{second}}}],
"buffers":[{{"byteLength":{}{uri}}}]}}"#,
        first + second
    )
}

fn gltf(mesh: &Mesh) -> String {
    gltf_document(mesh, &format!(r#","uri":"data:application/octet-stream;base64,{}""#, base64(&gltf_data(mesh))))
}

fn glb(mesh: &Mesh) -> Vec<u8> {
    let (mut json, data) = (gltf_document(mesh, "").into_bytes(), gltf_data(mesh));
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |n: usize| (n as u32).to_le_bytes();
    let head = [*b"glTF", word(2), word(28 + json.len() + data.len()), word(json.len()), *b"JSON"].concat();
    [head, json, [word(data.len()), *b"BIN\0"].concat(), data].concat()
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for part in bytes.chunks(3) {
        let bits = part.iter().fold(0, |bits, &b| bits << 8 | u32::from(b)) << (8 * (3 - part.len()));
        let letter = |k: usize| if k <= part.len() { LETTERS[(bits >> (18 - 6 * k) & 63) as usize] } else { b'=' };
        text.extend((0..4).map(|k| char::from(letter(k))));
    }
    text
}

fn collada(mesh: &Mesh) -> String {
    let numbers: Vec<String> = mesh.positions().iter().map(|p| format!("{} {} {}", p.x, p.y, p.z)).collect();
    let corners: Vec<String> = mesh.triangles().iter().map(|[a, b, c]| format!("{a} {b} {c}")).collect();
    let (count, triangles) = (numbers.len(), corners.len());
    format!(
        r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit name="meter" meter="1"/></asset>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="{}">{}</float_array>
<technique_common><accessor source="#a" count="{count}" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="{triangles}"><input semantic="VERTEX" source="#v" offset="0"/><p>{}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="c"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#c"/></scene></COLLADA>
"##,
        3 * count,
        numbers.join("\n"),
        corners.join("\n")
    )
}
