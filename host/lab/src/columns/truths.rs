//! Certified answers of the oracle, and lists of contacts.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, StringArray, UInt32Array, UInt64Array};
use ocb_core::configuration::{Class, Containment};

use super::truth_columns::class_name;
use super::{SCHEMA_VERSION, batch, to_parquet};
use crate::Result;
use crate::model::{ContactRow, TruthRow};

/// One row per answer; `index` names the column of [`TruthRow::index`]. Columns that no row has are left out.
pub fn truths_parquet(index: &str, rows: &[TruthRow]) -> Result<Vec<u8>> {
    let f64s =
        |of: &dyn Fn(&TruthRow) -> Option<f64>| -> ArrayRef { Arc::new(rows.iter().map(of).collect::<Float64Array>()) };
    let texts = |of: &dyn Fn(&TruthRow) -> Option<String>| -> ArrayRef {
        Arc::new(rows.iter().map(of).collect::<StringArray>())
    };
    let flags = |of: &dyn Fn(&TruthRow) -> Option<bool>| -> ArrayRef {
        Arc::new(rows.iter().map(of).collect::<BooleanArray>())
    };
    let triangles = |side: usize| -> ArrayRef {
        Arc::new(rows.iter().map(|r| r.triangles.map(|t| t[side])).collect::<UInt32Array>())
    };
    let class = |of: fn(&TruthRow) -> Class| texts(&|r| Some(class_name(of(r)).to_owned()));
    let point = |side: usize, axis: usize| f64s(&|r| r.points.map(|p| p[side][axis]));
    let mut columns: Vec<(&str, ArrayRef)> = vec![
        (index, Arc::new(rows.iter().map(|r| r.index).collect::<UInt64Array>())),
        ("name", texts(&|r| r.name.clone())),
        ("family", texts(&|r| r.family.clone())),
        ("hit", flags(&|r| Some(r.hit))),
        ("distance_lo", f64s(&|r| r.distance_lo)),
        ("distance_hi", f64s(&|r| r.distance_hi)),
        ("margin", f64s(&|r| Some(r.margin))),
        ("containment", texts(&|r| r.containment.map(|c: Containment| c.name().to_owned()))),
        ("class64", class(|r| r.class64)),
        ("class32", class(|r| r.class32)),
        ("triangle_a", triangles(0)),
        ("triangle_b", triangles(1)),
        ("point_a_x", point(0, 0)),
        ("point_a_y", point(0, 1)),
        ("point_a_z", point(0, 2)),
        ("point_b_x", point(1, 0)),
        ("point_b_y", point(1, 1)),
        ("point_b_z", point(1, 2)),
        ("exact_used", flags(&|r| Some(r.exact_used))),
        ("differs", texts(&|r| r.differs.clone())),
    ];
    let optional = ["name", "family", "distance_lo", "distance_hi", "differs"];
    columns.retain(|(name, column)| !optional.contains(name) || column.null_count() < rows.len());
    to_parquet(&batch(metadata(), columns)?)
}

/// One row per contact: the configuration, the pair, its margin. A configuration without contacts has no row.
pub fn contacts_parquet(rows: &[TruthRow]) -> Result<Vec<u8>> {
    let all: Vec<(u64, &ContactRow)> =
        rows.iter().flat_map(|r| r.contacts.iter().flatten().map(move |c| (r.index, c))).collect();
    let columns: Vec<(&str, ArrayRef)> = vec![
        ("configuration", Arc::new(all.iter().map(|(i, _)| Some(*i)).collect::<UInt64Array>())),
        ("triangle_a", Arc::new(all.iter().map(|(_, c)| Some(c.triangle_a)).collect::<UInt32Array>())),
        ("triangle_b", Arc::new(all.iter().map(|(_, c)| Some(c.triangle_b)).collect::<UInt32Array>())),
        ("margin", Arc::new(all.iter().map(|(_, c)| Some(c.margin)).collect::<Float64Array>())),
    ];
    to_parquet(&batch(metadata(), columns)?)
}

fn metadata() -> HashMap<String, String> {
    let facts = [("opencollbench.schema", SCHEMA_VERSION), ("opencollbench.version", env!("CARGO_PKG_VERSION"))];
    facts.map(|(key, value)| (key.to_owned(), value.to_owned())).into()
}
