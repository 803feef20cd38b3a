//! The board that a viewer may see, as values and as CSV.

use crate::board::{self, Circumstances, Measured};
use crate::boxed;
use crate::engine::{Engine, Inner};
use crate::model::{AlgorithmResult, Board, BoardRequest, State, Visibility};
use crate::runs::sql::RunRow;
use crate::{Profile, Result, columns};

/// Finished runs that are looked at, at most: the newest.
const MOST_RUNS: i64 = 1000;

impl Engine {
    /// Results of the finished runs that the viewer may see, filtered until they may be compared.
    #[boxed]
    pub async fn board(&self, request: &BoardRequest, viewer: Option<&str>) -> Result<Board> {
        let suites = self.inner.store.suites().await?;
        let standings = self.inner.store.standings().await?;
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
}

/// The rows of the board as CSV with a header line.
pub fn board_csv(board: &Board) -> Result<Vec<u8>> {
    Ok(columns::csv(&board::columns::board_parquet(&board.rows)?)?)
}

impl Inner {
    /// The finished runs whose results this viewer may see in lists and comparisons, the newest first: public ones, and
    /// the viewer's own; then those of suites.
    #[boxed]
    pub async fn visible_runs(&self, viewer: Option<&str>) -> Result<Vec<RunRow>> {
        let mut visible = Vec::new();
        for row in self.store.finished_runs(viewer, MOST_RUNS).await? {
            let own = viewer.is_some() && row.owner.as_deref() == viewer;
            if self.objects.may_see(&row, viewer).await?
                && (own || self.objects.visibility_of(&row).await? == Visibility::Public)
            {
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
        let ranked = machine.profile == Profile::Production.as_str();
        let circumstances = circumstances(row, [&machine.cpu, &machine.hardware_class], ranked);
        let results = self.store.results(&row.id).await?.into_iter();
        Ok(results.map(|stored| Measured::of(&circumstances, &stored.plugin_sha256, stored.result)).collect())
    }

    /// The results so far of a run that is being measured here.
    pub fn measured_so_far(&self, row: &RunRow, results: &[AlgorithmResult]) -> Vec<Measured> {
        let ranked = self.registry.profile() == Profile::Production;
        let circumstances = circumstances(row, [&self.machine.cpu, &self.machine.hardware_class], ranked);
        results.iter().map(|result| Measured::of(&circumstances, "", result.clone())).collect()
    }
}

fn circumstances<'a>(row: &'a RunRow, machine: [&'a str; 2], ranked: bool) -> Circumstances<'a> {
    Circumstances {
        run: &row.id,
        finished_us: row.finished_us.unwrap_or(row.created_us),
        spec: &row.spec,
        names: [&row.object_a_name, &row.object_b_name],
        machine,
        ranked,
        preview: row.preview.as_ref(),
        set: row.set.as_ref(),
    }
}
