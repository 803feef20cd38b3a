//! The numbers of one run, one value per configuration of its set: what heatmaps show and selections test.

mod selected;

use std::borrow::Cow;
use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::agreement::Said;
use ocb_core::configuration::{ConfigurationSet, Placed, Truth};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{U32, U64, largest_coordinate, scene_size};
use ocb_core::query::{Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::selection::{Body, Column, Columns, Selection, distances};
use ocb_core::validation::Precision;

use crate::columns::RecordColumns;
use crate::{LabError, Result};

/// What is known of the configurations of a run.
pub struct RecordTable {
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
    pub entries: Vec<Entry>,
    /// Some of them are still being measured.
    pub preliminary: bool,
}

/// The records of one algorithm.
pub struct Entry {
    /// Algorithm id.
    pub algorithm: String,
    /// Bits of the arithmetic that it declares.
    pub bits: u8,
    /// What was measured.
    pub records: Arc<RecordColumns>,
}

impl Entry {
    fn precision(&self) -> Precision {
        if self.bits == 32 { Precision::Single } else { Precision::Double }
    }
}

impl RecordTable {
    /// Which configurations a selection holds.
    pub fn choose(&self, selection: &Selection) -> Result<Vec<bool>> {
        selection.apply(self)
    }

    /// The records of an algorithm.
    pub fn entry(&self, algorithm: &str) -> Result<&Entry> {
        self.entries
            .iter()
            .find(|entry| entry.algorithm == algorithm)
            .ok_or_else(|| LabError::Invalid(format!("The algorithm {algorithm:?} has no records in this run.")))
    }

    /// The truth about the numbers that an algorithm got.
    pub fn truth(&self, entry: &Entry, configuration: usize) -> Truth {
        self.set.placed[configuration].seen_in(entry.precision()).truth
    }

    /// One value per configuration, NaN where the algorithm was not measured.
    fn spread(&self, entry: &Entry, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut values = vec![f64::NAN; self.set.placed.len()];
        for (row, &i) in entry.records.configuration.iter().enumerate() {
            if let Some(slot) = values.get_mut(i as usize) {
                *slot = value(row);
            }
        }
        values
    }

    /// 0 or 1 by verdict; an answer that was not given is neither right nor wrong.
    fn verdicts(&self, entry: &Entry, counts: fn(Verdict) -> bool) -> Vec<f64> {
        self.spread(entry, |row| match entry.records.verdict[row] {
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
    fn errors(&self, entry: &Entry) -> Result<Vec<f64>> {
        if self.query != Query::Proximity {
            return Err(LabError::Invalid(
                "This run has collision queries, and only distances have an error; use the wrong answers.".into(),
            ));
        }
        let grain = self.grain(entry.precision().unit_roundoff());
        Ok(self.spread(entry, |row| {
            let i = entry.records.configuration[row] as usize;
            match entry.records.said[row] {
                Said::Distance(d) => self.truth(entry, i).distance_error(d, self.semantics) / grain[i],
                Said::Decision(_) | Said::Nothing => f64::NAN,
            }
        }))
    }

    fn flips(&self, entry: &Entry) -> Result<Vec<f64>> {
        if entry.records.flips.iter().all(Option::is_none) {
            let sentence = "The records of this run come from a version that did not count flips; run it again.";
            return Err(LabError::Invalid(sentence.into()));
        }
        Ok(self.spread(entry, |row| entry.records.flips[row].map_or(f64::NAN, |n| f64::from(u8::from(n > 0)))))
    }

    /// Share of the other algorithms that contradict this one, of those that answered.
    fn disputes(&self, entry: &Entry) -> Result<Vec<f64>> {
        let said = self.said(entry);
        let (mut against, mut others) = (vec![0.0; said.len()], vec![0.0; said.len()]);
        let grain = [self.grain(U32), self.grain(U64)];
        let tau = |entry: &Entry, i: usize| 32.0 * grain[usize::from(entry.bits != 32)][i];
        for other in self.entries.iter().filter(|other| other.algorithm != entry.algorithm) {
            for (i, theirs) in self.said(other).into_iter().enumerate() {
                // One of them may have got rounded coordinates.
                let [own, its] = [entry, other].map(|entry| self.truth(entry, i));
                let between = own.distance_hi.max(its.distance_hi) - own.distance_lo.min(its.distance_lo);
                let slack = tau(entry, i) + tau(other, i) + between;
                if let (Some(mine), Some(theirs), true) = (said[i], theirs, own.hit == its.hit) {
                    others[i] += 1.0;
                    against[i] += f64::from(u8::from(mine.contradicts(theirs, slack)));
                }
            }
        }
        if others.iter().all(|n| *n == 0.0) {
            let sentence = "Disagreement requires a second algorithm on the same configurations.";
            return Err(LabError::Invalid(sentence.into()));
        }
        Ok(against.into_iter().zip(others).map(|(n, of): (f64, f64)| n / of).collect())
    }

    /// What an algorithm answered to each configuration; nothing where it was silent or not measured.
    fn said(&self, entry: &Entry) -> Vec<Option<Said>> {
        let mut all = vec![None; self.set.placed.len()];
        for (&i, &said) in entry.records.configuration.iter().zip(&entry.records.said) {
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

impl Columns for RecordTable {
    type Error = LabError;

    fn column(&self, column: Column, of: Option<&str>) -> Result<Cow<'_, [f64]>> {
        if column == Column::Distance {
            return Ok(self.set.placed.iter().map(|p| p.truth.distance_hi).collect());
        }
        let algorithm = of.unwrap_or(&self.looked_at);
        if algorithm.is_empty() {
            let sentence =
                "The selection does not name an algorithm; write for example `time of box-tree in [1ms, 1s]`.";
            return Err(LabError::Invalid(sentence.to_owned()));
        }
        let entry = self.entry(algorithm)?;
        let counted = |tests: &[Option<u64>]| {
            if tests.iter().all(Option::is_none) {
                let algorithm = &entry.algorithm;
                return Err(LabError::Invalid(format!("The algorithm {algorithm:?} does not report its tests.")));
            }
            Ok(self.spread(entry, |row| tests[row].map_or(f64::NAN, |n| n as f64)))
        };
        Ok(Cow::Owned(match column {
            Column::Time => self.spread(entry, |row| entry.records.time_ns[row]),
            Column::BvTests => counted(&entry.records.bv_tests)?,
            Column::PrimitiveTests => counted(&entry.records.primitive_tests)?,
            Column::Error => self.errors(entry)?,
            Column::Wrong => self.verdicts(entry, Verdict::is_wrong),
            Column::Missed => self.verdicts(entry, |verdict| verdict == Verdict::FalseNegative),
            Column::FalseAlarm => self.verdicts(entry, |verdict| verdict == Verdict::FalsePositive),
            Column::Flipped => self.flips(entry)?,
            Column::Disputed => self.disputes(entry)?,
            Column::Distance => unreachable!("answered above"),
        }))
    }

    fn distance_from(&self, body: Body, vertex: u32) -> Result<Vec<f64>> {
        let mesh = &self.meshes[body as usize];
        let Some(middle) = mesh.positions().get(vertex as usize) else {
            let vertices = mesh.positions().len();
            return Err(LabError::Invalid(format!(
                "The selection names vertex {vertex} of object {body:?}, which has {vertices}, counted from 0."
            )));
        };
        Ok(distances(&self.witnesses(body), middle, mesh.longest_side()))
    }
}
