//! How often each triangle took part in a primitive test: the "polygon tests" of [OpenCollBench 2020].

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array, StringArray, UInt32Array};
use ocb_core::record::TriangleTests;

use super::records::RecordsOf;
use super::{batch, column, from_parquet, to_parquet};
use crate::{LabError, Result};

/// Key of the number of counted queries.
const QUERIES: &str = "opencollbench.queries";

/// One row per triangle of A, then one per triangle of B.
pub fn triangle_tests_parquet(of: &RecordsOf, counted: &TriangleTests) -> Result<Vec<u8>> {
    let metadata = of.metadata().into_iter().chain([(QUERIES.to_owned(), counted.queries.to_string())]);
    let [a, b] = &counted.tests;
    let names = a.iter().map(|_| "a").chain(b.iter().map(|_| "b"));
    let triangles = (0..a.len() as u32).chain(0..b.len() as u32);
    to_parquet(&batch(
        metadata.collect::<HashMap<_, _>>(),
        vec![
            ("object", Arc::new(names.map(Some).collect::<StringArray>())),
            ("triangle", Arc::new(UInt32Array::from_iter_values(triangles))),
            ("tests", Arc::new(UInt32Array::from_iter_values(a.iter().chain(b).copied()))),
        ],
    )?)
}

/// Reads back what [`triangle_tests_parquet`] wrote.
pub fn read_triangle_tests(parquet: &[u8]) -> Result<TriangleTests> {
    let fault = |e: String| LabError::Fault(format!("The stored tests per triangle cannot be read: {e}."));
    let (schema, batches) = from_parquet(parquet).map_err(fault)?;
    let queries = schema.metadata().get(QUERIES).and_then(|n| n.parse().ok());
    let queries = queries.ok_or_else(|| fault("the number of queries is missing".into()))?;
    let mut tests = [Vec::new(), Vec::new()];
    for batch in &batches {
        let objects = column::<StringArray>(batch, "object").map_err(fault)?;
        let counts = column::<UInt32Array>(batch, "tests").map_err(fault)?;
        for row in 0..objects.len() {
            tests[usize::from(objects.value(row) == "b")].push(counts.value(row));
        }
    }
    Ok(TriangleTests { queries, tests })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_per_triangle_are_read_back() {
        let of = RecordsOf {
            run: "r",
            algorithm: "a",
            plugin_sha256: "",
            hardware_class: "",
            set_sha256: "",
            rounded: None,
        };
        let counted = TriangleTests { queries: 9, tests: [vec![4, 0, u32::MAX], vec![7]] };
        let file = triangle_tests_parquet(&of, &counted).unwrap();
        assert_eq!(read_triangle_tests(&file).unwrap(), counted);
        let lines = String::from_utf8(crate::columns::csv(&file).unwrap()).unwrap();
        assert_eq!(lines.lines().collect::<Vec<_>>()[..2], ["object,triangle,tests", "a,0,4"]);
    }
}
