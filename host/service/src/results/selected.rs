//! Selected configurations: how many, what they cost, their records, and the worst of them.

use std::cmp::Ordering;
use std::sync::Arc;

use ocb_core::agreement::Said;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::query::Query;
use ocb_core::record::Verdict;
use ocb_core::selection::{Body, Column, Columns, Kind, Selection};
use ocb_core::statistics::quantile;
use ocb_core::validation::Precision;

use super::table::{Entry, RecordTable};
use crate::blocking::blocking;
use crate::columns::{self, Numbers};
use crate::engine::Inner;
use crate::model::{Meeting, Selected, SelectedOf, WorstBy, WorstCase, WorstRequest};
use crate::{EngineError, Result};

/// Longest list of the worst.
const MOST_CASES: u32 = 1_000;
/// Longest list of pairs.
const MOST_PAIRS: usize = 100_000;

impl Inner {
    /// How many configurations a selection holds, and what they cost each algorithm.
    pub async fn selected(&self, run: &str, algorithm: &str, selection: &str) -> Result<Selected> {
        let selection = read(selection)?;
        let table = self.table(run, algorithm, Some(&selection), true).await?;
        blocking(move || {
            let chosen = table.choose(&selection)?;
            let n = chosen.iter().filter(|is| **is).count() as u32;
            let algorithms = table.entries.iter().map(|entry| selected_of(entry, &chosen)).collect();
            Ok(Selected { selection: selection.to_string(), n, of: chosen.len() as u32, algorithms })
        })
        .await
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
        blocking(move || worst(&table, selection.as_ref(), by, limit)).await
    }

    /// All pairs of triangles that meet in one configuration of the run; of the objects with their coordinates `rounded` to single
    /// precision, or as they are.
    pub async fn meeting(&self, run: &str, configuration: u32, rounded: bool) -> Result<Meeting> {
        let row = self.run_row(run).await?;
        let set = self.set(row.set_blob.as_deref().ok_or_else(|| super::not_yet(run))?).await?;
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
        blocking(move || {
            table.entry(&table.looked_at)?;
            let is_range = |column: &&Column| **column != Column::Distance && column.kind() != Kind::Flag;
            let all = Column::ALL.iter().filter(is_range).filter_map(|column| {
                // A column that cannot be had, such as tests that are not counted, is left out.
                Some((column.name(), Numbers::Exact(table.column(*column, None).ok()?.into_owned())))
            });
            Ok(columns::stream(all.collect())?)
        })
        .await
    }

    /// Where every configuration has its witness points, in the objects' frames, and how far apart it is.
    pub async fn witnesses_arrow(&self, run: &str) -> Result<Vec<u8>> {
        let table = self.table(run, "", None, false).await?;
        blocking(move || {
            let mut all = vec![("distance", Numbers::Exact(table.column(Column::Distance, None)?.into_owned()))];
            let triangles = |of: fn(&ocb_core::configuration::Witness) -> u32| {
                Numbers::Index(table.set.placed.iter().map(|p| of(&p.truth.witness)).collect())
            };
            all.push(("triangle_a", triangles(|w| w.triangle_a)));
            all.push(("triangle_b", triangles(|w| w.triangle_b)));
            for (body, names) in [(Body::A, ["a_x", "a_y", "a_z"]), (Body::B, ["b_x", "b_y", "b_z"])] {
                let points = table.witnesses(body);
                for (axis, name) in names.into_iter().enumerate() {
                    all.push((name, Numbers::Exact(points.iter().map(|p| p[axis]).collect())));
                }
            }
            Ok(columns::stream(all)?)
        })
        .await
    }
}

/// Reads a selection.
pub fn read(text: &str) -> Result<Selection> {
    text.parse().map_err(|e: ocb_core::selection::SelectionError| EngineError::Invalid(e.to_string()))
}

fn selected_of(entry: &Entry, chosen: &[bool]) -> SelectedOf {
    let records = &entry.records;
    let rows = || records.rows(Some(chosen));
    let mut times: Vec<f64> = rows().map(|row| records.time_ns[row]).collect();
    times.sort_unstable_by(f64::total_cmp);
    let at = |q: f64| (!times.is_empty()).then(|| quantile(&times, q));
    SelectedOf {
        algorithm: entry.algorithm.clone(),
        n: times.len() as u32,
        wrong: rows().filter(|&row| records.verdict[row].is_wrong()).count() as u32,
        median_ns: at(0.5),
        p99_ns: at(0.99),
        max_ns: times.last().copied(),
    }
}

fn worst(table: &RecordTable, selection: Option<&Selection>, by: WorstBy, limit: usize) -> Result<Vec<WorstCase>> {
    let entry = table.entry(&table.looked_at)?;
    let chosen = selection.map(|selection| table.choose(selection)).transpose()?;
    let errors = match (by, table.query) {
        (WorstBy::Time, Query::CollisionFirst | Query::CollisionAll) => None,
        _ => Some(table.column(Column::Error, None)?),
    };
    let records = &entry.records;
    let of = |row: usize| records.configuration[row] as usize;
    let key = |row: usize| match (by, &errors) {
        (WorstBy::Error, Some(errors)) => errors[of(row)],
        _ => records.time_ns[row],
    };
    let gravity = |verdict: Verdict| if verdict.is_wrong() { verdict.gravity() } else { 0 };
    let worse = |x: &usize, y: &usize| {
        let grave = gravity(records.verdict[*y]).cmp(&gravity(records.verdict[*x]));
        // What is not a number is no error that could be large.
        let [x_key, y_key] = [key(*x), key(*y)].map(|k| if k.is_nan() { f64::NEG_INFINITY } else { k });
        grave.then(y_key.partial_cmp(&x_key).unwrap_or(Ordering::Equal)).then(of(*x).cmp(&of(*y)))
    };
    let mut rows: Vec<usize> =
        (0..records.configuration.len()).filter(|&row| chosen.as_ref().is_none_or(|chosen| chosen[of(row)])).collect();
    rows.sort_unstable_by(worse);
    rows.truncate(limit);
    Ok(rows.into_iter().map(|row| case(table, entry, row, errors.as_ref().map(|e| e[of(row)]))).collect())
}

fn case(table: &RecordTable, entry: &Entry, row: usize, error: Option<f64>) -> WorstCase {
    let records = &entry.records;
    let placed = &table.set.placed[records.configuration[row] as usize];
    let truth = table.truth(entry, records.configuration[row] as usize);
    let witness = truth.witness;
    let inside = truth.is_inside(table.semantics);
    WorstCase {
        configuration: records.configuration[row],
        time_ns: records.time_ns[row],
        verdict: records.verdict[row],
        hit: if let Said::Decision(hit) = records.said[row] { Some(hit) } else { None },
        distance: if let Said::Distance(distance) = records.said[row] { Some(distance) } else { None },
        error: error.filter(|error| error.is_finite()),
        flips: records.flips[row],
        true_hit: truth.hit || inside,
        true_distance: if inside { [0.0; 2] } else { [truth.distance_lo, truth.distance_hi] },
        margin: truth.margin,
        pose_a: placed.configuration.pose_a.to_row_major().to_vec(),
        pose_b: placed.configuration.pose_b.to_row_major().to_vec(),
        points: [witness.point_a, witness.point_b].map(|p| [p.x, p.y, p.z]),
        triangles: [witness.triangle_a, witness.triangle_b],
        claim: records.claims.get(&row).copied(),
    }
}
