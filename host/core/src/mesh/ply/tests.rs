//! What the PLY reader makes of good and bad files.

use crate::mesh::{FileFormat, ReadMesh, read};

const HEADER: &str = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty double y\n\
                      property float z\nproperty uchar red\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
const BODY: &str = "0 0 0 255\n1 0 0 255\n1 1 0 0\n0.1 0.1 0 0\n3 0 1 2\n4 0 1 2 3\n";

fn ok(bytes: impl AsRef<[u8]>) -> ReadMesh {
    let read = read(bytes.as_ref()).unwrap();
    assert_eq!((read.format, &read.unit), (FileFormat::Ply, &None));
    read
}

fn error(bytes: impl AsRef<[u8]>) -> String {
    read(bytes.as_ref()).unwrap_err().to_string()
}

fn text() -> String {
    format!("{HEADER}{BODY}")
}

/// The same file in bytes.
fn binary(big_endian: bool) -> Vec<u8> {
    let (name, flip) = if big_endian { ("binary_big_endian", true) } else { ("binary_little_endian", false) };
    let mut bytes = HEADER.replace("ascii", name).into_bytes();
    let mut put = |number: &[u8]| if flip { bytes.extend(number.iter().rev()) } else { bytes.extend(number) };
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.1, 0.1]] {
        put(&(x as f32).to_le_bytes());
        put(&f64::to_le_bytes(y));
        put(&0f32.to_le_bytes());
        put(&[255]);
    }
    for face in [&[0, 1, 2][..], &[0, 1, 2, 3]] {
        put(&[face.len() as u8]);
        face.iter().for_each(|i: &i32| put(&i.to_le_bytes()));
    }
    bytes
}

#[test]
fn text_and_bytes_of_either_order_are_one_mesh() {
    let read = ok(text());
    assert_eq!(read.warnings, [""; 0]);
    assert_eq!(read.mesh.triangles().len(), 3);
    // Each coordinate in the precision of its type.
    assert_eq!((read.mesh.positions()[3].x, read.mesh.positions()[3].y), (f64::from(0.1f32), 0.1));
    for big_endian in [false, true] {
        assert_eq!(ok(binary(big_endian)), read);
    }
    assert_eq!(ok(text().replace('\n', "\r\n")), read);
    assert_eq!(ok(text().replace('\n', "\r")), read);
}

#[test]
fn other_elements_and_properties_are_skipped() {
    let header = HEADER
        .replace("element vertex", "element camera 1\nproperty list uchar float view\nelement vertex")
        .replace("end_header", "property float quality\nelement edge 7\nproperty int a\nend_header");
    let body = "\n2 0.5 0.5\n0 0 0 255\n1 0 0 255\n1 1 0 0\n0.1 0.1 0 0\n3 0 1 2 0.5\n4 0 1 2 3 0.5\n";
    let read = ok(format!("{header}{body}"));
    assert_eq!(read.mesh, ok(text()).mesh);
    assert_eq!(
        read.warnings,
        [
            "Skipped the element 'camera': only vertices and faces are read.",
            "Skipped the element 'edge': only vertices and faces are read."
        ]
    );
}

#[test]
fn each_fault_of_the_header_has_its_sentence() {
    let with = |from: &str, to: &str| error(text().replacen(from, to, 1));
    assert_eq!(with("ascii", "utf8"), "line 2: 'utf8' is no format of PLY; use 'ascii' or 'binary_little_endian'");
    assert_eq!(
        with("format ascii 1.0\n", ""),
        "line 2: the header has no line like 'format ascii 1.0'; export the object again"
    );
    assert_eq!(
        with("element face", "elements face"),
        "line 9: 'elements' is no word of a PLY header; export the object again"
    );
    assert_eq!(with("float x", "half x"), "line 5: 'half' is no type of PLY; use one like 'float', 'int' or 'uchar'");
    assert_eq!(with("float x", "float"), "line 5: a property has a type and a name; write it like 'property float x'");
    assert_eq!(
        with("element vertex 4", "comment"),
        "line 5: a property belongs below its element; export the object again"
    );
    assert_eq!(
        with("vertex 4", "vertex"),
        "line 4: an element has a name and a count; write it like 'element vertex 8'"
    );
    assert_eq!(with("vertex 4", "vertex -4"), "line 4: '-4' is not a count; write one like 'element vertex 8'");
    assert_eq!(with("element face", "element vertex"), "line 9: a second element 'vertex'; export the object again");
    assert_eq!(
        with("list uchar", "list float"),
        "line 10: the length of a list must be a whole number; use a type like 'uchar'"
    );
    assert_eq!(with("end_header\n", ""), "line 11: '0' is no word of a PLY header; export the object again");
    assert_eq!(
        error("ply\nformat ascii 1.0\n"),
        "line 3: the header has no line 'end_header'; export the object again"
    );
    assert_eq!(
        with("float z", "float w"),
        "line 4: the vertices have no coordinate 'z'; export x, y and z of each vertex"
    );
    assert_eq!(
        with("vertex_indices", "corners"),
        "line 9: the faces have no list 'vertex_indices'; export the corners of each face"
    );
    assert_eq!(
        with("int vertex_indices", "float vertex_indices"),
        "line 9: vertex numbers must be whole numbers, but the list has type float; export them as int"
    );
    assert_eq!(with("vertex 4", "vertex 5000001"), "line 4: more than 5000000 vertices; reduce the object");
    assert_eq!(with("face 2", "face 18446744073709551615"), "line 9: more than 10000000 triangles; reduce the object");
    let points =
        "the PLY file has no faces (an element 'face' with a list 'vertex_indices'); export a surface, not points";
    assert_eq!(with("face 2", "face 0"), points);
    assert_eq!(with("element face", "element strip"), points);
    let turned = "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\nelement vertex 3\nproperty float x\n\
                  property float y\nproperty float z\nend_header\n";
    assert_eq!(error(turned), "line 3: the faces come before the vertices; export the object from another program");
    let many = "property float a\n".repeat(1_000);
    assert_eq!(
        with("property uchar red\n", &many),
        "line 1004: more than 1000 elements and properties; export only vertices and faces"
    );
}

#[test]
fn each_fault_of_a_text_body_has_its_sentence() {
    let with = |from: &str, to: &str| error(format!("{HEADER}{}", BODY.replacen(from, to, 1)));
    assert_eq!(with("1 1 0 0", "1 x 0 0"), "line 14: 'x' is not a number; write coordinates like -1.25 or 3e-4");
    assert_eq!(with("1 1 0 0", "1 nan 0 0"), "line 14: 'nan' is not a finite number; remove or repair that vertex");
    assert_eq!(
        with("1 1 0 0", "1 1 0"),
        "line 14: the line has fewer numbers than the header declares; correct the header or the line"
    );
    assert_eq!(
        with("1 1 0 0", "1 1 0 0 0"),
        "line 14: the line has more numbers than the header declares; correct the header or the line"
    );
    assert_eq!(
        with("3 0 1 2", "3 0 1 4"),
        "line 16: vertex number 4, but the 4 vertices are numbered from 0; correct the number"
    );
    assert_eq!(
        with("3 0 1 2", "3 0 1 -1"),
        "line 16: vertex number -1, but the 4 vertices are numbered from 0; correct the number"
    );
    assert_eq!(with("3 0 1 2", "3 0 1 2.5"), "line 16: '2.5' is not a whole number; write lists like '3 0 1 2'");
    assert_eq!(with("3 0 1 2", "-3 0 1 2"), "line 16: a list of length -3; export the object again");
    assert_eq!(
        with("3 0 1 2", "4000000000 0 1 2"),
        "line 16: a face with 4000000000 corners, but at most 10000 are read; cut it into smaller faces"
    );
    assert_eq!(
        with("4 0 1 2 3\n", ""),
        "line 17: the file ends after 1 of 2 entries of the element 'face'; export or download it again"
    );
}

#[test]
fn each_fault_of_a_binary_body_has_its_sentence() {
    let good = binary(false);
    let body = HEADER.replace("ascii", "binary_little_endian").len();
    assert_eq!(
        error(&good[..body + 17]),
        format!(
            "byte {}: the file ends after 1 of 4 entries of the element 'vertex'; export or download it again",
            body + 17
        )
    );
    assert_eq!(
        error(&good[..good.len() - 1]),
        format!("byte {}: the file ends inside an entry; export or download it again", good.len() - 4)
    );
    let mut nan = good.clone();
    nan[body + 4..body + 12].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_eq!(error(&nan), format!("byte {}: 'NaN' is not a finite number; remove or repair that vertex", body + 4));
    // An entry without properties takes no room, and must take no time.
    let endless = "element nothing 18446744073709551615\nelement vertex";
    let header = HEADER.replace("ascii", "binary_little_endian");
    let file = [header.replace("element vertex", endless).as_bytes(), &good[body..]].concat();
    assert_eq!(ok(file).mesh, ok(good).mesh);
}
