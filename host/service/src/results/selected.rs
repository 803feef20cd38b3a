//! Selected configurations of a run, and all pairs of triangles that meet in one of them.

use std::sync::Arc;

use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::selection::Selection;
use ocb_core::validation::Precision;

use super::Results;
use crate::blocking::blocking;
use crate::columns::{self, Numbers};
use crate::model::{Meeting, Selected, WorstCase, WorstRequest};
use crate::{EngineError, Result};

/// Longest list of the worst.
const MOST_CASES: u32 = 1_000;
/// Longest list of pairs.
const MOST_PAIRS: usize = 100_000;

impl Results {
    /// How many configurations a selection holds, and what they cost each algorithm.
    pub async fn selected(&self, run: &str, algorithm: &str, selection: &str) -> Result<Selected> {
        let selection = read(selection)?;
        let table = self.table(run, algorithm, Some(&selection), true).await?;
        blocking(move || Ok(table.selected(&selection)?)).await
    }

    /// Which configurations a selection holds; columns without `of` are those of `algorithm`.
    pub async fn chosen(&self, run: &str, algorithm: &str, selection: &str) -> Result<Arc<[bool]>> {
        let selection = read(selection)?;
        let table = self.table(run, algorithm, Some(&selection), false).await?;
        blocking(move || Ok(table.choose(&selection)?.into())).await
    }

    /// The records of the selected configurations as Parquet.
    pub async fn selected_records(&self, run: &str, algorithm: &str, selection: &str) -> Result<Vec<u8>> {
        let selection = read(selection)?;
        let table = self.table(run, algorithm, Some(&selection), false).await?;
        let parquet = self.records_parquet(run, algorithm).await?;
        blocking(move || Ok(columns::select(&parquet, &table.choose(&selection)?)?)).await
    }

    /// The worst configurations of an algorithm: wrong answers first, missed collisions before all.
    pub async fn worst(&self, run: &str, request: &WorstRequest) -> Result<Vec<WorstCase>> {
        if !(1..=MOST_CASES).contains(&request.limit) {
            return Err(EngineError::Invalid(format!("A list of worst configurations has 1 to {MOST_CASES} entries.")));
        }
        let selection = request.selection.as_deref().map(read).transpose()?;
        let table = self.table(run, &request.algorithm, selection.as_ref(), false).await?;
        let (by, limit) = (request.by, request.limit as usize);
        blocking(move || Ok(table.worst(selection.as_ref(), by, limit)?)).await
    }

    /// All pairs of triangles that meet in one configuration of the run; of the objects with their coordinates `rounded` to single
    /// precision, or as they are.
    pub async fn meeting(&self, run: &str, configuration: u32, rounded: bool) -> Result<Meeting> {
        let row = self.store.run_row(run).await?;
        let set = self.sets.get(row.set_blob.as_deref().ok_or_else(|| super::not_yet(run))?).await?;
        let Some(placed) = set.placed.get(configuration as usize).copied() else {
            let n = set.placed.len();
            return Err(EngineError::NotFound(format!(
                "There is no configuration {configuration}; the set has {n}, counted from 0."
            )));
        };
        let precision = if rounded { Precision::Single } else { Precision::Double };
        let (placed, rounded) = (placed.seen_in(precision), rounded && placed.rounded.is_some());
        let [a, b] = self.both_meshes(&row).await?;
        let (a, b) = (self.shape(a, rounded).await?, self.shape(b, rounded).await?);
        blocking(move || {
            let meet = placed.truth.hit;
            let mut pairs = if meet { Pair::new(&a, &b).contacts(&placed.configuration) } else { Vec::new() };
            let total = pairs.len() as u32;
            pairs.truncate(MOST_PAIRS);
            Ok(Meeting { configuration, total, pairs })
        })
        .await
    }

    /// What the oracle needs of a mesh, from memory when it was used lately.
    async fn shape(&self, mesh: Arc<Mesh>, rounded: bool) -> Result<Arc<Shape>> {
        let key = if rounded { format!("{} rounded", mesh.sha256()) } else { mesh.sha256() };
        if let Some(shape) = self.shapes.get(&key) {
            return Ok(shape);
        }
        let shape = blocking(move || {
            let seen = if rounded { Arc::unwrap_or_clone(mesh).to_f32_representable().map(Arc::new) } else { Ok(mesh) };
            Ok(Shape::new(seen.map_err(|e| EngineError::fault("Rounding an object failed", e))?))
        })
        .await?;
        Ok(self.shapes.put(&key, shape))
    }

    /// Which configurations a selection holds, as an Arrow stream.
    pub async fn selection_arrow(&self, run: &str, algorithm: &str, selection: &str) -> Result<Vec<u8>> {
        let chosen = self.chosen(run, algorithm, selection).await?;
        blocking(move || Ok(columns::stream(vec![("chosen", Numbers::Chosen(chosen.to_vec()))])?)).await
    }

    /// Every column of an algorithm that a range can test, one value per configuration of the set, as an Arrow stream.
    pub async fn columns_arrow(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let table = self.table(run, algorithm, None, false).await?;
        blocking(move || Ok(table.columns_arrow()?)).await
    }

    /// Where every configuration has its witness points, in the objects' frames, and how far apart it is.
    pub async fn witnesses_arrow(&self, run: &str) -> Result<Vec<u8>> {
        let table = self.table(run, "", None, false).await?;
        blocking(move || Ok(table.witnesses_arrow()?)).await
    }
}

/// Reads a selection.
pub fn read(text: &str) -> Result<Selection> {
    text.parse().map_err(|e: ocb_core::selection::SelectionError| EngineError::Invalid(e.to_string()))
}
