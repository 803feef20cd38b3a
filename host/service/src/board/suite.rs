//! What a board of a suite has to hold, and how old it is.

use super::filter::{ALL, NO_SUITE};
use super::{Measured, keys};
use crate::model::{BoardFilter, BoardSuite, RunSpec};
use crate::suite::Suite;

/// A scene and a distance, as the filters name them.
type Scenario = (String, String);

/// The suite that the filters have chosen, and which of its scenarios they leave; nothing for the runs of people.
pub fn expected<'s>(suites: &'s [Suite], filters: &[BoardFilter]) -> Option<(&'s Suite, Vec<Scenario>)> {
    let chosen =
        |name: &str| filters.iter().find(|filter| filter.name == name).map_or("", |filter| filter.chosen.as_str());
    let version = Some(chosen("suite")).filter(|version| *version != NO_SUITE)?;
    let suite = suites.iter().find(|suite| suite.document.version.to_string() == version)?;
    let question = |spec: &RunSpec| keys::question(spec).value == chosen("question");
    let named = |spec: RunSpec| (keys::scene(&spec, ["", ""]).value, keys::distance(&spec).value);
    let leaves = |filter: &str, value: &str| chosen(filter) == ALL || chosen(filter) == value;
    let all = suite.scenarios().into_iter().filter(question).map(named);
    Some((suite, all.filter(|(scene, distance)| leaves("scene", scene) && leaves("distance", distance)).collect()))
}

/// What the board says of the suite; nothing without results.
pub fn shown(suite: &Suite, scenarios: usize, left: &[Measured]) -> Option<BoardSuite> {
    let times = || left.iter().map(|m| m.finished_us);
    Some(BoardSuite {
        version: suite.document.version,
        sha256: suite.sha256.clone(),
        scenarios: scenarios as u32,
        hardware: left.first()?.hardware.words.clone(),
        oldest_us: times().min()?,
        newest_us: times().max()?,
    })
}
