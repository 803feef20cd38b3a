//! The public benchmark.

use clap::{Args, Subcommand};

/// `ocb suite`
#[derive(Debug, Subcommand)]
pub enum SuiteCommand {
    /// Show the suite, and the progress of each algorithm on this machine.
    Show,
    /// Measure the missing runs of the suite on this machine, then print the board of the suite.
    Run(SuiteRunArgs),
}

/// `ocb suite run`
#[derive(Debug, Args)]
pub struct SuiteRunArgs {
    /// Algorithm ids, measured with default settings [default: all].
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    pub algorithm: Vec<String>,
}
