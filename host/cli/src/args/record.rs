//! Arguments of `ocb record`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;

/// `ocb record`
#[derive(Debug, Args)]
pub struct RecordArgs {
    /// Recording to write (.ocbrec); a file of that name is replaced.
    #[arg(short, long, value_name = "FILE")]
    pub out: PathBuf,
    /// Most queries that are kept of each process, 256 bytes each; of more, every second, fourth, ... whole group is kept.
    #[arg(long, default_value_t = 250_000, value_parser = clap::value_parser!(u64).range(1..=5_000_000), value_name = "QUERIES")]
    pub limit: u64,
    /// Instead of running a program: make a recording of what a recorder wrote into this folder.
    #[arg(long, value_name = "DIR", conflicts_with = "limit")]
    pub spool: Option<PathBuf>,
    /// Program to run, with its arguments.
    #[arg(last = true, required_unless_present = "spool", conflicts_with = "spool", value_name = "PROGRAM")]
    pub program: Vec<OsString>,
}
