//! A configuration set with its truth.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch, UInt32Array};
use ocb_core::configuration::{Configuration, ConfigurationSet, Placed, Separation, Truth};
use ocb_core::oracle;
use ocb_core::sampling;

use super::lists::{Poses, lists};
use super::truth_columns::{EXACT, ROUNDED, read_truths, truth_columns};
use super::{SCHEMA_VERSION, batch, column, from_parquet, to_parquet};
use crate::{LabError, Result};

/// What the file says of itself.
pub struct SetOf<'a> {
    /// SHA-256 of the mesh of A.
    pub mesh_a: &'a str,
    /// SHA-256 of the mesh of B.
    pub mesh_b: &'a str,
}

/// The set as Parquet. Poses are the first three rows of the 4x4 matrix, row-major, bit for bit.
pub fn set_parquet(of: &SetOf, set: &ConfigurationSet) -> Result<Vec<u8>> {
    let placed = &set.placed;
    let metadata = HashMap::from(
        [
            ("opencollbench.schema", SCHEMA_VERSION.to_owned()),
            ("opencollbench.version", env!("CARGO_PKG_VERSION").to_owned()),
            ("opencollbench.mesh_a_sha256", of.mesh_a.to_owned()),
            ("opencollbench.mesh_b_sha256", of.mesh_b.to_owned()),
            ("opencollbench.method", json(&set.method)?),
            ("opencollbench.separation", json(&set.separation)?),
            ("opencollbench.longest_side", set.longest_side.to_string()),
            ("opencollbench.missed_rays", set.missed_rays.to_string()),
            ("opencollbench.box_side", maybe(set.box_side)),
            ("opencollbench.spacing", maybe(set.spacing)),
            ("opencollbench.sampling", sampling::VERSION.to_string()),
            ("opencollbench.oracle", oracle::VERSION.to_string()),
        ]
        .map(|(key, value)| (key.to_owned(), value)),
    );
    let mut columns = vec![
        ("pose_a", lists(placed, 12, |p| p.configuration.pose_a.to_row_major()[..12].to_vec())?),
        ("pose_b", lists(placed, 12, |p| p.configuration.pose_b.to_row_major()[..12].to_vec())?),
    ];
    columns.extend(truth_columns(&EXACT, &placed.iter().map(|p| p.truth).collect::<Vec<_>>())?);
    columns.extend([
        ("root_index", Arc::new(placed.iter().map(|p| p.root_index).collect::<UInt32Array>()) as ArrayRef),
        (
            "relative_distance",
            wanted(placed, |w| match w {
                Separation::Relative { distance } => Some(distance),
                Separation::Step { .. } | Separation::Ladder => None,
            }),
        ),
        (
            "step",
            wanted(placed, |w| match w {
                Separation::Step { of_size } => Some(of_size),
                Separation::Relative { .. } | Separation::Ladder => None,
            }),
        ),
    ]);
    // All configurations have a second truth, or none has.
    if let Some(rounded) = placed.iter().map(|p| p.rounded).collect::<Option<Vec<Truth>>>() {
        columns.extend(truth_columns(&ROUNDED, &rounded)?);
    }
    to_parquet(&batch(metadata, columns)?)
}

fn maybe(number: Option<f64>) -> String {
    number.map_or_else(String::new, |x| x.to_string())
}

fn json(value: &impl serde::Serialize) -> Result<String> {
    serde_json::to_string(value).map_err(|e| LabError::fault("Encoding the method failed", e))
}

/// Reads back a stored set.
pub fn read_set(bytes: &[u8]) -> Result<ConfigurationSet> {
    let damaged = |e: String| LabError::Fault(format!("A stored configuration set cannot be read: {e}."));
    let (schema, batches) = from_parquet(bytes).map_err(damaged)?;
    let said = |key: &str| {
        let key = format!("opencollbench.{key}");
        schema.metadata().get(&key).cloned().ok_or_else(|| damaged(format!("{key} is missing")))
    };
    let number = |key: &str| said(key)?.parse::<f64>().map_err(|e| damaged(format!("{key}: {e}")));
    let not_json = |e: serde_json::Error| damaged(e.to_string());
    let mut set = ConfigurationSet {
        method: serde_json::from_str(&said("method")?).map_err(not_json)?,
        separation: serde_json::from_str(&said("separation")?).map_err(not_json)?,
        longest_side: number("longest_side")?,
        placed: Vec::new(),
        missed_rays: number("missed_rays")? as u32,
        box_side: number("box_side").ok(),
        spacing: number("spacing").ok(),
    };
    for batch in &batches {
        append_placed(&mut set.placed, batch).map_err(damaged)?;
    }
    Ok(set)
}

/// The versions of sampling and oracle that made a stored set, where it says.
pub fn set_versions(bytes: &[u8]) -> Result<(Option<u32>, Option<u32>)> {
    let damaged = |e: String| LabError::Fault(format!("A stored configuration set cannot be read: {e}."));
    let (schema, _) = from_parquet(bytes).map_err(damaged)?;
    let said = |key: &str| schema.metadata().get(key)?.parse().ok();
    Ok((said("opencollbench.sampling"), said("opencollbench.oracle")))
}

/// Only the poses of a set that somebody brings: whatever else the file says is found out anew.
pub fn read_poses(bytes: &[u8]) -> std::result::Result<Vec<Configuration>, String> {
    let (_, batches) = from_parquet(bytes)?;
    let mut all = Vec::new();
    for batch in &batches {
        let (pose_a, pose_b) = (Poses::of(batch, "pose_a")?, Poses::of(batch, "pose_b")?);
        for row in 0..batch.num_rows() {
            let pose = |poses: &Poses| poses.row(row).map_err(|e| format!("row {}: {e}", all.len() + 1));
            let configuration = Configuration { pose_a: pose(&pose_a)?, pose_b: pose(&pose_b)? };
            all.push(configuration);
        }
    }
    Ok(all)
}

fn append_placed(placed: &mut Vec<Placed>, batch: &RecordBatch) -> std::result::Result<(), String> {
    let (relative_distance, step) =
        (column::<Float64Array>(batch, "relative_distance")?, column::<Float64Array>(batch, "step")?);
    let root_index = column::<UInt32Array>(batch, "root_index")?;
    let (pose_a, pose_b) = (Poses::of(batch, "pose_a")?, Poses::of(batch, "pose_b")?);
    let truths = read_truths(batch, &EXACT)?;
    let rounded = match batch.column_by_name(ROUNDED.hit) {
        Some(_) => read_truths(batch, &ROUNDED)?.into_iter().map(Some).collect(),
        None => vec![None; truths.len()],
    };
    for (row, (truth, rounded)) in truths.into_iter().zip(rounded).enumerate() {
        placed.push(Placed {
            configuration: Configuration { pose_a: pose_a.row(row)?, pose_b: pose_b.row(row)? },
            truth,
            rounded,
            root_index: root_index.value(row),
            wanted: if relative_distance.is_valid(row) {
                Some(Separation::Relative { distance: relative_distance.value(row) })
            } else {
                step.is_valid(row).then(|| Separation::Step { of_size: step.value(row) })
            },
        });
    }
    Ok(())
}

/// What was looked for, where it was this.
fn wanted(placed: &[Placed], this: fn(Separation) -> Option<f64>) -> ArrayRef {
    Arc::new(placed.iter().map(|p| p.wanted.and_then(this)).collect::<Float64Array>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Rotation3, Vector3};
    use ocb_core::configuration::{Class, Containment, Method, Sampling, Witness};
    use ocb_core::pose::Pose;

    fn set() -> ConfigurationSet {
        let placed = |i: u32| {
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.1 * f64::from(i));
            let pose_b = Pose { linear: *turn.matrix(), translation: Vector3::new(1.0 / 3.0, f64::from(i), -0.0) };
            Placed {
                configuration: Configuration { pose_a: Pose::identity(), pose_b },
                truth: Truth {
                    hit: i == 1,
                    distance_lo: 0.1,
                    distance_hi: 0.1 + f64::EPSILON,
                    margin: 1e-9,
                    containment: (i == 0).then_some(Containment::BInA),
                    class64: Class::Clear,
                    class32: Class::Grazing,
                    witness: Witness {
                        point_a: Point3::new(0.1, 0.2, 0.3),
                        point_b: Point3::new(0.4, 0.5, 0.6),
                        triangle_a: i,
                        triangle_b: 9,
                    },
                    exact_used: i == 0,
                },
                rounded: None,
                root_index: 0,
                wanted: [Some(Separation::Step { of_size: -1e-8 }), Some(Separation::Relative { distance: 0.1 }), None]
                    [i as usize],
            }
        };
        ConfigurationSet {
            method: Method::Sphere { sampling: Sampling::Count { count: 3 }, seed: 5 },
            separation: Some(Separation::Ladder),
            longest_side: 2.0 / 3.0,
            placed: (0..3).map(placed).collect(),
            missed_rays: 1,
            box_side: None,
            spacing: Some(0.1 + 0.2),
        }
    }

    #[test]
    fn a_set_comes_back_bit_for_bit() {
        let file = set_parquet(&SetOf { mesh_a: "a", mesh_b: "b" }, &set()).unwrap();
        assert_eq!(read_set(&file).unwrap(), set());
        // A second truth comes back as well, and its columns are there only with it.
        let mut both = set();
        both.placed.iter_mut().for_each(|p| p.rounded = Some(Truth { hit: !p.truth.hit, margin: 0.25, ..p.truth }));
        let with_both = set_parquet(&SetOf { mesh_a: "a", mesh_b: "b" }, &both).unwrap();
        assert_eq!(read_set(&with_both).unwrap(), both);
        let columns = [&file, &with_both].map(|file| from_parquet(file).unwrap().0.fields().len());
        assert_eq!(columns, [17, 29]);
        let poses = read_poses(&file).unwrap();
        assert_eq!(poses, set().placed.iter().map(|p| p.configuration).collect::<Vec<_>>());
    }

    #[test]
    fn a_foreign_parquet_file_is_refused_with_the_missing_column() {
        let table = batch(HashMap::new(), vec![("x", Arc::new(Float64Array::from(vec![1.0])) as ArrayRef)]).unwrap();
        let reason = read_poses(&to_parquet(&table).unwrap()).unwrap_err();
        assert_eq!(reason, "the column \"pose_a\" is missing");
    }
}
