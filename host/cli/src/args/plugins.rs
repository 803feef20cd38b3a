//! Plugins: looking at them, handing them in, and the accounts of those who do.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::ServiceArgs;

/// `ocb plugin`
#[derive(Debug, Subcommand)]
pub enum PluginCommand {
    /// List all algorithms of all plugins.
    List,
    /// Check a plugin file, in the jail: format, ABI, descriptor, answers against the reference, conduct. A service gives
    /// the same verdicts.
    Check {
        /// The shared library.
        file: PathBuf,
        /// Only what takes a second: no comparison with the reference beyond a few dozen questions.
        #[arg(long)]
        quick: bool,
        /// What you say of it (JSON): compared with what the file says.
        #[arg(long, value_name = "FILE")]
        manifest: Option<PathBuf>,
        /// Ask nothing but the question of this repro again.
        #[arg(long, value_name = "FILE")]
        repro: Option<PathBuf>,
        /// Write each wrong answer's repro into this folder.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
}

/// `ocb submit`
#[derive(Debug, Args)]
pub struct SubmitArgs {
    /// The shared library.
    pub file: PathBuf,
    /// What you say of it, as JSON: name, version, authors, license (SPDX), paper, source, queries, threads.
    #[arg(long, value_name = "FILE")]
    pub manifest: PathBuf,
    /// Its signature by the key that your account there has registered (minisign -S writes it).
    #[arg(long, value_name = "FILE")]
    pub signature: Option<PathBuf>,
    #[command(flatten)]
    pub service: ServiceArgs,
    /// Do not wait for the check.
    #[arg(long)]
    pub no_wait: bool,
}

/// `ocb admin`
#[derive(Debug, Subcommand)]
pub enum AdminCommand {
    /// Make an account; the password comes from OCB_PASSWORD or the first line of the input.
    Create {
        /// User name or e-mail address.
        name: String,
        /// user, developer, curator or administrator.
        #[arg(long, default_value = "administrator", value_name = "ROLE")]
        role: String,
    },
    /// Show what goes and what stays with an account, then delete it for good; people delete theirs on the account page.
    Delete {
        /// Its name.
        name: String,
        /// Do not ask.
        #[arg(long)]
        yes: bool,
    },
    /// Invite somebody to be a developer: prints a link that one account may accept once, in a browser. Curators invite on
    /// the page of curators.
    Invite {
        /// For whom it is, for curators and the log.
        recipient: String,
        /// Days until it expires.
        #[arg(long, default_value_t = 14, value_name = "DAYS")]
        days: u32,
        /// Where the service is reached.
        #[arg(long, default_value = "http://127.0.0.1:8080", env = "OCB_SERVER", value_name = "URL")]
        server: String,
    },
    /// List invitations, newest first.
    Invitations,
    /// Withdraw an invitation that nobody has accepted.
    Revoke {
        /// Its id, as `ocb admin invitations` lists it.
        id: String,
    },
    /// Tell whether every entry of the audit log is as it was written.
    Audit,
}
