//! The replayed queries as a table.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, StringArray, UInt64Array};
use ocb_core::record::Verdict;
use ocb_core::workload::Recorded;

use crate::Result;
use crate::columns::{SCHEMA_VERSION, batch, to_parquet};
use crate::model::Track;

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
}

/// Names of the orders in tables.
const ORDERS: [(Track, &str); 2] = [(Track::Shuffled, "shuffled"), (Track::Recorded, "recorded")];

/// The order of this name.
pub fn track(name: &str) -> std::result::Result<Track, String> {
    let known = ORDERS.iter().find(|(_, known)| *known == name);
    known.map(|(track, _)| *track).ok_or_else(|| format!("{name:?} is no order"))
}

/// All of them as Parquet, with sequence, group and objects of each query.
pub fn workload_parquet(rows: &[WorkloadRow], queries: &[Recorded]) -> Result<Vec<u8>> {
    let asked = |row: &WorkloadRow| &queries[row.row as usize];
    let numbers = |of: &dyn Fn(&Recorded) -> u64| {
        Arc::new(rows.iter().map(|row| of(asked(row))).collect::<UInt64Array>()) as ArrayRef
    };
    let words =
        |of: &dyn Fn(&WorkloadRow) -> String| Arc::new(StringArray::from_iter_values(rows.iter().map(of))) as ArrayRef;
    let order = |row: &WorkloadRow| {
        ORDERS.iter().filter(|(track, _)| *track == row.track).map(|(_, name)| *name).collect::<String>()
    };
    let metadata = HashMap::from([("opencollbench.schema".to_owned(), SCHEMA_VERSION.to_owned())]);
    let columns = vec![
        ("sequence", numbers(&|query| query.sequence)),
        ("group", numbers(&|query| query.group)),
        ("object_a", numbers(&|query| query.objects[0].into())),
        ("object_b", numbers(&|query| query.objects[1].into())),
        ("kind", words(&|row| asked(row).kind.name().to_owned())),
        ("algorithm", words(&|row| row.algorithm.to_string())),
        ("order", words(&order)),
        ("time_ns", Arc::new(rows.iter().map(|row| row.time_ns).collect::<Float64Array>()) as ArrayRef),
        ("verdict", words(&|row| row.verdict.name().to_owned())),
        ("hit", Arc::new(rows.iter().map(|row| Some(row.hit)).collect::<BooleanArray>()) as ArrayRef),
    ];
    to_parquet(&batch(metadata, columns)?)
}
