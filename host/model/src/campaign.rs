//! Campaigns: stored benchmarks measured again, and what they gave before.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{Estimated, OutcomeName, State};

/// A campaign that is asked for.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({ "reason": "A new machine; the old hardware class was retired.", "suite": true, "people": true }))]
pub struct CampaignRequest {
    /// Why, for everybody to read.
    pub reason: String,
    /// Measure the suite as far as it was not measured on this hardware class and by this oracle.
    #[serde(default = "yes")]
    #[schema(default = true)]
    pub suite: bool,
    /// Measure public runs again whose accounts agree to that.
    #[serde(default = "yes")]
    #[schema(default = true)]
    pub people: bool,
    /// Measure on machines of this hardware class; of the service's usual one when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardware_class: Option<String>,
}

fn yes() -> bool {
    true
}

/// What a campaign would queue now.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CampaignPreview {
    /// Runs of the suite.
    pub suite_runs: u32,
    /// Of these, runs that repeat one which was measured before.
    pub suite_repeats: u32,
    /// Public runs of people.
    pub peoples_runs: u32,
    /// How long measuring all of it is expected to take, in seconds.
    pub expected_seconds: f64,
    /// The hardware class that it would measure on.
    pub hardware_class: String,
    /// Version of the oracle that judges.
    pub oracle: u32,
    /// Version of the suite.
    pub suite_version: u32,
}

/// A campaign, and how far it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CampaignInfo {
    /// Its id.
    pub id: String,
    /// Why it was made.
    pub reason: String,
    /// It measures the suite.
    pub suite: bool,
    /// It measures public runs again.
    pub people: bool,
    /// Name of the account that made it, or `the operator`.
    pub created_by: String,
    /// When it was made.
    pub created_us: i64,
    /// The hardware class that it measures on.
    pub hardware_class: String,
    /// Version of the oracle that judges.
    pub oracle: u32,
    /// Version of the suite.
    pub suite_version: u32,
    /// SHA-256 (hex) of the suite's file.
    pub suite_sha256: String,
    /// Running until nothing of it waits any more; then done, or cancelled.
    pub state: State,
    /// Its runs by state.
    pub runs: CampaignRuns,
    /// When its last run ended.
    pub ended_us: Option<i64>,
    /// Old and new results side by side, as far as the viewer may see them; empty in lists.
    pub results: Vec<Compared>,
}

/// The runs of a campaign by state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct CampaignRuns {
    /// In the queue.
    pub waiting: u32,
    /// At work.
    pub running: u32,
    /// With results.
    pub done: u32,
    /// Ended by a fault.
    pub failed: u32,
    /// Ended by somebody.
    pub cancelled: u32,
    /// How long those in the queue and at work are expected to take together, in seconds.
    pub expected_seconds: f64,
}

/// One algorithm in one scenario, before and in a campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Compared {
    /// The run of the campaign.
    pub run: String,
    /// Where that is.
    pub state: State,
    /// It belongs to the suite.
    pub of_suite: bool,
    /// The question, in words.
    pub question: String,
    /// The pair of objects.
    pub scene: String,
    /// How far apart.
    pub distance: String,
    /// Algorithm id, with its settings.
    pub algorithm: String,
    /// Display name.
    pub name: String,
    /// What the run before gave; absent when there was none or the viewer may not see it.
    pub old: Option<ComparedResult>,
    /// What the campaign gave; absent until it is measured.
    pub new: Option<ComparedResult>,
    /// New median time divided by the old one, and as far from that as both intervals allow; below 1 is faster now.
    pub ratio: Option<Estimated>,
    /// Both are of the same plugin file.
    pub same_file: bool,
}

/// One side of a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ComparedResult {
    /// The run.
    pub run: String,
    /// When that ended.
    pub finished_us: i64,
    /// CPU model.
    pub cpu: String,
    /// Hardware class.
    pub hardware_class: String,
    /// Version of the program that measured.
    pub version: String,
    /// Version of the oracle; absent in runs of older versions.
    pub oracle: Option<u32>,
    /// SHA-256 (hex) of the plugin file.
    pub plugin_sha256: String,
    /// How it ended.
    pub outcome: OutcomeName,
    /// Configurations measured.
    pub n: u32,
    /// Wrong answers.
    pub wrong: u32,
    /// Median time per query, nanoseconds; absent when nothing was measured.
    pub median_ns: Option<Estimated>,
}
