//! Who takes the mails of a service.

use std::path::PathBuf;

use clap::Args;

/// The mail server. Without one nothing is mailed.
#[derive(Args)]
pub struct MailArgs {
    /// Server that takes the mails of this service: `smtps://user:password@host:port`, or `smtp://...`, which must become encrypted
    /// before anything is said, unless the host is this machine. Everybody on this machine sees a command line: better say
    /// it in the environment.
    #[arg(long, env = "OCB_SMTP_URL", value_name = "URL", hide_env_values = true, requires = "mail_from")]
    pub smtp_url: Option<String>,
    /// Certificates (PEM) of authorities that may vouch for the mail server, beside those that this machine trusts; with it a
    /// server on this machine must become encrypted, too.
    #[arg(long, env = "OCB_SMTP_CA", value_name = "FILE", hide_env_values = true, requires = "smtp_url")]
    pub smtp_ca: Option<PathBuf>,
    /// Address that the mails come from.
    #[arg(long, env = "OCB_MAIL_FROM", value_name = "ADDRESS", hide_env_values = true, requires = "smtp_url")]
    pub mail_from: Option<String>,
    /// Where the pages of this service are, for the links in its mails [default: where it listens].
    #[arg(long, env = "OCB_PUBLIC_URL", value_name = "URL", hide_env_values = true)]
    pub public_url: Option<String>,
}

/// Without the password.
impl std::fmt::Debug for MailArgs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "MailArgs({})", if self.smtp_url.is_some() { "a server" } else { "no server" })
    }
}
