//! Selected configurations: how many, what they cost, and the worst of them; and columns for pages.

use std::cmp::Ordering;

use ocb_core::agreement::Said;
use ocb_core::configuration::Witness;
use ocb_core::query::Query;
use ocb_core::record::Verdict;
use ocb_core::selection::{Body, Column, Columns, Kind, Selection};
use ocb_core::statistics::quantile;

use super::{Entry, RecordTable};
use crate::Result;
use crate::columns::{self, Numbers};
use crate::model::{Selected, SelectedOf, WorstBy, WorstCase};

impl RecordTable {
    /// How many configurations a selection holds, and what they cost each algorithm.
    ///
    /// # Errors
    /// `Invalid` when a column that it names cannot be had.
    pub fn selected(&self, selection: &Selection) -> Result<Selected> {
        let chosen = self.choose(selection)?;
        let n = chosen.iter().filter(|is| **is).count() as u32;
        let algorithms = self.entries.iter().map(|entry| selected_of(entry, &chosen)).collect();
        Ok(Selected { selection: selection.to_string(), n, of: chosen.len() as u32, algorithms })
    }

    /// Every column of the algorithm that a range can test, one value per configuration of the set, as an Arrow stream.
    ///
    /// # Errors
    /// `Invalid` when there are no records of it.
    pub fn columns_arrow(&self) -> Result<Vec<u8>> {
        self.entry(&self.looked_at)?;
        let is_range = |column: &&Column| **column != Column::Distance && column.kind() != Kind::Flag;
        let all = Column::ALL.iter().filter(is_range).filter_map(|column| {
            // A column that cannot be had, such as tests that are not counted, is left out.
            Some((column.name(), Numbers::Exact(self.column(*column, None).ok()?.into_owned())))
        });
        columns::stream(all.collect())
    }

    /// Where every configuration has its witness points, in the objects' frames, and how far apart it is.
    ///
    /// # Errors
    /// A `Fault` of the file format.
    pub fn witnesses_arrow(&self) -> Result<Vec<u8>> {
        let mut all = vec![("distance", Numbers::Exact(self.column(Column::Distance, None)?.into_owned()))];
        let triangles =
            |of: fn(&Witness) -> u32| Numbers::Index(self.set.placed.iter().map(|p| of(&p.truth.witness)).collect());
        all.push(("triangle_a", triangles(|w| w.triangle_a)));
        all.push(("triangle_b", triangles(|w| w.triangle_b)));
        for (body, names) in [(Body::A, ["a_x", "a_y", "a_z"]), (Body::B, ["b_x", "b_y", "b_z"])] {
            let points = self.witnesses(body);
            for (axis, name) in names.into_iter().enumerate() {
                all.push((name, Numbers::Exact(points.iter().map(|p| p[axis]).collect())));
            }
        }
        columns::stream(all)
    }

    /// The worst configurations of the algorithm: wrong answers first, missed collisions before all.
    ///
    /// # Errors
    /// `Invalid` when a column that the selection names cannot be had.
    pub fn worst(&self, selection: Option<&Selection>, by: WorstBy, limit: usize) -> Result<Vec<WorstCase>> {
        let entry = self.entry(&self.looked_at)?;
        let chosen = selection.map(|selection| self.choose(selection)).transpose()?;
        let errors = match (by, self.query) {
            (WorstBy::Time, Query::CollisionFirst | Query::CollisionAll) => None,
            _ => Some(self.column(Column::Error, None)?),
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
        let mut rows: Vec<usize> = (0..records.configuration.len())
            .filter(|&row| chosen.as_ref().is_none_or(|chosen| chosen[of(row)]))
            .collect();
        rows.sort_unstable_by(worse);
        rows.truncate(limit);
        Ok(rows.into_iter().map(|row| case(self, entry, row, errors.as_ref().map(|e| e[of(row)]))).collect())
    }
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
