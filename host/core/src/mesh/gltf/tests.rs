//! What the glTF reader makes of good and bad documents.

use base64::Engine;
use serde_json::{Value, json};

use crate::mesh::{FileFormat, ReadMesh, read};

/// Four vertices (f32) of a square with sides 1 and 2, then two triangles (u16).
fn data() -> Vec<u8> {
    let positions = [[0f32, 0., 0.], [1., 0., 0.], [1., 2., 0.], [0., 2., 0.]];
    let mut bytes: Vec<u8> = positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    bytes
}

fn document() -> Value {
    let uri =
        format!("data:application/octet-stream;base64,{}", base64::engine::general_purpose::STANDARD.encode(data()));
    json!({
        "asset": { "version": "2.0" },
        "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 7 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
        ],
        "buffers": [{ "byteLength": 60, "uri": uri }],
    })
}

/// The document with the value at a pointer replaced, or added.
fn with(pointer: &str, value: Value) -> Value {
    let mut document = document();
    put(&mut document, pointer, value);
    document
}

fn put(document: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match document.pointer_mut(parent).unwrap() {
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        parent => parent[key] = value,
    }
}

fn glb(document: &Value, data: &[u8]) -> Vec<u8> {
    let json = document.to_string().into_bytes();
    let word = |n: usize| (n as u32).to_le_bytes();
    let length = 12 + 8 + json.len() + 8 + data.len();
    let head = [*b"glTF", word(2), word(length), word(json.len()), *b"JSON"].concat();
    [head, json, [word(data.len()), *b"BIN\0"].concat(), data.to_vec()].concat()
}

fn binary() -> Vec<u8> {
    glb(&with("/buffers/0", json!({ "byteLength": 60 })), &data())
}

fn ok(document: &Value) -> ReadMesh {
    let read = read(document.to_string().as_bytes()).unwrap();
    assert_eq!((read.format, read.unit.clone().unwrap().metres), (FileFormat::Gltf, 1.0));
    read
}

fn error(document: &Value) -> String {
    read(document.to_string().as_bytes()).unwrap_err().to_string()
}

fn corners(read: &ReadMesh) -> Vec<[f64; 3]> {
    read.mesh.positions().iter().map(|&p| p.into()).collect()
}

#[test]
fn json_and_binary_are_one_mesh() {
    let read_json = ok(&document());
    assert_eq!(read_json.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(corners(&read_json)[2], [1.0, 2.0, 0.0]);
    assert_eq!(read_json.warnings, [""; 0]);
    let read_binary = read(&binary()).unwrap();
    assert_eq!((&read_binary.mesh, read_binary.format), (&read_json.mesh, FileFormat::Glb));
    let longer = read(&[binary(), vec![0; 3]].concat()).unwrap();
    assert_eq!(longer.warnings, ["Skipped 3 bytes behind the end of the GLB file."]);
}

#[test]
fn nodes_are_flattened_with_their_transforms() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let nodes = json!([
        { "translation": [10, 0, 0], "children": [1, 2] },
        { "mesh": 0, "scale": [2, 2, 2] },
        { "mesh": 0, "rotation": [0, 0, half, half], "children": [3] },
        { "mesh": 0, "matrix": [-1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 5, 1] },
    ]);
    let read = ok(&with("/nodes", nodes));
    let corners = corners(&read);
    assert_eq!((corners.len(), read.mesh.triangles().len()), (12, 6));
    assert_eq!(corners[2], [12.0, 4.0, 0.0]);
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    // A quarter turn takes (1, 2) to (-2, 1); the child is a mirror image in x, then goes through the turn.
    assert!(near(corners[6], [8.0, 1.0, 0.0]), "{corners:?}");
    assert!(near(corners[10], [8.0, -1.0, 5.0]), "{corners:?}");
    // A mirror image is wound the other way.
    assert_eq!(read.mesh.triangles()[4], [8, 10, 9]);
}

#[test]
fn strips_fans_and_corners_without_indices() {
    let mode =
        |mode: u32| ok(&with("/meshes/0/primitives/0", json!({ "attributes": { "POSITION": 0 }, "mode": mode })));
    assert_eq!(mode(5).mesh.triangles(), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(mode(6).mesh.triangles(), [[1, 2, 0], [2, 3, 0]]);
}

#[test]
fn primitives_of_one_mesh_share_their_vertices() {
    let primitive = json!({ "attributes": { "POSITION": 0 }, "indices": 1 });
    let points = json!({ "attributes": { "POSITION": 0 }, "mode": 0 });
    let mut document = with("/meshes/0/primitives", json!([primitive, primitive, points]));
    document["nodes"][0]["skin"] = json!(0);
    document["extensionsRequired"] = json!(["KHR_materials_unlit", "ACME_shape"]);
    document["scenes"] = json!([{ "nodes": [0] }, {}]);
    let read = ok(&document);
    assert_eq!((read.mesh.positions().len(), read.mesh.triangles().len()), (4, 4));
    assert_eq!(
        read.warnings,
        [
            "Read scene 0 (from 0) of 2 scenes.",
            "Skipped 1 primitive(s) without triangles: points and lines are not surfaces.",
            "Skipped 1 skin(s): the meshes are in the pose they were bound in.",
            "The file requires the extension 'ACME_shape', which is not read.",
        ]
    );
}

#[test]
fn a_file_without_scenes_shows_the_nodes_without_parents() {
    let mut document = with("/nodes", json!([{ "mesh": 0 }, { "children": [0], "translation": [1, 0, 0] }]));
    document.as_object_mut().unwrap().remove("scenes");
    assert_eq!(corners(&ok(&document))[0], [1.0, 0.0, 0.0]);
}

#[test]
fn sparse_and_quantized_positions() {
    let mut document = document();
    document["accessors"][0] = json!({ "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {
        "count": 2, "indices": { "bufferView": 1, "byteOffset": 2, "componentType": 5123 }, "values": { "bufferView": 0, "byteOffset": 12 } } });
    assert_eq!(corners(&ok(&document)), [[0., 0., 0.], [1., 0., 0.], [1., 2., 0.], [0.; 3]]);
    document["accessors"][0] = json!({ "bufferView": 1, "byteOffset": 0, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC3" });
    assert_eq!(corners(&ok(&document))[1], [0.0, 2.0 / 255.0, 0.0]);
}

#[test]
fn each_fault_of_the_container_has_its_sentence() {
    let good = binary();
    let bad = |at: usize, bytes: &[u8]| {
        let mut file = good.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        read(&file).unwrap_err().to_string()
    };
    assert_eq!(bad(4, &[1]), "byte 4: version 1 of GLB is not read; export the object as glTF 2.0");
    assert_eq!(
        bad(8, &u32::MAX.to_le_bytes()),
        format!(
            "byte 8: the header promises 4294967295 bytes, but the file has {}; export or download it again",
            good.len()
        )
    );
    assert_eq!(
        bad(12, &u32::MAX.to_le_bytes()),
        "byte 12: a chunk of 4294967295 bytes ends behind the file; export or download it again"
    );
    assert_eq!(bad(16, b"BIN\0"), "byte 16: a chunk 'BIN\\0', but 'JSON' belongs here; export the object again");
    assert_eq!(bad(20, b"}"), "byte 20: this is no complete JSON (expected value); export the object again");
    assert_eq!(
        read(b"glTF").unwrap_err().to_string(),
        "byte 4: the file ends inside a header; export or download it again"
    );
}

#[test]
fn each_fault_of_the_document_has_its_sentence() {
    let text = |text: &str| read(text.as_bytes()).unwrap_err().to_string();
    assert_eq!(
        text("{\n\"asset\": {},\n}"),
        "line 2: this is no glTF document (missing field `version`); export the object again"
    );
    assert_eq!(
        text("{\n\"asset\"\n"),
        "line 3: this is no complete JSON (EOF while parsing an object); export the object again"
    );
    assert_eq!(text("{}"), "line 1: this is no glTF document (missing field `asset`); export the object again");
    assert!(
        text(&format!("{{\"a\":[{}]}}", "{},".repeat(4_000_000)))
            .starts_with("line 1: more than 4000000 values in the document")
    );
    assert!(text(&format!("{{\"a\":{}", "[".repeat(100_000))).starts_with("line 1: this is no complete JSON ("));
    let old = with("/asset/version", json!("1.0"));
    assert_eq!(error(&old), "asset.version: version '1.0' is not read; export the object as glTF 2.0");
    assert_eq!(
        error(&with("/nodes", json!([{}]))),
        "the scene of the glTF file shows no triangles; export it with its meshes"
    );
    assert_eq!(
        error(&with("/nodes/0/mesh", json!(3))),
        "meshes[3]: it is named, but not there; export the object again"
    );
    assert_eq!(error(&with("/scene", json!(3))), "scenes[3]: it is named, but not there; export the object again");
    assert_eq!(
        error(&with("/scenes/0/nodes", json!([9]))),
        "nodes[9]: it is named, but not there; export the object again"
    );
    let again = "nodes[0]: it is reached twice, but a node has one parent; export the object again";
    assert_eq!(error(&with("/nodes/0/children", json!([0]))), again);
    let below = "a node below is reached twice, but a node has one parent; export the object again";
    assert_eq!(error(&with("/scenes/0/nodes", json!([0, 0]))), format!("scenes: {below}"));
    assert_eq!(error(&with("/nodes/0/children", json!([0, 0]))), format!("nodes[0]: {below}"));
    let twice = with("/nodes", json!([{ "children": [1, 2] }, { "children": [2] }, { "mesh": 0 }]));
    assert_eq!(error(&twice), again.replace("[0]", "[2]"));
    assert_eq!(
        error(&with("/nodes/0/extensions", json!({ "EXT_mesh_gpu_instancing": {} }))),
        "nodes[0]: its instances (EXT_mesh_gpu_instancing) are not read; export each instance as a node"
    );
    assert_eq!(
        error(&with("/meshes/0/primitives/0/extensions", json!({ "KHR_draco_mesh_compression": {} }))),
        "meshes[0]: it is compressed by Draco, which is not read; export the object without compression"
    );
    assert_eq!(
        error(&with("/bufferViews/0/extensions", json!({ "EXT_meshopt_compression": {} }))),
        "bufferViews[0]: it is compressed by meshopt, which is not read; export the object without compression"
    );
    assert_eq!(
        error(&with("/nodes/0/scale", json!([1e300, 1, 1]))),
        "accessors[0]: '1e300' is larger than 1e18; scale the object down"
    );
}

#[test]
fn each_fault_of_the_data_has_its_sentence() {
    let other = with("/buffers/0/uri", json!("../../etc/passwd.bin"));
    assert_eq!(
        error(&other),
        "buffers[0]: its data is in another file ('../../etc/passwd.bin'), which is not opened; export the object as GLB"
    );
    assert_eq!(
        error(&with("/buffers/0/uri", json!("data:,abc"))),
        "buffers[0]: its data is not in base64; export the object as GLB"
    );
    assert_eq!(
        error(&with("/buffers/0/uri", json!("data:;base64,a!"))),
        "buffers[0]: its base64 is damaged; export or download the file again"
    );
    assert_eq!(
        error(&with("/buffers/0", json!({ "byteLength": 60 }))),
        "buffers[0]: it has no data; export the object as GLB"
    );
    assert_eq!(
        error(&with("/buffers/0/byteLength", json!(61))),
        "buffers[0]: it promises 61 bytes, but holds 60; export or download the file again"
    );
    assert_eq!(
        error(&with("/bufferViews/0/buffer", json!(1))),
        "buffers[1]: it is named, but not there; export the object again"
    );
    assert_eq!(
        error(&with("/bufferViews/0/byteLength", json!(u64::MAX))),
        "bufferViews[0]: it ends behind its buffer; export or download the file again"
    );
    assert_eq!(
        error(&with("/bufferViews/0/byteStride", json!(4))),
        "bufferViews[0]: a stride of 4 bytes, but elements have 12; export the object again"
    );
    assert_eq!(
        error(&with("/accessors/0/count", json!(5))),
        "accessors[0]: its 5 elements end behind its view of 48 bytes; export or download the file again"
    );
    assert_eq!(
        error(&with("/bufferViews/0/byteStride", json!(u64::MAX))),
        "accessors[0]: its 4 elements end behind its view of 48 bytes; export or download the file again"
    );
    assert_eq!(
        error(&with("/accessors/0/count", json!(u64::MAX))),
        "accessors[0]: more than 5000000 vertices; reduce the object"
    );
    assert_eq!(
        error(&with("/accessors/1/count", json!(30_000_001))),
        "accessors[1]: more than 10000000 triangles; reduce the object"
    );
    assert_eq!(
        error(&with("/accessors/1/count", json!(5))),
        "accessors[1]: triangles have 3 corners each, but here are 5; export the object again"
    );
    assert_eq!(
        error(&with("/accessors/0/type", json!("VEC2"))),
        "accessors[0]: its type is 'VEC2', but 'VEC3' belongs here; export the object again"
    );
    assert_eq!(
        error(&with("/accessors/0/componentType", json!(5130))),
        "accessors[0]: its component type is none of glTF; export the object again"
    );
    assert_eq!(
        error(&with("/accessors/0/bufferView", json!(7))),
        "bufferViews[7]: it is named, but not there; export the object again"
    );
    assert_eq!(
        error(&with("/accessors/0/bufferView", Value::Null)),
        "accessors[0]: it has no data; export the object again"
    );
    let mut file = data();
    file[58] = 9;
    let document = with("/buffers/0", json!({ "byteLength": 60 }));
    let sentence = read(&glb(&document, &file)).unwrap_err().to_string();
    assert_eq!(sentence, "accessors[1]: vertex number 9, but the 4 vertices are numbered from 0; correct the number");
    file[0..4].copy_from_slice(&f32::NAN.to_le_bytes());
    let sentence = read(&glb(&document, &file)).unwrap_err().to_string();
    assert_eq!(sentence, "accessors[0]: 'NaN' is not a finite number; remove or repair that vertex");
    let sparse =
        json!({ "count": 2, "indices": { "bufferView": 1, "componentType": 5123 }, "values": { "bufferView": 0 } });
    assert_eq!(
        error(&with(
            "/accessors/1/sparse",
            json!({ "count": 9, "indices": sparse["indices"], "values": sparse["values"] })
        )),
        "accessors[1]: it has more sparse elements than elements; export the object again"
    );
}

#[test]
fn a_scene_that_places_much_is_bounded() {
    // Each node places the four vertices again; a node placed no triangle takes time all the same.
    let mut document = with("/meshes/0/primitives", json!(vec![json!({ "attributes": {} }); 1_001]));
    document["nodes"] = json!(vec![json!({ "mesh": 0 }); 1_000]);
    document["scenes"][0]["nodes"] = json!((0..1_000).collect::<Vec<u32>>());
    assert_eq!(
        error(&document),
        "nodes[999]: the scene places more than 1000000 primitives; join them into fewer meshes"
    );
}
