//! Invitations to be a developer.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Where an invitation stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum InvitationState {
    /// Whoever has its link may accept it.
    Open,
    /// Somebody has; it opens nothing any more.
    Accepted,
    /// A curator has withdrawn it.
    Revoked,
    /// Nobody has accepted it in time.
    Expired,
}

/// An invitation, as curators see it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct InvitationInfo {
    /// Its id.
    pub id: String,
    /// For whom it is, in the words of who made it.
    pub recipient: String,
    /// Name of the account that made it; absent when whoever has the data folder did.
    pub invited_by: Option<String>,
    /// Where it stands.
    pub state: InvitationState,
    /// Name of the account that accepted it.
    pub accepted_by: Option<String>,
    /// When it was made.
    pub created_us: i64,
    /// Until when it can be accepted.
    pub expires_us: i64,
}

/// An invitation that is asked for.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct InvitationRequest {
    /// For whom it is: 1 to 200 characters, for curators and the log.
    pub recipient: String,
    /// Days until it expires, 1 to 90.
    #[serde(default = "two_weeks")]
    #[schema(minimum = 1, maximum = 90, default = 14)]
    pub days: u32,
}

fn two_weeks() -> u32 {
    14
}

/// An invitation just made: the only time that its secret is shown.
#[derive(Clone, Serialize, ToSchema)]
pub struct NewInvitation {
    /// The invitation.
    pub invitation: InvitationInfo,
    /// What is shown to accept it.
    pub secret: String,
    /// The page that accepts it. The secret stands behind `#`, so that no server and no log hears of it.
    pub link: String,
}

/// What was in the link.
#[derive(Clone, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Acceptance {
    /// The secret.
    pub secret: String,
}
