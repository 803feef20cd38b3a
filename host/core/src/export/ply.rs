//! PLY, binary little-endian, as MeshLab and CloudCompare read it.

use super::Legend;
use crate::colormap::{self, NO_DATA};
use crate::heatmap::VertexValues;
use crate::mesh::Mesh;

/// Geometry with a heatmap: per vertex x y z (double), sRGB `red green blue` (uchar), `quality` (float, NaN where there
/// is no value) and `count` (uint, values that went in); the legend stands in comments of the header.
pub fn heatmap(mesh: &Mesh, values: &VertexValues, legend: &Legend) -> Vec<u8> {
    let mut file = header(mesh, legend).into_bytes();
    for (i, p) in mesh.positions().iter().enumerate() {
        for x in p.coords.iter() {
            file.extend(x.to_le_bytes());
        }
        let value = values.values[i];
        file.extend(colormap::color(legend.colormap, legend.scale, value, legend.range));
        file.extend(value.map_or(f32::NAN, |x| x as f32).to_le_bytes());
        file.extend(values.counts[i].to_le_bytes());
    }
    for t in mesh.triangles() {
        file.push(3);
        // The format's readers agree on int, not on uint, for indices; the caps keep them below 2^31.
        for &i in t {
            file.extend((i as i32).to_le_bytes());
        }
    }
    file
}

fn header(mesh: &Mesh, legend: &Legend) -> String {
    let mut comments = format!("comment OpenCollBench heatmap, version {}\n", env!("CARGO_PKG_VERSION"));
    let [lo, hi] = legend.range;
    let [r, g, b] = NO_DATA;
    for (key, value) in [
        ("run", legend.run.clone()),
        ("algorithm", legend.algorithm.clone()),
        ("minus", legend.against.clone().unwrap_or_default()),
        ("where", legend.selection.clone().unwrap_or_default()),
        ("measure", legend.measure.clone()),
        ("statistic", legend.statistic.clone()),
        ("outliers", legend.outliers.clone()),
        ("unit", legend.unit.clone()),
        ("range", format!("{lo} {hi}")),
        ("scale", format!("{:?}", legend.scale).to_lowercase()),
        ("colormap", format!("{:?}", legend.colormap).to_lowercase()),
        ("configurations", legend.n.to_string()),
        ("no value", format!("quality nan, color {r} {g} {b}")),
    ] {
        if value.is_empty() {
            continue;
        }
        // A line break in a name would end the comment and begin a header line of its own.
        let value: String = value.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        comments += &format!("comment {key}: {value}\n");
    }
    format!(
        "ply\nformat binary_little_endian 1.0\n{comments}\
         element vertex {}\n\
         property double x\nproperty double y\nproperty double z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n\
         property float quality\nproperty uint count\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions().len(),
        mesh.triangles().len(),
    )
}
