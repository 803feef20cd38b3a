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
    /// Measure all configurations of a run that was a preview.
    Refine {
        /// Run id, or `latest`.
        run: String,
    },
    /// Write a run with everything that its answers follow from as one file, which `ocb replay` asks again anywhere.
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
    /// The repro archive of a run: `ocb run repro` writes it, and so does the run's page.
    pub file: PathBuf,
    /// Only these algorithms of it, repeated or separated by commas [default: all].
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    pub algorithm: Vec<String>,
}
