//! Columns of numbers for the pages, as an Arrow IPC stream: read there without parsing.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, RecordBatch, UInt32Array};
use arrow_ipc::writer::StreamWriter;
use arrow_schema::{Field, Schema};
use ocb_core::selection::{Column, Kind};

use crate::{LabError, Result};

/// One column.
pub enum Numbers {
    /// Values, NaN where there is none.
    Exact(Vec<f64>),
    /// Indices.
    Index(Vec<u32>),
    /// Which configurations are selected.
    Chosen(Vec<bool>),
}

/// Named columns of the same length as one stream. A column of selections carries the `axis` and the `unit` that a chart writes.
pub fn stream(columns: Vec<(&str, Numbers)>) -> Result<Vec<u8>> {
    let fault = |e| LabError::fault("Writing an Arrow stream failed", e);
    let (mut fields, mut arrays) = (Vec::new(), Vec::new());
    for (name, numbers) in columns {
        let array: ArrayRef = match numbers {
            Numbers::Exact(values) => Arc::new(Float64Array::from(values)),
            Numbers::Index(values) => Arc::new(UInt32Array::from(values)),
            Numbers::Chosen(values) => Arc::new(BooleanArray::from(values)),
        };
        fields.push(Field::new(name, array.data_type().clone(), false).with_metadata(axis(name)));
        arrays.push(array);
    }
    let table = RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).map_err(fault)?;
    let mut writer = StreamWriter::try_new(Vec::new(), &table.schema()).map_err(fault)?;
    writer.write(&table).map_err(fault)?;
    writer.into_inner().map_err(fault)
}

fn axis(name: &str) -> HashMap<String, String> {
    match Column::ALL.iter().find(|column| column.name() == name).map(|column| column.kind()) {
        Some(Kind::Range { axis, unit }) => [("axis", axis), ("unit", unit)].map(|(k, v)| (k.into(), v.into())).into(),
        Some(Kind::Flag) | None => HashMap::new(),
    }
}

#[cfg(test)]
mod tests {
    use arrow_array::cast::AsArray;
    use arrow_ipc::reader::StreamReader;

    use super::*;

    #[test]
    fn what_is_chosen_comes_back_and_columns_tell_their_axis() {
        let columns = vec![
            ("chosen", Numbers::Chosen(vec![true, false])),
            ("bv", Numbers::Exact(vec![3.0, f64::NAN])),
            ("triangle_a", Numbers::Index(vec![0, 7])),
        ];
        let bytes = stream(columns).unwrap();
        let table = StreamReader::try_new(bytes.as_slice(), None).unwrap().next().unwrap().unwrap();
        let chosen = table.column_by_name("chosen").unwrap().as_boolean();
        assert_eq!(chosen.iter().collect::<Vec<_>>(), [Some(true), Some(false)]);
        let axis = |name: &str| table.schema().field_with_name(name).unwrap().metadata().clone();
        assert_eq!(
            axis("bv"),
            HashMap::from([("axis", "BV tests"), ("unit", "tests")].map(|(k, v)| (k.into(), v.into())))
        );
        assert!(axis("chosen").is_empty() && axis("triangle_a").is_empty());
    }
}
