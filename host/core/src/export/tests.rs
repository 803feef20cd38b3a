use gltf_json::validation::Validate;
use gltf_json::{Root, accessor};
use nalgebra::{Point3, Vector3};

use super::*;
use crate::heatmap::VertexValues;
use crate::mesh::Mesh;

/// Three triangles, one of them the back of another; vertex 3 is unused.
fn mesh() -> Mesh {
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 0.5), (2.0, -3.0), (1.0, 1.0)];
    let positions = corners.iter().map(|&(x, y)| Point3::new(x, y, 0.25)).collect();
    Mesh::new(positions, vec![[2, 0, 1], [1, 4, 2], [0, 2, 1]]).unwrap()
}

fn values() -> VertexValues {
    VertexValues {
        values: vec![Some(100.0), Some(300.0), None, None, Some(200.5)],
        counts: vec![3, 4, 0, 0, 70_000],
        dropped: vec![0, 1, 0, 0, 2],
    }
}

fn legend() -> Legend {
    Legend {
        run: "0199".into(),
        algorithm: "box-tree".into(),
        against: None,
        selection: None,
        measure: "time".into(),
        statistic: "median".into(),
        outliers: "keep".into(),
        unit: "ns".into(),
        range: [100.0, 300.0],
        scale: Scale::Linear,
        colormap: Colormap::Turbo,
        n: 77,
    }
}

/// Takes a GLB apart, checking the container on the way.
fn open(glb: &[u8]) -> (Root, Vec<u8>) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
    let json = word(12);
    assert_eq!((&glb[16..20], json % 4), (&b"JSON"[..], 0));
    let root = Root::from_slice(&glb[20..20 + json]).unwrap();
    assert_eq!(&glb[24 + json..28 + json], b"BIN\0");
    let bytes = glb[28 + json..].to_vec();
    assert_eq!((word(20 + json), bytes.len() % 4), (bytes.len(), 0));

    let mut faults = vec![];
    root.validate(&root, gltf_json::Path::new, &mut |path, error| faults.push((path().to_string(), error)));
    assert!(faults.is_empty(), "{faults:?}");
    for view in &root.buffer_views {
        let (offset, length) = (view.byte_offset.unwrap().0, view.byte_length.0);
        assert_eq!(offset % 4, 0);
        assert!((offset + length) as usize <= bytes.len());
    }
    (root, bytes)
}

/// The bytes of an accessor by attribute name; `INDICES` for the indices.
fn data<'a>(root: &'a Root, bytes: &'a [u8], name: &str) -> (&'a gltf_json::Accessor, &'a [u8]) {
    let primitive = &root.meshes[0].primitives[0];
    let index = match name {
        "INDICES" => primitive.indices.unwrap(),
        _ => *primitive.attributes.iter().find(|(k, _)| k.as_ref().unwrap().to_string() == name).unwrap().1,
    };
    let accessor = &root.accessors[index.value()];
    let view = &root.buffer_views[accessor.buffer_view.unwrap().value()];
    let start = view.byte_offset.unwrap().0 as usize;
    (accessor, &bytes[start..start + view.byte_length.0 as usize])
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

/// The object read back is the same, up to the rounding of its own size and not of its place.
#[test]
fn a_small_object_far_from_the_origin_keeps_its_detail() {
    let far = mesh().positions().iter().map(|p| (p * 1e-3) + Vector3::new(1e6, -1e6, 1e6)).collect();
    let far = Mesh::new(far, mesh().triangles().to_vec()).unwrap();
    let back = crate::mesh::read(&glb::geometry(&far)).unwrap().mesh;
    assert_eq!(back.triangles(), far.triangles());
    let off = back.positions().iter().zip(far.positions()).map(|(x, y)| (x - y).amax()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{off}");
}

#[test]
fn geometry_keeps_the_order_of_vertices_and_triangles() {
    let (root, bytes) = open(&glb::geometry(&mesh()));
    let (positions, xyz) = data(&root, &bytes, "POSITION");
    let expected: Vec<f32> = mesh().positions().iter().flat_map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
    assert_eq!(floats(xyz), expected);
    assert_eq!(positions.min, Some(serde_json::json!([0.0, -3.0, 0.25])));
    assert_eq!(positions.max, Some(serde_json::json!([2.0, 1.0, 0.25])));
    let (_, indices) = data(&root, &bytes, "INDICES");
    let indices: Vec<u32> = indices.chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect();
    assert_eq!(indices, [2, 0, 1, 1, 4, 2, 0, 2, 1]);
    assert_eq!(root.meshes[0].primitives[0].attributes.len(), 1);
}

#[test]
fn what_is_exported_is_read_as_the_same_object() {
    for file in [
        glb::geometry(&mesh()),
        glb::heatmap(&mesh(), &values(), &legend()),
        ply::heatmap(&mesh(), &values(), &legend()),
    ] {
        assert_eq!(crate::mesh::read(&file).unwrap().mesh, mesh());
    }
}

#[test]
fn heatmap_holds_linear_colors_raw_values_and_the_legend() {
    let (root, bytes) = open(&glb::heatmap(&mesh(), &values(), &legend()));
    let (accessor, colors) = data(&root, &bytes, "COLOR_0");
    assert!(accessor.normalized);
    assert_eq!(accessor.component_type.as_ref().unwrap().0, accessor::ComponentType::U16);
    let colors: Vec<u16> = colors.chunks_exact(2).map(|b| u16::from_le_bytes(b.try_into().unwrap())).collect();
    assert_eq!(colors.len(), 20);
    // sRGB 128 is 0.2158605 in linear light.
    assert_eq!(colors[8..12], [14146, 14146, 14146, 65535]);
    let low = Colormap::Turbo.at(0.0).map(|c| {
        let s = f64::from(c) / 255.0;
        (if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }) * 65535.0
    });
    assert!(colors[..3].iter().zip(low).all(|(&c, l)| (f64::from(c) - l).abs() <= 0.5));

    assert_eq!(floats(data(&root, &bytes, "_VALUE").1), [100.0, 300.0, -1.0, -1.0, 200.5]);
    assert_eq!(floats(data(&root, &bytes, "_COUNT").1), [3.0, 4.0, 0.0, 0.0, 70_000.0]);
    let extras: serde_json::Value = serde_json::from_str(root.meshes[0].extras.as_ref().unwrap().get()).unwrap();
    insta::assert_json_snapshot!(extras, @r#"
    {
      "ocb": {
        "algorithm": "box-tree",
        "colormap": "turbo",
        "measure": "time",
        "n": 77,
        "no_value": -1.0,
        "outliers": "keep",
        "range": [
          100.0,
          300.0
        ],
        "run": "0199",
        "scale": "linear",
        "statistic": "median",
        "unit": "ns"
      }
    }
    "#);
}

#[test]
fn a_difference_says_what_was_subtracted_and_marks_no_value_by_the_lowest_number() {
    let difference = Legend {
        against: Some("parry".into()),
        selection: Some("wrong".into()),
        range: [-7.0, 7.0],
        colormap: Colormap::PurpleOrange,
        ..legend()
    };
    let (root, bytes) = open(&glb::heatmap(&mesh(), &values(), &difference));
    assert_eq!(floats(data(&root, &bytes, "_VALUE").1)[2..4], [f32::MIN; 2]);
    let extras: serde_json::Value = serde_json::from_str(root.meshes[0].extras.as_ref().unwrap().get()).unwrap();
    let [against, selection, none] = ["against", "where", "no_value"].map(|key| &extras["ocb"][key]);
    assert_eq!((against, selection), (&"parry".into(), &"wrong".into()));
    assert_eq!(none.as_f64(), Some(f64::from(f32::MIN)));
    let file = ply::heatmap(&mesh(), &values(), &difference);
    let header = String::from_utf8_lossy(&file);
    assert!(header.contains("comment minus: parry\ncomment where: wrong\n"), "{header}");
}

#[test]
fn ply_has_the_legend_in_its_header_and_srgb_colors() {
    let mut hostile = legend();
    hostile.algorithm = "x\nend_header".into();
    let file = ply::heatmap(&mesh(), &values(), &hostile);
    let end = file.windows(12).position(|w| w == b"\nend_header\n").unwrap() + 12;
    let header = std::str::from_utf8(&file[..end]).unwrap();
    insta::assert_snapshot!(header.replace(env!("CARGO_PKG_VERSION"), "VERSION"), @r"
    ply
    format binary_little_endian 1.0
    comment OpenCollBench heatmap, version VERSION
    comment run: 0199
    comment algorithm: x end_header
    comment measure: time
    comment statistic: median
    comment outliers: keep
    comment unit: ns
    comment range: 100 300
    comment scale: linear
    comment colormap: turbo
    comment configurations: 77
    comment no value: quality nan, color 128 128 128
    element vertex 5
    property double x
    property double y
    property double z
    property uchar red
    property uchar green
    property uchar blue
    property float quality
    property uint count
    element face 3
    property list uchar int vertex_indices
    end_header
    ");
    let body = &file[end..];
    let vertex = 3 * 8 + 3 + 4 + 4;
    assert_eq!(body.len(), 5 * vertex + 3 * 13);
    let last = &body[4 * vertex..5 * vertex];
    assert_eq!(f64::from_le_bytes(last[8..16].try_into().unwrap()), 1.0);
    assert_eq!(last[24..27], Colormap::Turbo.at(0.5025));
    assert_eq!(f32::from_le_bytes(last[27..31].try_into().unwrap()), 200.5);
    assert_eq!(u32::from_le_bytes(last[31..35].try_into().unwrap()), 70_000);
    assert_eq!(body[2 * vertex + 24..2 * vertex + 27], [128; 3]);
    assert!(f32::from_le_bytes(body[2 * vertex + 27..2 * vertex + 31].try_into().unwrap()).is_nan());
    assert_eq!(body[5 * vertex..5 * vertex + 13], [3, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
}
