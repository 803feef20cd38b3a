//! The charts that a viewer may see, as values and as files.

use ocb_chart::Chart;

use super::columns::chart_parquet as parquet;
use crate::boxed;
use crate::engine::Engine;
use crate::model::ChartRequest;
use crate::results::still_measured;
use crate::{Result, columns};

impl Engine {
    /// One chart of a run. Others of its kind are taken from the runs that the viewer may see.
    #[boxed]
    pub async fn chart(&self, run: &str, request: ChartRequest, viewer: Option<&str>) -> Result<Chart> {
        self.inner.charts.chart(run, request, viewer).await
    }
}

/// The numbers of a chart as Parquet, one row per point.
///
/// # Errors
/// `NotFound` while they are preliminary.
pub fn chart_parquet(chart: &Chart) -> Result<Vec<u8>> {
    if chart.preliminary { Err(still_measured()) } else { Ok(parquet(chart)?) }
}

/// The same rows as CSV with a header line.
pub fn chart_csv(chart: &Chart) -> Result<Vec<u8>> {
    Ok(columns::csv(&chart_parquet(chart)?)?)
}

#[cfg(test)]
mod tests {
    use ocb_core::query::Query;
    use ocb_core::resolution::{Decade, Resolution, Threshold};

    use super::*;
    use crate::EngineConfig;
    use crate::model::State;
    use crate::results::sql::{StoredResult, keep_result};
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
        let keep = async |wrong| {
            let mut connection = store.pool.acquire().await.unwrap();
            keep_result(&mut connection, "r", 0, &with_wrong(wrong), 100, Query::Proximity).await.unwrap();
        };
        assert!(store.add_run(&run("r", None, 1, 1), &[], None).await.unwrap());
        keep(0).await;
        assert_eq!(ask().await, 0.0);
        keep(1).await;
        assert_eq!(ask().await, 0.2, "a run that goes on changes");
        assert!(store.end_waiting_run("r", State::Done, None).await.unwrap());
        assert_eq!(ask().await, 0.2);
        // No finished run is written to; this shows that nothing is read again.
        keep(2).await;
        assert_eq!(ask().await, 0.2);
        let row = store.run("r").await.unwrap().unwrap();
        assert!(store.queue_again(&row, &[]).await.unwrap());
        assert!(store.end_waiting_run("r", State::Done, None).await.unwrap());
        assert_eq!(ask().await, 0.4, "a refined run is another one");
        engine.shutdown().await;
    }
}
