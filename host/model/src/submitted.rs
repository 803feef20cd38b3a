//! Submitted plugins: what their authors declare about them, and what becomes of them.

use ocb_core::query::Query;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{AlgorithmInfo, AuditEntry, CheckLine};

/// What a developer says of a plugin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Display name.
    pub name: String,
    /// Version: letters, digits and `. + - _`, at most 32; another one for every upload.
    pub version: String,
    /// Authors.
    pub authors: String,
    /// SPDX licence expression.
    pub license: String,
    /// The paper the method comes from.
    #[serde(default)]
    pub paper: String,
    /// Where the source is.
    #[serde(default)]
    pub source: String,
    /// The questions it answers.
    pub queries: Vec<Query>,
    /// It enters the multi-threaded track, too.
    #[serde(default)]
    pub threads: bool,
}

/// Where a plugin is on its way to the public benchmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum PluginState {
    /// Waits for its check.
    Uploaded,
    /// The file is a plugin that may be loaded; its answers are being compared.
    Vetted,
    /// Did not pass: the report says why.
    Failed,
    /// Passed on the hardware class that is named; its author may benchmark it.
    Validated,
    /// Offered to the public; a curator decides.
    Awaiting,
    /// A curator asks its author something.
    Asked,
    /// A curator said no.
    Rejected,
    /// Everybody may benchmark it.
    Public,
    /// A curator took it out for the time being.
    Suspended,
    /// Taken out on this hardware class.
    Excluded,
    /// Its author took it out.
    Withdrawn,
}

impl PluginState {
    /// Every state with its name in the database.
    pub const NAMES: [(Self, &'static str); 11] = [
        (Self::Uploaded, "uploaded"),
        (Self::Vetted, "vetted"),
        (Self::Failed, "failed"),
        (Self::Validated, "validated"),
        (Self::Awaiting, "awaiting"),
        (Self::Asked, "asked"),
        (Self::Rejected, "rejected"),
        (Self::Public, "public"),
        (Self::Suspended, "suspended"),
        (Self::Excluded, "excluded"),
        (Self::Withdrawn, "withdrawn"),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }

    /// The state of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(state, _)| *state)
    }

    /// Everybody may look at it: it is public, or was.
    pub fn is_shown(self) -> bool {
        matches!(self, Self::Public | Self::Suspended | Self::Excluded | Self::Withdrawn)
    }

    /// Its author may benchmark it.
    pub fn is_usable(self) -> bool {
        matches!(self, Self::Validated | Self::Awaiting | Self::Asked | Self::Public)
    }

    /// The check is not through.
    pub fn is_checking(self) -> bool {
        matches!(self, Self::Uploaded | Self::Vetted)
    }
}

/// A submitted plugin, as the viewer may see it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PluginInfo {
    /// Its id.
    pub id: String,
    /// SHA-256 (hex) of the file.
    pub sha256: String,
    /// Size of the file.
    pub bytes: u64,
    /// Name of the file as it was sent.
    pub file: String,
    /// Name of the account that sent it.
    pub owner: String,
    /// The viewer sent it.
    pub mine: bool,
    /// What its author says of it.
    pub manifest: Manifest,
    /// The registered key of its author that it is signed with, as minisign writes it.
    pub signed_by: Option<String>,
    /// Where it is on its way.
    pub state: PluginState,
    /// Why it is there: a curator's or the author's words, or the first line that failed.
    pub reason: String,
    /// The hardware class on which it was checked.
    pub hardware_class: Option<String>,
    /// The hardware class on which it was taken out, where that is not the one of its check.
    #[serde(default)]
    pub excluded_on: Option<String>,
    /// The report so far.
    pub lines: Vec<CheckLine>,
    /// The algorithms that it describes.
    pub algorithms: Vec<AlgorithmInfo>,
    /// What a curator should look at; for curators and the author.
    pub flags: Vec<String>,
    /// The version before this one that is or was public.
    pub previous: Option<String>,
    /// When it was sent.
    pub created_us: i64,
    /// When its state changed last.
    pub changed_us: i64,
    /// What was done to it, oldest first.
    pub history: Vec<AuditEntry>,
}

/// A step on a plugin's way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// The author offers it to the public.
    Offer,
    /// The author answers a curator's question.
    Answer,
    /// The author takes it out.
    Withdraw,
    /// A curator makes it public.
    Approve,
    /// A curator asks something.
    Ask,
    /// A curator says no.
    Reject,
    /// A curator takes it out for the time being.
    Suspend,
    /// A curator takes it out on this hardware class.
    Exclude,
    /// A curator brings it back.
    Reinstate,
    /// The author or a curator ends its check, whether it waits or is under way.
    EndCheck,
}

/// A step, and why it is taken.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Decision {
    /// The step.
    pub action: Action,
    /// Why, for the author and for the log.
    #[serde(default)]
    pub reason: String,
}
