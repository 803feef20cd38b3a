//! What the STL reader makes of good and bad files.

use crate::mesh::{FileFormat, ReadMesh, read};

fn facet(corners: [[f32; 3]; 3]) -> Vec<u8> {
    let normal = [0f32; 3];
    let mut bytes: Vec<u8> = [normal].iter().chain(&corners).flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0, 0]);
    bytes
}

fn binary(facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = b"solid, though the file is binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((facets.len() as u32).to_le_bytes());
    bytes.extend(facets.iter().flat_map(|&f| facet(f)));
    bytes
}

const SQUARE: [[[f32; 3]; 3]; 2] =
    [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], [[0.0, -0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.1, 0.0]]];

fn facet_text(corners: [&str; 3]) -> String {
    let [a, b, c] = corners;
    format!("facet normal 0 0 nan\n outer loop\n  vertex {a}\n  vertex {b}\n  vertex {c}\n endloop\nendfacet\n")
}

fn text(facets: &str) -> String {
    format!("solid a cube\n{facets}endsolid a cube\n")
}

fn ok(bytes: impl AsRef<[u8]>) -> ReadMesh {
    let read = read(bytes.as_ref()).unwrap();
    assert_eq!((read.format, &read.unit), (FileFormat::Stl, &None));
    read
}

fn error(bytes: impl AsRef<[u8]>) -> String {
    read(bytes.as_ref()).unwrap_err().to_string()
}

#[test]
fn equal_corners_become_one_vertex_and_it_is_said() {
    let read = ok(binary(&SQUARE));
    assert_eq!(read.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(read.mesh.positions()[3].y, f64::from(0.1f32));
    // -0 and 0 are one place; the first one stays.
    assert!(read.mesh.positions()[0].y.is_sign_positive());
    let merged = "6 vertices of the triangles were merged into 4: those with equal coordinates are one vertex.";
    assert_eq!(read.warnings, [merged]);
    assert_eq!(ok(binary(&SQUARE[..1])).warnings, [""; 0]);
}

#[test]
fn text_in_any_case_and_line_end_and_with_several_solids() {
    let one = facet_text(["0 0 0", "1 0 0", "0 0.1 0"]);
    let read = ok(text(&one));
    assert_eq!((read.mesh.positions()[2].y, &read.warnings[..]), (0.1, &[][..]));
    let shouted = ok(text(&one.to_uppercase().replace('\n', "\r\n")) + &text(&one).replace("solid a cube", "solid"));
    assert_eq!(shouted.mesh.triangles(), [[0, 1, 2]; 2]);
}

#[test]
fn each_fault_of_a_text_has_its_sentence() {
    let one = facet_text(["0 0 0", "1 0 0", "0 1 0"]);
    let with = |from: &str, to: &str| error(text(&one.replacen(from, to, 1)));
    assert_eq!(
        with("vertex 1 0 0", "vertex 1 x 0"),
        "line 5: 'x' is not a number; write coordinates like -1.25 or 3e-4"
    );
    assert_eq!(with("1 0 0", "1 nan 0"), "line 5: 'nan' is not a finite number; remove or repair that vertex");
    assert_eq!(with("1 0 0", "1 1e19 0"), "line 5: '1e19' is larger than 1e18; scale the object down");
    assert_eq!(with("1 0 0", "1 0"), "line 5: a vertex needs 3 coordinates; write it like 'vertex 1 0 -2.5'");
    assert_eq!(with("  vertex 1 0 0\n", ""), "line 7: a facet has 3 vertices, but this one has 2; repair that facet");
    assert_eq!(
        with(" endloop", " vertex 1 1 1\n endloop"),
        "line 7: a facet has 3 vertices, but this is another; cut the facet into triangles"
    );
    assert_eq!(with("outer", "inner"), "line 3: 'inner' is no word of an STL file; export the object again");
    assert_eq!(
        with("endfacet", "endsolid"),
        "line 8: 'endsolid' is out of place here; a line above is missing, so export it again"
    );
    assert_eq!(
        error(text(&one).replace("endsolid a cube\n", "")),
        "line 9: the file ends before 'endsolid', so part of it is missing; export or download it again"
    );
    assert_eq!(error(text("")), "the STL file has no facets; export a surface");
    assert_eq!(error("solid\n\0"), "line 2: this is not text (it holds a NUL byte); export or download the file again");
    let flat = facet_text(["0 0 0", "1 0 0", "1 0 0"]);
    assert_eq!(error(text(&flat)), "every triangle has zero area; the object needs at least one triangle with area");
}

#[test]
fn each_fault_of_a_binary_file_has_its_sentence() {
    let good = binary(&SQUARE);
    let mut lying = good.clone();
    lying[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(
        error(&lying),
        "byte 80: the header promises 4,294,967,295 triangles in 214748364834 bytes, but the file has 184; export or \
         download it again"
    );
    let mut short = good.clone();
    short.pop();
    assert!(error(&short).starts_with("byte 80: the header promises 2 triangles in 184 bytes, but the file has 183"));
    let mut longer = good.clone();
    longer.push(7);
    assert!(error(&longer).starts_with("byte 80: the header promises 2 triangles in 184 bytes, but the file has 185"));
    let mut nan = good.clone();
    nan[150..154].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(error(&nan), "byte 150: 'NaN' is not a finite number; remove or repair that vertex");
    nan[150..154].copy_from_slice(&1e30f32.to_le_bytes());
    assert!(error(&nan).ends_with("is larger than 1e18; scale the object down"));
}

#[test]
fn data_that_is_no_stl_is_not_taken_for_it() {
    let elf = [
        b"\x7fELF\x02\x01\x01\0".to_vec(),
        (0..400u32).flat_map(|i| i.wrapping_mul(2_654_435_761).to_le_bytes()).collect(),
    ]
    .concat();
    assert!(
        error(&elf).starts_with("the content is in no format that is read (OBJ, STL, PLY, OFF, glTF, GLB, COLLADA)")
    );
}
