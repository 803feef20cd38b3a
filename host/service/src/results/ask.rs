//! Heatmaps, distributions and records of a run, as values and as files.

use ocb_core::colormap::{Colormap, Scale};

use crate::engine::Engine;
use crate::model::{Ecdf, Heatmap, HeatmapRequest};
use crate::results::Format;
use crate::{Result, boxed};

impl Engine {
    /// Values on the vertices of one object of the run.
    #[boxed]
    pub async fn heatmap(&self, run: &str, request: &HeatmapRequest) -> Result<Heatmap> {
        self.inner.results.heatmap(run, request).await
    }

    /// The coloured object as glTF binary, with the raw values.
    #[boxed]
    pub async fn heatmap_glb(
        &self,
        run: &str,
        request: &HeatmapRequest,
        map: Colormap,
        scale: Scale,
    ) -> Result<Vec<u8>> {
        self.inner.results.export(run, request, map, scale, Format::Glb).await
    }

    /// The coloured object as PLY, with the raw values.
    #[boxed]
    pub async fn heatmap_ply(
        &self,
        run: &str,
        request: &HeatmapRequest,
        map: Colormap,
        scale: Scale,
    ) -> Result<Vec<u8>> {
        self.inner.results.export(run, request, map, scale, Format::Ply).await
    }

    /// Distribution of the time per query of one algorithm, over all configurations or those that a selection holds.
    #[boxed]
    pub async fn ecdf(&self, run: &str, algorithm: &str, selection: Option<&str>) -> Result<Ecdf> {
        self.inner.results.ecdf(run, algorithm, selection).await
    }

    /// The records of one algorithm as Parquet.
    #[boxed]
    pub async fn records_parquet(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        self.inner.results.records_parquet(run, algorithm).await
    }

    /// The records of one algorithm as CSV with a header line.
    #[boxed]
    pub async fn records_csv(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        self.inner.results.records_csv(run, algorithm).await
    }

    /// In how many primitive tests of one algorithm each triangle took part, as Parquet.
    #[boxed]
    pub async fn triangle_tests_parquet(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        self.inner.results.triangle_tests_parquet(run, algorithm).await
    }

    /// The run's configuration set with its truth as Parquet.
    #[boxed]
    pub async fn configurations_parquet(&self, run: &str) -> Result<Vec<u8>> {
        self.inner.results.configurations_parquet(run).await
    }
}
