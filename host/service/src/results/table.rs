//! The numbers of one run, from the store.

use std::sync::Arc;

use ocb_core::configuration::ConfigurationSet;
use ocb_core::mesh::Mesh;
use ocb_core::selection::{Column, Selection};
use ocb_lab::table::{Entry, RecordTable};

use super::{Results, not_yet, still_measured};
use crate::Result;
use crate::runs::sql::RunRow;

impl Results {
    /// The numbers of a run: of the algorithm that is looked at (when one is), of those that a selection names, or of all.
    pub async fn table(
        &self,
        run: &str,
        looked_at: &str,
        selection: Option<&Selection>,
        all: bool,
    ) -> Result<RecordTable> {
        let row = self.store.run_row(run).await?;
        let set = self.sets.get(row.set_blob.as_deref().ok_or_else(|| not_yet(run))?).await?;
        let table = self.table_so_far(&row, set, looked_at, selection, all).await?;
        if table.preliminary { Err(still_measured()) } else { Ok(table) }
    }

    /// The same, with what a run under way has so far, over its configurations so far.
    pub async fn table_so_far(
        &self,
        row: &RunRow,
        set: Arc<ConfigurationSet>,
        looked_at: &str,
        selection: Option<&Selection>,
        all: bool,
    ) -> Result<RecordTable> {
        let run = row.id.as_str();
        let all = all || selection.is_some_and(|selection| selection.uses(Column::Disputed));
        let mut wanted: Vec<String> = (!looked_at.is_empty()).then(|| looked_at.to_owned()).into_iter().collect();
        wanted.extend(selection.iter().flat_map(|selection| selection.algorithms()).map(str::to_owned));
        if all {
            let with_records = self.store.results(run).await?.into_iter().filter(|r| r.records.is_some());
            wanted.extend(with_records.map(|r| r.result.algorithm));
            wanted.extend(self.under_way.results(run).into_iter().map(|result| result.algorithm));
        }
        let mut entries: Vec<Entry> = Vec::new();
        let mut preliminary = false;
        for algorithm in wanted {
            if entries.iter().all(|entry| entry.algorithm != algorithm) {
                let (result, records) = self.records_so_far(run, &algorithm).await?;
                if records.configuration.iter().any(|configuration| *configuration as usize >= set.placed.len()) {
                    // The whole set has come meanwhile.
                    return Err(not_yet(run));
                }
                preliminary |= result.preliminary;
                let bits = result.class.map_or(64, |class| class.bits);
                entries.push(Entry { algorithm, bits, records });
            }
        }
        let meshes = self.both_meshes(row).await?;
        let (query, semantics) = (row.spec.query, row.spec.semantics);
        Ok(RecordTable { query, semantics, set, meshes, looked_at: looked_at.to_owned(), entries, preliminary })
    }

    /// Object A and object B.
    pub async fn both_meshes(&self, row: &RunRow) -> Result<[Arc<Mesh>; 2]> {
        let a = self.objects.mesh(&row.spec.object_a).await?;
        let b = match &row.spec.object_b {
            Some(b) => self.objects.mesh(b).await?,
            None => a.clone(),
        };
        Ok([a, b])
    }
}
