//! What a scene asks, and at what distances.

use serde::{Deserialize, Serialize};

/// So many configurations are a good sample to choose by.
pub const CONFIGURATIONS: u32 = 400;
/// And so many others to check by.
pub const HELD_OUT: u32 = 1_000;
/// Relative distances of a scene that asks how far apart the objects are.
const DISTANCES: [f64; 4] = [0.003, 0.03, 0.1, 0.3];
/// The same for a clearance, as shares of it: on both sides, more and more clearly.
const AROUND: [f64; 6] = [0.25, 0.75, 1.25, 2.0, 4.0, 8.0];

/// Relative distances (surface distance over A's longest side) that fit a question.
pub fn usual_distances(question: Question, longest_side: f64) -> Vec<f64> {
    match question {
        Question::Clearance { clearance } if clearance > 0.0 => AROUND.map(|x| x * clearance / longest_side).to_vec(),
        Question::Clearance { .. } | Question::Distance { .. } => DISTANCES.to_vec(),
    }
}

/// What is asked of every configuration; lengths are the objects' own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case", tag = "kind")]
#[schema(as = AdviceQuestion)]
pub enum Question {
    /// How far apart are they, give or take the tolerance?
    Distance {
        /// Largest error of an answer; more than 0.
        tolerance: f64,
    },
    /// Are they further apart than this?
    Clearance {
        /// The distance; 0 asks whether the surfaces meet.
        clearance: f64,
    },
}

impl Question {
    /// What a yes or no is about: the clearance, or where a distance is asked, its tolerance.
    pub fn reach(self) -> f64 {
        match self {
            Self::Distance { tolerance } => tolerance,
            Self::Clearance { clearance } => clearance,
        }
    }
}
