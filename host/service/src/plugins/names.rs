//! Names and versions of plugins that exclude each other.

use crate::model::PluginState;
use crate::plugins::sql::PluginRow;

/// An algorithm id of this plugin that another account's plugin, which is or was public, has as well.
pub fn taken(row: &PluginRow, all: &[PluginRow]) -> Option<String> {
    let others = || all.iter().filter(|other| other.account != row.account && other.state.is_shown());
    ids(row).find(|id| others().any(|other| ids(other).any(|known| known == *id))).map(str::to_owned)
}

/// Why a finished check must not count: names that are taken, or a version that is there already.
pub fn conflict(row: &PluginRow, all: &[PluginRow], installed: impl Fn(&str) -> bool) -> Option<String> {
    if let Some(id) = ids(row).find(|id| installed(id)) {
        return Some(format!("The algorithm id {id:?} belongs to a plugin of this service; choose another id."));
    }
    if let Some(id) = taken(row, all) {
        return Some(format!("The algorithm id {id:?} belongs to another author's plugin; choose another id."));
    }
    let version = &row.manifest.version;
    let again = |other: &&PluginRow| {
        let same = ids(row).any(|id| ids(other).any(|known| known == id));
        let kept = !matches!(other.state, PluginState::Failed | PluginState::Rejected);
        other.id != row.id && other.account == row.account && kept && same && other.manifest.version == *version
    };
    all.iter().find(again).map(|_| format!("Version {version} of this plugin already exists; choose another version."))
}

pub fn ids(row: &PluginRow) -> impl Iterator<Item = &str> {
    row.algorithms.iter().map(|a| a.id.as_str())
}
