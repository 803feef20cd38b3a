//! Mean and maximum time against distance and against triangle count.

use std::collections::BTreeMap;

use ocb_chart::{Axis, Chart, Form, Point, Scale, Series};
use ocb_core::configuration::{ConfigurationSet, Placed, Separation};
use ocb_core::statistics::{Statistic, maximum_interval};

use super::{Charts, mean, series};
use crate::blocking::blocking;
use crate::board::runs::{measured_of, visible_runs};
use crate::board::{Measured, Named};
use crate::columns::RecordColumns;
use crate::model::{AlgorithmResult, ObjectId};
use crate::runs::sql::RunRow;
use crate::{EngineError, Result};

/// Other runs beside this one, at most.
const OTHERS: usize = 24;

impl Charts {
    /// This run and those of the same pair of objects at other distances.
    pub(super) async fn at_other_distances(&self, row: &RunRow, viewer: Option<&str>) -> Result<Vec<RunRow>> {
        self.alike(row, viewer, |m| &m.scene, |m| &m.distance).await
    }

    /// This run and those at the same distance with other resolutions of a stock object, or with any objects that were
    /// brought.
    pub(super) async fn of_other_sizes(&self, row: &RunRow, viewer: Option<&str>) -> Result<Vec<RunRow>> {
        let runs = self.alike(row, viewer, |m| &m.distance, |m| &m.scene).await?;
        Ok(runs.into_iter().filter(|other| shapes(other) == shapes(row)).collect())
    }

    /// Over the steps of a ladder, and over runs of the same pair of objects.
    pub(super) async fn time_by_distance(&self, results: &[AlgorithmResult], runs: &[RunRow]) -> Result<Chart> {
        let mut all = Vec::new();
        for (place, result) in results.iter().enumerate() {
            let mut groups = Vec::new();
            for run in runs {
                let Some((set, records)) = self.set_and_records(run, &result.algorithm).await? else { continue };
                groups.extend(blocking(move || Ok(by_step(&set, &records))).await?);
            }
            all.extend(mean_and_maximum(&result.name, place, groups));
        }
        let x = Axis::new(
            "distance / L (logarithmic); to the left of the middle: margin of crossing / L",
            "of L",
            Scale::Signed,
        );
        let apart = all.iter().flat_map(|s| &s.points).all(|p| p.x.is_some_and(|x| x > 0.0));
        let x =
            if apart { Axis::new("distance / L, the longest side of A (logarithmic)", "of L", Scale::Log) } else { x };
        Ok(chart("distance", "Time against distance", x, all, runs.len()))
    }

    /// Over runs at the same distance.
    pub(super) async fn time_by_triangles(&self, results: &[AlgorithmResult], runs: &[RunRow]) -> Result<Chart> {
        let mut all = Vec::new();
        for (place, result) in results.iter().enumerate() {
            let mut groups = Vec::new();
            for run in runs {
                let Some((_, records)) = self.set_and_records(run, &result.algorithm).await? else { continue };
                let b = run.spec.object_b.as_ref().unwrap_or(&run.spec.object_a);
                let triangles = [self.objects.info(&run.spec.object_a).await?, self.objects.info(b).await?];
                let x = triangles.iter().map(|object| f64::from(object.triangles)).sum();
                groups.push((x, records.time_ns.clone()));
            }
            all.extend(mean_and_maximum(&result.name, place, groups));
        }
        let x = Axis::new("triangles of both objects (logarithmic)", "triangles", Scale::Log);
        Ok(chart("triangles", "Time against triangle count", x, all, runs.len()))
    }

    /// This run, then others that the asker may see, of the same question and hardware class, that agree in one thing
    /// and differ in another.
    async fn alike(
        &self,
        row: &RunRow,
        viewer: Option<&str>,
        same: fn(&Measured) -> &Named,
        differs: fn(&Measured) -> &Named,
    ) -> Result<Vec<RunRow>> {
        let own = measured_of(&self.store, row).await?;
        let Some(first) = own.first() else { return Ok(Vec::new()) };
        let (mut seen, mut runs) = (vec![differs(first).clone()], vec![row.clone()]);
        for other in visible_runs(&self.store, &self.objects, viewer).await? {
            let of_other = measured_of(&self.store, &other).await?;
            let Some(m) = of_other.first().filter(|_| other.id != row.id) else { continue };
            let alike = same(m) == same(first) && m.question == first.question && m.hardware == first.hardware;
            if alike && !seen.contains(differs(m)) && runs.len() <= OTHERS {
                seen.push(differs(m).clone());
                runs.push(other);
            }
        }
        Ok(runs)
    }

    /// What an algorithm measured in a run; nothing when it took no part.
    async fn set_and_records(
        &self,
        run: &RunRow,
        algorithm: &str,
    ) -> Result<Option<(std::sync::Arc<ConfigurationSet>, std::sync::Arc<RecordColumns>)>> {
        match self.results.records_so_far(&run.id, algorithm).await {
            Ok((_, records)) => Ok(Some((self.results.set_so_far(run).await?, records))),
            Err(EngineError::NotFound(_)) => Ok(None),
            Err(e) => Err(e),
        }
    }
}

/// The shapes of a run's objects: a stock object is the same in every resolution, those that were brought are alike.
fn shapes(row: &RunRow) -> [&str; 2] {
    let a = &row.spec.object_a;
    [a, row.spec.object_b.as_ref().unwrap_or(a)].map(|id| match ObjectId::of(id) {
        ObjectId::Stock { name, .. } => name,
        ObjectId::Added(_) => "",
    })
}

/// The times of the configurations that were to be equally far apart, at the median of what they are, over L.
fn by_step(set: &ConfigurationSet, records: &RecordColumns) -> Vec<(f64, Vec<f64>)> {
    let mut steps: BTreeMap<u64, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
    for (configuration, ns) in records.configuration.iter().zip(&records.time_ns) {
        let Some(placed) = set.placed.get(*configuration as usize) else { continue };
        let group = match placed.wanted {
            Some(Separation::Step { of_size }) => of_size.to_bits(),
            _ if placed.truth.hit => 1,
            _ => 0,
        };
        let (apart, times) = steps.entry(group).or_default();
        apart.push(signed(placed) / set.longest_side);
        times.push(*ns);
    }
    let at = |(mut apart, times): (Vec<f64>, Vec<f64>)| Some((Statistic::Median.of(&mut apart)?, times));
    // Touching is at no distance of a logarithmic axis.
    steps.into_values().filter_map(at).filter(|(x, _)| *x != 0.0).collect()
}

/// The distance; when they cross, the margin, below 0.
fn signed(placed: &Placed) -> f64 {
    if placed.truth.hit { -placed.truth.margin } else { 0.5 * (placed.truth.distance_lo + placed.truth.distance_hi) }
}

/// Two series: filled marks for the mean, hollow ones for the maximum.
fn mean_and_maximum(name: &str, place: usize, mut groups: Vec<(f64, Vec<f64>)>) -> Vec<Series> {
    groups.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let (mut means, mut maxima) = (Vec::new(), Vec::new());
    for (x, mut times) in groups {
        let n = times.len() as u64;
        let [value, lo, hi] = mean(&times);
        means.push(Point::at(x, value, n).within(lo, hi));
        times.sort_unstable_by(f64::total_cmp);
        let (lo, most) = maximum_interval(&times);
        maxima.push(Point { filled: false, ..Point::at(x, most, n).within(lo, most) });
    }
    let line = |what: &str, points| series(&format!("{name}, {what}"), place, Form::Line, points);
    if means.is_empty() { Vec::new() } else { vec![line("mean", means), line("maximum", maxima)] }
}

fn chart(kind: &str, title: &str, x: Axis, series: Vec<Series>, runs: usize) -> Chart {
    let from = if runs == 1 { "this run".to_owned() } else { format!("{runs} runs on this hardware class") };
    Chart {
        kind: kind.into(),
        preliminary: false,
        title: title.into(),
        finding: String::new(),
        x,
        y: Axis::new("time per query (logarithmic)", "ns", Scale::Log),
        series,
        notes: vec![
            format!(
                "From {from}. Filled: mean with its 95 % bootstrap interval over the configurations; hollow: maximum."
            ),
            "The bar of a maximum begins at the sixth largest time and has no upper end.".into(),
        ],
    }
}
