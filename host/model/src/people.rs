//! Accounts, what they may do, and what was done.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::Owner;

/// What an account may do; each role may do what those before it may.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Keeps runs and objects in one place.
    User,
    /// Submits plugins.
    Developer,
    /// Decides about plugins and about who is a developer.
    Curator,
    /// Decides about roles, too.
    Administrator,
}

impl Role {
    /// Every role with its name in the database and on the command line.
    pub const NAMES: [(Self, &'static str); 4] = [
        (Self::User, "user"),
        (Self::Developer, "developer"),
        (Self::Curator, "curator"),
        (Self::Administrator, "administrator"),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }

    /// The role of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(role, _)| *role)
    }
}

/// An account, as its owner and curators see it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AccountInfo {
    /// Its id.
    pub id: String,
    /// Its name, as it is shown beside plugins.
    pub name: String,
    /// What it may do.
    pub role: Role,
    /// Why its owner wants to be a developer, while that is undecided.
    pub developer_request: Option<String>,
    /// The minisign key that its plugins may be signed with.
    pub signing_key: Option<String>,
    /// When it was made.
    pub created_us: i64,
}

impl AccountInfo {
    /// What owns this account's runs, objects and plugins.
    pub fn owner(&self) -> String {
        Owner::Account(&self.id).to_string()
    }
}

/// Who asks: a guest has no account.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Identity {
    /// The account that is logged in.
    pub account: Option<AccountInfo>,
}

/// Name and password.
#[derive(Clone, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Credentials {
    /// User name or e-mail address: 3 to 80 letters, digits and `. _ - @ +`.
    pub name: String,
    /// Password of 10 to 200 characters.
    pub password: String,
    /// Moves the guest's runs and objects into the account.
    #[serde(default)]
    pub keep: bool,
}

/// A change of the password.
#[derive(Clone, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct NewPassword {
    /// The password until now.
    pub old: String,
    /// The password from now on.
    pub new: String,
}

/// A key that plugins may be signed with.
#[derive(Clone, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct SigningKey {
    /// A minisign public key: the file `minisign.pub`, or its last line.
    pub public_key: String,
}

/// Why somebody wants to be a developer.
#[derive(Clone, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct DeveloperRequest {
    /// A sentence or two for the curators.
    pub reason: String,
}

/// Another role for an account.
#[derive(Clone, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct NewRole {
    /// The role.
    pub role: Role,
}

/// What a token may be used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// Objects, runs and results.
    Runs,
    /// Submitting plugins and looking at them.
    Plugins,
}

/// A token for programs, without its secret.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TokenInfo {
    /// Its id.
    pub id: String,
    /// What its owner calls it.
    pub name: String,
    /// What it may be used for.
    pub scopes: Vec<Scope>,
    /// When it was made.
    pub created_us: i64,
    /// When it ends.
    pub expires_us: i64,
}

/// A token that is asked for.
#[derive(Clone, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct TokenRequest {
    /// What its owner calls it, 1 to 80 characters.
    pub name: String,
    /// What it may be used for.
    pub scopes: Vec<Scope>,
}

/// A token just made: the only time that its secret is shown.
#[derive(Clone, Serialize, ToSchema)]
pub struct NewToken {
    /// The token.
    pub token: TokenInfo,
    /// To be sent as `Authorization: Bearer <secret>`.
    pub secret: String,
}

/// One thing that somebody did.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AuditEntry {
    /// Position in the log, from 1.
    pub seq: i64,
    /// When.
    pub at_us: i64,
    /// Who: the name of an account, or `the service`.
    pub actor: String,
    /// What, in a word.
    pub action: String,
    /// To what.
    pub subject: String,
    /// The reason given.
    pub detail: String,
}
