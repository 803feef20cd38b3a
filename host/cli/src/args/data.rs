//! What one has made: what goes with it, deleting it, taking it along.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

/// `ocb data`
#[derive(Debug, Subcommand)]
pub enum DataCommand {
    /// Show all runs and objects of yours.
    Show {
        #[command(flatten)]
        place: PlaceArgs,
    },
    /// Show what goes with a run, an object or all of them, then delete it for good.
    Delete {
        /// What it is.
        #[arg(value_enum)]
        what: Deleted,
        /// Its id, the last part of its link; absent for `all`.
        #[arg(required_if_eq_any([("what", "run"), ("what", "object")]))]
        id: Option<String>,
        /// Do not ask.
        #[arg(long)]
        yes: bool,
        #[command(flatten)]
        place: PlaceArgs,
    },
    /// Write everything of yours into one archive: objects, runs with configurations and records, advice, plugins.
    Export {
        /// File to write (.tar).
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        #[command(flatten)]
        place: PlaceArgs,
    },
}

/// Whose things: those of an account on a service, or those of this command line in the data folder.
#[derive(Debug, Args)]
pub struct PlaceArgs {
    /// The service [default: the data folder of this command line].
    #[arg(long, env = "OCB_SERVER", value_name = "URL", requires = "token")]
    pub server: Option<String>,
    /// A token of your account there, made on its account page for runs and objects.
    #[arg(long, env = "OCB_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: Option<String>,
}

/// What is deleted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Deleted {
    /// A run with its results.
    Run,
    /// An object, and your runs and advice with it.
    Object,
    /// Everything but plugins, because results belong to them.
    All,
}
