//! The columns of the files that users take away: records and configuration sets, as Parquet and CSV.
//!
//! The meaning of each column, its unit and its frame stand in `host/README.md`; the file itself carries the schema
//! version, the run, the hardware class and the plugin's hash as key-value metadata.

mod answers;
mod csv;
mod ipc;
mod lists;
mod recorded;
mod records;
mod sets;
mod triangle_tests;
mod truth_columns;
mod truths;

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, RecordBatch, UInt32Array};
use arrow_schema::Schema;
use arrow_select::concat::concat_batches;
use arrow_select::filter::filter_record_batch;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::properties::WriterProperties;

use crate::{LabError, Result};

pub use answers::{AnswerRow, Flat, read_answers};
pub use csv::csv;
pub use ipc::{Numbers, stream};
pub use recorded::{read_recorded, recorded_parquet};
pub use records::{RecordColumns, RecordsOf, read_records, records_parquet};
pub use sets::{SetOf, read_poses, read_set, set_parquet, set_versions};
pub use triangle_tests::{read_triangle_tests, triangle_tests_parquet};
pub use truths::{contacts_parquet, truths_parquet};

/// Version of the columns; grows when a column changes its meaning.
pub const SCHEMA_VERSION: &str = "2";

/// One ZSTD-compressed Parquet file with the given metadata in its schema.
pub fn to_parquet(batch: &RecordBatch) -> Result<Vec<u8>> {
    let fault = |e| LabError::fault("Writing a Parquet file failed", e);
    let properties = WriterProperties::builder().set_compression(Compression::ZSTD(ZstdLevel::default())).build();
    let mut bytes = Vec::new();
    let mut writer = ArrowWriter::try_new(&mut bytes, batch.schema(), Some(properties)).map_err(fault)?;
    writer.write(batch).map_err(fault)?;
    writer.close().map_err(fault)?;
    Ok(bytes)
}

/// The rows of a file of records whose configuration is chosen.
pub fn select(parquet: &[u8], chosen: &[bool]) -> Result<Vec<u8>> {
    let fault = |e: String| LabError::Fault(format!("Selecting records failed: {e}."));
    let (schema, batches) = from_parquet(parquet).map_err(fault)?;
    let all = concat_batches(&schema, &batches).map_err(|e| fault(e.to_string()))?;
    let configurations = column::<UInt32Array>(&all, "configuration").map_err(fault)?.values();
    let mask: BooleanArray =
        configurations.iter().map(|&i| Some(chosen.get(i as usize).copied().unwrap_or(false))).collect();
    to_parquet(&filter_record_batch(&all, &mask).map_err(|e| fault(e.to_string()))?)
}

/// All rows of a Parquet file in batches, or why it is none.
pub(crate) fn from_parquet(bytes: &[u8]) -> std::result::Result<(Arc<Schema>, Vec<RecordBatch>), String> {
    let bytes = parquet_bytes(bytes);
    let builder = ParquetRecordBatchReaderBuilder::try_new(bytes).map_err(|e| e.to_string())?;
    let schema = builder.schema().clone();
    let reader = builder.with_batch_size(64 << 10).build().map_err(|e| e.to_string())?;
    let batches = reader.collect::<std::result::Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
    Ok((schema, batches))
}

/// The reader wants to own its bytes.
fn parquet_bytes(bytes: &[u8]) -> bytes::Bytes {
    bytes::Bytes::copy_from_slice(bytes)
}

/// A table from named columns.
pub fn batch(metadata: HashMap<String, String>, columns: Vec<(&str, ArrayRef)>) -> Result<RecordBatch> {
    let fault = |e| LabError::fault("Building the columns failed", e);
    let plain = RecordBatch::try_from_iter(columns).map_err(fault)?;
    let schema = Schema::new_with_metadata(plain.schema().fields().clone(), metadata);
    RecordBatch::try_new(Arc::new(schema), plain.columns().to_vec()).map_err(fault)
}

/// A stored column of a known type.
pub(crate) fn column<'a, T: 'static>(batch: &'a RecordBatch, name: &str) -> std::result::Result<&'a T, String> {
    batch
        .column_by_name(name)
        .ok_or_else(|| format!("the column {name:?} is missing"))?
        .as_any()
        .downcast_ref::<T>()
        .ok_or_else(|| format!("the column {name:?} has an unexpected type"))
}
