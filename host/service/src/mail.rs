//! Mails: the server that takes them, what stands in them, and bringing one there.

#[cfg(feature = "mail")]
mod delivery;
#[cfg(not(feature = "mail"))]
#[path = "mail/no_delivery.rs"]
mod delivery;
mod letter;
pub mod outbox;
mod server;
pub mod sql;

pub use delivery::{Refused, deliver};
pub use letter::{Letter, one_line};
pub use server::{MailServer, Pace, address};
