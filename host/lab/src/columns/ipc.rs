//! Columns of numbers for the pages, as an Arrow IPC stream: read there without parsing.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float32Array, Float64Array, UInt32Array};
use arrow_ipc::writer::StreamWriter;

use super::batch;
use crate::{LabError, Result};

/// One column.
pub enum Numbers {
    /// Values, NaN where there is none.
    Exact(Vec<f64>),
    /// Values of which few digits are needed.
    Rough(Vec<f64>),
    /// Indices.
    Index(Vec<u32>),
}

/// Named columns of the same length as one stream.
pub fn stream(columns: Vec<(&str, Numbers)>) -> Result<Vec<u8>> {
    let fault = |e| LabError::fault("Writing an Arrow stream failed", e);
    let array = |numbers| -> ArrayRef {
        match numbers {
            Numbers::Exact(values) => Arc::new(Float64Array::from(values)),
            Numbers::Rough(values) => Arc::new(Float32Array::from_iter_values(values.iter().map(|x| *x as f32))),
            Numbers::Index(values) => Arc::new(UInt32Array::from(values)),
        }
    };
    let table = batch(HashMap::new(), columns.into_iter().map(|(name, numbers)| (name, array(numbers))).collect())?;
    let mut writer = StreamWriter::try_new(Vec::new(), &table.schema()).map_err(fault)?;
    writer.write(&table).map_err(fault)?;
    writer.into_inner().map_err(fault)
}
