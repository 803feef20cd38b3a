//! What one has made: what goes with it, deleting it, taking it along.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

/// `ocb data`
#[derive(Debug, Subcommand)]
pub enum DataCommand {
    /// List all your runs and objects.
    Show {
        #[command(flatten)]
        place: PlaceArgs,
    },
    /// Preview the deletion of a run, an object or all data, then delete it permanently.
    Delete {
        /// What to delete.
        #[arg(value_enum)]
        what: Deleted,
        /// Its id, the last part of its link; omit it for `all`.
        #[arg(required_if_eq_any([("what", "run"), ("what", "object")]))]
        id: Option<String>,
        /// Do not ask for confirmation.
        #[arg(long)]
        yes: bool,
        #[command(flatten)]
        place: PlaceArgs,
    },
    /// Write all your data to one archive: objects, runs with configurations and records, advice, plugins.
    Export {
        /// File to write (.tar).
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        #[command(flatten)]
        place: PlaceArgs,
    },
}

/// Whose data: that of an account on a service, or that of the command line in the data folder.
#[derive(Debug, Args)]
pub struct PlaceArgs {
    /// URL of the service [default: use the data folder of the command line].
    #[arg(long, env = "OCB_SERVER", value_name = "URL", requires = "token")]
    pub server: Option<String>,
    /// Token of your account there for runs and objects; its account page creates tokens.
    #[arg(long, env = "OCB_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: Option<String>,
}

/// What is deleted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Deleted {
    /// A run with its results.
    Run,
    /// An object, and your runs and advice that use it.
    Object,
    /// Everything but plugins, because results belong to them.
    All,
}
