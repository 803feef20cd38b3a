//! What a session is asked.

use ocb_core::configuration::Configuration;
use ocb_core::instance::Presented;
use ocb_core::query::Query;

/// A query about two of the objects that a process has loaded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// What is asked.
    pub query: Query,
    /// The object that stands first and the one that stands second, by their numbers in the order of loading, from 0. In a
    /// process of one pair A is 0 and B is 1, also where both are one mesh.
    pub objects: [u32; 2],
    /// Their poses.
    pub configuration: Configuration,
}

impl Question {
    /// About the objects of a process of one pair.
    pub fn of_pair(query: Query, Presented { configuration, swapped }: Presented) -> Self {
        Self { query, objects: if swapped { [1, 0] } else { [0, 1] }, configuration }
    }
}
