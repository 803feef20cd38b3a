//! Queries recorded from a running program: what it asked about the objects of a scene, and what it was answered.

mod claim;

use serde::{Deserialize, Serialize};

use crate::configuration::Configuration;
use crate::query::Query;

pub use claim::{Bracket, Claim};

/// What a program asked about a pair of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Do they collide?
    Collide,
    /// Where do they collide?
    Contacts,
    /// How far apart are they?
    Distance,
    /// Are they closer than a length?
    Tolerance,
}

impl Kind {
    /// Every kind with its name in files; its place is its number in a spool.
    pub const NAMES: [(Self, &'static str); 4] = [
        (Self::Collide, "collide"),
        (Self::Contacts, "contacts"),
        (Self::Distance, "distance"),
        (Self::Tolerance, "tolerance"),
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }

    /// The kind of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.into_iter().find_map(|(kind, its)| (its == name).then_some(kind))
    }

    /// The query that algorithms are asked instead. No algorithm here has a tolerance, so the distance is asked for it.
    pub fn query(self) -> Query {
        match self {
            Self::Collide => Query::CollisionFirst,
            Self::Contacts => Query::CollisionAll,
            Self::Distance | Self::Tolerance => Query::Proximity,
        }
    }
}

/// What the recorded program's library answered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Answered {
    /// A collision; for [`Kind::Tolerance`]: closer than the length.
    pub hit: Option<bool>,
    /// The distance; 0 or less when the objects collide.
    pub distance: Option<f64>,
}

/// One recorded query.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// Its number among all queries that the recorder saw; numbers that are missing were sampled away.
    pub sequence: u64,
    /// The robot state, planner call or simulation step to which it belongs.
    pub group: u64,
    /// The two objects, by their place in the scene.
    pub objects: [u32; 2],
    /// Their poses.
    pub configuration: Configuration,
    /// What was asked.
    pub kind: Kind,
    /// For [`Kind::Tolerance`] the length, in the unit of the scene; for [`Kind::Contacts`] the most contacts asked for.
    pub limit: f64,
    /// What was answered.
    pub answered: Answered,
    /// How long the library took in the recorded program, in seconds.
    pub seconds: Option<f64>,
    /// Which of the libraries of the recording answered.
    pub library: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_is_at_the_place_of_its_number() {
        for (number, (kind, name)) in Kind::NAMES.into_iter().enumerate() {
            assert_eq!((kind as usize, kind.name(), Kind::named(name)), (number, name, Some(kind)));
        }
        assert_eq!(Kind::named("Collide"), None);
    }
}
