//! Plugins: looking at them, handing them in, and the accounts of those who do.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::ServiceArgs;

/// `ocb plugin`
#[derive(Debug, Subcommand)]
pub enum PluginCommand {
    /// List all algorithms of all plugins.
    List,
    /// Check a plugin file in the jail: format, ABI, descriptor, answers against the reference, behaviour. A service gives
    /// the same verdicts.
    Check {
        /// The shared library.
        file: PathBuf,
        /// Only the checks that take a second: at most a few dozen queries are compared with the reference.
        #[arg(long)]
        quick: bool,
        /// Manifest of the plugin (JSON), to compare with the file's descriptor.
        #[arg(long, value_name = "FILE")]
        manifest: Option<PathBuf>,
        /// Only repeat the query of this repro.
        #[arg(long, value_name = "FILE")]
        repro: Option<PathBuf>,
        /// Folder for the repros of wrong answers.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
}

/// `ocb submit`
#[derive(Debug, Args)]
pub struct SubmitArgs {
    /// The shared library.
    pub file: PathBuf,
    /// Manifest of the plugin (JSON): name, version, authors, license (SPDX), paper, source, queries, threads.
    #[arg(long, value_name = "FILE")]
    pub manifest: PathBuf,
    /// Signature of the file by the registered key of your account there (`minisign -S` writes it).
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
    /// Create an account; the password comes from OCB_PASSWORD or the first line of the input.
    Create {
        /// User name or e-mail address.
        name: String,
        /// Role: user, developer, curator or administrator.
        #[arg(long, default_value = "administrator", value_name = "ROLE")]
        role: String,
    },
    /// Preview the deletion of an account, then delete it permanently; users delete their own on the account page.
    Delete {
        /// Its name.
        name: String,
        /// Do not ask for confirmation.
        #[arg(long)]
        yes: bool,
    },
    /// Invite a developer: print a link that one account can accept once, in a browser. Curators can also invite on the
    /// curators' page.
    Invite {
        /// Name of the recipient, for curators and the log.
        recipient: String,
        /// Days until it expires.
        #[arg(long, default_value_t = 14, value_name = "DAYS")]
        days: u32,
        /// URL of the service.
        #[arg(long, default_value = "http://127.0.0.1:8080", env = "OCB_SERVER", value_name = "URL")]
        server: String,
    },
    /// List invitations, newest first.
    Invitations,
    /// Revoke an open invitation.
    Revoke {
        /// Its id, as `ocb admin invitations` lists it.
        id: String,
    },
    /// Allow a machine to measure for this service: print the token for `ocb work`. For the same name again, the old token ends.
    Machine {
        /// Name of the machine.
        name: String,
    },
    /// List the machines that measure.
    Machines,
    /// Revoke the token of a machine; what it measures waits again.
    RevokeMachine {
        /// Its name.
        name: String,
    },
    /// Check that no entry of the audit log was altered.
    Audit,
}
