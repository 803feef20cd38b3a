//! Do two answers to the same question say the same? Asked of the passes of one algorithm, and of two algorithms.

use serde::{Deserialize, Serialize};

use crate::query::Answer;

/// What an answer comes down to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Said {
    /// No answer was given, or a number that is none.
    #[default]
    Nothing,
    /// They collide, or not.
    Decision(bool),
    /// So far apart.
    Distance(f64),
}

impl Said {
    /// Of an answer of any kind; a list of contacts says whether it is empty.
    pub fn of(answer: &Answer) -> Self {
        match *answer {
            Answer::Collision { hit, .. } => Self::Decision(hit),
            Answer::Contacts { total, .. } => Self::Decision(total > 0),
            Answer::Distance { distance, .. } if distance.is_finite() => Self::Distance(distance),
            Answer::Distance { .. } | Answer::GaveUp | Answer::Unsupported => Self::Nothing,
        }
    }

    /// Not both can be right: another decision, a distance further away than `slack`, or an answer beside none.
    pub fn contradicts(self, other: Self, slack: f64) -> bool {
        match (self, other) {
            (Self::Distance(x), Self::Distance(y)) => (x - y).abs() > slack,
            _ => self != other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_contradict_by_decision_by_distance_and_by_silence() {
        let hit = |hit| Said::of(&Answer::Collision { hit, pair: None });
        let contacts = |total| Said::of(&Answer::Contacts { total, pairs: vec![] });
        let distance = |distance| Said::of(&Answer::Distance { distance, points: None, triangles: None });
        assert!(hit(true).contradicts(hit(false), 1.0));
        assert!(!contacts(3).contradicts(contacts(7), 0.0) && contacts(3).contradicts(contacts(0), 0.0));
        assert!(!contacts(3).contradicts(hit(true), 0.0));
        assert!(!distance(1.0).contradicts(distance(1.25), 0.25) && distance(1.0).contradicts(distance(1.5), 0.25));
        assert!(distance(f64::NAN).contradicts(distance(1.0), 9.0) && Said::of(&Answer::GaveUp) == Said::Nothing);
        assert!(!distance(f64::NAN).contradicts(Said::Nothing, 0.0));
    }
}
