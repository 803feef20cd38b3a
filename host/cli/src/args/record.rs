//! Arguments of `ocb record`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;
use ocb_core::workload::Kind;

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
    /// Instead of running a program: make a recording of poses that it wrote down, as JSON with objects and queries; with --object, as
    /// a configuration file (CSV, JSON, f64 matrices or Parquet) of a pair.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["limit", "spool"])]
    pub poses: Option<PathBuf>,
    /// Object of the pair, twice: A, then B, which may be the same file.
    #[arg(long, value_name = "FILE", requires = "poses")]
    pub object: Vec<PathBuf>,
    /// What was asked of the pair, in the words of the JSON: collide, contacts or distance.
    #[arg(long, default_value = "distance", value_parser = of_pair, requires = "object", value_name = "QUERY")]
    pub query: Kind,
    /// Program to run, with its arguments.
    #[arg(last = true, required_unless_present_any = ["spool", "poses"], conflicts_with_all = ["spool", "poses"], value_name = "PROGRAM")]
    pub program: Vec<OsString>,
}

/// A query that needs no length.
fn of_pair(name: &str) -> Result<Kind, String> {
    let kind = Kind::named(name).filter(|kind| *kind != Kind::Tolerance);
    kind.ok_or_else(|| "this is one of collide, contacts, distance".to_owned())
}
