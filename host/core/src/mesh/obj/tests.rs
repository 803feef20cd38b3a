use super::*;

#[test]
fn reads_a_triangle() {
    let read = read(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    assert_eq!(read.mesh.triangles(), [[0, 1, 2]]);
    assert_eq!(read.mesh.positions()[1], Point3::new(1.0, 0.0, 0.0));
    assert_eq!(read.warnings, [""; 0]);
}
