//! Answers as they stand in a row, and back.

use std::fmt;

use arrow_array::{Array, BooleanArray, Float64Array, RecordBatch, StringArray, UInt32Array, UInt64Array};
use nalgebra::Point3;
use ocb_core::instance::{AskedAs, Instance};
use ocb_core::query::Answer;

use super::{column, from_parquet};
use crate::sha256_hex;

/// The kinds of answers by their names in files.
const KINDS: [&str; 5] = ["collision", "contacts", "distance", "gave_up", "unsupported"];

/// An answer of any kind in one row.
#[derive(Clone, Debug, Default)]
pub struct Flat {
    /// What kind, by its name in files.
    pub kind: &'static str,
    /// Do they meet?
    pub hit: Option<bool>,
    /// How many pairs of triangles meet.
    pub contacts: Option<u64>,
    /// SHA-256 over those that were listed, in the order in which they came.
    pub contacts_sha256: Option<String>,
    /// The distance.
    pub distance: Option<f64>,
    /// Witness triangles.
    pub triangles: Option<[u32; 2]>,
    /// Witness points.
    pub points: Option<[Point3<f64>; 2]>,
}

impl From<&Answer> for Flat {
    fn from(answer: &Answer) -> Self {
        match answer {
            Answer::Collision { hit, pair } => {
                Flat { kind: "collision", hit: Some(*hit), triangles: *pair, ..Flat::default() }
            }
            Answer::Contacts { total, pairs } => {
                let listed: Vec<u8> = pairs.iter().flatten().flat_map(|triangle| triangle.to_le_bytes()).collect();
                Flat {
                    kind: "contacts",
                    hit: Some(*total > 0),
                    contacts: Some(*total),
                    contacts_sha256: Some(sha256_hex(&listed)),
                    ..Flat::default()
                }
            }
            Answer::Distance { distance, points, triangles } => Flat {
                kind: "distance",
                distance: Some(*distance),
                triangles: *triangles,
                points: *points,
                ..Flat::default()
            },
            Answer::GaveUp => Flat { kind: "gave_up", ..Flat::default() },
            Answer::Unsupported => Flat { kind: "unsupported", ..Flat::default() },
        }
    }
}

impl Flat {
    /// Are they the same in every bit? Two that are no numbers are when their bits are.
    pub fn is_same(&self, other: &Self) -> bool {
        let bits =
            |points: &Option<[Point3<f64>; 2]>| points.map(|both| both.map(|p| [p.x, p.y, p.z].map(f64::to_bits)));
        self.kind == other.kind
            && (self.hit, self.contacts, &self.contacts_sha256) == (other.hit, other.contacts, &other.contacts_sha256)
            && self.distance.map(f64::to_bits) == other.distance.map(f64::to_bits)
            && self.triangles == other.triangles
            && bits(&self.points) == bits(&other.points)
    }
}

impl fmt::Display for Flat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.kind, self.hit, self.contacts, self.distance) {
            ("contacts", _, Some(total), _) => write!(f, "{total} contacts")?,
            (_, Some(hit), _, _) => f.write_str(if hit { "a hit" } else { "no hit" })?,
            (_, _, _, Some(distance)) => write!(f, "the distance {distance:?}")?,
            ("gave_up", ..) => f.write_str("gave up")?,
            _ => f.write_str("no answer")?,
        }
        if let Some([a, b]) = self.triangles {
            write!(f, " of triangles {a} and {b}")?;
        }
        if let Some([a, b]) = self.points {
            write!(f, " at ({:?}, {:?}, {:?}) and ({:?}, {:?}, {:?})", a.x, a.y, a.z, b.x, b.y, b.z)?;
        }
        if let Some(hash) = &self.contacts_sha256 {
            write!(f, " with the hash {}", hash.get(..8).unwrap_or(hash))?;
        }
        Ok(())
    }
}

/// One recorded answer.
#[derive(Clone, Debug)]
pub struct AnswerRow {
    /// Index of the configuration in its set.
    pub configuration: u32,
    /// As what it was asked.
    pub asked: AskedAs,
    /// What was answered.
    pub answer: Flat,
}

/// The answers of a file of records, or why there are none in it.
pub fn read_answers(bytes: &[u8]) -> Result<Vec<AnswerRow>, String> {
    let (_, batches) = from_parquet(bytes)?;
    let mut all = Vec::new();
    for batch in &batches {
        append(&mut all, batch)?;
    }
    Ok(all)
}

/// What answers point at.
pub struct Pointers<'b> {
    triangles: [&'b UInt32Array; 2],
    coordinates: Vec<&'b Float64Array>,
}

impl<'b> Pointers<'b> {
    /// The columns of a file of records that hold it.
    pub fn of(batch: &'b RecordBatch) -> Result<Self, String> {
        let real = |name| column::<Float64Array>(batch, name);
        let coordinates = ["point_a_x", "point_a_y", "point_a_z", "point_b_x", "point_b_y", "point_b_z"].map(real);
        Ok(Self {
            triangles: [column(batch, "triangle_a")?, column(batch, "triangle_b")?],
            coordinates: coordinates.into_iter().collect::<Result<Vec<_>, _>>()?,
        })
    }

    /// Triangles of A and B.
    pub fn triangles(&self, row: usize) -> Option<[u32; 2]> {
        let of = |side: usize| self.triangles[side].is_valid(row).then(|| self.triangles[side].value(row));
        Some([of(0)?, of(1)?])
    }

    /// Points on A and on B.
    pub fn points(&self, row: usize) -> Option<[Point3<f64>; 2]> {
        let of = |side: usize| {
            let of = |axis: usize| self.coordinates[3 * side + axis];
            of(0).is_valid(row).then(|| Point3::new(of(0).value(row), of(1).value(row), of(2).value(row)))
        };
        Some([of(0)?, of(1)?])
    }
}

fn append(all: &mut Vec<AnswerRow>, batch: &RecordBatch) -> Result<(), String> {
    let whole = |name| column::<UInt32Array>(batch, name);
    let real = |name| column::<Float64Array>(batch, name);
    let (configuration, process, instance) = (whole("configuration")?, whole("process")?, whole("instance")?);
    let aside = column::<BooleanArray>(batch, "aside")?;
    let (kind, hit) = (column::<StringArray>(batch, "answer")?, column::<BooleanArray>(batch, "hit")?);
    let (contacts, hash) =
        (column::<UInt64Array>(batch, "contacts")?, column::<StringArray>(batch, "contacts_sha256")?);
    let distance = real("distance")?;
    let pointers = Pointers::of(batch)?;
    for row in 0..batch.num_rows() {
        let name = kind.value(row);
        let known =
            KINDS.iter().find(|known| **known == name).ok_or_else(|| format!("{name:?} is not a kind of answer"))?;
        all.push(AnswerRow {
            configuration: configuration.value(row),
            asked: AskedAs {
                process: process.is_valid(row).then(|| process.value(row)),
                instance: Instance { number: instance.value(row), aside: aside.value(row) },
            },
            answer: Flat {
                kind: known,
                hit: hit.is_valid(row).then(|| hit.value(row)),
                contacts: contacts.is_valid(row).then(|| contacts.value(row)),
                contacts_sha256: hash.is_valid(row).then(|| hash.value(row).to_owned()),
                distance: distance.is_valid(row).then(|| distance.value(row)),
                triangles: pointers.triangles(row),
                points: pointers.points(row),
            },
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bit_is_a_difference_and_no_number_is_the_same_as_itself() {
        let of = |distance: f64, x: f64| {
            let points = Some([Point3::new(x, 0.0, 1.0), Point3::origin()]);
            Flat::from(&Answer::Distance { distance, points, triangles: Some([1, 2]) })
        };
        let first = of(0.25, 1.0);
        assert!(first.is_same(&of(0.25, 1.0)) && of(f64::NAN, 1.0).is_same(&of(f64::NAN, 1.0)));
        assert!(!first.is_same(&of(0.25f64.next_up(), 1.0)) && !first.is_same(&of(0.25, 1f64.next_down())));
        assert!(!of(0.0, 1.0).is_same(&of(-0.0, 1.0)) && !first.is_same(&Flat::from(&Answer::GaveUp)));
        let listed = |pairs: &[[u32; 2]]| Flat::from(&Answer::Contacts { total: 2, pairs: pairs.to_vec() });
        assert!(listed(&[[1, 2], [3, 4]]).is_same(&listed(&[[1, 2], [3, 4]])));
        assert!(!listed(&[[1, 2], [3, 4]]).is_same(&listed(&[[3, 4], [1, 2]])));
        assert_eq!(first.to_string(), "the distance 0.25 of triangles 1 and 2 at (1.0, 0.0, 1.0) and (0.0, 0.0, 0.0)");
        assert!(listed(&[[1, 2]]).to_string().starts_with("2 contacts with the hash "));
    }
}
