//! In the place of `delivery.rs` where nothing can be sent: there is no `MailServer` then.

use std::convert::Infallible;

use lettre::Message;

use super::server::MailServer;

/// Why the server does not have the mail.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// In one line, for the log.
    pub reason: String,
    /// The server knows no such receiver: asking again changes nothing.
    pub for_good: bool,
}

/// Brings nothing.
pub async fn deliver(_: &MailServer, _: &Message) -> Result<(), Refused> {
    Err(Refused { reason: "this ocb was built without mail".into(), for_good: false })
}

impl MailServer {
    /// Nothing is encrypted here.
    pub(super) fn tls(&self) -> Result<(), Infallible> {
        Ok(())
    }
}
