//! How times spread, and how they go with the work that an algorithm counts.

use std::collections::BTreeMap;
use std::sync::Arc;

use ocb_chart::{Axis, Chart, Form, Point, Scale};
use rayon::prelude::*;

use super::{Charts, mean, series};
use crate::Result;
use crate::blocking::blocking;
use crate::model::{AlgorithmResult, ChartKind};
use crate::runs::sql::RunRow;

/// Steps of a power of ten into which tests are sorted.
const STEPS: f64 = 4.0;

impl Charts {
    /// The distribution of the time per query.
    pub(super) async fn times_spread(
        &self,
        row: &RunRow,
        results: &[AlgorithmResult],
        chosen: Option<&[bool]>,
    ) -> Result<Chart> {
        let mut all = Vec::new();
        for (place, result) in results.iter().enumerate() {
            let curve = self.results.ecdf_of(&row.id, &result.algorithm, chosen).await?;
            let points = curve.time_ns.iter().zip(&curve.share);
            let points = points.map(|(ns, share)| Point::at(*ns, *share, u64::from(curve.n))).collect();
            all.push(series(&result.name, place, Form::Steps, points));
        }
        Ok(Chart {
            kind: "ecdf".into(),
            preliminary: false,
            title: "Distribution of the time per query".into(),
            finding: String::new(),
            x: Axis::new("time per query (logarithmic)", "ns", Scale::Log),
            y: Axis::new("share of configurations at or below", "share", Scale::Linear),
            series: all,
            notes: vec!["Each curve is drawn through at most 512 points.".into()],
        })
    }

    /// Mean time of the queries that needed about as many tests.
    pub(super) async fn time_by_tests(
        &self,
        row: &RunRow,
        results: &[AlgorithmResult],
        kind: ChartKind,
        chosen: Option<Arc<[bool]>>,
    ) -> Result<Chart> {
        let mut all = Vec::new();
        for (place, result) in results.iter().enumerate() {
            let (_, records) = self.results.records_so_far(&row.id, &result.algorithm).await?;
            let chosen = chosen.clone();
            let points = blocking(move || {
                let tests = if kind == ChartKind::BvTests { &records.bv_tests } else { &records.primitive_tests };
                let rows = records.rows(chosen.as_deref());
                Ok(binned(rows.filter_map(|row| Some((tests[row]?, records.time_ns[row])))))
            })
            .await?;
            if !points.is_empty() {
                all.push(series(&result.name, place, Form::Line, points));
            }
        }
        let (kind, what) =
            if kind == ChartKind::BvTests { ("bv_tests", "BV tests") } else { ("primitive_tests", "primitive tests") };
        Ok(Chart {
            kind: kind.into(),
            preliminary: false,
            title: format!("Time against {what}"),
            finding: String::new(),
            x: Axis::new(&format!("{what} per query (logarithmic)"), "tests", Scale::Log),
            y: Axis::new("mean time per query (logarithmic)", "ns", Scale::Log),
            series: all,
            notes: vec![
                "A mark is the mean of all queries with a similar number of tests (a quarter of a power of ten), its bar the 95 % \
                 bootstrap interval; queries without a test stand at 1."
                    .into(),
            ],
        })
    }
}

/// Means by quarters of a power of ten.
fn binned(values: impl Iterator<Item = (u64, f64)>) -> Vec<Point> {
    let mut bins: BTreeMap<i64, (f64, Vec<f64>)> = BTreeMap::new();
    for (tests, ns) in values {
        let tests = tests.max(1) as f64;
        let bin = bins.entry((STEPS * tests.log10()).floor() as i64).or_default();
        bin.0 += tests;
        bin.1.push(ns);
    }
    let bins: Vec<(f64, Vec<f64>)> = bins.into_values().collect();
    let point = |(tests, times): &(f64, Vec<f64>)| {
        let [value, lo, hi] = mean(times);
        Point::at(tests / times.len() as f64, value, times.len() as u64).within(lo, hi)
    };
    bins.par_iter().map(point).collect()
}
