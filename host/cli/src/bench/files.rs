//! The result files of `--out`.

use std::path::{Path, PathBuf};

use ocb_core::colormap::{Colormap, Scale};
use ocb_core::statistics::{Outliers, Statistic};
use ocb_service::model::{AlgorithmResult, HeatmapRequest, Measure, RunInfo};
use ocb_service::{Engine, EngineError};

use crate::failure::{Failure, Result};
use crate::output;

/// Writes run.json, the configurations, and of every algorithm that was measured its records and its heatmap of times on
/// A. One that was not measured has no files: run.json says why.
pub async fn write(engine: &Engine, run: &RunInfo, folder: &Path) -> Result<Vec<PathBuf>> {
    let mut written = Vec::new();
    let mut keep = |name: String, bytes: Vec<u8>| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|e| Failure::file("write", &path, &e))?;
        written.push(path);
        Ok::<(), Failure>(())
    };
    keep("run.json".to_owned(), output::to_json(run)?.into_bytes())?;
    if run.set.is_some() {
        keep("configurations.parquet".to_owned(), engine.configurations_parquet(&run.id).await?)?;
    }
    for AlgorithmResult { algorithm, .. } in run.results.iter().filter(|result| result.n > 0) {
        keep(format!("{algorithm}.parquet"), engine.records_parquet(&run.id, algorithm).await?)?;
        // Not every algorithm counts.
        match engine.triangle_tests_parquet(&run.id, algorithm).await {
            Err(EngineError::NotFound(_)) => {}
            tests => keep(format!("{algorithm}.triangles.parquet"), tests?)?,
        }
        keep(format!("{algorithm}.csv"), engine.records_csv(&run.id, algorithm).await?)?;
        let request = HeatmapRequest::new(algorithm, Measure::Time, Statistic::Median, Outliers::PerVertex);
        let (colormap, scale) = (Colormap::default(), Scale::default());
        keep(format!("{algorithm}.glb"), engine.heatmap_glb(&run.id, &request, colormap, scale).await?)?;
        keep(format!("{algorithm}.ply"), engine.heatmap_ply(&run.id, &request, colormap, scale).await?)?;
    }
    Ok(written)
}
