//! What the reader makes of good, odd and hostile files.

use proptest::prelude::*;

use super::*;
use crate::mesh::read::limits::{MAX_CORNERS, MAX_LINE_BYTES, MAX_VERTICES};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

fn ok(text: impl AsRef<[u8]>) -> ReadObj {
    read(text.as_ref()).unwrap()
}

/// A file that reads without a warning.
fn clean(text: impl AsRef<[u8]>) -> Mesh {
    let read = ok(text);
    assert_eq!(read.warnings, [""; 0]);
    read.mesh
}

fn error(text: impl AsRef<[u8]>) -> String {
    read(text.as_ref()).unwrap_err().to_string()
}

fn with(lines: &str) -> String {
    format!("{TRIANGLE}{lines}")
}

#[test]
fn plain_triangle() {
    let mesh = clean(with("f 1 2 3\n"));
    assert_eq!(mesh.triangles(), [[0, 1, 2]]);
    assert_eq!(mesh.positions()[1], Point3::new(1.0, 0.0, 0.0));
}

#[test]
fn coordinates_are_read_in_double_precision() {
    assert_eq!(clean("v 0.1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").positions()[0].x, 0.1);
}

#[test]
fn slashes_normals_and_texture_coordinates() {
    let more = "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 2//1 3//1\nf 1/9 2/9 3/9\n";
    assert_eq!(clean(with(more)).triangles(), [[0, 1, 2]; 3]);
}

#[test]
fn negative_indices_count_back_from_their_line() {
    let mesh = clean(with("f -3 -2 -1\nv 0 0 1\nf -4 -3 -1\n"));
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 1, 3]]);
}

#[test]
fn a_face_may_name_a_vertex_below_it() {
    assert_eq!(clean("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles(), [[0, 1, 2]]);
}

#[test]
fn index_errors_name_line_and_reason() {
    assert_eq!(error(with("f 1 2 4")), "line 4: vertex number 4, but the file has only 3 vertices; correct the number");
    assert_eq!(
        error(with("f -4 -2 -1")),
        "line 4: vertex number -4 counts back 4 vertices, but only 3 precede it; correct the number"
    );
    assert_eq!(error(with("f 0 1 2")), "line 4: vertex number 0, but vertices are numbered from 1");
    assert!(error(with("f 1 2 -9223372036854775808")).starts_with("line 4: vertex number -9223372036854775808 counts"));
    assert!(error(with("f 1 2 9223372036854775807")).starts_with("line 4: vertex number 9223372036854775807, but"));
    assert!(error(with("f 1 2 100000000000000000000")).starts_with("line 4: '100000000000000000000' is not a vertex"));
    assert!(error(with("f 1 2 x")).starts_with("line 4: 'x' is not a vertex number"));
    assert!(error(with("f 1 2 /1/1")).starts_with("line 4: '/1/1' is not a vertex number"));
}

#[test]
fn numbers_that_are_none_are_refused_with_their_line() {
    for bad in ["nan", "NaN", "inf", "-inf", "infinity", "1e999"] {
        let message = error(format!("v 0 0 0\nv 1 {bad} 0\nv 0 1 0\nf 1 2 3"));
        assert_eq!(message, format!("line 2: '{bad}' is not a finite number; remove or repair that vertex"));
    }
    assert_eq!(error("v 1e39 0 0"), "line 1: '1e39' is larger than 1e18; scale the object down");
    assert_eq!(error("v 0,5 0 0"), "line 1: '0,5' is not a number; write coordinates like -1.25 or 3e-4");
    assert!(error("v 1 2").starts_with("line 1: a vertex needs 3 coordinates"));
    assert!(error("v 1 2 3 4 5").contains("here are 5 numbers"));
}

#[test]
fn weights_divide_and_colours_are_ignored() {
    let mesh = clean("v 2 4 6 2\nv 1 0 0 0.1 0.2 0.3\nv 0 1 0 1 1 1 1\nf 1 2 3");
    assert_eq!(mesh.positions()[0], Point3::new(1.0, 2.0, 3.0));
    assert_eq!(mesh.positions()[2], Point3::new(0.0, 1.0, 0.0));
    assert_eq!(error("v 1 2 3 0"), "line 1: the weight '0' puts this vertex at infinity; use a weight that is not 0");
    assert!(error("v 1e10 2 3 1e-10").contains("is larger than"));
}

#[test]
fn byte_order_mark_does_not_eat_the_first_vertex() {
    let mesh = clean(format!("\u{feff}{}", with("f 1 2 3")));
    assert_eq!(mesh.positions().len(), 3);
}

#[test]
fn latin_1_is_fine_in_comments_and_names() {
    let mut bytes = b"# caf\xe9\ng br\xfccke\nusemtl gr\xfcn\n".to_vec();
    bytes.extend(with("f 1 2 3").bytes());
    clean(bytes);
    assert!(error(b"v 1\xe9 0 0").starts_with("line 1: '1\u{fffd}' is not a number"));
}

#[test]
fn continuation_lines_are_joined_and_counted() {
    assert_eq!(clean(with("f 1 \\\n2 \\\r\n3\n")).triangles(), [[0, 1, 2]]);
    assert_eq!(clean("v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\").triangles(), [[0, 1, 2]]);
    assert!(error("v 0 0 \\\n0\nv 1 0 x").starts_with("line 3: 'x'"));
}

#[test]
fn line_ends_of_all_systems_and_trailing_comments() {
    for end in ["\n", "\r\n", "\r"] {
        clean(with("f 1 2 3 # here\n").replace('\n', end));
    }
}

#[test]
fn groups_and_materials_do_not_renumber() {
    let text = "mtllib ../../secret.mtl\no a\nv 9 9 9\nv 0 0 0\nusemtl m\nv 1 0 0\nv 0 1 0\ng one\nf 2 3 4\no b\nv 0 0 1\n\
                usemtl n\ns 1\nf 5 2 4\ng two\nf 3 5 2\n";
    let read = ok(text);
    assert_eq!(read.mesh.triangles(), [[1, 2, 3], [4, 1, 3], [2, 4, 1]]);
    assert_eq!(read.mesh.positions()[0], Point3::new(9.0, 9.0, 9.0));
    assert_eq!(read.warnings, ["1 of 5 vertices are not used by any face; they keep their numbers."]);
}

#[test]
fn many_objects_stay_one_cheap_mesh() {
    let mut text = TRIANGLE.to_owned();
    text.push_str(&"o x\nf 1 2 3\n".repeat(100_000));
    assert_eq!(clean(text).triangles().len(), 100_000);
}

#[test]
fn what_is_not_read_is_said() {
    let read = ok(with("l 1 2\np 1\ncstype bezier\nfrobnicate \u{1b}[31m\nfrobnicate\nf 1 2\nf 1 2 3\nf 1 1 2\n"));
    assert_eq!(
        read.warnings,
        [
            "Skipped 1 line(s) starting with 'l', the first in line 4: lines and points are not surfaces.",
            "Skipped 1 line(s) starting with 'p', the first in line 5: lines and points are not surfaces.",
            "Skipped 1 line(s) starting with 'cstype', the first in line 6: free-form curves and surfaces are not read.",
            "Skipped 2 line(s) starting with 'frobnicate', the first in line 7: only vertices and faces are read.",
            "Skipped 1 face(s) with fewer than 3 corners, the first in line 9.",
            "1 of 2 triangles have zero area; they are kept.",
        ]
    );
}

#[test]
fn warnings_stay_short_whatever_the_file_says() {
    let junk: String = (0..100).map(|i| format!("\u{7}word{i}{}\n", "x".repeat(1_000))).collect();
    let read = ok(with(&format!("{junk}f 1 2 3")));
    assert_eq!(read.warnings.len(), 9);
    assert!(read.warnings.iter().all(|w| w.len() < 160 && !w.contains('\u{7}')));
    assert_eq!(read.warnings[8], "Skipped 92 more lines starting with other words.");
}

#[test]
fn files_that_are_no_object() {
    assert_eq!(error(""), "the file is empty; export the object again");
    assert_eq!(error(" \n\n"), "the file is empty; export the object again");
    assert_eq!(
        error(b"\x7fELF\x02\0\0\0"),
        "line 1: this is not text (it holds a NUL byte); an OBJ file is plain text in UTF-8 or Latin-1"
    );
    let no_faces = "the file has no faces (lines that start with 'f'); make sure it is an OBJ file with a polygon mesh";
    assert_eq!(error(TRIANGLE), no_faces);
    assert_eq!(error("solid x\nfacet normal 0 0 1\n"), no_faces);
    assert_eq!(error(b"\xff\xfe\x01\x02 junk"), no_faces);
    assert_eq!(
        error(with("f 1 1 2\nf 2 2 2")),
        "every triangle has zero area; the object needs at least one triangle with area"
    );
}

#[test]
fn caps_hold_before_anything_is_built() {
    assert!(error(vec![b'\n'; MAX_BYTES + 1]).starts_with("the file has 268435457 bytes, but at most"));
    assert!(error(format!("#{}", "x".repeat(MAX_LINE_BYTES))).starts_with("line 1: longer than 1048576 bytes"));
    let half = "x".repeat(MAX_LINE_BYTES / 2 + 1);
    assert!(error(format!("\ng {half}\\\n{half}")).starts_with("line 2: longer than"));
    let corners = " 1 2 3".repeat(MAX_CORNERS / 3 + 1);
    assert!(error(with(&format!("f{corners}"))).starts_with("line 4: a face with 10002 corners"));
    assert!(error("v 0 0 0\n".repeat(MAX_VERTICES + 1)).starts_with("line 5000001: more than 5000000 vertices"));
    // 5,001 corners give 4,999 triangles; 2,001 such faces are too many.
    let face = format!("f{}\n", " 1 2 3".repeat(1_667));
    assert!(error(with(&face.repeat(2_001))).starts_with("line 2004: more than 10000000 triangles"));
}

/// Twice the area vector of the triangles.
fn area(mesh: &Mesh) -> f64 {
    let normal = |t: u32| {
        let [a, b, c] = mesh.corners(t);
        (b - a).cross(&(c - a))
    };
    (0..mesh.triangles().len() as u32).map(|t| normal(t).z).sum::<f64>() / 2.0
}

#[test]
fn concave_faces_are_cut_inside() {
    // An L in the plane z = 0; a fan from its first corner would leave it.
    let mesh = clean("v 2 1 0\nv 2 2 0\nv 0 2 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 4 5 6 1 2 3");
    assert_eq!(mesh.triangles().len(), 4);
    assert_eq!(area(&mesh), 3.0);
    assert!((0..4).all(|t| {
        let [a, b, c] = mesh.corners(t);
        (b - a).cross(&(c - a)).z > 0.0
    }));
}

#[test]
fn concave_quads_are_cut_at_the_reflex_corner() {
    // A dart, given from the corner whose fan would be wrong.
    let mesh = clean("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 2 3 4 1");
    assert_eq!(mesh.triangles().len(), 2);
    assert_eq!(area(&mesh), 1.0);
    assert!(mesh.triangles().iter().all(|t| t.contains(&0) && t.contains(&2)), "{:?}", mesh.triangles());
}

#[test]
fn clockwise_faces_stay_clockwise() {
    assert_eq!(area(&clean("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 4 3 2 1")), -1.0);
}

#[test]
fn corners_on_straight_edges_are_kept() {
    // A cube whose front has an extra vertex in the middle of an edge that its neighbour shares.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0.5 0 0\nv 0.25 0 0\n\
                f 4 3 2 9 10 1\nf 5 6 7 8\nf 1 10 9 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let mesh = clean(text);
    assert!(mesh.is_closed());
    assert_eq!((mesh.triangles().len(), mesh.degenerate_triangles()), (16, 0));
}

#[test]
fn faces_without_area_keep_all_corners_and_are_warned_of() {
    let read = ok("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 5");
    assert_eq!(read.mesh.triangles(), [[0, 1, 2], [0, 2, 3], [0, 1, 4]]);
    assert_eq!(read.warnings.len(), 2);
}

#[test]
fn tiny_and_huge_faces_are_cut_alike() {
    for scale in ["e-200", "e17", "e0"] {
        let l = [(2, 1), (2, 2), (0, 2), (0, 0), (1, 0), (1, 1)];
        let mut text: String = l.iter().map(|(x, y)| format!("v {x}{scale} {y}{scale} 0\n")).collect();
        text += "f 4 5 6 1 2 3\n";
        assert_eq!(
            clean(text).triangles(),
            clean("v 2 1 0\nv 2 2 0\nv 0 2 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 4 5 6 1 2 3").triangles()
        );
    }
}

/// The files for tests and measurements that stand beside the repository; `OCB_SHARED` names another place.
#[test]
fn shared_meshes_have_the_triangles_their_list_says() {
    let folder = std::env::var_os("OCB_SHARED").map_or_else(
        || std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
        std::path::PathBuf::from,
    );
    assert!(folder.join("meshes").is_dir(), "not run: objects missing, set OCB_SHARED");
    for (name, triangles, closed) in [
        ("bunny1k", 1_023, false),
        ("bunny4k", 4_096, false),
        ("bunny16k", 16_383, false),
        ("bunny65k", 65_536, false),
        ("dragon1k", 1_024, false),
        ("dragon4k", 4_096, false),
        ("dragon16k", 16_384, false),
        ("dragon65k", 65_536, false),
        ("knot16k", 16_392, true),
        ("knot65k", 65_520, true),
        ("fandisk", 12_946, true),
        ("rocker-arm", 20_088, true),
        ("teapot", 6_320, false),
        ("homer", 12_000, true),
        ("fcl_env", 2_180, false),
        ("fcl_rob", 216, false),
    ] {
        let path = folder.join("meshes").join(name).with_extension("obj");
        let bytes = std::fs::read(&path).unwrap_or_else(|e| {
            panic!("{} cannot be read ({e}); set OCB_SHARED to the folder that holds meshes/", path.display())
        });
        let mesh = ok(bytes).mesh;
        assert_eq!((mesh.triangles().len(), mesh.is_closed()), (triangles, closed), "{name}");
        assert!((mesh.bounds().diagonal() - 1.0).abs() < 1e-5, "{name}");
        // Not assert_eq: nobody wants to read 65,536 triangles.
        assert!(ok(write(&mesh)).mesh == mesh, "{name}");
        assert!(mesh.to_f32_representable().is_ok(), "{name}");
    }
}

proptest! {
    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read(&bytes);
    }

    #[test]
    fn no_words_make_it_panic(words in prop::collection::vec(
        prop::sample::select(vec!["v", "f", "vt", "l", "1", "2", "-1", "3", "0", "1e308", "-2.5", "nan", "1/2/3", "\\\n", "\n", "\n",
            "\n", "o", "#", "99", "\u{feff}", "é"]), 0..120)) {
        if let Ok(read) = read(words.join(" ").as_bytes()) {
            prop_assert_eq!(super::read(write(&read.mesh).as_bytes()).unwrap().mesh, read.mesh);
        }
    }

    #[test]
    fn writing_and_reading_gives_the_same_mesh(
        coordinates in prop::collection::vec(prop::array::uniform3(-1e18..1e18f64), 3..40),
        corners in prop::collection::vec(prop::array::uniform3(any::<prop::sample::Index>()), 1..60),
    ) {
        let positions: Vec<_> = coordinates.iter().map(|&c| Point3::from(c)).collect();
        let triangles = corners.iter().map(|t| t.map(|i| i.index(positions.len()) as u32)).collect();
        if let Ok(mesh) = Mesh::new(positions, triangles) {
            prop_assert_eq!(read(write(&mesh).as_bytes()).unwrap().mesh, mesh);
        }
    }

    /// Any star-shaped polygon, concave ones included, is cut into triangles that cover exactly its area.
    #[test]
    fn star_polygons_keep_their_area(radii in prop::collection::vec(0.05..1.0f64, 3..60)) {
        let n = radii.len();
        let points: Vec<_> = radii.iter().enumerate().map(|(i, r)| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
            (r * cos, r * sin)
        }).collect();
        let shoelace: f64 = (0..n).map(|i| {
            let ((x0, y0), (x1, y1)) = (points[i], points[(i + 1) % n]);
            (x0 * y1 - x1 * y0) / 2.0
        }).sum();
        let mut text: String = points.iter().map(|(x, y)| format!("v {x} {y} 0\n")).collect();
        text += "f";
        (1..=n).for_each(|i| text += &format!(" {i}"));
        let read = read(text.as_bytes()).unwrap();
        prop_assert_eq!(read.mesh.triangles().len(), n - 2);
        prop_assert!((area(&read.mesh) - shoelace).abs() < 1e-9);
        for t in 0..n as u32 - 2 {
            let [a, b, c] = read.mesh.corners(t);
            prop_assert!((b - a).cross(&(c - a)).z > -1e-12);
        }
    }
}
