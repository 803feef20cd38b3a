//! The points of a chart.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, StringArray, UInt64Array};
use ocb_chart::{Chart, Form, Point};

use crate::columns::{SCHEMA_VERSION, batch, to_parquet};
use ocb_lab::Result;

/// One row per point; lines that only guide the eye are left out.
pub fn chart_parquet(chart: &Chart) -> Result<Vec<u8>> {
    let drawn = chart.series.iter().filter(|series| series.form != Form::Rule);
    let rows: Vec<(&str, &Point)> = drawn.flat_map(|s| s.points.iter().map(|p| (s.name.as_str(), p))).collect();
    let number = |of: fn(&Point) -> Option<f64>| -> ArrayRef {
        Arc::new(rows.iter().map(|(_, point)| of(point)).collect::<Float64Array>())
    };
    let count = |of: fn(&Point) -> u64| -> ArrayRef {
        Arc::new(rows.iter().map(|(_, point)| Some(of(point))).collect::<UInt64Array>())
    };
    let metadata = [
        ("schema", SCHEMA_VERSION),
        ("version", env!("CARGO_PKG_VERSION")),
        ("chart", &chart.kind),
        ("title", &chart.title),
        ("x", &chart.x.label),
        ("x_unit", &chart.x.unit),
        ("y", &chart.y.label),
        ("y_unit", &chart.y.unit),
    ];
    let metadata: HashMap<String, String> =
        metadata.into_iter().map(|(key, value)| (format!("opencollbench.{key}"), value.to_owned())).collect();
    to_parquet(&batch(
        metadata,
        vec![
            ("series", Arc::new(rows.iter().map(|(name, _)| Some(*name)).collect::<StringArray>())),
            ("name", Arc::new(rows.iter().map(|(_, point)| point.name.as_deref()).collect::<StringArray>())),
            ("x", number(|p| p.x)),
            ("x_lo", number(|p| p.x_lo)),
            ("x_hi", number(|p| p.x_hi)),
            ("y", number(|p| Some(p.y))),
            ("y_lo", number(|p| p.y_lo)),
            ("y_hi", number(|p| p.y_hi)),
            ("n", count(|p| p.n)),
            ("missed", count(|p| p.missed)),
            ("false_alarms", count(|p| p.false_alarms)),
        ],
    )?)
}
