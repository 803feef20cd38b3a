//! Runs: looking at them, taking one along, asking it again.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// `ocb run`
#[derive(Debug, Subcommand)]
pub enum RunCommand {
    /// List runs, newest first.
    List,
    /// Show one run with its table.
    Show {
        /// Run id, or `latest`.
        run: String,
    },
    /// Measure all configurations of a preview.
    Refine {
        /// Run id, or `latest`.
        run: String,
    },
    /// Write a repro archive of a run, with everything that determines its answers; `ocb replay` repeats it anywhere.
    Repro {
        /// Run id, or `latest`.
        run: String,
        /// File to write (.zip).
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
    },
}

/// `ocb replay`
#[derive(Debug, Args)]
pub struct ReplayArgs {
    /// Repro archive of a run, from `ocb run repro` or the run's page.
    pub file: PathBuf,
    /// Only these algorithms, repeated or separated by commas [default: all].
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    pub algorithm: Vec<String>,
}
