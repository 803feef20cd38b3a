//! From stored records to heatmaps, charts and files.

mod ask;
mod hand_in;
mod selected;
pub mod selecting;
pub mod sql;
mod table;

use std::sync::Arc;

use ocb_core::colormap::{Colormap, Scale};
use ocb_core::configuration::ConfigurationSet;
use ocb_core::export::{Legend, glb, ply};
use ocb_core::heatmap::{VertexMap, VertexValues};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::Shape;
use ocb_core::selection::{Column, Columns};
use ocb_core::statistics;

use crate::blobs::Blobs;
use crate::blocking::blocking;
use crate::cache::Cache;
use crate::columns::{self, RecordColumns};
use crate::model::{AlgorithmResult, Ecdf, Heatmap, HeatmapRequest, Measure, Side};
use crate::objects::Objects;
use crate::results::sql::StoredResult;
use crate::runs::preliminary::UnderWay;
use crate::runs::sql::RunRow;
use crate::sets::stored::Sets;
use crate::store::Store;
use crate::{EngineError, Result};

/// Points of a distribution's curve at most.
const ECDF_POINTS: usize = 512;

/// Records and maps that stay in memory, and what the oracle needs of meshes.
const RECENT_RECORDS: usize = 16;
const RECENT_MAPS: usize = 8;
const RECENT_SHAPES: usize = 4;

/// The results of all runs, also of those under way.
pub struct Results {
    store: Store,
    blobs: Blobs,
    objects: Arc<Objects>,
    sets: Arc<Sets>,
    under_way: Arc<UnderWay>,
    records: Cache<RecordColumns>,
    maps: Cache<VertexMap>,
    shapes: Cache<Shape>,
}

impl Results {
    /// Those of this store, and what the runs under way can show.
    pub fn new(store: Store, blobs: Blobs, objects: Arc<Objects>, sets: Arc<Sets>, under_way: Arc<UnderWay>) -> Self {
        Self {
            store,
            blobs,
            objects,
            sets,
            under_way,
            records: Cache::new(RECENT_RECORDS),
            maps: Cache::new(RECENT_MAPS),
            shapes: Cache::new(RECENT_SHAPES),
        }
    }

    /// Values on the vertices of one object.
    pub async fn heatmap(&self, run: &str, request: &HeatmapRequest) -> Result<Heatmap> {
        let (heatmap, _) = self.values(run, request).await?;
        Ok(heatmap)
    }

    async fn values(&self, run: &str, request: &HeatmapRequest) -> Result<(Heatmap, Arc<Mesh>)> {
        let request = request.settled();
        let (mut heatmap, mesh) = self.map_of(run, &request.algorithm, &request).await?;
        if let Some((other_run, other)) = request.subtrahend() {
            if request.measure == Measure::Density && other_run.is_none() {
                let sentence =
                    "The density belongs to the configuration set, so it is the same for all algorithms of a run.";
                return Err(EngineError::Invalid(sentence.into()));
            }
            let other_run = other_run.unwrap_or(run);
            let (subtracted, other_mesh) = self.map_of(other_run, other, &request).await?;
            if !Arc::ptr_eq(&mesh, &other_mesh) && mesh.sha256() != other_mesh.sha256() {
                return Err(EngineError::Invalid(format!(
                    "The runs {run} and {other_run} have different objects there; a difference needs the same object."
                )));
            }
            subtract(&mut heatmap, &subtracted);
        }
        Ok((heatmap, mesh))
    }

    /// The map of one algorithm, before anything is subtracted.
    async fn map_of(&self, run: &str, algorithm: &str, request: &HeatmapRequest) -> Result<(Heatmap, Arc<Mesh>)> {
        if request.measure == Measure::TriangleTests {
            return self.triangle_map(run, algorithm, request).await;
        }
        let row = self.store.run_row(run).await?;
        let set = self.set_so_far(&row).await?;
        let (mesh, map) = self.vertex_map(&row, &set, request.side).await?;
        let selection = request.selection.as_deref().map(selected::read).transpose()?;
        let column = request.measure.column();
        let table = match (column, &selection) {
            (None, None) => None,
            _ => {
                let all = column == Some(Column::Disputed);
                Some(self.table_so_far(&row, set.clone(), algorithm, selection.as_ref(), all).await?)
            }
        };
        let configurations = set.placed.len();
        let preliminary = row.set_blob.is_none() || table.as_ref().is_some_and(|table| table.preliminary);
        let request = request.clone();
        let heatmap = blocking(move || {
            let chosen = match (&table, &selection) {
                (Some(table), Some(selection)) => Some(table.choose(selection)?),
                _ => None,
            };
            let mut values = match (&table, column) {
                (Some(table), Some(column)) => Some(table.column(column, None)?.into_owned()),
                _ => None,
            };
            if let (Some(values), Some(chosen)) = (&mut values, &chosen) {
                values.iter_mut().zip(chosen).filter(|(_, is)| !**is).for_each(|(x, _)| *x = f64::NAN);
            }
            let heatmap = aggregate(&map, values.as_deref(), chosen.as_deref(), request, configurations);
            Ok(Heatmap { preliminary, ..heatmap })
        })
        .await?;
        Ok((heatmap, mesh))
    }

    /// The map of the primitive tests of each triangle.
    async fn triangle_map(&self, run: &str, algorithm: &str, request: &HeatmapRequest) -> Result<(Heatmap, Arc<Mesh>)> {
        if request.selection.is_some() {
            let sentence = "Tests per triangle are counted over all configurations; leave out the selection.";
            return Err(EngineError::Invalid(sentence.into()));
        }
        let row = self.store.run_row(run).await?;
        let [a, b] = self.both_meshes(&row).await?;
        let (side, mesh) = if request.side == Side::A { (0, a) } else { (1, b) };
        let parquet = self.triangle_tests_parquet(run, algorithm).await?;
        let (request, shown) = (request.clone(), mesh.clone());
        let heatmap = blocking(move || {
            let counted = columns::read_triangle_tests(&parquet)?;
            let queries = f64::from(counted.queries.max(1));
            let values: Vec<f64> = counted.tests[side].iter().map(|tests| f64::from(*tests) / queries).collect();
            if values.len() != shown.triangles().len() {
                return Err(EngineError::fault("Reading tests per triangle failed", "they are of another object"));
            }
            // Each triangle assigns its value to its own vertices.
            let map = VertexMap::new(&shown, &(0..values.len() as u32).collect::<Vec<_>>());
            let heatmap = aggregate(&map, Some(&values), None, request, 0);
            Ok(Heatmap { n: counted.queries, ..heatmap })
        })
        .await?;
        Ok((heatmap, mesh))
    }

    /// In how many primitive tests each triangle took part, as it is stored.
    pub async fn triangle_tests_parquet(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let (stored, _) = self.stored_result(run, algorithm).await?;
        let blob = stored.triangle_tests.ok_or_else(|| {
            EngineError::NotFound(format!(
                "The algorithm {algorithm:?} has no tests per triangle in this run: it does not count them, or the run is \
                 of a version that did not."
            ))
        })?;
        self.blobs.get(&blob).await
    }

    /// The run's configurations, or the beginning of them while the others are still being found.
    pub async fn set_so_far(&self, row: &RunRow) -> Result<Arc<ConfigurationSet>> {
        match &row.set_blob {
            Some(blob) => self.sets.get(blob).await,
            None => self.under_way.beginning(&row.id).ok_or_else(|| not_yet(&row.id)),
        }
    }

    /// Prepares what the first heatmap of a run needs besides the records.
    pub async fn prepare_maps(&self, row: &RunRow) -> Result<()> {
        let set = self.set_so_far(row).await?;
        self.vertex_map(row, &set, Side::A).await.map(|_| ())
    }

    /// Which configurations each vertex hears of.
    async fn vertex_map(
        &self,
        row: &RunRow,
        set: &Arc<ConfigurationSet>,
        side: Side,
    ) -> Result<(Arc<Mesh>, Arc<VertexMap>)> {
        let [a, b] = self.both_meshes(row).await?;
        let mesh = if side == Side::A { a } else { b };
        let key = row.set_blob.as_ref().map(|blob| format!("{blob} {side:?}"));
        if let Some(map) = key.as_ref().and_then(|key| self.maps.get(key)) {
            return Ok((mesh, map));
        }
        let (for_map, set) = (mesh.clone(), set.clone());
        let map = blocking(move || {
            let witness = |p: &ocb_core::configuration::Placed| match side {
                Side::A => p.truth.witness.triangle_a,
                Side::B => p.truth.witness.triangle_b,
            };
            Ok(VertexMap::new(&for_map, &set.placed.iter().map(witness).collect::<Vec<u32>>()))
        })
        .await?;
        let map = match key {
            Some(key) => self.maps.put(&key, map),
            None => Arc::new(map),
        };
        Ok((mesh, map))
    }

    /// The summaries of a run, also those that one under way has so far.
    pub async fn results_so_far(&self, run: &str) -> Result<Vec<AlgorithmResult>> {
        let mut all: Vec<_> = self.store.results(run).await?.into_iter().map(|stored| stored.result).collect();
        let is_new = |new: &AlgorithmResult| all.iter().all(|old| old.algorithm != new.algorithm);
        let so_far: Vec<_> = self.under_way.results(run).into_iter().filter(is_new).collect();
        all.extend(so_far);
        Ok(all)
    }

    /// Summary and records of one algorithm, also those that a run under way has so far.
    pub async fn records_so_far(&self, run: &str, algorithm: &str) -> Result<(AlgorithmResult, Arc<RecordColumns>)> {
        match self.records(run, algorithm).await {
            Ok((stored, records)) => Ok((stored.result, records)),
            Err(EngineError::NotFound(why)) => self.under_way.records(run, algorithm).ok_or(EngineError::NotFound(why)),
            Err(e) => Err(e),
        }
    }

    /// The columns of one algorithm's records that charts need, from memory when they were used lately.
    pub async fn records(&self, run: &str, algorithm: &str) -> Result<(StoredResult, Arc<RecordColumns>)> {
        let (stored, blob) = self.stored_result(run, algorithm).await?;
        Ok((stored, self.records_of(&blob).await?))
    }

    /// The same of a blob.
    pub async fn records_of(&self, blob: &str) -> Result<Arc<RecordColumns>> {
        if let Some(records) = self.records.get(blob) {
            return Ok(records);
        }
        let bytes = self.blobs.get(blob).await?;
        let records = blocking(move || Ok(columns::read_records(&bytes)?)).await?;
        Ok(self.records.put(blob, records))
    }

    async fn stored_result(&self, run: &str, algorithm: &str) -> Result<(StoredResult, String)> {
        let row = self.store.run_row(run).await?;
        let results = self.store.results(run).await?;
        let Some(stored) = results.into_iter().find(|r| r.result.algorithm == algorithm) else {
            let there_are = row.spec.algorithms.join(", ");
            return Err(EngineError::NotFound(if row.spec.algorithms.iter().any(|a| a == algorithm) {
                format!("The algorithm {algorithm:?} has no result in this run yet.")
            } else {
                format!("The algorithm {algorithm:?} is not in this run; available: {there_are}.")
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

    /// Distribution of the time per query, over all configurations or those that a selection holds.
    pub async fn ecdf(&self, run: &str, algorithm: &str, selection: Option<&str>) -> Result<Ecdf> {
        let chosen = match selection {
            Some(selection) => Some(self.chosen(run, algorithm, selection).await?),
            None => None,
        };
        self.ecdf_of(run, algorithm, chosen.as_deref()).await
    }

    /// The same over all, or the `chosen`.
    pub async fn ecdf_of(&self, run: &str, algorithm: &str, chosen: Option<&[bool]>) -> Result<Ecdf> {
        let (result, records) = self.records_so_far(run, algorithm).await?;
        let mut times: Vec<f64> = records.rows(chosen).map(|row| records.time_ns[row]).collect();
        times.sort_unstable_by(f64::total_cmp);
        let (time_ns, share) = statistics::ecdf(&times, ECDF_POINTS).into_iter().unzip();
        let preliminary = result.preliminary;
        Ok(Ecdf { algorithm: algorithm.to_owned(), n: times.len() as u32, time_ns, share, preliminary })
    }

    /// The records file as it is stored.
    pub async fn records_parquet(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let (_, blob) = self.stored_result(run, algorithm).await?;
        self.blobs.get(&blob).await
    }

    /// The same rows as CSV.
    pub async fn records_csv(&self, run: &str, algorithm: &str) -> Result<Vec<u8>> {
        let parquet = self.records_parquet(run, algorithm).await?;
        blocking(move || Ok(columns::csv(&parquet)?)).await
    }

    /// The run's set as it is stored.
    pub async fn configurations_parquet(&self, run: &str) -> Result<Vec<u8>> {
        let row = self.store.run_row(run).await?;
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
        if heatmap.preliminary {
            return Err(still_measured());
        }
        let request = &heatmap.request;
        let against = request.subtrahend().map(|(other_run, algorithm)| {
            other_run.map_or_else(|| algorithm.to_owned(), |run| format!("{run}/{algorithm}"))
        });
        let (colormap, scale) = match against {
            Some(_) => (Colormap::PurpleOrange, Scale::Linear),
            None => (colormap, scale),
        };
        let legend = Legend {
            run: run.to_owned(),
            algorithm: if request.measure == Measure::Density { String::new() } else { request.algorithm.clone() },
            measure: name_of(&request.measure),
            statistic: name_of(&request.statistic),
            outliers: name_of(&request.outliers),
            unit: heatmap.unit.clone(),
            range: colour_range(&heatmap),
            selection: request.selection.clone(),
            against,
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
}

/// Which file.
#[derive(Clone, Copy, Debug)]
pub enum Format {
    /// glTF binary.
    Glb,
    /// Polygon file, binary.
    Ply,
}

fn aggregate(
    map: &VertexMap,
    values: Option<&[f64]>,
    chosen: Option<&[bool]>,
    request: HeatmapRequest,
    configurations: usize,
) -> Heatmap {
    let result = match values {
        Some(values) => map.aggregate(values, request.statistic, request.outliers),
        None => map.density(chosen),
    };
    let counted = || chosen.map_or(configurations, |chosen| chosen.iter().filter(|is| **is).count());
    Heatmap {
        range: result.range(),
        unit: request.measure.unit().to_owned(),
        n: values.map_or_else(counted, |v| v.iter().filter(|x| x.is_finite()).count()) as u32,
        values: result.values,
        counts: result.counts,
        dropped: result.dropped,
        preliminary: false,
        request,
    }
}

/// The values at the two ends of the colours: of a difference as far below 0 as above it, of failures from 0 on.
fn colour_range(heatmap: &Heatmap) -> [f64; 2] {
    let [lo, hi] = heatmap.range.unwrap_or([0.0, 0.0]);
    let measure = heatmap.request.measure;
    if heatmap.request.subtrahend().is_some() {
        let reach = hi.abs().max(lo.abs());
        [-reach, reach]
    } else if measure.is_share() || measure == Measure::DistanceError {
        [0.0, hi]
    } else {
        [lo, hi]
    }
}

/// Its values minus those of another map of the same object.
fn subtract(map: &mut Heatmap, other: &Heatmap) {
    let of = |map: &Heatmap| VertexValues {
        values: map.values.clone(),
        counts: map.counts.clone(),
        dropped: map.dropped.clone(),
    };
    if let Some(difference) = of(map).minus(&of(other)) {
        map.range = difference.range();
        map.n = map.n.min(other.n);
        map.preliminary |= other.preliminary;
        (map.values, map.counts, map.dropped) = (difference.values, difference.counts, difference.dropped);
    }
}

/// Nothing is known of the run's configurations yet.
pub fn not_yet(run: &str) -> EngineError {
    EngineError::NotFound(format!("The run {run:?} has no configurations yet; wait until they are found."))
}

/// What leaves the service is final.
pub fn still_measured() -> EngineError {
    EngineError::NotFound("The run is still being measured; wait for its end.".into())
}

/// The name that the JSON has for it.
fn name_of(value: &impl serde::Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(name)) => name,
        _ => String::new(),
    }
}
