//! A query with its answer, and its row in the spool.

use std::time::Duration;

use crate::{Object, Refusal};

/// Bytes of a row.
pub(crate) const ROW: usize = 256;
/// Where the number of the group stands in a row.
const GROUP: usize = 8;
/// Parts of an answer, added up.
const ANSWERED: u32 = 1;
const HIT: u32 = 2;
const MEASURED: u32 = 4;

/// Object to world: the upper three rows of the 4x4 matrix, row-major; a rotation and a translation.
pub type Pose = [f64; 12];

/// The pose of an object whose frame is that of the world.
pub const IDENTITY: Pose = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// What was asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Do they collide?
    Collide,
    /// Where do they collide?
    Contacts {
        /// The most contacts asked for.
        most: u32,
    },
    /// How far apart are they?
    Distance,
    /// Are they closer than a length?
    Tolerance {
        /// The length, in the unit of the objects.
        within: f64,
    },
}

/// A query with its answer. What is not known stays `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// What was asked.
    pub kind: Kind,
    /// Of which objects.
    pub objects: [Object; 2],
    /// Where they were.
    pub poses: [Pose; 2],
    /// Whether they collide ([`Kind::Tolerance`]: are closer).
    pub hit: Option<bool>,
    /// Their distance in the unit of the objects; 0 or less where they collide. A distance that is not finite is no answer.
    pub distance: Option<f64>,
    /// How long the library took.
    pub time: Option<Duration>,
    /// What belongs together has one number: a robot state, a call of a planner, a step of a simulation.
    pub group: u64,
}

impl Query {
    /// A query of group 0 whose answer is not known.
    pub fn new(kind: Kind, objects: [Object; 2], poses: [Pose; 2]) -> Self {
        Self { kind, objects, poses, hit: None, distance: None, time: None, group: 0 }
    }

    /// Its row, without its place in the order of queries.
    pub(crate) fn row(&self) -> Result<Row, Refusal> {
        if self.poses.as_flattened().iter().any(|number| !number.is_finite()) {
            return Err(Refusal::Pose);
        }
        let (kind, limit) = match self.kind {
            Kind::Collide => (0, 0.0),
            Kind::Contacts { most } => (1, f64::from(most)),
            Kind::Distance => (2, 0.0),
            Kind::Tolerance { within } if within.is_finite() && within >= 0.0 => (3, within),
            Kind::Tolerance { .. } => return Err(Refusal::Tolerance),
        };
        let distance = self.distance.filter(|distance| distance.is_finite());
        let hit = self.hit.map_or(0, |hit| if hit { ANSWERED | HIT } else { ANSWERED });
        let bits: u32 = hit | distance.map_or(0, |_| MEASURED);
        let seconds = self.time.map_or(-1.0, |time| time.as_secs_f64());
        let mut row = Row::default();
        row.put(GROUP, &self.group.to_le_bytes());
        for (place, object) in self.objects.iter().enumerate() {
            row.put(16 + 4 * place, &object.number.to_le_bytes());
        }
        for (place, number) in self.poses.as_flattened().iter().enumerate() {
            row.put(24 + 8 * place, &number.to_le_bytes());
        }
        row.put(216, &u32::to_le_bytes(kind));
        row.put(220, &bits.to_le_bytes());
        for (place, number) in [limit, distance.unwrap_or(0.0), seconds].into_iter().enumerate() {
            row.put(224 + 8 * place, &number.to_le_bytes());
        }
        Ok(row)
    }
}

/// A row of the spool; `host/lab/src/recording/spool.rs` reads it.
pub(crate) struct Row(pub [u8; ROW]);

impl Default for Row {
    fn default() -> Self {
        Self([0; ROW])
    }
}

impl Row {
    fn put(&mut self, at: usize, bytes: &[u8]) {
        self.0[at..at + bytes.len()].copy_from_slice(bytes);
    }

    /// Says that it is the query after so many.
    pub fn follow(&mut self, before: u64) {
        self.put(0, &before.to_le_bytes());
    }

    /// The group of a row that was read back.
    pub fn group(row: &[u8; ROW]) -> u64 {
        let mut bytes = [0; 8];
        bytes.copy_from_slice(&row[GROUP..GROUP + 8]);
        u64::from_le_bytes(bytes)
    }
}
