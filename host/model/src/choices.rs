//! What an account has chosen, and where its mails go.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What an account has chosen. All of it is off until somebody says otherwise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(example = json!({
    "agrees_to_reruns": true, "mail_notices": true, "address": "ada@example.org", "confirmed": true, "mailing": true
}))]
pub struct Choices {
    /// The service may measure this account's public runs again on new hardware, and tells it so.
    pub agrees_to_reruns: bool,
    /// Notices come by mail, too, once the address is confirmed.
    pub mail_notices: bool,
    /// Where mails go. Only the account itself sees it.
    pub address: Option<String>,
    /// The link that was sent to the address has been opened.
    pub confirmed: bool,
    /// This service sends mails at all.
    pub mailing: bool,
}

/// Choices to change; what is absent stays as it is.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({ "mail_notices": true }))]
pub struct NewChoices {
    /// May public runs be measured again on new hardware?
    #[serde(default)]
    pub agrees_to_reruns: Option<bool>,
    /// Do notices come by mail, too?
    #[serde(default)]
    pub mail_notices: Option<bool>,
}

/// An address that mails are to go to.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({ "address": "ada@example.org" }))]
pub struct NewAddress {
    /// At most 254 plain letters, digits and signs.
    pub address: String,
}

/// What was in the link that confirms an address.
#[derive(Clone, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({ "secret": "5d0c4b7e9f1a4c6e8b3d2f1a0c9e8d7b6a5f4e3d2c1b40a98f7e6d5c4b3a2918" }))]
pub struct OpenedLink {
    /// The secret.
    pub secret: String,
}
