//! Stored benchmarks that are measured again.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

/// `ocb campaign`
#[derive(Debug, Subcommand)]
pub enum CampaignCommand {
    /// Queue stored benchmarks again that were measured on another hardware class, suite or by another oracle; they come after
    /// whatever anybody waits for.
    Create(CampaignArgs),
    /// List campaigns, newest first.
    List,
    /// Show how far a campaign is, with old and new results side by side.
    Show {
        /// Campaign id, or `latest`.
        campaign: String,
        /// File to write the results to, .csv or .json.
        #[arg(short, long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// End what waits of a campaign.
    Cancel {
        /// Campaign id, or `latest`.
        campaign: String,
    },
}

/// `ocb campaign create`
#[derive(Debug, Args)]
pub struct CampaignArgs {
    /// Why, for everybody to read.
    #[arg(long, value_name = "TEXT", required_unless_present = "dry_run")]
    pub reason: Option<String>,
    /// Only the suite, or only public runs whose accounts agree [default: both].
    #[arg(long, value_enum)]
    pub only: Option<CampaignOf>,
    /// Tell how many runs it would be, and queue nothing.
    #[arg(long)]
    pub dry_run: bool,
    /// Measure it here and now, to its end, instead of leaving it to the service.
    #[arg(long, conflicts_with = "dry_run")]
    pub measure: bool,
}

/// What a campaign measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CampaignOf {
    /// What of the suite is missing here.
    Suite,
    /// Public runs.
    People,
}
