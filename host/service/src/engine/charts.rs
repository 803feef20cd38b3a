//! The board and the charts of a run, as values and as files.

use ocb_chart::Chart;

use super::{Engine, Inner};
use crate::board::{self, Circumstances, Measured};
use crate::boxed;
use crate::model::{Board, BoardRequest, ChartRequest, State, Visibility};
use crate::store::RunRow;
use crate::{Profile, Result, columns};

/// Finished runs that are looked at, at most: the newest.
const MOST_RUNS: i64 = 1000;

impl Engine {
    /// Results of the finished runs that the viewer may see, filtered until they may be compared.
    #[boxed]
    pub async fn board(&self, request: &BoardRequest, viewer: Option<&str>) -> Result<Board> {
        let suites = self.inner.store.suites().await?;
        let standings = self.inner.standings().await?;
        let mut measured = Vec::new();
        for row in self.inner.visible_runs(viewer).await? {
            let suite = row.suite.as_ref().and_then(|sha256| suites.iter().find(|suite| suite.sha256 == *sha256));
            for mut result in self.inner.measured_of(&row).await? {
                result.suite = suite.map(board::suite);
                result.standing = standings.get(&result.plugin_sha256).and_then(|standing| standing.why_not(&result));
                measured.push(result);
            }
        }
        let mut board = board::board(measured, request, &suites)?;
        board::add_stability(&mut board.rows, &self.stability().await?);
        Ok(board)
    }

    /// One chart of a run. Others of its kind are taken from the runs that the viewer may see.
    #[boxed]
    pub async fn chart(&self, run: &str, request: ChartRequest, viewer: Option<&str>) -> Result<Chart> {
        self.inner.chart(run, request, viewer).await
    }
}

/// The rows of the board as CSV with a header line.
pub fn board_csv(board: &Board) -> Result<Vec<u8>> {
    Ok(columns::csv(&columns::board_parquet(&board.rows)?)?)
}

/// The numbers of a chart as Parquet, one row per point.
pub fn chart_parquet(chart: &Chart) -> Result<Vec<u8>> {
    Ok(columns::chart_parquet(chart)?)
}

/// The same rows as CSV with a header line.
pub fn chart_csv(chart: &Chart) -> Result<Vec<u8>> {
    Ok(columns::csv(&columns::chart_parquet(chart)?)?)
}

impl Inner {
    /// The finished runs whose results this viewer may see in lists and comparisons, the newest first: public ones, and
    /// the viewer's own; then those of suites.
    #[boxed]
    pub async fn visible_runs(&self, viewer: Option<&str>) -> Result<Vec<RunRow>> {
        let mut visible = Vec::new();
        for row in self.store.finished_runs(viewer, MOST_RUNS).await? {
            let own = viewer.is_some() && row.owner.as_deref() == viewer;
            if self.may_see(&row, viewer).await? && (own || self.visibility_of(&row).await? == Visibility::Public) {
                visible.push(row);
            }
        }
        visible.extend(self.store.suite_runs().await?.into_iter().filter(|row| row.state == State::Done));
        Ok(visible)
    }

    /// The results of one run; none when it was never measured.
    #[boxed]
    pub async fn measured_of(&self, row: &RunRow) -> Result<Vec<Measured>> {
        let Some(machine) = &row.environment else { return Ok(Vec::new()) };
        let circumstances = Circumstances {
            run: &row.id,
            finished_us: row.finished_us.unwrap_or(row.created_us),
            spec: &row.spec,
            names: [&row.object_a_name, &row.object_b_name],
            machine: [&machine.cpu, &machine.hardware_class],
            ranked: machine.profile == Profile::Production.as_str(),
            preview: row.preview.as_ref(),
            set: row.set.as_ref(),
        };
        let results = self.store.results(&row.id).await?.into_iter();
        Ok(results.map(|stored| Measured::of(&circumstances, &stored.plugin_sha256, stored.result)).collect())
    }
}

#[cfg(test)]
mod tests {
    use ocb_core::query::Query;
    use ocb_core::resolution::{Decade, Resolution, Threshold};

    use super::*;
    use crate::EngineConfig;
    use crate::store::StoredResult;
    use crate::store::tests::{result, run};

    /// Some of five decisions were wrong.
    fn with_wrong(wrong: u32) -> StoredResult {
        let decades = vec![Decade { exponent: -3, n: 5, wrong }];
        let false_hits = Threshold { n: 5, wrong, at: Some(1e-3), decades };
        let mut stored = result("a", 5);
        stored.result.resolution = Some(Resolution { false_hits, ..Resolution::default() });
        stored
    }

    #[tokio::test]
    async fn the_charts_of_a_finished_run_are_drawn_once() {
        let folder = tempfile::tempdir().unwrap();
        let config =
            EngineConfig { plugins: Vec::new(), dispatch: false, ..EngineConfig::beside_executable(folder.path()) };
        let engine = Engine::open(config).await.unwrap();
        let store = &engine.inner.store;
        let ask = async || {
            let request = serde_json::from_str(r#"{ "kind": "resolution" }"#).unwrap();
            engine.chart("r", request, None).await.unwrap().series[0].points[0].y
        };
        let keep = async |wrong| store.keep_result("r", 0, &with_wrong(wrong), 100, Query::Proximity).await.unwrap();
        assert!(store.add_run(&run("r", None, 1, 1), &[], None).await.unwrap());
        keep(0).await;
        assert_eq!(ask().await, 0.0);
        keep(1).await;
        assert_eq!(ask().await, 0.2, "a run that goes on changes");
        assert!(store.end_run("r", State::Queued, State::Done, None).await.unwrap());
        assert_eq!(ask().await, 0.2);
        // No finished run is written to; this shows that nothing is read again.
        keep(2).await;
        assert_eq!(ask().await, 0.2);
        let row = store.run("r").await.unwrap().unwrap();
        assert!(store.queue_again(&row, &[]).await.unwrap());
        assert!(store.end_run("r", State::Queued, State::Done, None).await.unwrap());
        assert_eq!(ask().await, 0.4, "a refined run is another one");
        engine.shutdown().await;
    }
}
