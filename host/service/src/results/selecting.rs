//! Selections of configurations, and the worst of them.

use crate::Result;
use crate::blocking::blocking;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{Meeting, Selected, WorstCase, WorstRequest};

impl Engine {
    /// How many configurations of the run a selection holds, and what they cost each algorithm. Columns without `of` are
    /// those of `algorithm`.
    #[boxed]
    pub async fn selected(&self, run: &str, algorithm: &str, selection: &str) -> Result<Selected> {
        self.inner.results.selected(run, algorithm, selection).await
    }

    /// The records of the selected configurations as Parquet.
    #[boxed]
    pub async fn selected_parquet(&self, run: &str, algorithm: &str, selection: &str) -> Result<Vec<u8>> {
        self.inner.results.selected_records(run, algorithm, selection).await
    }

    /// The records of the selected configurations as CSV with a header line.
    #[boxed]
    pub async fn selected_csv(&self, run: &str, algorithm: &str, selection: &str) -> Result<Vec<u8>> {
        let parquet = self.inner.results.selected_records(run, algorithm, selection).await?;
        blocking(move || Ok(crate::columns::csv(&parquet)?)).await
    }

    /// The worst configurations of an algorithm: wrong answers first.
    #[boxed]
    pub async fn worst(&self, run: &str, request: &WorstRequest) -> Result<Vec<WorstCase>> {
        self.inner.results.worst(run, request).await
    }

    /// All pairs of triangles that meet in one configuration, by the oracle; of the objects as algorithms in single precision get
    /// them when `rounded`.
    #[boxed]
    pub async fn meeting(&self, run: &str, configuration: u32, rounded: bool) -> Result<Meeting> {
        self.inner.results.meeting(run, configuration, rounded).await
    }

    /// Which configurations a selection holds, as an Arrow stream.
    #[boxed]
    pub async fn selection_arrow(&self, run: &str, algorithm: &str, selection: &str) -> Result<Vec<u8>> {
        self.inner.results.selection_arrow(run, algorithm, selection).await
    }

    /// Every column of an algorithm that a range can test, one value per configuration of the set (NaN where there is none), as an Arrow stream.
    #[boxed]
    pub async fn columns_arrow(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        self.inner.results.columns_arrow(run, algorithm).await
    }

    /// Where every configuration has its witness points, in the objects' frames, as an Arrow stream.
    #[boxed]
    pub async fn witnesses_arrow(&self, run: &str) -> Result<Vec<u8>> {
        self.inner.results.witnesses_arrow(run).await
    }
}
