//! The public benchmark.

use clap::{Args, Subcommand};

/// `ocb suite`
#[derive(Debug, Subcommand)]
pub enum SuiteCommand {
    /// Tell what the suite asks, and how far each algorithm has come with it on this machine.
    Show,
    /// Measure what is missing of the suite here, then print the board of the suite.
    Run(SuiteRunArgs),
}

/// `ocb suite run`
#[derive(Debug, Args)]
pub struct SuiteRunArgs {
    /// Algorithms, by id, as they are when nothing is set [default: all].
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    pub algorithm: Vec<String>,
}
