//! From stored records to heatmaps, charts and files.

use std::sync::Arc;

use ocb_core::colormap::{Colormap, Scale};
use ocb_core::configuration::ConfigurationSet;
use ocb_core::export::{Legend, glb, ply};
use ocb_core::heatmap::{VertexMap, VertexValues};
use ocb_core::mesh::Mesh;
use ocb_core::statistics::{self, Outliers, Statistic};

use crate::columns::{self, RecordColumns};
use crate::engine::Inner;
use crate::model::{Ecdf, Heatmap, HeatmapRequest, Measure, Side};
use crate::objects::blocking;
use crate::store::{RunRow, StoredResult};
use crate::{EngineError, Result};

/// Points of a distribution's curve at most.
const ECDF_POINTS: usize = 512;

/// What the explorer shows first.
pub fn first_look(algorithm: &str) -> HeatmapRequest {
    HeatmapRequest {
        algorithm: algorithm.to_owned(),
        side: Side::A,
        measure: Measure::Time,
        statistic: Statistic::Mean,
        outliers: Outliers::Keep,
    }
}

impl Inner {
    /// A stored set, from memory when it was used lately.
    pub async fn set(&self, blob: &str) -> Result<Arc<ConfigurationSet>> {
        if let Some(set) = self.sets.get(blob) {
            return Ok(set);
        }
        let bytes = self.blobs.get(blob).await?;
        let set = blocking(move || columns::read_set(&bytes)).await?;
        Ok(self.sets.put(blob, set))
    }

    /// Values on the vertices of one object.
    pub async fn heatmap(&self, run: &str, request: &HeatmapRequest) -> Result<Heatmap> {
        let (heatmap, _) = self.values(run, request).await?;
        Ok(heatmap)
    }

    async fn values(&self, run: &str, request: &HeatmapRequest) -> Result<(Heatmap, Arc<Mesh>)> {
        let row = self.run_row(run).await?;
        let set_blob = row.set_blob.clone().ok_or_else(|| not_yet(run))?;
        let (mesh, map) = self.vertex_map(&row, &set_blob, request.side).await?;
        let configurations = self.set(&set_blob).await?.placed.len();
        let values = match request.measure {
            Measure::Density => None,
            _ => Some(self.measured(run, request, configurations).await?),
        };
        let request = request.clone();
        let heatmap = blocking(move || Ok(aggregate(&map, values.as_deref(), request, configurations))).await?;
        Ok((heatmap, mesh))
    }

    /// Which configurations each vertex hears of.
    async fn vertex_map(&self, row: &RunRow, set_blob: &str, side: Side) -> Result<(Arc<Mesh>, Arc<VertexMap>)> {
        let object = match (side, &row.spec.object_b) {
            (Side::B, Some(b)) => b,
            _ => &row.spec.object_a,
        };
        let mesh = self.objects.mesh(object).await?;
        let key = format!("{set_blob} {side:?}");
        if let Some(map) = self.maps.get(&key) {
            return Ok((mesh, map));
        }
        let set = self.set(set_blob).await?;
        let for_map = mesh.clone();
        let map = blocking(move || {
            let witness = |p: &ocb_core::configuration::Placed| match side {
                Side::A => p.truth.witness.triangle_a,
                Side::B => p.truth.witness.triangle_b,
            };
            Ok(VertexMap::new(&for_map, &set.placed.iter().map(witness).collect::<Vec<u32>>()))
        })
        .await?;
        Ok((mesh, self.maps.put(&key, map)))
    }

    /// One value per configuration of the set; NaN where it was not measured.
    async fn measured(&self, run: &str, request: &HeatmapRequest, configurations: usize) -> Result<Vec<f64>> {
        let (_, records) = self.records(run, &request.algorithm).await?;
        let count = |tests: &Option<u64>| tests.map_or(f64::NAN, |n| n as f64);
        let column: Vec<f64> = match request.measure {
            Measure::Time | Measure::Density => records.time_ns.clone(),
            Measure::BvTests => records.bv_tests.iter().map(count).collect(),
            Measure::PrimitiveTests => records.primitive_tests.iter().map(count).collect(),
        };
        if column.iter().all(|x| x.is_nan()) {
            return Err(EngineError::Invalid(format!(
                "The algorithm {:?} does not count its tests.",
                request.algorithm
            )));
        }
        let mut values = vec![f64::NAN; configurations];
        for (i, value) in records.configuration.iter().zip(column) {
            if let Some(slot) = values.get_mut(*i as usize) {
                *slot = value;
            }
        }
        Ok(values)
    }

    /// The columns of one algorithm's records that charts need, from memory when they were used lately.
    pub async fn records(&self, run: &str, algorithm: &str) -> Result<(StoredResult, Arc<RecordColumns>)> {
        let (stored, blob) = self.stored_result(run, algorithm).await?;
        if let Some(records) = self.records.get(&blob) {
            return Ok((stored, records));
        }
        let bytes = self.blobs.get(&blob).await?;
        let records = blocking(move || columns::read_records(&bytes)).await?;
        Ok((stored, self.records.put(&blob, records)))
    }

    async fn stored_result(&self, run: &str, algorithm: &str) -> Result<(StoredResult, String)> {
        let row = self.run_row(run).await?;
        let results = self.store.results(run).await?;
        let Some(stored) = results.into_iter().find(|r| r.result.algorithm == algorithm) else {
            let there_are = row.spec.algorithms.join(", ");
            return Err(EngineError::NotFound(if row.spec.algorithms.iter().any(|a| a == algorithm) {
                format!("The algorithm {algorithm:?} has no result in this run yet.")
            } else {
                format!("The algorithm {algorithm:?} is not in this run; there are: {there_are}.")
            }));
        };
        let Some(blob) = stored.records.clone() else {
            return Err(EngineError::NotFound(format!(
                "The algorithm {algorithm:?} has no records in this run. {}",
                stored.result.outcome.message
            )));
        };
        Ok((stored, blob))
    }

    /// Distribution of the time per query.
    pub async fn ecdf(&self, run: &str, algorithm: &str) -> Result<Ecdf> {
        let (_, records) = self.records(run, algorithm).await?;
        let mut times = records.time_ns.clone();
        times.sort_unstable_by(f64::total_cmp);
        let (time_ns, share) = statistics::ecdf(&times, ECDF_POINTS).into_iter().unzip();
        Ok(Ecdf { algorithm: algorithm.to_owned(), n: times.len() as u32, time_ns, share })
    }

    /// The records file as it is stored.
    pub async fn records_parquet(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let (_, blob) = self.stored_result(run, algorithm).await?;
        self.blobs.get(&blob).await
    }

    /// The same rows as CSV.
    pub async fn records_csv(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let parquet = self.records_parquet(run, algorithm).await?;
        blocking(move || columns::csv(&parquet)).await
    }

    /// The run's set as it is stored.
    pub async fn configurations_parquet(&self, run: &str) -> Result<Vec<u8>> {
        let row = self.run_row(run).await?;
        self.blobs.get(&row.set_blob.ok_or_else(|| not_yet(run))?).await
    }

    /// The coloured object for other programs.
    pub async fn export(
        &self,
        run: &str,
        request: &HeatmapRequest,
        colormap: Colormap,
        scale: Scale,
        format: Format,
    ) -> Result<Vec<u8>> {
        let (heatmap, mesh) = self.values(run, request).await?;
        let legend = Legend {
            run: run.to_owned(),
            algorithm: if request.measure == Measure::Density { String::new() } else { request.algorithm.clone() },
            measure: name_of(&request.measure),
            statistic: name_of(&request.statistic),
            outliers: name_of(&request.outliers),
            unit: heatmap.unit.clone(),
            range: heatmap.range.unwrap_or([0.0, 0.0]),
            scale,
            colormap,
            n: u64::from(heatmap.n),
        };
        let values = VertexValues { values: heatmap.values, counts: heatmap.counts, dropped: heatmap.dropped };
        blocking(move || {
            Ok(match format {
                Format::Glb => glb::heatmap(&mesh, &values, &legend),
                Format::Ply => ply::heatmap(&mesh, &values, &legend),
            })
        })
        .await
    }

    /// The run, or that there is none.
    pub async fn run_row(&self, run: &str) -> Result<RunRow> {
        let row = self.store.run(run).await?;
        row.ok_or_else(|| no_run(run))
    }
}

/// There is no such run, or not for who asks: both sound alike.
pub fn no_run(run: &str) -> EngineError {
    EngineError::NotFound(format!("There is no run {run:?}; check the link."))
}

/// Which file.
#[derive(Clone, Copy, Debug)]
pub enum Format {
    /// glTF binary.
    Glb,
    /// Polygon file, binary.
    Ply,
}

fn aggregate(map: &VertexMap, values: Option<&[f64]>, request: HeatmapRequest, configurations: usize) -> Heatmap {
    let result = match values {
        Some(values) => map.aggregate(values, request.statistic, request.outliers),
        None => map.density(),
    };
    let unit = match request.measure {
        Measure::Time => "ns",
        Measure::BvTests | Measure::PrimitiveTests => "tests",
        Measure::Density => "configurations",
    };
    Heatmap {
        range: result.range(),
        unit: unit.to_owned(),
        n: values.map_or(configurations, |v| v.iter().filter(|x| x.is_finite()).count()) as u32,
        values: result.values,
        counts: result.counts,
        dropped: result.dropped,
        request,
    }
}

fn not_yet(run: &str) -> EngineError {
    EngineError::NotFound(format!("The run {run:?} has no configurations yet; wait until they are found."))
}

/// The name that the JSON has for it.
fn name_of(value: &impl serde::Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(name)) => name,
        _ => String::new(),
    }
}
