//! What machines hand in.

use crate::model::Ended;

/// How a machine ended an attempt, with the files.
pub struct Handing {
    /// How.
    pub ended: Ended,
    /// Records, then tests per triangle, of each algorithm that has them, in the order of the algorithms.
    pub files: Vec<Vec<u8>>,
}
