//! The charts of a run: each a set of series with n and intervals, from stored records and summaries.
//!
//! Times are compared inside one hardware class, so that charts over several runs take those of this run's class alone,
//! and only runs that the asker may see.
//!
//! A run under way has charts, too, made of the answers so far and marked as preliminary.
//!
//! A finished run never changes, so its charts are kept in memory ([`KEPT_POINTS`]): the intervals of a large one take more
//! than a second.

pub mod ask;
pub mod columns;
mod resolution;
mod times;
mod work;

use std::sync::Arc;

use ocb_chart::{Chart, Series};
use ocb_core::statistics::bootstrap_interval;

use crate::board::runs::{measured_of, measured_so_far};
use crate::board::{Measured, of_run};
use crate::cache::Cache;
use crate::machine::Machine;
use crate::model::{AlgorithmResult, ChartKind, ChartRequest, State};
use crate::objects::Objects;
use crate::results::Results;
use crate::runs::sql::RunRow;
use crate::store::Store;
use crate::{EngineError, Profile, Result};

/// Points of the charts in memory, in all: about 40 MB.
const KEPT_POINTS: usize = 200_000;

/// The charts of all runs.
pub struct Charts {
    store: Store,
    objects: Arc<Objects>,
    results: Arc<Results>,
    /// The machine and the jail in which runs are measured here.
    machine: Machine,
    profile: Profile,
    drawn: Cache<Chart>,
}

impl Charts {
    /// Those of these results.
    pub fn new(store: Store, objects: Arc<Objects>, results: Arc<Results>, machine: Machine, profile: Profile) -> Self {
        Self { store, objects, results, machine, profile, drawn: Cache::weighing(KEPT_POINTS, points) }
    }

    /// One chart of a run, from memory when it was drawn lately.
    pub async fn chart(&self, run: &str, request: ChartRequest, viewer: Option<&str>) -> Result<Chart> {
        let row = self.store.run_row(run).await?;
        let runs = self.charted_runs(&row, request.kind, viewer).await?;
        let Some(key) = key(&request, &row, &runs) else { return self.draw(&row, &runs, request).await };
        if let Some(chart) = self.drawn.get(&key) {
            return Ok((*chart).clone());
        }
        let chart = self.draw(&row, &runs, request).await?;
        Ok((*self.drawn.put(&key, chart)).clone())
    }

    /// The runs that a chart is made of: this one alone, or with others that the asker may see.
    async fn charted_runs(&self, row: &RunRow, kind: ChartKind, viewer: Option<&str>) -> Result<Vec<RunRow>> {
        match kind {
            // Its results are compared with no other run's.
            _ if matches!(row.state, State::Queued | State::Running) => Ok(vec![row.clone()]),
            ChartKind::Distance => self.at_other_distances(row, viewer).await,
            ChartKind::Triangles => self.of_other_sizes(row, viewer).await,
            _ => Ok(vec![row.clone()]),
        }
    }

    async fn draw(&self, row: &RunRow, runs: &[RunRow], request: ChartRequest) -> Result<Chart> {
        let run = &row.id;
        let mut results = self.results.results_so_far(run).await?;
        results.retain(|result| result.n > 0);
        let preliminary = results.iter().any(|result| result.preliminary);
        if results.is_empty() {
            return Err(EngineError::NotFound(format!("The run {run:?} cannot be charted: no algorithm has a time.")));
        }
        let chosen = self.chosen_for(row, &results, &request).await?;
        let mut chart = match request.kind {
            ChartKind::Accuracy => {
                let measured: Vec<Measured> = match preliminary {
                    true => measured_so_far(&self.machine, self.profile, row, &results),
                    false => measured_of(&self.store, row).await?,
                };
                of_run(&measured, request.accuracy)
            }
            ChartKind::Distance => self.time_by_distance(&results, runs).await?,
            ChartKind::Triangles => self.time_by_triangles(&results, runs).await?,
            ChartKind::Ecdf => self.times_spread(row, &results, chosen.as_deref()).await?,
            ChartKind::BvTests | ChartKind::PrimitiveTests => {
                self.time_by_tests(row, &results, request.kind, chosen.clone()).await?
            }
            ChartKind::Resolution => resolution::chart(&results),
        };
        // While it is preliminary, there may be points later.
        if !preliminary && chart.series.iter().all(|series| series.points.is_empty()) {
            let why = match chosen {
                Some(_) => "The selection has none of these configurations.",
                None => nothing(request.kind),
            };
            return Err(EngineError::NotFound(why.into()));
        }
        if let (Some(selection), Some(chosen)) = (&request.selection, &chosen) {
            let n = chosen.iter().filter(|is| **is).count();
            chart.notes.push(format!("Only the {n} of {} configurations of the selection {selection}.", chosen.len()));
        }
        if preliminary {
            chart.notes.push("Preliminary: the run is still being measured, and this shows its answers so far.".into());
        }
        Ok(Chart { preliminary, ..chart })
    }

    /// The configurations of the request's selection; none when it has none.
    async fn chosen_for(
        &self,
        row: &RunRow,
        results: &[AlgorithmResult],
        request: &ChartRequest,
    ) -> Result<Option<Arc<[bool]>>> {
        let Some(selection) = &request.selection else { return Ok(None) };
        if !request.kind.takes_selection() {
            return Err(EngineError::Invalid(
                "This chart shows whole runs; only the kinds ecdf, bv_tests and primitive_tests accept a selection."
                    .into(),
            ));
        }
        let only = if let [one] = results { one.algorithm.as_str() } else { "" };
        let algorithm = request.algorithm.as_deref().unwrap_or(only);
        Ok(Some(self.results.chosen(&row.id, algorithm, selection).await?))
    }
}

/// What a chart is kept under; nothing while one of its runs may still change. A run that was refined has another end.
fn key(request: &ChartRequest, row: &RunRow, runs: &[RunRow]) -> Option<String> {
    let mut key = format!("{request:?}");
    for run in std::iter::once(row).chain(runs) {
        let finished_us = run.finished_us.filter(|_| run.state == State::Done)?;
        key.push_str(&format!(" {}@{finished_us}", run.id));
    }
    Some(key)
}

/// How much of the memory for charts one takes.
fn points(chart: &Chart) -> usize {
    1 + chart.series.iter().map(|series| series.points.len()).sum::<usize>()
}

/// Why there are no points.
fn nothing(kind: ChartKind) -> &'static str {
    match kind {
        ChartKind::Accuracy => "No algorithm of this run has both a time and an accuracy of this kind.",
        ChartKind::Distance | ChartKind::Triangles | ChartKind::Ecdf => "This run has no times to chart.",
        ChartKind::BvTests | ChartKind::PrimitiveTests => "No algorithm of this run reports its tests.",
        ChartKind::Resolution => {
            "This run has no decisions by distance: it was measured by an older version, or the objects touch in \
             every configuration."
        }
    }
}

/// Arithmetic mean with its 95 % bootstrap interval; the same values give the same interval.
fn mean(values: &[f64]) -> [f64; 3] {
    let of = |values: &mut [f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (lo, hi) = bootstrap_interval(values, of, 1);
    [of(&mut values.to_vec()), lo, hi]
}

/// A chart whose series are the algorithms in the run's order.
fn series(name: &str, place: usize, form: ocb_chart::Form, points: Vec<ocb_chart::Point>) -> Series {
    Series { name: name.to_owned(), style: Some((place % ocb_chart::STYLES.len()) as u8), form, points }
}
