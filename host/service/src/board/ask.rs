//! The board that a viewer may see, as values and as CSV.

use crate::board;
use crate::board::runs::{measured_of, visible_runs};
use crate::boxed;
use crate::engine::Engine;
use crate::model::{Board, BoardRequest};
use crate::{Result, columns};

impl Engine {
    /// Results of the finished runs that the viewer may see, filtered until they may be compared.
    #[boxed]
    pub async fn board(&self, request: &BoardRequest, viewer: Option<&str>) -> Result<Board> {
        let (store, objects) = (&self.inner.store, &self.inner.objects);
        let suites = store.suites().await?;
        let standings = store.standings().await?;
        let mut measured = Vec::new();
        for row in visible_runs(store, objects, viewer).await? {
            let suite = row.suite.as_ref().and_then(|sha256| suites.iter().find(|suite| suite.sha256 == *sha256));
            for mut result in measured_of(store, &row).await? {
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
