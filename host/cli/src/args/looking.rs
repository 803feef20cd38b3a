//! Looking at what a run has found.

use std::path::PathBuf;

use clap::Args;

use crate::choice::{ColormapArg, MeasureArg, OutliersArg, ScaleArg, SideArg, StatisticArg, WorstByArg};

/// `ocb heatmap`
#[derive(Debug, Args)]
pub struct HeatmapArgs {
    /// Run id, or `latest`.
    pub run: String,
    /// File to write: .glb (colours and values), .ply (colours and quality) or .csv (vertex, value, count, dropped).
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Algorithm [default: the run's only one].
    #[arg(long, value_name = "ID")]
    pub algorithm: Option<String>,
    /// What to show.
    #[arg(long, value_enum, default_value_t = MeasureArg::Time)]
    pub measure: MeasureArg,
    /// Statistic of the values at a vertex.
    #[arg(long, value_enum, default_value_t = StatisticArg::Median)]
    pub statistic: StatisticArg,
    /// How to treat values outside the IQR fence.
    #[arg(long, value_enum, default_value_t = OutliersArg::PerVertex)]
    pub outliers: OutliersArg,
    /// Object to show.
    #[arg(long, value_enum, default_value_t = SideArg::A)]
    pub side: SideArg,
    /// Colours.
    #[arg(long, value_enum, default_value_t = ColormapArg::Turbo)]
    pub colormap: ColormapArg,
    /// Subtract the values of this algorithm; colours are purple (less), white (0) and orange (more).
    #[arg(long, value_name = "ID")]
    pub against: Option<String>,
    /// Subtract the values of this run on the same object.
    #[arg(long, value_name = "RUN")]
    pub against_run: Option<String>,
    /// Only the configurations of this selection (`ocb select --help` explains the syntax).
    #[arg(long = "where", value_name = "SELECTION")]
    pub selection: Option<String>,
    /// How values are mapped to colours.
    #[arg(long, value_enum, default_value_t = ScaleArg::Linear)]
    pub scale: ScaleArg,
}

/// `ocb worst`
#[derive(Debug, Args)]
pub struct WorstArgs {
    /// Run id, or `latest`.
    pub run: String,
    /// Algorithm [default: the run's only one].
    #[arg(long, value_name = "ID")]
    pub algorithm: Option<String>,
    /// What counts as worse.
    #[arg(long, value_enum, default_value_t = WorstByArg::Time)]
    pub by: WorstByArg,
    /// Maximum number of configurations.
    #[arg(long, default_value_t = 100)]
    pub limit: u32,
    /// Only the configurations of this selection.
    #[arg(long = "where", value_name = "SELECTION")]
    pub selection: Option<String>,
}

/// `ocb select`
#[derive(Debug, Args)]
pub struct SelectArgs {
    /// Run id, or `latest`.
    pub run: String,
    /// The selection.
    #[arg(long = "where", value_name = "SELECTION")]
    pub selection: String,
    /// Algorithm of columns for which the selection names none [default: the run's only one].
    #[arg(long, value_name = "ID")]
    pub algorithm: Option<String>,
    /// File for the records of that algorithm: .parquet or .csv.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}
