//! Bringing one mail to the server. It counts from the server's word that it has the mail on; what happens behind that word, such
//! as a QUIT that is never answered, sends nothing twice.

use std::time::Duration;

use lettre::Message;
use lettre::transport::smtp::authentication::{Credentials, DEFAULT_MECHANISMS};
use lettre::transport::smtp::client::{AsyncSmtpConnection, Certificate, TlsParameters, TlsParametersBuilder};
use lettre::transport::smtp::extension::ClientId;
use lettre::transport::smtp::response::Code;

use super::letter::one_line;
use super::server::{MailServer, Security};

/// For QUIT, whose answer changes nothing.
const QUIT_TIMEOUT: Duration = Duration::from_secs(2);

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
        Ok(brought) => brought.map_err(|e| refused(server, &e))?,
        Err(_) => {
            let reason = format!("it did not accept the mail within {} s", patience.as_secs_f64());
            return Err(Refused { reason, for_good: false });
        }
    };
    tokio::spawn(async move { tokio::time::timeout(QUIT_TIMEOUT, connection.quit()).await.is_ok() });
    Ok(())
}

async fn bring(server: &MailServer, mail: &Message) -> Result<AsyncSmtpConnection, lettre::transport::smtp::Error> {
    let name = ClientId::default();
    let wrapped = if server.security == Security::Wrapped { Some(server.tls()?) } else { None };
    let place = (server.host.as_str(), server.port);
    let mut connection = AsyncSmtpConnection::connect_tokio1(place, None, &name, wrapped, None).await?;
    if server.security == Security::StartTls {
        connection.starttls(server.tls()?, &name).await?;
    }
    if let Some((user, password)) = &server.credentials {
        connection.auth(DEFAULT_MECHANISMS, &Credentials::new(user.clone(), password.clone())).await?;
    }
    connection.send(mail.envelope(), &mail.formatted()).await?;
    Ok(connection)
}

impl MailServer {
    /// How its certificate is looked at: it must be for this host, by somebody whom the machine trusts or who was named.
    pub(super) fn tls(&self) -> Result<TlsParameters, lettre::transport::smtp::Error> {
        let how = TlsParametersBuilder::new(self.host.clone());
        let how = match &self.authorities {
            Some(pem) => how.add_root_certificate(Certificate::from_pem(pem)?),
            None => how,
        };
        how.build()
    }
}

/// What is wrong, and how to mend it where the server is another than we were told, or seems to be.
fn told(server: &MailServer, e: &lettre::transport::smtp::Error) -> String {
    let told = one_line(&e.to_string());
    let Some((_, why)) = told.split_once("invalid peer certificate: ") else { return told };
    let server = server.named();
    if why.contains("not valid for name") {
        return format!("nothing was sent: the certificate of {server} is for another host ({why})");
    }
    let mend = "give its authority with --smtp-ca if it is your own";
    format!("nothing was sent: cannot verify the certificate of {server} ({why}); {mend}")
}

fn refused(server: &MailServer, e: &lettre::transport::smtp::Error) -> Refused {
    // 550, 551 and 553 are about the receiver; other refusals may be about us, and somebody may mend them.
    let receiver = ["550", "551", "553"];
    let for_good = e.status().is_some_and(|code: Code| receiver.contains(&code.to_string().as_str()));
    Refused { reason: told(server, e).chars().take(300).collect(), for_good }
}

#[cfg(test)]
mod tests {
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    use tokio::net::TcpListener;

    use super::super::Letter;
    use super::*;

    /// Brings a mail to a server that says these lines, one after each thing that it hears, and gives how that ended and what the
    /// server has heard.
    async fn brought(security: Security, lines: &[&str]) -> (Result<(), Refused>, Vec<u8>) {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let lock = if security == Security::Plain { "" } else { "ada:secret@" };
        let url = format!("smtps://{lock}{}", listener.local_addr().unwrap());
        let mut server = MailServer::new(&url, "ocb@example.org", "https://ocb.example.org").unwrap();
        server.security = security;
        server.pace.delivery = Duration::from_secs(20);
        let letter = Letter { to: "ada@example.org".into(), subject: "s".into(), text: "t".into(), off: "o".into() };
        let mail = letter.written(&server, "1").unwrap();
        let hearing = async {
            let (mut stream, _) = listener.accept().await.unwrap();
            let (mut heard, mut part) = (Vec::new(), [0; 4096]);
            for line in lines {
                stream.write_all(line.as_bytes()).await.unwrap();
                match stream.read(&mut part).await {
                    Ok(bytes) if bytes > 0 => heard.extend(&part[..bytes]),
                    _ => break,
                }
            }
            heard
        };
        let both = async { tokio::join!(deliver(&server, &mail), hearing) };
        tokio::time::timeout(Duration::from_secs(60), both).await.expect("the server is spoken to")
    }

    #[tokio::test]
    async fn nothing_is_said_to_a_server_that_will_not_encrypt() {
        let lines = ["220 here\r\n", "250-here\r\n250 AUTH PLAIN\r\n", "221 farewell\r\n"];
        let (ended, heard) = brought(Security::StartTls, &lines).await;
        let heard = String::from_utf8(heard).unwrap();
        assert!(ended.unwrap_err().reason.contains("STARTTLS"), "{heard}");
        assert!(heard.starts_with("EHLO") && !heard.contains("AUTH") && !heard.contains("MAIL"), "{heard}");
        // A server that only says that it would.
        let lines = ["220 here\r\n", "250-here\r\n250 STARTTLS\r\n", "220 go on\r\n", "250 no\r\n"];
        let (ended, heard) = brought(Security::StartTls, &lines).await;
        let heard = String::from_utf8_lossy(&heard).into_owned();
        assert!(ended.is_err() && heard.contains("STARTTLS") && !heard.contains("AUTH"), "{heard}");
        // One that was to be encrypted from the first byte hears the beginning of TLS, whatever it says.
        let (ended, heard) = brought(Security::Wrapped, &["", "220 here\r\n"]).await;
        assert!(ended.is_err() && heard.first() == Some(&0x16), "{heard:?}");
    }

    #[tokio::test]
    async fn only_an_unknown_receiver_is_given_up_at_once() {
        let greeting = ["220 here\r\n", "250 here\r\n", "250 OK\r\n"];
        for (answer, for_good) in
            [("550 who\r\n", true), ("553 who\r\n", true), ("552 full\r\n", false), ("450 later\r\n", false)]
        {
            let lines = [&greeting[..], &[answer, "221 farewell\r\n"]].concat();
            let (ended, _) = brought(Security::Plain, &lines).await;
            assert_eq!(ended.unwrap_err().for_good, for_good, "{answer}");
        }
    }
}
