//! What the table of a replayed recording says about a stretch of it.

use std::collections::{BTreeMap, HashMap};

use arrow_array::{BooleanArray, Float64Array, RecordBatch, StringArray, UInt64Array};
use ocb_core::record::Verdict;

use crate::columns::{column, from_parquet};
use crate::model::{AlgorithmOnStretch, PairTime, Stretch, StretchResult, Track};
use crate::{LabError, Result};

/// Adds up the rows of [`workload_parquet`](super::workload_parquet) that belong to a stretch.
///
/// # Errors
/// `Fault` when it is no such table.
pub fn stretch(table: &[u8], of: Stretch) -> Result<StretchResult> {
    let damaged = |why: String| LabError::fault("Reading the queries of a replayed recording failed", why);
    let mut sums = Sums::default();
    for batch in &from_parquet(table).map_err(damaged)?.1 {
        sums.add(batch, of).map_err(damaged)?;
    }
    Ok(StretchResult { algorithms: sums.0.into_iter().map(Sum::result).collect() })
}

/// In the order of the table.
#[derive(Default)]
struct Sums(Vec<Sum>);

struct Sum {
    result: AlgorithmOnStretch,
    pairs: BTreeMap<[u32; 2], PairTime>,
}

impl Sums {
    fn add(&mut self, batch: &RecordBatch, of: Stretch) -> std::result::Result<(), String> {
        let numbers = |name| column::<UInt64Array>(batch, name);
        let words = |name| column::<StringArray>(batch, name);
        let (sequence, a, b) = (numbers("sequence")?, numbers("object_a")?, numbers("object_b")?);
        let (algorithm, order, verdict) = (words("algorithm")?, words("order")?, words("verdict")?);
        let (times, hit) = (column::<Float64Array>(batch, "time_ns")?, column::<BooleanArray>(batch, "hit")?);
        let mut places: HashMap<(&str, &str), usize> = HashMap::new();
        for row in 0..batch.num_rows() {
            let number = sequence.value(row);
            // Every algorithm of the table is named, also one that was asked nothing here.
            let key = (algorithm.value(row), order.value(row));
            let place = match places.get(&key) {
                Some(place) => *place,
                None => *places.entry(key).or_insert(self.place(key.0, super::table::track(key.1)?)),
            };
            if number < of.from.unwrap_or(0) || of.to.is_some_and(|to| number >= to) {
                continue;
            }
            let verdict = Verdict::named(verdict.value(row)).ok_or("a verdict is unknown")?;
            let objects = [a.value(row), b.value(row)].map(|place| place as u32);
            self.0[place].count(objects, times.value(row), hit.value(row), verdict);
        }
        Ok(())
    }

    fn place(&mut self, algorithm: &str, track: Track) -> usize {
        let known = self.0.iter().position(|sum| sum.result.algorithm == algorithm && sum.result.track == track);
        known.unwrap_or_else(|| {
            let algorithm = algorithm.to_owned();
            let result = AlgorithmOnStretch { algorithm, track, n: 0, ns: 0.0, wrong: 0, missed: 0, pairs: Vec::new() };
            self.0.push(Sum { result, pairs: BTreeMap::new() });
            self.0.len() - 1
        })
    }
}

impl Sum {
    fn count(&mut self, objects: [u32; 2], ns: f64, hit: bool, verdict: Verdict) {
        let wrong = u64::from(verdict.is_wrong());
        let pair = self.pairs.entry(objects).or_insert(PairTime { objects, n: 0, hits: 0, wrong: 0, ns: 0.0 });
        pair.n += 1;
        pair.hits += u64::from(hit);
        pair.wrong += wrong;
        pair.ns += ns;
        self.result.n += 1;
        self.result.ns += ns;
        self.result.wrong += wrong;
        self.result.missed += u64::from(verdict == Verdict::FalseNegative);
    }

    fn result(mut self) -> AlgorithmOnStretch {
        self.result.pairs = self.pairs.into_values().collect();
        self.result.pairs.sort_by(|a, b| b.ns.total_cmp(&a.ns));
        self.result
    }
}
