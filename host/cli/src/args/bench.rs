//! Arguments of `ocb bench`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::choice::OrderArg;
use crate::placing::PlacingArgs;

/// `ocb bench`
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Object A (fixed): a file (OBJ, STL, PLY, OFF, glTF, GLB, COLLADA), or a stock object such as `stock:castle@5000`.
    #[arg(required_unless_present = "workload")]
    pub a: Option<String>,
    /// Object B (moving) [default: the same as A].
    pub b: Option<String>,
    /// Instead of objects: replay every query of a recording (.ocbrec).
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["a", "b", "query", "contacts", "solid", "method", "configurations", "paper_compat", "rotate",
                              "move_by", "count", "seed", "distance", "step", "ladder", "center_distance", "hit_share",
                              "precision", "quick"]
    )]
    pub workload: Option<PathBuf>,
    /// For a recording: orders in which the queries are put, repeated or separated by commas [default: all].
    #[arg(long, value_enum, value_delimiter = ',', requires = "workload")]
    pub order: Vec<OrderArg>,
    /// Algorithm ids, with optional settings (box-tree:leaf_size=4, x:threads=2), repeated or separated by commas; or `all`
    /// [default: the usual ones that answer the query].
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    pub algorithm: Vec<String>,
    /// Collision query (cd) or distance query (pq).
    #[arg(long, value_enum, default_value_t = Question::Cd)]
    pub query: Question,
    /// For cd: stop at the first contact, or list all [default: first].
    #[arg(long, value_enum)]
    pub contacts: Option<Contacts>,
    /// Solid bodies: an object completely inside the other one collides, too. Needs closed objects and algorithms that support it.
    #[arg(long)]
    pub solid: bool,
    #[command(flatten)]
    pub placing: PlacingArgs,
    /// Configurations from a file: Parquet as `ocb generate` writes it, or row-major 4x4 matrices that place B in A's frame,
    /// as CSV (16 or 12 numbers per line), JSON or raw little-endian f64.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["paper_compat", "rotate", "move_by", "count", "seed", "distance", "step", "ladder", "center_distance", "hit_share"]
    )]
    pub configurations: Option<PathBuf>,
    /// Number of fresh processes, each with one timed pass over the configurations in the unit of the files; the median counts.
    #[arg(long, default_value_t = 5)]
    pub passes: u32,
    /// Seed of the query order, the equivalent instances and the blocks of queries, to repeat a run [default: random].
    #[arg(long, value_name = "NUMBER")]
    pub run_seed: Option<u64>,
    /// Measuring time per algorithm; a slower algorithm is measured on as many configurations as fit.
    #[arg(long, default_value_t = 60.0, allow_negative_numbers = true, value_name = "SECONDS")]
    pub budget: f64,
    /// Stop once the comparison is settled; differences below this share (5%, 0.02) do not matter. The result is a preview,
    /// which `ocb run refine` completes.
    #[arg(long, allow_hyphen_values = true, value_name = "SHARE", value_parser = share)]
    pub precision: Option<f64>,
    /// Quick look: measure at most 5,000 configurations, evenly spread over all. The result is a preview;
    /// `ocb run refine` completes it.
    #[arg(long)]
    pub quick: bool,
    /// Folder for the result files: records as Parquet and CSV, configurations, run.json, heatmaps as GLB and PLY.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// A share of one, as 5% or 0.05.
fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = text.strip_suffix('%').map_or((text, 1.0), |percent| (percent, 100.0));
    let share = number.trim().parse::<f64>().map(|number| number / unit);
    share.map_err(|_| format!("{text:?} is not a share; write it as 5% or 0.05"))
}

/// The query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Question {
    /// Collision query.
    Cd,
    /// Proximity query.
    Pq,
}

/// How much of the answer to a collision query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Contacts {
    /// The first intersecting pair.
    First,
    /// All intersecting pairs.
    All,
}
