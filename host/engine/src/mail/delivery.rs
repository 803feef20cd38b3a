//! Bringing one mail to the server. It counts from the server's word that it has the mail on; what happens behind that word, such
//! as a farewell that is never answered, sends nothing twice.

use std::time::Duration;

use lettre::Message;
use lettre::transport::smtp::authentication::{Credentials, DEFAULT_MECHANISMS};
use lettre::transport::smtp::client::{AsyncSmtpConnection, TlsParameters};
use lettre::transport::smtp::extension::ClientId;
use lettre::transport::smtp::response::Code;

use super::{MailServer, Security, one_line};

/// For the farewell, which is polite and no more.
const FAREWELL: Duration = Duration::from_secs(2);

/// Why the server does not have the mail.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// In one line, for the log.
    pub reason: String,
    /// The server knows no such receiver: asking again changes nothing.
    pub for_good: bool,
}

/// Brings a mail to the server within its time.
pub async fn deliver(server: &MailServer, mail: &Message) -> Result<(), Refused> {
    let patience = server.pace.delivery;
    let brought = tokio::time::timeout(patience, bring(server, mail)).await;
    let mut connection = match brought {
        Ok(brought) => brought.map_err(|e| refused(&e))?,
        Err(_) => {
            let reason = format!("it did not take the mail within {} s", patience.as_secs_f64());
            return Err(Refused { reason, for_good: false });
        }
    };
    tokio::spawn(async move { tokio::time::timeout(FAREWELL, connection.quit()).await.is_ok() });
    Ok(())
}

async fn bring(server: &MailServer, mail: &Message) -> Result<AsyncSmtpConnection, lettre::transport::smtp::Error> {
    let name = ClientId::default();
    let tls = || TlsParameters::new(server.host.clone());
    let wrapped = if server.security == Security::Wrapped { Some(tls()?) } else { None };
    let place = (server.host.as_str(), server.port);
    let mut connection = AsyncSmtpConnection::connect_tokio1(place, None, &name, wrapped, None).await?;
    if server.security == Security::StartTls {
        connection.starttls(tls()?, &name).await?;
    }
    if let Some((user, password)) = &server.credentials {
        connection.auth(DEFAULT_MECHANISMS, &Credentials::new(user.clone(), password.clone())).await?;
    }
    connection.send(mail.envelope(), &mail.formatted()).await?;
    Ok(connection)
}

fn refused(e: &lettre::transport::smtp::Error) -> Refused {
    // 550, 551 and 553 are about the receiver; other refusals may be about us, and somebody may mend them.
    let receiver = ["550", "551", "553"];
    let for_good = e.status().is_some_and(|code: Code| receiver.contains(&code.to_string().as_str()));
    Refused { reason: one_line(&e.to_string()).chars().take(300).collect(), for_good }
}
