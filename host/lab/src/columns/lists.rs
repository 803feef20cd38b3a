//! Columns of lists of so many numbers: poses and points.

use std::sync::Arc;

use arrow_array::{Array, ArrayRef, FixedSizeListArray, Float64Array, RecordBatch};
use arrow_schema::{DataType, Field};
use nalgebra::Point3;
use ocb_core::pose::Pose;

use super::column;
use crate::{LabError, Result};

/// A column with `width` numbers in each row; `of` gives those of one row.
pub fn lists<T>(rows: &[T], width: i32, of: impl Fn(&T) -> Vec<f64>) -> Result<ArrayRef> {
    let values: Float64Array = rows.iter().flat_map(of).collect::<Vec<_>>().into();
    let item = Arc::new(Field::new("item", DataType::Float64, false));
    let list = FixedSizeListArray::try_new(item, width, Arc::new(values), None)
        .map_err(|e| LabError::fault("Building the columns failed", e))?;
    Ok(Arc::new(list))
}

/// Such a column of a file, which may be anybody's, so nothing about it is taken for granted.
struct Lists<'b> {
    name: &'b str,
    rows: &'b FixedSizeListArray,
    numbers: &'b Float64Array,
}

impl<'b> Lists<'b> {
    fn of(batch: &'b RecordBatch, name: &'b str, width: i32) -> std::result::Result<Self, String> {
        let rows = column::<FixedSizeListArray>(batch, name)?;
        let numbers = rows.values().as_any().downcast_ref().ok_or_else(|| format!("{name} does not hold f64"))?;
        if rows.value_length() != width {
            return Err(format!("{name} must hold {width} numbers"));
        }
        Ok(Self { name, rows, numbers })
    }

    fn row(&self, row: usize) -> std::result::Result<&'b [f64], String> {
        if self.rows.is_null(row) {
            return Err(format!("{} is missing", self.name));
        }
        let (from, width) = (self.rows.value_offset_at(row), self.rows.value_length() as usize);
        if self.numbers.null_count() > 0 && (from..from + width).any(|i| self.numbers.is_null(i)) {
            return Err(format!("{} must hold {width} numbers", self.name));
        }
        Ok(&self.numbers.values()[from..from + width])
    }
}

/// A column of poses: the first three rows of the 4x4 matrix, row-major.
pub struct Poses<'b>(Lists<'b>);

impl<'b> Poses<'b> {
    /// The column of this name.
    pub fn of(batch: &'b RecordBatch, name: &'b str) -> std::result::Result<Self, String> {
        Lists::of(batch, name, 12).map(Self)
    }

    /// The pose in a row.
    pub fn row(&self, row: usize) -> std::result::Result<Pose, String> {
        let mut matrix = [0.0; 16];
        matrix[..12].copy_from_slice(self.0.row(row)?);
        matrix[15] = 1.0;
        Pose::from_row_major(&matrix).map_err(|e| format!("{}: {e}", self.0.name))
    }
}

/// A column of points.
pub struct Points<'b>(Lists<'b>);

impl<'b> Points<'b> {
    /// The column of this name.
    pub fn of(batch: &'b RecordBatch, name: &'b str) -> std::result::Result<Self, String> {
        Lists::of(batch, name, 3).map(Self)
    }

    /// The point in a row.
    pub fn row(&self, row: usize) -> std::result::Result<Point3<f64>, String> {
        Ok(Point3::from_slice(self.0.row(row)?))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use arrow_array::types::Float64Type;

    use super::*;
    use crate::columns::batch;

    fn told(rows: Vec<Option<Vec<Option<f64>>>>, width: i32) -> Vec<std::result::Result<Point3<f64>, String>> {
        let lists = FixedSizeListArray::from_iter_primitive::<Float64Type, _, _>(rows, width);
        let table = batch(HashMap::new(), vec![("p", Arc::new(lists) as ArrayRef)]).unwrap();
        let points = Points::of(&table, "p");
        (0..table.num_rows()).map(|row| points.as_ref().map_err(Clone::clone)?.row(row)).collect()
    }

    #[test]
    fn a_row_without_a_number_is_refused_and_the_others_are_read() {
        let rows = vec![None, Some(vec![Some(1.0), Some(2.0), Some(3.0)]), Some(vec![Some(1.0), None, Some(3.0)])];
        let missing = [Err("p is missing".to_owned()), Err("p must hold 3 numbers".to_owned())];
        assert_eq!(told(rows, 3), [missing[0].clone(), Ok(Point3::new(1.0, 2.0, 3.0)), missing[1].clone()]);
        assert_eq!(told(vec![Some(vec![Some(1.0), Some(2.0)])], 2), [missing[1].clone()]);
    }

    #[test]
    fn a_column_of_anything_else_is_refused() {
        let table = batch(HashMap::new(), vec![("p", Arc::new(Float64Array::from(vec![1.0])) as ArrayRef)]).unwrap();
        let refused = |name| Poses::of(&table, name).err().expect("it is no column of poses");
        assert_eq!(refused("p"), "the column \"p\" has an unexpected type");
        assert_eq!(refused("q"), "the column \"q\" is missing");
    }
}
