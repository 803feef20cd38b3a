//! The replayed queries as a table.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, BooleanArray, Float64Array, RecordBatch, StringArray, UInt32Array, UInt64Array};
use ocb_core::record::Verdict;
use ocb_core::workload::Recorded;

use crate::columns::{SCHEMA_VERSION, batch, column, from_parquet, to_parquet};
use crate::model::Track;
use crate::{LabError, Result};

/// One query as one algorithm answered it in one order.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkloadRow {
    /// Algorithm id.
    pub algorithm: Arc<str>,
    /// The order.
    pub track: Track,
    /// Place of the query in the recording.
    pub row: u32,
    /// Median over the processes.
    pub time_ns: f64,
    /// The gravest verdict of all processes.
    pub verdict: Verdict,
    /// The objects certainly collide, as surfaces.
    pub hit: bool,
    /// Where they collide or are closest, by the oracle: a triangle of each object as algorithms get it.
    pub triangles: Option<[u32; 2]>,
}

/// The name of an order in tables.
pub fn name(track: Track) -> &'static str {
    match track {
        Track::Shuffled => "shuffled",
        Track::Recorded => "recorded",
        Track::Scene => "scene",
    }
}

/// The order of this name.
fn track(named: &str) -> std::result::Result<Track, String> {
    let known = [Track::Shuffled, Track::Recorded, Track::Scene].into_iter().find(|track| name(*track) == named);
    known.ok_or_else(|| format!("{named:?} is no order"))
}

/// All of them as Parquet, with sequence, group and objects of each query.
pub fn workload_parquet(rows: &[WorkloadRow], queries: &[Recorded]) -> Result<Vec<u8>> {
    let asked = |row: &WorkloadRow| &queries[row.row as usize];
    let numbers = |of: &dyn Fn(&Recorded) -> u64| {
        Arc::new(rows.iter().map(|row| of(asked(row))).collect::<UInt64Array>()) as ArrayRef
    };
    let words =
        |of: &dyn Fn(&WorkloadRow) -> String| Arc::new(StringArray::from_iter_values(rows.iter().map(of))) as ArrayRef;
    let triangles = |side: usize| {
        Arc::new(rows.iter().map(|row| row.triangles.map(|both| both[side])).collect::<UInt32Array>()) as ArrayRef
    };
    let metadata = HashMap::from([("opencollbench.schema".to_owned(), SCHEMA_VERSION.to_owned())]);
    let columns = vec![
        ("sequence", numbers(&|query| query.sequence)),
        ("group", numbers(&|query| query.group)),
        ("object_a", numbers(&|query| query.objects[0].into())),
        ("object_b", numbers(&|query| query.objects[1].into())),
        ("kind", words(&|row| asked(row).kind.name().to_owned())),
        ("algorithm", words(&|row| row.algorithm.to_string())),
        ("order", words(&|row| name(row.track).to_owned())),
        ("time_ns", Arc::new(rows.iter().map(|row| row.time_ns).collect::<Float64Array>()) as ArrayRef),
        ("verdict", words(&|row| row.verdict.name().to_owned())),
        ("hit", Arc::new(rows.iter().map(|row| Some(row.hit)).collect::<BooleanArray>()) as ArrayRef),
        ("triangle_a", triangles(0)),
        ("triangle_b", triangles(1)),
    ];
    to_parquet(&batch(metadata, columns)?)
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Row<'t> {
    /// Number of the query in the recording.
    pub sequence: u64,
    /// The objects, by their place in the scene.
    pub objects: [u32; 2],
    /// Algorithm id.
    pub algorithm: &'t str,
    /// The order.
    pub track: Track,
    /// Median over the processes.
    pub time_ns: f64,
    /// The gravest verdict of all processes.
    pub verdict: Verdict,
    /// The objects certainly collide, as surfaces.
    pub hit: bool,
    /// A triangle of each object; nothing in tables of versions that did not keep them.
    pub triangles: Option<[u32; 2]>,
}

/// Hands out every row of [`workload_parquet`].
///
/// # Errors
/// `Invalid` when it is no such table.
pub fn each_row(table: &[u8], mut visit: impl FnMut(Row)) -> Result<()> {
    let bad = |why: String| LabError::Invalid(format!("This is no table of the queries of a replay: {why}."));
    for batch in &from_parquet(table).map_err(bad)?.1 {
        each_of(batch, &mut visit).map_err(bad)?;
    }
    Ok(())
}

fn each_of(batch: &RecordBatch, visit: &mut impl FnMut(Row)) -> std::result::Result<(), String> {
    let numbers = |name| column::<UInt64Array>(batch, name);
    let words = |name| column::<StringArray>(batch, name);
    let (sequence, objects) = (numbers("sequence")?, [numbers("object_a")?, numbers("object_b")?]);
    let (algorithm, order, verdict) = (words("algorithm")?, words("order")?, words("verdict")?);
    let (times, hit) = (column::<Float64Array>(batch, "time_ns")?, column::<BooleanArray>(batch, "hit")?);
    let triangles = match batch.column_by_name("triangle_a") {
        Some(_) => Some([column::<UInt32Array>(batch, "triangle_a")?, column::<UInt32Array>(batch, "triangle_b")?]),
        None => None,
    };
    for row in 0..batch.num_rows() {
        let known = |of: &[&UInt32Array; 2]| of.iter().all(|side| side.is_valid(row));
        visit(Row {
            sequence: sequence.value(row),
            objects: objects.map(|side| side.value(row) as u32),
            algorithm: algorithm.value(row),
            track: track(order.value(row))?,
            time_ns: times.value(row),
            verdict: Verdict::named(verdict.value(row)).ok_or("a verdict is unknown")?,
            hit: hit.value(row),
            triangles: triangles.filter(known).map(|of| of.map(|side| side.value(row))),
        });
    }
    Ok(())
}
