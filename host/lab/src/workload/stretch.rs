//! What the table of a replayed recording says about a stretch of it.

use std::collections::BTreeMap;

use ocb_core::record::Verdict;

use super::table::{Row, each_row};
use crate::Result;
use crate::model::{AlgorithmOnStretch, PairTime, Stretch, StretchResult};

/// Adds up the rows of [`workload_parquet`](super::workload_parquet) that belong to a stretch.
///
/// # Errors
/// `Invalid` when it is no such table.
pub fn stretch(table: &[u8], of: Stretch) -> Result<StretchResult> {
    let mut sums = Sums::default();
    each_row(table, |row| {
        // Every algorithm of the table is named, also one that was asked nothing here.
        let sum = sums.of(&row);
        if of.contains(row.sequence) {
            sum.count(&row);
        }
    })?;
    Ok(StretchResult { algorithms: sums.all.into_iter().map(Sum::result).collect() })
}

/// In the order of the table.
#[derive(Default)]
struct Sums {
    all: Vec<Sum>,
    /// Of the row before: those of one algorithm stand together.
    last: usize,
}

struct Sum {
    result: AlgorithmOnStretch,
    pairs: BTreeMap<[u32; 2], PairTime>,
}

impl Sums {
    fn of(&mut self, row: &Row) -> &mut Sum {
        let is_of = |sum: &Sum| sum.result.algorithm == row.algorithm && sum.result.track == row.track;
        if !self.all.get(self.last).is_some_and(is_of) {
            self.last = self.all.iter().position(is_of).unwrap_or(self.all.len());
        }
        if self.last == self.all.len() {
            let (algorithm, track) = (row.algorithm.to_owned(), row.track);
            let result = AlgorithmOnStretch { algorithm, track, n: 0, ns: 0.0, wrong: 0, missed: 0, pairs: Vec::new() };
            self.all.push(Sum { result, pairs: BTreeMap::new() });
        }
        &mut self.all[self.last]
    }
}

impl Sum {
    fn count(&mut self, row: &Row) {
        let objects = row.objects;
        let wrong = u64::from(row.verdict.is_wrong());
        let pair = self.pairs.entry(objects).or_insert(PairTime { objects, n: 0, hits: 0, wrong: 0, ns: 0.0 });
        pair.n += 1;
        pair.hits += u64::from(row.hit);
        pair.wrong += wrong;
        pair.ns += row.time_ns;
        self.result.n += 1;
        self.result.ns += row.time_ns;
        self.result.wrong += wrong;
        self.result.missed += u64::from(row.verdict == Verdict::FalseNegative);
    }

    fn result(mut self) -> AlgorithmOnStretch {
        self.result.pairs = self.pairs.into_values().collect();
        self.result.pairs.sort_by(|a, b| b.ns.total_cmp(&a.ns));
        self.result
    }
}
