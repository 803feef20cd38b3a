//! What was measured of one algorithm in a run.

use ocb_core::comparison::Interval;
use ocb_core::resolution::Resolution;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::agreement::{Agreement, ContactQuality};
use crate::by_unit::{InUnit, UnitDependence};
use crate::contract::ContractClass;
use crate::outcome::OutcomeInfo;
use crate::plugin::BuildInfo;
use crate::timing::Timing;
use crate::unranked::{Controls, Unranked};

/// Numbers of one algorithm on the run's configurations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct AlgorithmResult {
    /// Algorithm id.
    pub algorithm: String,
    /// Display name.
    pub name: String,
    /// How its code was compiled; empty in runs of older versions.
    #[serde(default)]
    pub builds: Vec<BuildInfo>,
    /// How its runner ended.
    pub outcome: OutcomeInfo,
    /// Configurations measured.
    pub n: u32,
    /// Configurations in the set.
    pub of: u32,
    /// Stopped by the time budget before the whole set.
    pub budget_limited: bool,
    /// Time per query in the unit of the files; absent when nothing was measured.
    pub time: Option<TimeSummary>,
    /// Against the reference algorithm: geometric mean of the ratios of the times of the same configuration, with its 95 %
    /// interval over the processes; below 1 is faster.
    #[serde(default)]
    pub ratio: Option<Estimated>,
    /// What it had to deliver for its time; absent in runs of older versions.
    #[serde(default)]
    pub class: Option<ContractClass>,
    /// Rank by `ratio` within its class, from 1; algorithms whose intervals overlap are tied. Absent for what failed, gave a
    /// wrong answer, was measured in the development profile, or for what `unranked` says.
    #[serde(default)]
    pub rank: Option<u32>,
    /// Why there is no rank, where neither the outcome nor the verdicts show it.
    #[serde(default)]
    pub unranked: Option<Unranked>,
    /// What became of the control questions; absent in runs of older versions.
    #[serde(default)]
    pub controls: Option<Controls>,
    /// How the passes went, and what the integrity checks found; absent in runs of older versions.
    #[serde(default)]
    pub timing: Option<Timing>,
    /// All answers by verdict (`correct`, `false_negative`, `gave_up`, ...); those that do not occur are left out.
    pub verdicts: Vec<VerdictCount>,
    /// It got the objects' coordinates rounded to single precision, in which it computes, and was judged by the truth about
    /// these; the others got the numbers of the files.
    #[serde(default)]
    pub rounded: bool,
    /// Configurations answered wrongly at least once, in any unit. Giving up and not supporting the question are not wrong.
    pub wrong: u32,
    /// Time and answers in each unit of length, the unit of the files first; empty in runs of older versions.
    #[serde(default)]
    pub by_unit: Vec<InUnit>,
    /// Present when its time or its answers depend on the unit of length.
    #[serde(default)]
    pub depends_on_unit: Option<UnitDependence>,
    /// The answers that are not scored, because the configuration is narrower than the precision of the algorithm.
    #[serde(default)]
    pub grazing: Agreement,
    /// eps*: how finely it tells apart from colliding. Absent in runs of older versions.
    #[serde(default)]
    pub resolution: Option<Resolution>,
    /// Of lists of all contacts.
    #[serde(default)]
    pub contacts: Option<ContactQuality>,
    /// Mean BV tests per query.
    pub bv_tests_mean: Option<f64>,
    /// Mean primitive tests per query.
    pub primitive_tests_mean: Option<f64>,
    /// Time to build both structures, milliseconds, from the moment on at which the meshes could be seen: median over the
    /// processes. What a process built while it was asked is part of it.
    pub build_ms: Option<f64>,
    /// Time to load the plugin's file, with all that it does before it sees a mesh, milliseconds: median over the processes.
    #[serde(default)]
    pub load_ms: Option<f64>,
    /// Peak memory of the runner above its baseline, bytes.
    pub memory_bytes: Option<u64>,
    /// The run is still being measured and this will change: it comes from the answers so far, and has no rank.
    #[serde(default)]
    #[schema(required = true)]
    pub preliminary: bool,
    /// While it is preliminary: the place that it would have if the run ended now. The end may give it another, or none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place_so_far: Option<u32>,
}

impl AlgorithmResult {
    /// A control question was answered wrongly.
    pub fn guessed(&self) -> bool {
        self.controls.is_some_and(|controls| controls.wrong > 0)
    }
}

/// Count of one verdict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct VerdictCount {
    /// The verdict.
    pub verdict: ocb_core::record::Verdict,
    /// How many.
    pub count: u32,
}

/// A statistic with its 95 % bootstrap interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Estimated {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

impl From<Interval> for Estimated {
    fn from(Interval { value, lo, hi }: Interval) -> Self {
        Estimated { value, lo, hi }
    }
}

/// Distribution of the time per query over configurations, nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TimeSummary {
    /// Arithmetic mean. Its interval and the following two are over the processes; over the configurations, too, where there is
    /// one process only or not every configuration was measured.
    pub mean_ns: Estimated,
    /// Median.
    pub median_ns: Estimated,
    /// 95th percentile.
    pub p95_ns: Estimated,
    /// Maximum; its interval is over the configurations.
    pub max_ns: Estimated,
    /// How many lie below the clock's resolution.
    pub below_resolution: u32,
}
