//! The rows of the board.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, StringArray, UInt32Array, UInt64Array};

use crate::columns::{SCHEMA_VERSION, batch, to_parquet};
use ocb_lab::Result;

use crate::model::{BoardRow, BuildInfo, Estimated};

/// One row per algorithm with its settings, in the board's order.
pub fn board_parquet(rows: &[BoardRow]) -> Result<Vec<u8>> {
    let text =
        |of: fn(&BoardRow) -> Option<&str>| -> ArrayRef { Arc::new(rows.iter().map(of).collect::<StringArray>()) };
    let owned = |of: &dyn Fn(&BoardRow) -> String| -> ArrayRef {
        Arc::new(rows.iter().map(|row| Some(of(row))).collect::<StringArray>())
    };
    let number =
        |of: &dyn Fn(&BoardRow) -> Option<f64>| -> ArrayRef { Arc::new(rows.iter().map(of).collect::<Float64Array>()) };
    let count =
        |of: fn(&BoardRow) -> Option<u64>| -> ArrayRef { Arc::new(rows.iter().map(of).collect::<UInt64Array>()) };
    let small =
        |of: fn(&BoardRow) -> Option<u32>| -> ArrayRef { Arc::new(rows.iter().map(of).collect::<UInt32Array>()) };
    let flag = |of: fn(&BoardRow) -> bool| -> ArrayRef {
        Arc::new(rows.iter().map(|row| Some(of(row))).collect::<BooleanArray>())
    };
    let mut columns: Vec<(String, ArrayRef)> = Vec::new();
    let mut put = |name: &str, column: ArrayRef| columns.push((name.to_owned(), column));
    put("rank", small(|r| r.rank));
    put("algorithm", text(|r| Some(&r.algorithm)));
    put("name", text(|r| Some(&r.name)));
    put("family", text(|r| Some(&r.family)));
    put("class", text(|r| Some(&r.class)));
    put("frontier", flag(|r| r.frontier));
    put("n", count(|r| Some(r.n)));
    put("wrong", count(|r| Some(r.wrong)));
    put("missed", count(|r| Some(r.missed)));
    put("false_alarms", count(|r| Some(r.false_alarms)));
    type Of = fn(&BoardRow) -> Option<Estimated>;
    let estimates: [(&str, Of); 4] = [
        ("questions_per_second", |r| r.rate),
        ("wrong_share", |r| r.wrong_share),
        ("missed_share", |r| r.missed_share),
        ("false_alarm_share", |r| r.false_alarm_share),
    ];
    for (name, of) in estimates {
        put(name, number(&|r| of(r).map(|e| e.value)));
        put(&format!("{name}_lo"), number(&|r| of(r).map(|e| e.lo)));
        put(&format!("{name}_hi"), number(&|r| of(r).map(|e| e.hi)));
    }
    put("eps", number(&|r| r.eps));
    put("eps_seen", flag(|r| r.eps_seen));
    put("distance_error", number(&|r| r.distance_error));
    put("build_ms", number(&|r| r.build_ms));
    put("memory_bytes", count(|r| r.memory_bytes));
    put("stability_passed", small(|r| r.stability.map(|s| s.passed)));
    put("stability_of", small(|r| r.stability.map(|s| s.of)));
    put("scenarios", small(|r| Some(r.scenarios)));
    put("of", small(|r| Some(r.of)));
    put("finished_us", count(|r| u64::try_from(r.finished_us).ok()));
    put("oracle", small(|r| r.oracle));
    put("hardware_class", text(|r| Some(&r.hardware_class)));
    put("plugin_sha256", text(|r| Some(&r.plugin_sha256)));
    put("compilers", owned(&|r| said_of(r, |build| &build.compilers)));
    put("flags", owned(&|r| said_of(r, |build| &build.flags)));
    put("instruction_sets", owned(&|r| said_of(r, |build| &build.instruction_sets)));
    put("reason", text(|r| r.reason.as_deref()));
    let metadata = HashMap::from([("opencollbench.schema".to_owned(), SCHEMA_VERSION.to_owned())]);
    to_parquet(&batch(metadata, columns.iter().map(|(name, column)| (name.as_str(), column.clone())).collect())?)
}

/// The same of each file that the algorithm is made of.
fn said_of(row: &BoardRow, of: fn(&BuildInfo) -> &[String]) -> String {
    let files = row.builds.iter().map(|build| format!("{}: {}", build.file, of(build).join(", ")));
    files.collect::<Vec<_>>().join("; ")
}
