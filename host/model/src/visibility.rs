//! Who sees what somebody made.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Who sees an object or a run; to others it is not there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Visibility {
    /// Its owner alone.
    Private,
    /// Whoever has its link; no list has it.
    // The default, also for guests: with the link a guest comes back from another browser and shows the result to others, and
    // ids cannot be guessed.
    #[default]
    Unlisted,
    /// Everybody: the list of objects has it, or the board when it is a finished run.
    Public,
}

impl Visibility {
    /// All of them with their names in the database and on the command line.
    pub const NAMES: [(Self, &'static str); 3] =
        [(Self::Private, "private"), (Self::Unlisted, "unlisted"), (Self::Public, "public")];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }

    /// The one of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(visibility, _)| *visibility)
    }
}

/// Who is to see it.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct NewVisibility {
    /// From now on.
    pub visibility: Visibility,
}
