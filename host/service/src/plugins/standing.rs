//! Why results of a submitted plugin have no place any more: what its author or a curator decided since.

use std::collections::HashMap;

use crate::Result;
use crate::board::Measured;
use crate::model::PluginState;
use crate::plugins::sql::PluginRow;
use crate::store::Store;

/// Where a plugin file stands that has left the public benchmark.
pub struct Standing {
    state: PluginState,
    reason: String,
    hardware_class: Option<String>,
}

impl Standing {
    /// Why this result has no place, if so. Who was excluded on one hardware class keeps the places on others.
    pub fn why_not(&self, result: &Measured) -> Option<String> {
        let Self { state, reason, hardware_class } = self;
        let because = if reason.is_empty() { ".".to_owned() } else { format!(": {reason}") };
        match state {
            PluginState::Withdrawn => Some(format!("Its author has withdrawn this plugin{because}")),
            PluginState::Suspended => Some(format!("A curator has suspended this plugin{because}")),
            PluginState::Excluded if hardware_class.as_ref().is_none_or(|class| *class == result.hardware.value) => {
                Some(format!("This plugin is excluded on this hardware class{because}"))
            }
            _ => None,
        }
    }
}

impl Store {
    /// By the hash of the file; a file that somebody else has made public stands as that.
    pub(crate) async fn standings(&self) -> Result<HashMap<String, Standing>> {
        let rows = self.plugins().await?;
        let public = |blob: &str| rows.iter().any(|row| row.blob == blob && row.state == PluginState::Public);
        let left = rows.iter().filter(|row| row.state.is_shown() && !public(&row.blob));
        let standing = |row: &PluginRow| Standing {
            state: row.state,
            reason: row.reason.clone(),
            hardware_class: row.excluded_on.clone().or_else(|| row.hardware_class.clone()),
        };
        Ok(left.map(|row| (row.blob.clone(), standing(row))).collect())
    }
}
