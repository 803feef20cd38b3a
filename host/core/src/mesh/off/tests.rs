//! What the OFF reader makes of good and bad files.

use crate::mesh::{FileFormat, ReadMesh, read};

const SQUARE: &str = "0 0 0\n1 0 0\n1 1 0\n0 0.1 0\n";

fn ok(text: impl AsRef<[u8]>) -> ReadMesh {
    let read = read(text.as_ref()).unwrap();
    assert_eq!((read.format, &read.unit), (FileFormat::Off, &None));
    read
}

fn error(text: impl AsRef<[u8]>) -> String {
    read(text.as_ref()).unwrap_err().to_string()
}

fn file(faces: &str) -> String {
    format!("OFF\n4 {} 0\n{SQUARE}{faces}", faces.lines().count())
}

#[test]
fn triangles_and_polygons_with_colours_and_comments() {
    let read = ok(format!(
        "# a square\n\nCOFF # coloured\n4 2 0\n{}# faces\n4 0 1 2 3  0.5 0.5 0.5\n2 0 1\n",
        SQUARE.replace("0\n", "0 1 1 1 1\n")
    ));
    assert_eq!((read.mesh.triangles().len(), read.mesh.positions()[3].y), (2, 0.1));
    assert_eq!(read.warnings, ["Skipped 1 face(s) with fewer than 3 corners."]);
}

#[test]
fn the_counts_may_stand_in_the_first_line() {
    for head in ["OFF 4 1 0", "OFF4 1 0", "\u{feff}OFF\r\n4 1"] {
        assert_eq!(ok(format!("{head}\n{SQUARE}3 0 1 2\n")).mesh.triangles(), [[0, 1, 2]], "{head}");
    }
}

#[test]
fn each_fault_has_its_sentence() {
    assert_eq!(
        error(file("3 0 1 4")),
        "line 7: vertex number 4, but the 4 vertices are numbered from 0; correct the number"
    );
    assert_eq!(
        error(file("3 0 1 -1")),
        "line 7: vertex number -1, but the 4 vertices are numbered from 0; correct the number"
    );
    assert_eq!(error(file("3 0 1")), "line 7: a face of 3 corners, but here are 2 vertex numbers");
    assert_eq!(error(file("3 0 1 x")), "line 7: 'x' is not a vertex number; write faces like '3 0 1 2'");
    assert_eq!(error(file("x 0 1 2")), "line 7: 'x' is not a number of corners; write faces like '3 0 1 2'");
    assert_eq!(
        error(file("1000000000000 0 1 2")),
        "line 7: a face with 1000000000000 corners, but at most 10000 are read; cut it into smaller faces"
    );
    assert_eq!(error("OFF\n1 1 0\n0 0\n"), "line 3: a vertex needs 3 coordinates, but here are 2 numbers");
    assert_eq!(error("OFF\n1 1 0\n0 inf 0\n"), "line 3: 'inf' is not a finite number; remove or repair that vertex");
    assert_eq!(error("OFF\n5000001 1 0\n"), "line 2: more than 5000000 vertices; reduce the object");
    assert_eq!(error("OFF\n3 99999999999 0\n"), "line 2: more than 10000000 triangles; reduce the object");
    assert_eq!(error("OFF\n3 x 0\n"), "line 2: 'x' is not a count; write 'VERTICES FACES EDGES'");
    assert_eq!(error("OFF\n3\n"), "line 2: the counts of vertices and faces belong here; write them like '8 6 12'");
    assert_eq!(error("OFF\n3 0 0\n0 0 0\n"), "line 2: the file has no faces; export a surface, not points");
    assert_eq!(
        error("4OFF\n1 1 0\n"),
        "line 1: '4OFF' has vertices that are not in three dimensions; export the object as a plain OFF file"
    );
    assert_eq!(error("OFF BINARY\n\0\0"), "line 1: binary OFF files are not read; export the object as text");
    assert_eq!(
        error("OFF"),
        "line 1: the file ends before the counts of vertices and faces; export or download it again"
    );
    assert_eq!(
        error("OFF 4000000 1 0\n0 0 0\n"),
        "line 3: the file ends before the last of its 4000000 vertices (1 are there); export or download it again"
    );
    assert_eq!(
        error(file("3 0 1 1\n3 2 2 2")),
        "every triangle has zero area; the object needs at least one triangle with area"
    );
}
