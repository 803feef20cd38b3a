//! What must hold between the answers to related questions, whoever is right: no oracle is needed to see it broken.
//!
//! A relation makes further questions of one that has been answered, and says what their answers must be. Those that round
//! nothing (another unit, mirrored axes, other numbers for triangles, the objects swapped) allow no other decision at all
//! where the answer is certain, and none anywhere for the unit; the others allow `tau`.

mod derive;
mod hold;

use nalgebra::Point3;

use crate::Posed;
use crate::draw::Draw;

/// What was answered to one question; absent what the method does not answer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Said {
    /// Do they collide?
    pub hit: Option<bool>,
    /// How many pairs of triangles meet?
    pub contacts: Option<u64>,
    /// How far apart?
    pub distance: Option<f64>,
    /// Between which points.
    pub points: Option<[Point3<f64>; 2]>,
}

/// How a relation is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Breach {
    /// Another decision than there must be.
    Decision,
    /// Another distance than there must be.
    Distance,
}

/// A relation between answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// A and B change places.
    Swap,
    /// Everything times a power of two.
    Unit,
    /// Axes exchanged and mirrored.
    Axes,
    /// Both moved alike, far away.
    Translation,
    /// Both turned alike.
    Rotation,
    /// Vertices and triangles in another order, and triangles twice.
    Numbering,
    /// Fewer triangles: no nearer.
    Subset,
    /// The nearer of two halves is as near as the whole.
    Union,
    /// Moved by v: nearer or farther by at most v.
    Moved,
    /// Turned by an angle: by at most as much as the farthest point moves.
    Turned,
    /// Moved straight away: farther by as much.
    Away,
    /// Moved straight on: nearer by as much.
    Approach,
    /// Triangles cut into four: the same surface.
    Subdivision,
    /// A collision is a distance of 0.
    Consistency,
    /// Some contact if and only if there is a first one.
    FirstAndAll,
    /// The points named are as far apart as the distance.
    Witness,
    /// Asked again after others, and of a new process.
    Again,
}

impl Relation {
    /// All of them, in the order of the tables.
    pub const ALL: [Self; 17] = [
        Self::Swap,
        Self::Unit,
        Self::Axes,
        Self::Translation,
        Self::Rotation,
        Self::Numbering,
        Self::Subset,
        Self::Union,
        Self::Moved,
        Self::Turned,
        Self::Away,
        Self::Approach,
        Self::Subdivision,
        Self::Consistency,
        Self::FirstAndAll,
        Self::Witness,
        Self::Again,
    ];

    /// Short name, name for people, and what must hold.
    pub fn words(self) -> [&'static str; 3] {
        match self {
            Self::Swap => {
                ["swap", "A and B swapped", "The same decision and distance with the objects in the other order."]
            }
            Self::Unit => {
                ["unit", "Another unit", "Times a power of two: the same decision, the distance times as much."]
            }
            Self::Axes => {
                ["axes", "Other axes", "Axes exchanged and mirrored, which rounds nothing: the same answers."]
            }
            Self::Translation => {
                ["translation", "Moved together", "Both objects moved alike: the same answers up to rounding."]
            }
            Self::Rotation => {
                ["rotation", "Turned together", "Both objects turned alike: the same answers up to rounding."]
            }
            Self::Numbering => [
                "numbering",
                "Other numbers",
                "Vertices and triangles in another order, some triangles twice: the same answers.",
            ],
            Self::Subset => {
                ["subset", "Part of an object", "Fewer triangles are no nearer, and collide only if the whole does."]
            }
            Self::Union => ["union", "Two halves", "The nearer half of an object is as near as the whole."],
            Self::Moved => ["moved", "A small move", "Moving by a length changes the distance by no more than that."],
            Self::Turned => {
                ["turned", "A small turn", "Turning changes the distance by no more than the farthest point moves."]
            }
            Self::Away => {
                ["away", "Straight away", "Moved along the line between the nearest points, away: farther by as much."]
            }
            Self::Approach => ["approach", "Straight on", "Moved along that line, on: nearer by as much."],
            Self::Subdivision => [
                "subdivision",
                "Triangles in four",
                "Every triangle cut into four is the same surface: the same answers.",
            ],
            Self::Consistency => [
                "consistency",
                "Collision and distance",
                "Collision means distance 0, no collision a distance that is not 0.",
            ],
            Self::FirstAndAll => {
                ["first-all", "First and all", "There is a first contact if and only if the list of all is not empty."]
            }
            Self::Witness => {
                ["witness", "Nearest points", "The points that are named are as far apart as the distance."]
            }
            Self::Again => [
                "again",
                "Asked again",
                "After other questions, and of a new process, the same answer to the last bit.",
            ],
        }
    }

    /// It rounds nothing and leaves no choice, so that even an answer within rounding must stay.
    pub fn strict(self) -> bool {
        matches!(self, Self::Unit | Self::Again | Self::FirstAndAll)
    }

    /// The amounts by which it is tried; one that has none is tried once.
    pub fn steps(self) -> &'static [f64] {
        match self {
            // Powers of two.
            Self::Unit => &[-40.0, -20.0, -15.0, -10.0, 10.0, 20.0],
            Self::Translation => &[16.0, 1024.0, 65536.0],
            Self::Moved | Self::Away => &[1e-9, 1e-4, 0.1],
            Self::Turned => &[1e-6, 1e-2],
            Self::Axes => &[1.0, 2.0, 3.0],
            Self::Rotation | Self::Numbering => &[1.0, 2.0],
            // Of the way.
            Self::Approach => &[0.5, 0.99],
            _ => &[0.0],
        }
    }

    /// The further questions at one amount.
    pub fn derive(self, base: &Posed, said: &Said, at: f64, draw: &mut Draw) -> Vec<Posed> {
        derive::derive(self, base, said, at, draw)
    }

    /// What is wrong with the answers to them; `tau` is the band of the method's precision, of the scene that needs the
    /// widest.
    pub fn breach(
        self,
        base: &Posed,
        said: &Said,
        at: f64,
        derived: &[Posed],
        answers: &[Said],
        tau: f64,
    ) -> Option<Breach> {
        hold::breach(self, base, said, at, derived, answers, tau)
    }
}

#[cfg(test)]
mod tests;
