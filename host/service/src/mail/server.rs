//! The mail server: its address, how its connection is encrypted, who may send.

use std::fmt;
use std::time::Duration;

use lettre::Address;
use percent_encoding::percent_decode_str;
use url::{Host, Url};

use crate::{EngineError, Result};

/// The server that takes the mails of this service, and what stands in each of them.
#[derive(Clone)]
pub struct MailServer {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) security: Security,
    pub(super) credentials: Option<(String, String)>,
    /// Whom its certificate may be from, beside those that the machine trusts: certificates as PEM.
    pub(super) authorities: Option<Vec<u8>>,
    pub(super) from: Address,
    /// Where the pages of this service are, without a slash at its end.
    pub(super) origin: String,
    /// How patient we are.
    pub pace: Pace,
}

/// When the connection is encrypted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Security {
    /// From the first byte.
    Wrapped,
    /// From the server's consent on, and never without it.
    StartTls,
    /// Never: the server is this machine, and no authority is named for it.
    Plain,
}

/// How patient we are with the server, and with who confirms an address.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// One mail, from connecting to the server's word that it has it.
    pub delivery: Duration,
    /// Before the second try; twice as long before each further one, up to an hour.
    pub first_wait: Duration,
    /// After so long a mail is given up.
    pub give_up: Duration,
    /// How long a link that confirms an address can be opened.
    pub link: Duration,
    /// How long a link that turns mails off does so: mails are read late.
    pub off: Duration,
}

impl Default for Pace {
    fn default() -> Self {
        let hours = |n: u64| Duration::from_secs(n * 3600);
        let seconds = Duration::from_secs;
        Self {
            delivery: seconds(30),
            first_wait: seconds(30),
            give_up: hours(24),
            link: hours(24),
            off: hours(180 * 24),
        }
    }
}

/// The longest wait between two tries.
const LONGEST_WAIT: Duration = Duration::from_secs(3600);

impl Pace {
    /// How long to wait after so many tries in vain.
    pub fn wait(&self, tries: u32) -> Duration {
        self.first_wait.saturating_mul(1 << tries.saturating_sub(1).min(20)).min(LONGEST_WAIT)
    }
}

impl MailServer {
    /// From `smtps://user:password@host:port` or `smtp://...`, which begins unencrypted and must become encrypted before anything
    /// is said, unless the server is this machine; the sender's address; and where the pages of this service are.
    ///
    /// # Errors
    /// `Invalid`, with a sentence that holds nothing of the URL: it has a password in it.
    pub fn new(url: &str, from: &str, origin: &str) -> Result<Self> {
        if cfg!(not(feature = "mail")) {
            return Err(EngineError::left_out("mail"));
        }
        let wrong = |what: &str| {
            let shape = "smtps://user:password@host:port, with %XX for special characters in the password";
            EngineError::Invalid(format!("The URL of the mail server {what}; it looks like {shape}."))
        };
        let url = Url::parse(url).map_err(|e| wrong(&format!("cannot be read ({e})")))?;
        let (host, here) = match url.host() {
            Some(Host::Domain(name)) => (name.to_owned(), name == "localhost"),
            Some(Host::Ipv4(address)) => (address.to_string(), address.is_loopback()),
            Some(Host::Ipv6(address)) => (address.to_string(), address.is_loopback()),
            None => return Err(wrong("has no host")),
        };
        // The host of a scheme that is no web address is not read as an IPv4 address.
        let here = here || host.parse::<std::net::Ipv4Addr>().is_ok_and(|address| address.is_loopback());
        let (security, port) = match url.scheme() {
            "smtps" => (Security::Wrapped, 465),
            "smtp" if here => (Security::Plain, 25),
            "smtp" => (Security::StartTls, 587),
            _ => return Err(wrong("must begin with smtps:// or smtp://")),
        };
        let decoded = |text: &str| {
            let text = percent_decode_str(text)
                .decode_utf8()
                .map_err(|_| wrong("has a name or password that is not UTF-8"))?;
            Ok::<_, EngineError>(text.into_owned())
        };
        let credentials = match (url.username(), url.password()) {
            ("", None) => None,
            (user, Some(password)) if !user.is_empty() => Some((decoded(user)?, decoded(password)?)),
            _ => return Err(wrong("has a user name without a password, or a password without a user name")),
        };
        if !matches!(url.path(), "" | "/") || url.query().is_some() || url.fragment().is_some() {
            return Err(wrong("has more than a host and a port"));
        }
        let port = url.port().unwrap_or(port);
        Ok(Self {
            host,
            port,
            security,
            credentials,
            authorities: None,
            from: address(from)?,
            origin: pages(origin)?,
            pace: Pace::default(),
        })
    }

    /// The same, whose certificate may also be from the authorities in this text of certificates (PEM). Whoever names one wants
    /// the certificate looked at, so this machine is spoken to with encryption, too.
    ///
    /// # Errors
    /// `Invalid` when there is no certificate in it, or one that cannot be read.
    pub fn trusting(mut self, pem: &[u8]) -> Result<Self> {
        let wrong = |what: &str| {
            let shape = "it consists of lines from -----BEGIN CERTIFICATE----- to -----END CERTIFICATE-----";
            EngineError::Invalid(format!("The file with the mail server's authority {what}; {shape}."))
        };
        if !String::from_utf8_lossy(pem).contains("-----BEGIN CERTIFICATE-----") {
            return Err(wrong("contains no certificate"));
        }
        self.authorities = Some(pem.to_vec());
        self.tls().map_err(|_| wrong("contains a certificate that cannot be read"))?;
        if self.security == Security::Plain {
            self.security = Security::StartTls;
        }
        Ok(self)
    }

    /// Who it is, for the log: no name and no password.
    pub fn named(&self) -> String {
        format!("{}:{}", self.host, self.port)
    }
}

/// Without name and password.
impl fmt::Debug for MailServer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "MailServer({}, {:?}, from {}, for {})", self.named(), self.security, self.from, self.origin)
    }
}

/// Letters of an address.
const ADDRESS: usize = 254;

/// An address that mails may be sent to: ASCII, one, without a name beside it, and not a mailbox of the server's own machine.
pub fn address(text: &str) -> Result<Address> {
    let text = text.trim();
    let plain = text.len() <= ADDRESS && text.chars().all(|c| c.is_ascii_graphic() && !"\"<>()[],;:\\".contains(c));
    let parsed = if plain { text.parse::<Address>().ok() } else { None };
    parsed.filter(|address| address.domain().contains('.')).ok_or_else(|| {
        EngineError::Invalid("An address must look like name@example.org and contain only ASCII characters.".into())
    })
}

fn pages(origin: &str) -> Result<String> {
    let wrong = || {
        EngineError::Invalid(format!(
            "{origin:?} is not the address of this service's pages; write https://host or http://host:port."
        ))
    };
    let url = Url::parse(origin).map_err(|_| wrong())?;
    let plain = matches!(url.scheme(), "http" | "https") && matches!(url.path(), "" | "/");
    let bare =
        url.username().is_empty() && url.password().is_none() && url.query().is_none() && url.fragment().is_none();
    if plain && bare && url.has_host() { Ok(url.origin().ascii_serialization()) } else { Err(wrong()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn server(url: &str) -> Result<MailServer> {
        MailServer::new(url, "ocb@example.org", "https://ocb.example.org/")
    }

    #[test]
    fn only_this_machine_is_spoken_to_without_encryption() {
        let of = |url: &str| server(url).map(|s| (s.security, s.port)).unwrap();
        assert_eq!(of("smtps://mail.example.org"), (Security::Wrapped, 465));
        assert_eq!(of("smtps://127.0.0.1:4650"), (Security::Wrapped, 4650));
        assert_eq!(of("smtp://mail.example.org"), (Security::StartTls, 587));
        assert_eq!(of("smtp://10.0.0.1:25"), (Security::StartTls, 25));
        assert_eq!(of("smtp://localhost.example.org:25"), (Security::StartTls, 25));
        for here in ["localhost", "127.0.0.1", "[::1]"] {
            assert_eq!(of(&format!("smtp://{here}:2525")), (Security::Plain, 2525), "{here}");
        }
    }

    #[test]
    fn an_authority_is_one_or_more_certificates() {
        let here = server("smtp://127.0.0.1:2525").unwrap();
        let broken = "-----BEGIN CERTIFICATE-----\nbm8gY2VydGlmaWNhdGU=\n-----END CERTIFICATE-----\n";
        for odd in ["", "no certificate", "-----BEGIN CERTIFICATE-----\n", broken] {
            let told = here.clone().trusting(odd.as_bytes()).unwrap_err().to_string();
            assert!(told.contains("authority") && told.ends_with('.'), "{odd:?}: {told}");
        }
    }

    #[test]
    fn the_password_is_read_and_never_shown() {
        let known = server("smtps://ada%40example.org:s%3Acret@mail.example.org").unwrap();
        assert_eq!(known.credentials, Some(("ada@example.org".into(), "s:cret".into())));
        let shown = format!("{known:?} {}", known.named());
        assert!(!shown.contains("cret") && !shown.contains("ada"), "{shown}");
        for odd in [
            "smtps://ada:secret@",
            "https://ada:secret@mail.example.org",
            "smtps://:secret@mail.example.org",
            "smtps://secret@mail.example.org",
            "smtps://ada:secret@mail.example.org:port",
            "smtps://ada:secret@mail.example.org/secret",
            "smtps://ada:secret@mail.example.org?tls=none",
            "secret",
        ] {
            let told = server(odd).unwrap_err().to_string();
            assert!(!told.contains("secret") && told.ends_with('.'), "{odd}: {told}");
        }
    }

    #[test]
    fn addresses_and_pages_are_what_they_say() {
        assert_eq!(address(" Ada.L+x@example.org ").unwrap().to_string(), "Ada.L+x@example.org");
        let long = format!("a@{}.org", "b".repeat(260));
        for odd in [
            "",
            "ada",
            "a@b@c",
            "a@b\r\nBcc: c@d",
            "Ada <a@b.org>",
            "a@b.org,c@d.org",
            "ä@b.org",
            "@b.org",
            "a@",
            "root@localhost",
            "a@[127.0.0.1]",
            &long,
        ] {
            assert!(address(odd).is_err(), "{odd:?}");
        }
        assert_eq!(pages("https://ocb.example.org/").unwrap(), "https://ocb.example.org");
        assert_eq!(pages("http://127.0.0.1:8080").unwrap(), "http://127.0.0.1:8080");
        for odd in ["", "ocb.example.org", "ftp://a", "https://a/b", "https://a?b", "https://u:p@a"] {
            assert!(pages(odd).is_err(), "{odd:?}");
        }
    }

    #[test]
    fn waits_grow_to_an_hour() {
        let pace = Pace::default();
        let waits: Vec<u64> = [1, 2, 3, 8, 40].map(|tries| pace.wait(tries).as_secs()).into();
        assert_eq!(waits, [30, 60, 120, 3600, 3600]);
    }
}
