//! What the COLLADA reader makes of good and bad files.

use crate::mesh::{FileFormat, ReadMesh, read};

const FACES: &str = "<triangles count=\"2\" material=\"m\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\
                     <input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/><p>0 0 1 0 2 0\n0 0 2 0 3 0</p></triangles>";
const NODE: &str = "<node><instance_geometry url=\"#g\"/></node>";

/// A square with sides 1 and 2.
fn file(faces: &str, nodes: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n\
         <asset><unit name=\"inch\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis></asset>\n\
         <library_geometries><geometry id=\"g\"><mesh>\n\
         <source id=\"s\"><float_array id=\"a\" count=\"12\">0 0 0 1 0 0\n1 2 0 0 2 0.1</float_array><technique_common>\n\
         <accessor source=\"#a\" count=\"4\" stride=\"3\"><param name=\"X\"/><param name=\"Y\"/><param name=\"Z\"/></accessor>\n\
         </technique_common></source>\n\
         <vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>\n\
         {faces}\n\
         </mesh></geometry></library_geometries>\n\
         <library_visual_scenes><visual_scene id=\"scene\">\n{nodes}\n</visual_scene></library_visual_scenes>\n\
         <scene><instance_visual_scene url=\"#scene\"/></scene>\n</COLLADA>\n"
    )
}

fn good() -> String {
    file(FACES, NODE)
}

fn ok(text: impl AsRef<[u8]>) -> ReadMesh {
    let read = read(text.as_ref()).unwrap();
    assert_eq!(read.format, FileFormat::Collada);
    read
}

fn error(text: impl AsRef<[u8]>) -> String {
    read(text.as_ref()).unwrap_err().to_string()
}

fn corners(read: &ReadMesh) -> Vec<[f64; 3]> {
    read.mesh.positions().iter().map(|&p| p.into()).collect()
}

#[test]
fn triangles_in_the_unit_of_the_file() {
    let read = ok(good());
    let unit = read.unit.clone().unwrap();
    assert_eq!((unit.name.as_str(), unit.metres), ("inch", 0.0254));
    assert_eq!(read.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(corners(&read)[3], [0.0, 2.0, 0.1]);
    assert_eq!(read.warnings, [""; 0]);
    assert_eq!(ok(good().replace('\n', "\r\n")), read);
    let metre = ok(good().replace("<unit name=\"inch\" meter=\"0.0254\"/>", "")).unit.unwrap();
    assert_eq!((metre.name.as_str(), metre.metres), ("meter", 1.0));
}

#[test]
fn every_kind_of_faces() {
    let input = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
    let triangles = |faces: String| ok(file(&faces, NODE)).mesh.triangles().to_vec();
    let quad = triangles(format!("<polygons>{input}<p>0 1 2 3</p></polygons>"));
    assert_eq!(quad.len(), 2);
    assert_eq!(triangles(format!("<polylist>{input}<vcount>0 4</vcount><p>0 1 2 3</p></polylist>")), quad);
    assert_eq!(
        triangles(format!("<polylist>{input}<vcount>3 3</vcount><p>0 1 2 0 2 3</p></polylist>")),
        [[0, 1, 2], [0, 2, 3]]
    );
    assert_eq!(triangles(format!("<tristrips>{input}<p>0 1 3 2</p></tristrips>")), [[0, 1, 3], [3, 1, 2]]);
    assert_eq!(triangles(format!("<trifans>{input}<p>0 1 2 3</p></trifans>")), [[0, 1, 2], [0, 2, 3]]);
    let read =
        ok(file(&format!("{FACES}<lines>{input}<p>0 1</p></lines><polygons>{input}<p>0 1</p></polygons>"), NODE));
    assert_eq!(
        read.warnings,
        ["Skipped 1 face(s) with fewer than 3 corners.", "Skipped 1 set(s) of lines: lines are not surfaces."]
    );
}

#[test]
fn nodes_and_instances_are_flattened_with_their_transforms() {
    let nodes = "<node id=\"pair\"><translate>10 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>\n\
                 <instance_geometry url=\"#g\"/><node><matrix>-1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1</matrix>\n\
                 <instance_geometry url=\"#g\"/></node></node><node><translate>0 0 7</translate><instance_node url=\"#pair\"/></node>";
    let read = ok(file(FACES, nodes));
    let corners = corners(&read);
    assert_eq!((corners.len(), read.mesh.triangles().len()), (16, 8));
    // (1, 2) is scaled to (2, 2), turned to (-2, 2) and shifted.
    assert_eq!(corners[2], [8.0, 2.0, 0.0]);
    assert_eq!(corners[6], [8.0, -2.0, 5.0]);
    assert_eq!(corners[10], [8.0, 2.0, 7.0]);
    // A mirror image is wound the other way.
    assert_eq!((read.mesh.triangles()[0], read.mesh.triangles()[2]), ([0, 1, 2], [4, 6, 5]));
}

#[test]
fn a_skinned_mesh_is_read_as_it_was_bound() {
    let skin = "<library_controllers><controller id=\"c\"><skin source=\"#g\"/></controller></library_controllers><library_visual_scenes>";
    let nodes = "<node><instance_controller url=\"#c\"/></node>";
    let read = ok(file(FACES, nodes).replace("<library_visual_scenes>", skin));
    assert_eq!(read.mesh, ok(good()).mesh);
    assert_eq!(read.warnings, ["Skipped 1 skin(s) or morph(s): the meshes are in the shape they were bound in."]);
}

#[test]
fn each_fault_of_the_xml_has_its_sentence() {
    assert_eq!(
        error(&good()[..good().find("2 0.1").unwrap()]),
        "line 6: the file ends inside an element; export or download it again"
    );
    assert_eq!(
        error(good().replace("</mesh>", "</mash>")),
        "line 12: this is no XML (expected 'mesh' tag, not 'mash'); export the object again"
    );
    assert_eq!(
        error(good().replace("<COLLADA", "<!DOCTYPE a [<!ENTITY b \"c\">]><COLLADA")),
        "the COLLADA file has a DTD, which is not read; remove its '<!DOCTYPE' part"
    );
    let attributes: String = (0..101).map(|i| format!(" a{i}=\"\"")).collect();
    assert_eq!(
        error(good().replace("<asset>", &format!("<asset{attributes}>"))),
        "line 3: more than 100 attributes here, or 4000000 attributes or 1000 namespaces in all; export the object again"
    );
    assert_eq!(
        error(good().replace("<asset>", &"<a/>".repeat(2_000_001))),
        "the COLLADA file has more than 2000000 elements; join its meshes"
    );
    let nested: String = (0..1_001).map(|i| format!("<a xmlns:b{i}=\"\">")).collect();
    assert!(error(good().replace("<asset>", &nested)).starts_with("line 3: more than 100 attributes here, or"));
    // Deep nesting costs no stack.
    let deep = error(good().replace("<asset>", &"<a>".repeat(500_000)));
    assert!(deep.starts_with("line 3: this is no XML") || deep.contains("ends inside an element"), "{deep}");
}

#[test]
fn each_fault_of_the_geometry_has_its_sentence() {
    let with = |from: &str, to: &str| error(good().replacen(from, to, 1));
    assert_eq!(with("0.0254", "-1"), "line 3: a unit of '-1' metres; write a number above 0");
    assert_eq!(with("1 2 0 0", "1 x 0 0"), "line 6: 'x' is not a number; write coordinates like -1.25 or 3e-4");
    assert_eq!(with("1 2 0 0", "1 nan 0 0"), "line 6: 'nan' is not a finite number; remove or repair that vertex");
    assert_eq!(
        with("0.1<", "<"),
        "line 5: the array promises 12 numbers, but holds 11; export or download the file again"
    );
    assert_eq!(
        with("count=\"4\"", "count=\"5\""),
        "line 7: it needs more numbers than the 12 of its array; export or download the file again"
    );
    assert_eq!(with("count=\"4\"", "count=\"5000001\""), "line 7: more than 5000000 vertices; reduce the object");
    assert_eq!(with("count=\"4\"", "count=\"x\""), "line 7: count 'x' is not a whole number; export the object again");
    assert_eq!(
        with("stride=\"3\"", "stride=\"2\""),
        "line 7: a stride of 2 numbers, but a vertex has 3 coordinates; export the object again"
    );
    assert!(with("stride=\"3\"", "stride=\"18446744073709551615\"").starts_with("line 7: it needs more numbers"));
    assert_eq!(
        with("#a", "other.dae#a"),
        "line 7: 'other.dae#a' is in another file, which is not opened; export everything into one file"
    );
    assert_eq!(with("#a", "#b"), "line 7: it refers to '#b', which is not there; export the object again");
    assert_eq!(
        with("semantic=\"POSITION\"", "semantic=\"OTHER\""),
        "line 9: vertices without positions; export the object again"
    );
    assert_eq!(
        with("2 0\n0 0", "4 0\n0 0"),
        "line 10: vertex number 4, but the 4 vertices are numbered from 0; correct the number"
    );
    assert_eq!(
        with("3 0</p>", "-3 0</p>"),
        "line 11: vertex number -3, but the 4 vertices are numbered from 0; correct the number"
    );
    assert_eq!(with("3 0</p>", "x 0</p>"), "line 11: 'x' is not a vertex number; export the object again");
    let cut = "line 10: the vertex numbers end inside a face, or are more than the faces need; export the object again";
    assert_eq!(with(" 3 0</p>", "</p>"), cut);
    let input = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
    let faces = |faces: String| error(file(&faces, NODE));
    assert_eq!(faces(format!("<polylist>{input}<vcount>3 3</vcount><p>0 1 2</p></polylist>")), cut);
    assert_eq!(faces(format!("<polylist>{input}<vcount>3</vcount><p>0 1 2 3</p></polylist>")), cut);
    assert_eq!(
        faces(format!("<polylist>{input}<vcount>x</vcount><p>0</p></polylist>")),
        "line 10: 'x' is not a number of corners; export the object again"
    );
    assert!(
        faces(format!("<polylist>{input}<vcount>10001</vcount><p>0</p></polylist>"))
            .starts_with("line 10: a face with 10001 corners")
    );
    assert_eq!(
        faces(format!("<polygons>{input}<ph><p>0 1 2</p><h>0 1 2</h></ph></polygons>")),
        "line 10: a polygon with holes; cut it into triangles before exporting"
    );
    assert_eq!(
        error(good().replace("mesh>", "spline>")),
        "line 4: a geometry without a mesh; export it as a polygon mesh"
    );
}

#[test]
fn each_fault_of_the_scene_has_its_sentence() {
    let with = |nodes: &str| error(file(FACES, nodes));
    assert_eq!(with(""), "the scene of the COLLADA file shows no faces; export it with its meshes");
    assert_eq!(
        error(good().replace("visual_scene", "other_scene")),
        "the COLLADA file has no visual scene; export the object with its scene"
    );
    assert_eq!(
        with("<node><instance_geometry/></node>"),
        "line 14: 'instance_geometry' has no 'url'; export the object again"
    );
    assert_eq!(
        with("<node><translate>1 2</translate></node>"),
        "line 14: 'translate' needs 3 numbers, and here are fewer or more; export the object again"
    );
    assert_eq!(
        with("<node><scale>1 1\ninf</scale></node>"),
        "line 15: 'inf' is not a finite number; export the object again"
    );
    assert_eq!(
        with("<node><lookat>0 0 0 1 1 1 0 0 1</lookat><node><instance_geometry url=\"#g\"/></node></node>"),
        "line 14: a transform 'lookat' of a mesh is not read; export transforms as matrices"
    );
    let camera = "<node><lookat>0 0 0 1 1 1 0 0 1</lookat><instance_camera url=\"#k\"/></node>";
    assert_eq!(ok(file(FACES, &format!("{camera}{NODE}"))).mesh, ok(good()).mesh);
    assert_eq!(
        with("<node id=\"loop\"><instance_node url=\"#loop\"/><instance_node url=\"#loop\"/></node>"),
        "line 14: the scene has more than 1000000 nodes, or a node contains itself; export the object again"
    );
    assert!(
        with("<node><scale>1e300 1 1</scale><instance_geometry url=\"#g\"/></node>")
            .starts_with("line 4: '1e300' is larger than")
    );
}

#[test]
fn what_is_referred_to_again_and_again_is_bounded() {
    // Each node looks at all of its elements, and is shown by each of the nodes around it.
    let lights = "<instance_light url=\"#l\"/>".repeat(20_000);
    let instances = "<node><instance_node url=\"#many\"/></node>".repeat(5_100);
    assert_eq!(
        error(file(FACES, &format!("<node id=\"many\">{lights}</node>{instances}"))),
        "the COLLADA file refers to the same elements too often; export the object again"
    );
}
