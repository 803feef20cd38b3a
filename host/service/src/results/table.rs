//! The numbers of one run, one value per configuration of its set: what heatmaps show and selections test.

use std::borrow::Cow;
use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::agreement::Said;
use ocb_core::configuration::{ConfigurationSet, Placed};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{U32, U64, largest_coordinate, scene_size};
use ocb_core::query::{Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::selection::{Body, Column, Columns, Selection, distances};

use super::{not_yet, still_measured};
use crate::columns::RecordColumns;
use crate::engine::Inner;
use crate::runs::sql::RunRow;
use crate::{EngineError, Result};

/// What is known of the configurations of a run.
pub struct Table {
    /// The question.
    pub query: Query,
    /// What counts as an object.
    pub semantics: Semantics,
    /// The configurations with their truth.
    pub set: Arc<ConfigurationSet>,
    /// Object A and object B.
    pub meshes: [Arc<Mesh>; 2],
    /// The algorithm whose columns are meant when none is named.
    pub looked_at: String,
    /// The algorithms whose records were loaded.
    pub lanes: Vec<Lane>,
    /// Some of them are still being measured.
    pub preliminary: bool,
}

/// The records of one algorithm.
pub struct Lane {
    /// Algorithm id.
    pub algorithm: String,
    /// Bits of the arithmetic that it declares.
    pub bits: u8,
    /// What was measured.
    pub records: Arc<RecordColumns>,
}

impl Inner {
    /// The numbers of a run: of the algorithm that is looked at (when one is), of those that a selection names, or of all.
    pub async fn table(&self, run: &str, looked_at: &str, selection: Option<&Selection>, all: bool) -> Result<Table> {
        let row = self.run_row(run).await?;
        let set = self.set(row.set_blob.as_deref().ok_or_else(|| not_yet(run))?).await?;
        let table = self.table_so_far(&row, set, looked_at, selection, all).await?;
        if table.preliminary { Err(still_measured(run)) } else { Ok(table) }
    }

    /// The same, with what a run under way has so far, over its configurations so far.
    pub async fn table_so_far(
        &self,
        row: &RunRow,
        set: Arc<ConfigurationSet>,
        looked_at: &str,
        selection: Option<&Selection>,
        all: bool,
    ) -> Result<Table> {
        let run = row.id.as_str();
        let all = all || selection.is_some_and(|selection| selection.uses(Column::Disputed));
        let mut wanted: Vec<String> = (!looked_at.is_empty()).then(|| looked_at.to_owned()).into_iter().collect();
        wanted.extend(selection.iter().flat_map(|selection| selection.algorithms()).map(str::to_owned));
        if all {
            let with_records = self.store.results(run).await?.into_iter().filter(|r| r.records.is_some());
            wanted.extend(with_records.map(|r| r.result.algorithm));
            wanted.extend(self.under_way.results(run).into_iter().map(|result| result.algorithm));
        }
        let mut lanes: Vec<Lane> = Vec::new();
        let mut preliminary = false;
        for algorithm in wanted {
            if lanes.iter().all(|lane| lane.algorithm != algorithm) {
                let (result, records) = self.records_so_far(run, &algorithm).await?;
                if records.configuration.iter().any(|configuration| *configuration as usize >= set.placed.len()) {
                    // The whole set has come meanwhile.
                    return Err(not_yet(run));
                }
                preliminary |= result.preliminary;
                let bits = result.class.map_or(64, |class| class.bits);
                lanes.push(Lane { algorithm, bits, records });
            }
        }
        let meshes = self.both_meshes(row).await?;
        let (query, semantics) = (row.spec.query, row.spec.semantics);
        Ok(Table { query, semantics, set, meshes, looked_at: looked_at.to_owned(), lanes, preliminary })
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

impl Lane {
    /// What one rounding of its arithmetic may change, relatively.
    fn unit_roundoff(&self) -> f64 {
        if self.bits == 32 { U32 } else { U64 }
    }
}

impl Table {
    /// Which configurations a selection holds.
    pub fn choose(&self, selection: &Selection) -> Result<Vec<bool>> {
        selection.apply(self)
    }

    /// The records of an algorithm.
    pub fn lane(&self, algorithm: &str) -> Result<&Lane> {
        self.lanes
            .iter()
            .find(|lane| lane.algorithm == algorithm)
            .ok_or_else(|| EngineError::NotFound(format!("The algorithm {algorithm:?} has no records in this run.")))
    }

    /// One value per configuration, NaN where the algorithm was not measured.
    fn spread(&self, lane: &Lane, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut values = vec![f64::NAN; self.set.placed.len()];
        for (row, &i) in lane.records.configuration.iter().enumerate() {
            if let Some(slot) = values.get_mut(i as usize) {
                *slot = value(row);
            }
        }
        values
    }

    /// 0 or 1 by verdict; an answer that was not given is neither right nor wrong.
    fn verdicts(&self, lane: &Lane, counts: fn(Verdict) -> bool) -> Vec<f64> {
        self.spread(lane, |row| match lane.records.verdict[row] {
            silent if silent.is_silent() => f64::NAN,
            verdict => f64::from(u8::from(counts(verdict))),
        })
    }

    /// u S of every configuration.
    fn grain(&self, unit_roundoff: f64) -> Vec<f64> {
        let largest = [0, 1].map(|side: usize| largest_coordinate(self.meshes[side].positions()));
        self.set.placed.iter().map(|p| unit_roundoff * scene_size(largest, &p.configuration)).collect()
    }

    /// By how much the answered distances miss the certified intervals, in u S.
    fn errors(&self, lane: &Lane) -> Result<Vec<f64>> {
        if self.query != Query::Proximity {
            return Err(EngineError::Invalid(
                "This run has collision queries, and only distances have an error; use the wrong answers.".into(),
            ));
        }
        let grain = self.grain(lane.unit_roundoff());
        Ok(self.spread(lane, |row| {
            let i = lane.records.configuration[row] as usize;
            match lane.records.said[row] {
                Said::Distance(d) => self.set.placed[i].truth.distance_error(d, self.semantics) / grain[i],
                Said::Decision(_) | Said::Nothing => f64::NAN,
            }
        }))
    }

    fn flips(&self, lane: &Lane) -> Result<Vec<f64>> {
        if lane.records.flips.iter().all(Option::is_none) {
            let sentence = "The records of this run come from a version that did not count flips; run it again.";
            return Err(EngineError::Invalid(sentence.into()));
        }
        Ok(self.spread(lane, |row| lane.records.flips[row].map_or(f64::NAN, |n| f64::from(u8::from(n > 0)))))
    }

    /// Share of the other algorithms that contradict this one, of those that answered.
    fn disputes(&self, lane: &Lane) -> Result<Vec<f64>> {
        let said = self.said(lane);
        let (mut against, mut others) = (vec![0.0; said.len()], vec![0.0; said.len()]);
        let grain = [self.grain(U32), self.grain(U64)];
        let tau = |lane: &Lane, i: usize| 32.0 * grain[usize::from(lane.bits != 32)][i];
        for other in self.lanes.iter().filter(|other| other.algorithm != lane.algorithm) {
            for (i, theirs) in self.said(other).into_iter().enumerate() {
                let truth = &self.set.placed[i].truth;
                let slack = tau(lane, i) + tau(other, i) + (truth.distance_hi - truth.distance_lo);
                if let (Some(mine), Some(theirs)) = (said[i], theirs) {
                    others[i] += 1.0;
                    against[i] += f64::from(u8::from(mine.contradicts(theirs, slack)));
                }
            }
        }
        if others.iter().all(|n| *n == 0.0) {
            let sentence = "Disagreement requires a second algorithm on the same configurations.";
            return Err(EngineError::Invalid(sentence.into()));
        }
        Ok(against.into_iter().zip(others).map(|(n, of): (f64, f64)| n / of).collect())
    }

    /// What an algorithm answered to each configuration; nothing where it was silent or not measured.
    fn said(&self, lane: &Lane) -> Vec<Option<Said>> {
        let mut all = vec![None; self.set.placed.len()];
        for (&i, &said) in lane.records.configuration.iter().zip(&lane.records.said) {
            if let Some(slot) = all.get_mut(i as usize) {
                *slot = Some(said).filter(|said| *said != Said::Nothing);
            }
        }
        all
    }

    /// The certified witness points on one object, in its own frame.
    pub fn witnesses(&self, body: Body) -> Vec<Point3<f64>> {
        let nowhere = Point3::new(f64::NAN, f64::NAN, f64::NAN);
        let of = |p: &Placed| match body {
            Body::A => p.configuration.pose_a.locate(&p.truth.witness.point_a),
            Body::B => p.configuration.pose_b.locate(&p.truth.witness.point_b),
        };
        self.set.placed.iter().map(|p| of(p).unwrap_or(nowhere)).collect()
    }
}

impl Columns for Table {
    type Error = EngineError;

    fn column(&self, column: Column, of: Option<&str>) -> Result<Cow<'_, [f64]>> {
        if column == Column::Distance {
            return Ok(self.set.placed.iter().map(|p| p.truth.distance_hi).collect());
        }
        let algorithm = of.unwrap_or(&self.looked_at);
        if algorithm.is_empty() {
            let sentence =
                "The selection does not name an algorithm; write for example `time of box-tree in [1ms, 1s]`.";
            return Err(EngineError::Invalid(sentence.to_owned()));
        }
        let lane = self.lane(algorithm)?;
        let counted = |tests: &[Option<u64>]| {
            if tests.iter().all(Option::is_none) {
                let algorithm = &lane.algorithm;
                return Err(EngineError::Invalid(format!("The algorithm {algorithm:?} does not report its tests.")));
            }
            Ok(self.spread(lane, |row| tests[row].map_or(f64::NAN, |n| n as f64)))
        };
        Ok(Cow::Owned(match column {
            Column::Time => self.spread(lane, |row| lane.records.time_ns[row]),
            Column::BvTests => counted(&lane.records.bv_tests)?,
            Column::PrimitiveTests => counted(&lane.records.primitive_tests)?,
            Column::Error => self.errors(lane)?,
            Column::Wrong => self.verdicts(lane, Verdict::is_wrong),
            Column::Missed => self.verdicts(lane, |verdict| verdict == Verdict::FalseNegative),
            Column::FalseAlarm => self.verdicts(lane, |verdict| verdict == Verdict::FalsePositive),
            Column::Flipped => self.flips(lane)?,
            Column::Disputed => self.disputes(lane)?,
            Column::Distance => unreachable!("answered above"),
        }))
    }

    fn distance_from(&self, body: Body, vertex: u32) -> Result<Vec<f64>> {
        let mesh = &self.meshes[body as usize];
        let Some(middle) = mesh.positions().get(vertex as usize) else {
            let vertices = mesh.positions().len();
            return Err(EngineError::Invalid(format!(
                "The selection names vertex {vertex} of object {body:?}, which has {vertices}, counted from 0."
            )));
        };
        Ok(distances(&self.witnesses(body), middle, mesh.longest_side()))
    }
}
