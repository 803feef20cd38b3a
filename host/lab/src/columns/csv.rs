//! The rows of a Parquet file as CSV.

use std::borrow::Cow;

use arrow_array::{Array, BooleanArray, Float64Array, StringArray, UInt32Array, UInt64Array};

use super::from_parquet;
use crate::{LabError, Result};

/// The rows of a Parquet file without lists as CSV with a header line; an absent value is an empty field, and a number has
/// the fewest digits that read back as the same number.
pub fn csv(parquet: &[u8]) -> Result<Vec<u8>> {
    let fault = |e: String| LabError::Fault(format!("Writing the rows as CSV failed: {e}."));
    let (schema, batches) = from_parquet(parquet).map_err(fault)?;
    let mut text = schema.fields().iter().map(|f| f.name().as_str()).collect::<Vec<_>>().join(",");
    text.push('\n');
    for batch in &batches {
        let columns: std::result::Result<Vec<_>, _> = batch.columns().iter().map(|column| texts(column)).collect();
        let columns = columns.map_err(fault)?;
        for row in 0..batch.num_rows() {
            for (i, column) in columns.iter().enumerate() {
                if i > 0 {
                    text.push(',');
                }
                text.push_str(&quoted(&column(row)));
            }
            text.push('\n');
        }
    }
    Ok(text.into_bytes())
}

/// The text of a row of a column.
type Text<'a> = Box<dyn Fn(usize) -> String + 'a>;

/// Of all types of column that are written here.
fn texts(column: &dyn Array) -> std::result::Result<Text<'_>, String> {
    let any = column.as_any();
    let text: Text = if let Some(values) = any.downcast_ref::<Float64Array>() {
        Box::new(|row| format!("{:?}", values.value(row)))
    } else if let Some(values) = any.downcast_ref::<UInt32Array>() {
        Box::new(|row| values.value(row).to_string())
    } else if let Some(values) = any.downcast_ref::<UInt64Array>() {
        Box::new(|row| values.value(row).to_string())
    } else if let Some(values) = any.downcast_ref::<BooleanArray>() {
        Box::new(|row| values.value(row).to_string())
    } else if let Some(values) = any.downcast_ref::<StringArray>() {
        Box::new(|row| values.value(row).to_owned())
    } else {
        return Err(format!("a column of {} has no text", column.data_type()));
    };
    Ok(Box::new(move |row| if column.is_null(row) { String::new() } else { text(row) }))
}

/// As RFC 4180 has it.
fn quoted(value: &str) -> Cow<'_, str> {
    if value.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", value.replace('"', "\"\"")).into()
    } else {
        value.into()
    }
}
