//! The rows as tables.

use std::fmt::Write;
use std::sync::Arc;

use arrow_array::{Float64Array, RecordBatch, StringArray, UInt32Array, UInt64Array};
use arrow_schema::{DataType, Field, Schema};
use ocb_core::query::Query;
use ocb_service::model::{AlgorithmResult, RunInfo};
use parquet::arrow::ArrowWriter;

/// One algorithm on one workload.
pub struct Row {
    /// The object and its number of triangles.
    pub object: String,
    /// `CD W1`, `PQ W2`, ...
    pub workload: String,
    pub algorithm: String,
    pub class: String,
    pub rank: Option<u32>,
    pub n: u32,
    pub wrong: u32,
    /// Median with its 95 % interval, nanoseconds.
    pub median_ns: Option<[f64; 3]>,
    pub p95_ns: Option<f64>,
    /// To the reference, with its 95 % interval.
    pub ratio: Option<[f64; 3]>,
    pub build_ms: Option<f64>,
    pub memory_bytes: Option<u64>,
    pub outcome: String,
}

impl Row {
    pub fn of(run: &RunInfo, workload: &str, result: &AlgorithmResult) -> Self {
        let question = if run.spec.query == Query::Proximity { "PQ" } else { "CD" };
        Self {
            object: run.object_a_name.clone(),
            workload: format!("{question} {workload}"),
            algorithm: result.algorithm.clone(),
            class: result.class.map(|class| class.words()).unwrap_or_default(),
            rank: result.rank,
            n: result.n,
            wrong: result.wrong,
            median_ns: result.time.map(|t| [t.median_ns.value, t.median_ns.lo, t.median_ns.hi]),
            p95_ns: result.time.map(|t| t.p95_ns.value),
            ratio: result.ratio.map(|r| [r.value, r.lo, r.hi]),
            build_ms: result.build_ms,
            memory_bytes: result.memory_bytes,
            outcome: result.outcome.name.to_string(),
        }
    }
}

/// One table per object and workload, the fastest first; what failed or was wrong stands below, without a rank.
pub fn markdown(rows: &[Row], machine: &str) -> String {
    let mut text = format!("Measured on {machine}. Medians per query with 95 % intervals over the configurations.\n");
    let mut groups: Vec<(&str, &str)> = Vec::new();
    for row in rows {
        if !groups.contains(&(&row.object, &row.workload)) {
            groups.push((&row.object, &row.workload));
        }
    }
    for (object, workload) in groups {
        let mut members: Vec<&Row> = rows.iter().filter(|r| (&*r.object, &*r.workload) == (object, workload)).collect();
        let last = |row: &Row| (row.rank.is_none(), row.median_ns.map_or(f64::INFINITY, |m| m[0]));
        members.sort_by(|x, y| last(x).partial_cmp(&last(y)).expect("times are numbers"));
        write!(text, "\n### {object}, {workload}\n\n").expect("text");
        text.push_str(
            "| rank | algorithm | class | n | median us | p95 us | to reference | wrong | build ms | MB | outcome |\n",
        );
        text.push_str("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
        for row in members {
            let dash = || "–".to_owned();
            let us = |[value, lo, hi]: [f64; 3]| format!("{:.3} [{:.3}, {:.3}]", value / 1e3, lo / 1e3, hi / 1e3);
            writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
                row.rank.map_or_else(dash, |rank| rank.to_string()),
                row.algorithm,
                row.class,
                row.n,
                row.median_ns.map_or_else(dash, us),
                row.p95_ns.map_or_else(dash, |ns| format!("{:.3}", ns / 1e3)),
                row.ratio.map_or_else(dash, |[value, lo, hi]| format!("{value:.3} [{lo:.3}, {hi:.3}]")),
                row.wrong,
                row.build_ms.map_or_else(dash, |ms| format!("{ms:.1}")),
                row.memory_bytes.map_or_else(dash, |bytes| format!("{:.1}", bytes as f64 / 1e6)),
                row.outcome,
            )
            .expect("text");
        }
    }
    text
}

/// The same rows as one Parquet file.
pub fn parquet(rows: &[Row]) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let text = |of: fn(&Row) -> &str| Arc::new(rows.iter().map(|r| Some(of(r))).collect::<StringArray>());
    let number = |of: fn(&Row) -> Option<f64>| Arc::new(rows.iter().map(of).collect::<Float64Array>());
    let schema = Schema::new(vec![
        Field::new("object", DataType::Utf8, true),
        Field::new("workload", DataType::Utf8, true),
        Field::new("algorithm", DataType::Utf8, true),
        Field::new("class", DataType::Utf8, true),
        Field::new("outcome", DataType::Utf8, true),
        Field::new("rank", DataType::UInt32, true),
        Field::new("n", DataType::UInt32, true),
        Field::new("wrong", DataType::UInt32, true),
        Field::new("median_ns", DataType::Float64, true),
        Field::new("median_lo_ns", DataType::Float64, true),
        Field::new("median_hi_ns", DataType::Float64, true),
        Field::new("p95_ns", DataType::Float64, true),
        Field::new("ratio", DataType::Float64, true),
        Field::new("ratio_lo", DataType::Float64, true),
        Field::new("ratio_hi", DataType::Float64, true),
        Field::new("build_ms", DataType::Float64, true),
        Field::new("memory_bytes", DataType::UInt64, true),
    ]);
    let batch = RecordBatch::try_new(
        Arc::new(schema),
        vec![
            text(|r| &r.object),
            text(|r| &r.workload),
            text(|r| &r.algorithm),
            text(|r| &r.class),
            text(|r| &r.outcome),
            Arc::new(rows.iter().map(|r| r.rank).collect::<UInt32Array>()),
            Arc::new(rows.iter().map(|r| Some(r.n)).collect::<UInt32Array>()),
            Arc::new(rows.iter().map(|r| Some(r.wrong)).collect::<UInt32Array>()),
            number(|r| r.median_ns.map(|m| m[0])),
            number(|r| r.median_ns.map(|m| m[1])),
            number(|r| r.median_ns.map(|m| m[2])),
            number(|r| r.p95_ns),
            number(|r| r.ratio.map(|m| m[0])),
            number(|r| r.ratio.map(|m| m[1])),
            number(|r| r.ratio.map(|m| m[2])),
            number(|r| r.build_ms),
            Arc::new(rows.iter().map(|r| r.memory_bytes).collect::<UInt64Array>()),
        ],
    )?;
    let mut bytes = Vec::new();
    let mut writer = ArrowWriter::try_new(&mut bytes, batch.schema(), None)?;
    writer.write(&batch)?;
    writer.close()?;
    Ok(bytes)
}
