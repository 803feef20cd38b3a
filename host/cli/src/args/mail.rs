//! Who takes the mails of a service.

use std::path::PathBuf;

use clap::Args;

use super::secret;

/// The mail server. Without one nothing is mailed.
#[derive(Args)]
pub struct MailArgs {
    /// Mail server of this service: `smtps://user:password@host:port`, or `smtp://...`, which must switch to encryption first
    /// unless the host is this machine; or `@FILE` with that address in it. All users of this machine can see its command lines,
    /// so better use a file or the environment variable.
    #[arg(long, env = "OCB_SMTP_URL", value_name = "URL", hide_env_values = true, requires = "mail_from", value_parser = secret::value)]
    pub smtp_url: Option<String>,
    /// Certificates (PEM) of additional authorities to trust for the mail server; with them, a mail server on this machine
    /// must be encrypted, too.
    #[arg(long, env = "OCB_SMTP_CA", value_name = "FILE", hide_env_values = true, requires = "smtp_url")]
    pub smtp_ca: Option<PathBuf>,
    /// Sender address of the mails.
    #[arg(long, env = "OCB_MAIL_FROM", value_name = "ADDRESS", hide_env_values = true, requires = "smtp_url")]
    pub mail_from: Option<String>,
    /// URL of the pages of this service, for the links in its mails [default: the address it listens on].
    #[arg(long, env = "OCB_PUBLIC_URL", value_name = "URL", hide_env_values = true)]
    pub public_url: Option<String>,
}

/// Without the password.
impl std::fmt::Debug for MailArgs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "MailArgs({})", if self.smtp_url.is_some() { "a server" } else { "no server" })
    }
}
