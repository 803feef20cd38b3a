//! Other readers of the same files find the same triangles.

use std::io::Cursor;

use ocb_core::mesh::{Mesh, read};
use ocb_core::stock;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};

use crate::write::{DIALECTS, Dialect, cube};

fn meshes() -> [Mesh; 2] {
    let knot = stock::generate("torus-knot", 600).and_then(|mesh| mesh.to_f32_representable().ok());
    [cube(), knot.expect("a knot")]
}

/// The corners of each triangle.
type Soup = Vec<[[f64; 3]; 3]>;

fn ours(file: &[u8]) -> Soup {
    let mesh = read(file).expect("a valid file").mesh;
    (0..mesh.triangles().len() as u32).map(|t| mesh.corners(t).map(Into::into)).collect()
}

fn theirs(dialect: Dialect, file: &[u8]) -> Option<Soup> {
    match dialect {
        Dialect::StlText | Dialect::StlBinary => Some(stl(file)),
        Dialect::PlyText | Dialect::PlyLittleEndian | Dialect::PlyBigEndian => Some(ply(file)),
        Dialect::Glb => Some(glb(file)),
        _ => None,
    }
}

fn stl(file: &[u8]) -> Soup {
    let read = stl_io::read_stl(&mut Cursor::new(file)).expect("a valid file");
    let corner = |i: usize| read.vertices[i].0.map(f64::from);
    read.faces.iter().map(|face| face.vertices.map(corner)).collect()
}

fn ply(file: &[u8]) -> Soup {
    let read = Parser::<DefaultElement>::new().read_ply(&mut Cursor::new(file)).expect("a valid file");
    let coordinate = |vertex: &DefaultElement, axis: &str| match vertex[axis] {
        Property::Double(x) => x,
        ref other => panic!("{axis} is {other:?}"),
    };
    let vertices: Vec<[f64; 3]> =
        read.payload["vertex"].iter().map(|v| ["x", "y", "z"].map(|axis| coordinate(v, axis))).collect();
    let corners = |face: &DefaultElement| match &face["vertex_indices"] {
        Property::ListUInt(corners) => [0, 1, 2].map(|k| vertices[corners[k] as usize]),
        other => panic!("the corners are {other:?}"),
    };
    read.payload["face"].iter().map(corners).collect()
}

fn glb(file: &[u8]) -> Soup {
    let read = gltf::Gltf::from_slice(file).expect("a valid file");
    let blob = read.blob.as_deref();
    let primitive = read.meshes().next().and_then(|mesh| mesh.primitives().next()).expect("a primitive");
    let reader = primitive.reader(|_| blob);
    let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
    let corners: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
    corners.chunks_exact(3).map(|t| [0, 1, 2].map(|k| positions[t[k] as usize].map(f64::from))).collect()
}

#[test]
fn other_readers_find_the_same_triangles() {
    let mut compared = 0;
    for mesh in meshes() {
        for dialect in DIALECTS {
            let file = dialect.write(&mesh);
            if let Some(theirs) = theirs(dialect, &file) {
                assert!(ours(&file) == theirs, "{dialect:?}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 12);
}
