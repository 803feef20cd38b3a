//! Stored benchmarks that are measured again.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

/// `ocb campaign`
#[derive(Debug, Subcommand)]
pub enum CampaignCommand {
    /// Queue stored benchmarks of another hardware class, suite or oracle again, with lower priority than all other runs.
    Create(CampaignArgs),
    /// List campaigns, newest first.
    List,
    /// Show the progress of a campaign, with old and new results side by side.
    Show {
        /// Campaign id, or `latest`.
        campaign: String,
        /// File to write the results to, .csv or .json.
        #[arg(short, long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// Cancel the queued runs of a campaign.
    Cancel {
        /// Campaign id, or `latest`.
        campaign: String,
    },
}

/// `ocb campaign create`
#[derive(Debug, Args)]
pub struct CampaignArgs {
    /// Reason for the campaign, shown to everyone.
    #[arg(long, value_name = "TEXT", required_unless_present = "dry_run")]
    pub reason: Option<String>,
    /// Measure only the suite, or only public runs whose accounts agree [default: both].
    #[arg(long, value_enum)]
    pub only: Option<CampaignOf>,
    /// Print the number of runs and queue nothing.
    #[arg(long)]
    pub dry_run: bool,
    /// Measure the whole campaign now, instead of leaving it to the service.
    #[arg(long, conflicts_with = "dry_run")]
    pub measure: bool,
}

/// What a campaign measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CampaignOf {
    /// The runs of the suite that are missing here.
    Suite,
    /// Public runs.
    People,
}
