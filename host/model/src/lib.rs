//! The values of API and store: the JSON of the API and of `--json`; there is no second set, which would have to be kept equal
//! by hand. No I/O.
//!
//! Ids are UUIDv7 text, times are microseconds since the Unix epoch (UTC), durations say their unit in their name.
#![forbid(unsafe_code)]

mod advice;
mod agreement;
mod board;
mod by_unit;
mod campaign;
mod chart;
mod choices;
mod citation;
mod contract;
mod deletion;
mod environment;
mod errand;
mod estimate;
mod example;
mod heatmap;
mod invitation;
mod machine;
mod notice;
mod object;
mod object_id;
mod outcome;
mod owned;
mod owner;
mod page;
mod people;
mod plugin;
mod preview;
mod reduction;
mod replay;
mod result;
mod saved;
mod selecting;
mod stability;
mod stability_run;
mod submitted;
mod suite;
mod timing;
mod truth;
mod unranked;
mod visibility;
mod workload;
mod workload_job;

use ocb_core::configuration::{Class, Method, Sampling, Separation};
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

pub use advice::{AdviceInfo, AdviceSpec, Asked};
pub use agreement::{Agreement, ContactQuality};
pub use board::{Accuracy, Board, BoardFilter, BoardOption, BoardRequest, BoardRow, StabilityPassed};
pub use by_unit::{InUnit, UnitDependence};
pub use campaign::{CampaignInfo, CampaignPreview, CampaignRequest, CampaignRuns, Compared, ComparedResult};
pub use chart::{ChartKind, ChartRequest};
pub use choices::{Choices, NewAddress, NewChoices, OpenedLink};
pub use citation::Citation;
pub use contract::{ContractClass, Delivered, Order};
pub use deletion::{DeleteAccount, DeletionPreview, OwnedCounts};
pub use environment::Environment;
pub use errand::{Errand, Wanted};
pub use estimate::{AlgorithmSeconds, Estimate};
pub use example::{Example, ExampleInfo, ExampleWork};
pub use heatmap::{Ecdf, Heatmap, HeatmapRequest, Measure, Side, VertexValue};
pub use invitation::{Acceptance, InvitationInfo, InvitationRequest, InvitationState, NewInvitation};
pub use machine::{
    Beat, ClassStatus, Ended, GoOn, MachineFacts, MachineInfo, MachineState, MachineStatus, MeasuredAlgorithm,
    NextWork, OrderedAlgorithm, Sentinel, Told, WorkOrder,
};
pub use notice::NoticeInfo;
pub use object::{ObjectInfo, Rounding};
pub use object_id::{ObjectId, stock_id};
pub use outcome::{OutcomeInfo, OutcomeName};
pub use owned::{OwnedItem, OwnedItems};
pub use owner::Owner;
pub use page::{BadPage, Cursor, Page, Part};
pub use people::{
    AccountInfo, AuditEntry, Credentials, DeveloperRequest, Identity, NewPassword, NewRole, NewToken, Role, Scope,
    SigningKey, TokenInfo, TokenRequest,
};
pub use plugin::{AlgorithmInfo, BuildInfo, CheckLine, CheckVerdict, ParameterInfo, PluginReport, Repro};
pub use preview::{Beside, Preview};
pub use reduction::{
    BodyKind, ChangedAnswer, FRONTIER, LaterQueries, ReduceTerms, ReducedObject, ReducedScene, ReducedSpeed, Reduction,
    frontier,
};
pub use replay::{Difference, Recipe, RecipeAlgorithm, RecipeFile, RecipeObject, RecipeVersions, Replay, Replayed};
pub use result::{AlgorithmResult, Estimated, TimeSummary, VerdictCount};
pub use saved::SavedConfigurations;
pub use selecting::{Claim, Meeting, Selected, SelectedOf, WorstBy, WorstCase, WorstRequest};
pub use stability::{
    CellState, FailingCase, FailureInfo, FailureResult, FamilyInfo, FamilyResult, HarderWhen, RelationInfo,
    RelationResult, RelationStep, SearchResult, Stability, StabilityTable, StepResult, Tally, TessellationResult,
    ThresholdInfo, Timed,
};
pub use stability_run::{StabilityRunInfo, StabilitySpec};
pub use submitted::{Action, Decision, Manifest, PluginInfo, PluginState};
pub use suite::{BoardSuite, SuiteInfo, SuiteProgress};
pub use timing::{Draw, Reference, Timing, TimingCheck};
pub use truth::{ContactRow, TruthRow};
pub use unranked::{Controls, Unranked, UnrankedCause};
pub use visibility::{NewVisibility, Visibility};
pub use workload::{
    AlgorithmOnWorkload, ClaimCount, EndedPair, FalseAnswer, GroupTimes, LeftOut, ObjectHeatmap, ObjectHeatmapRequest,
    ObjectMeasure, OrderGain, PairTime, PosedScene, RecordedAnswers, ScenePair, TotalTime, Track, TrackResult,
    WorkloadObject, WorkloadResult, order_gains,
};
pub use workload_job::{
    AlgorithmOnStretch, PosedGroup, PosedObject, RecordingInfo, Stretch, StretchResult, Timeline, TimelineSeries,
    WhichGroup, WorkloadInfo, WorkloadSpec,
};

/// What to measure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct RunSpec {
    /// Object A (fixed).
    pub object_a: String,
    /// Object B (moving); the same object when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub object_b: Option<String>,
    /// The question.
    pub query: Query,
    /// What counts as an object: surfaces, or solid bodies, which need closed objects and an algorithm that knows them.
    #[serde(default)]
    pub semantics: Semantics,
    /// How the configurations are found.
    pub method: Method,
    /// How far apart the objects are placed, or how deep in each other; only the sphere and the grid method use it.
    #[serde(default = "no_distance")]
    #[schema(required = false)]
    pub separation: Separation,
    /// Algorithm ids, each with its settings behind it (`box-tree:leaf_size=4`); the usual ones that answer the question when
    /// empty, every one that does for `["all"]`.
    #[serde(default)]
    pub algorithms: Vec<String>,
    /// Fresh processes that see the unit of the files, with one timed pass over the configurations each (1 to 99). Two more
    /// share the configurations in a smaller unit, and two in a larger one.
    #[serde(default = "default_passes")]
    pub passes: u32,
    /// Measuring time allowed per algorithm; a slower one is measured on as many configurations (taken in a shuffled
    /// order that all algorithms share) as fit. Other units and counters are not part of it; each may take as long as two passes.
    #[serde(default = "default_budget")]
    pub budget_seconds: f64,
    /// Seed of everything that is drawn while measuring (order, equivalent instances, blocks), below 2^53; to repeat a
    /// run. Drawn for every run when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Stop as soon as the algorithms are told apart, where differences below this share do not matter (0.05: 5 %). All
    /// configurations are measured when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub precision: Option<f64>,
    /// A quick look: measure at most so many configurations, evenly spread over all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<u32>,
    /// Measure on a machine of this hardware class; of the service's usual one when absent. `/api/v1/status` lists them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardware_class: Option<String>,
}

impl RunSpec {
    /// May it end before all configurations are measured?
    pub fn is_partial(&self) -> bool {
        self.precision.is_some() || self.at_most.is_some()
    }

    /// The method with which configurations are found. Every prefix of a low-discrepancy sequence is evenly spread, so of
    /// one a quick look needs the beginning only; of the others it needs all to choose from.
    pub fn finding(&self) -> Method {
        let few = self.at_most.map(u64::from).filter(|few| sampling::count(&self.method).is_ok_and(|all| *few < all));
        match (&self.method, few) {
            (Method::Sphere { sampling: Sampling::Count { .. } | Sampling::Steps { .. }, seed }, Some(few)) => {
                Method::Sphere { sampling: Sampling::Count { count: few as u32 }, seed: *seed }
            }
            (Method::Random { hit_share, seed, .. }, Some(few)) => {
                Method::Random { count: few as u32, hit_share: *hit_share, seed: *seed }
            }
            (all, _) => all.clone(),
        }
    }

    /// How far apart or how deep the configurations are; `None` where the method does not ask.
    pub fn separation(&self) -> Option<Separation> {
        match self.method {
            Method::Trajectory { .. } | Method::Random { .. } | Method::File { .. } => None,
            Method::Sphere { .. } | Method::Grid { .. } => Some(self.separation),
        }
    }
}

fn no_distance() -> Separation {
    Separation::Relative { distance: 0.0 }
}

fn default_passes() -> u32 {
    5
}

fn default_budget() -> f64 {
    60.0
}

/// State of a run or of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// Waiting.
    Queued,
    /// At work.
    Running,
    /// Finished.
    Done,
    /// Ended by a fault; the reason is in `message`.
    Failed,
    /// Ended by its owner.
    Cancelled,
}

/// A run with everything a page needs to show it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunInfo {
    /// Id (UUIDv7).
    pub id: String,
    /// What was asked, with defaults filled in.
    pub spec: RunSpec,
    /// Name of object A.
    pub object_a_name: String,
    /// Name of object B.
    pub object_b_name: String,
    /// State.
    pub state: State,
    /// Why it failed, one sentence.
    pub message: Option<String>,
    /// Runs ahead, while queued.
    pub runs_ahead: u32,
    /// The stages, in order: object, configurations, one measuring stage per algorithm, heatmap.
    pub stages: Vec<Stage>,
    /// Summary per algorithm, as far as there is one.
    pub results: Vec<AlgorithmResult>,
    /// What the results are a preview of; absent when all configurations were measured.
    #[serde(default)]
    pub preview: Option<Preview>,
    /// The configuration set, once known.
    pub set: Option<SetInfo>,
    /// The machine, once measured.
    pub environment: Option<Environment>,
    /// SHA-256 of the secret that the seed is drawn from, published before anything is measured; absent when the seed was
    /// given.
    #[serde(default)]
    pub commitment: Option<String>,
    /// Times this run was started (more than 1 after a restart of the service).
    pub attempts: u32,
    /// The campaign that it belongs to.
    #[serde(default)]
    pub campaign: Option<String>,
    /// The run that it repeats in that campaign.
    #[serde(default)]
    pub rerun_of: Option<String>,
    /// Made by the caller, who may cancel it and decides who sees it.
    pub mine: bool,
    /// Who sees it: what its owner decided, and no more than see its objects.
    #[serde(default)]
    #[schema(required = true)]
    pub visibility: Visibility,
    /// When it was asked for.
    pub created_us: i64,
    /// When it ended.
    pub finished_us: Option<i64>,
    /// Expected seconds until its end, from what it has measured so far; known while it is running.
    #[serde(default)]
    pub seconds_left: Option<f64>,
}

/// Which stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum StageKind {
    /// Reading the object(s).
    Object,
    /// Finding and certifying configurations.
    Configurations,
    /// Measuring one algorithm.
    Measuring,
    /// Aggregating onto the vertices.
    Heatmap,
}

/// One stage of the live page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Stage {
    /// Which stage.
    pub kind: StageKind,
    /// The algorithm, for measuring stages.
    pub algorithm: Option<String>,
    /// State.
    pub state: State,
    /// Items done (configurations, queries).
    pub done: u64,
    /// Items in all (0: unknown yet).
    pub total: u64,
    /// Items per second lately.
    pub rate: f64,
    /// Expected seconds left, when known.
    pub seconds_left: Option<f64>,
    /// Note or cause, one sentence.
    pub message: Option<String>,
}

/// The configuration set of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SetInfo {
    /// SHA-256 (hex) of the stored set.
    pub sha256: String,
    /// Configurations.
    pub configurations: u32,
    /// Rays on which no position was found.
    pub missed_rays: u32,
    /// L, the longest side of A's bounding box.
    pub longest_side: f64,
    /// How many are of which class in f64.
    pub classes: Vec<ClassCount>,
    /// Configurations whose truth needed exact arithmetic.
    #[serde(default)]
    pub exact: u32,
    /// Positions that no ray from outside toward A's centre meets first.
    #[serde(default)]
    pub further_roots: u32,
    /// Share of A's triangles that are a closest feature at least once.
    pub coverage_a: f64,
    /// The same of B.
    pub coverage_b: f64,
    /// How evenly: entropy of the closest features over A's triangles, divided by its maximum (1: all equally often).
    #[serde(default)]
    pub evenness_a: f64,
    /// The same of B.
    #[serde(default)]
    pub evenness_b: f64,
    /// Distance between the nodes of the grid method.
    #[serde(default)]
    pub spacing: Option<f64>,
    /// Side of the cube of random placement.
    #[serde(default)]
    pub box_side: Option<f64>,
    /// Version of the oracle that certified it; absent in sets of older versions.
    #[serde(default)]
    pub oracle: Option<u32>,
    /// What rounding the coordinates to single precision changes; absent where it changes no coordinate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounding: Option<RoundingEffect>,
}

/// How the truths about the objects of the files differ from those about the same objects with coordinates rounded to single
/// precision. Algorithms in single precision get the latter and are judged by their truths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RoundingEffect {
    /// Configurations with the other answer to whether the surfaces meet.
    pub other_answers: u32,
    /// Largest change of a distance, over the configurations that are apart either way.
    pub largest_change: f64,
}

/// How many configurations are of a class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ClassCount {
    /// The class.
    pub class: Class,
    /// How many.
    pub count: u32,
}

/// Something that happened in a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RunEvent {
    /// Position in the run's log, from 1; the `id:` of the event stream.
    pub seq: i64,
    /// When.
    pub at_us: i64,
    /// The run's state after it.
    pub state: State,
    /// Runs ahead, while queued.
    pub runs_ahead: u32,
    /// The stage that changed, as it is now.
    pub stage: Option<Stage>,
    /// The algorithm's summary, when it has just been finished, or when there is a newer one that is preliminary.
    pub result: Option<AlgorithmResult>,
    /// Expected seconds until the run's end, from what it has measured so far; known while it is running.
    #[serde(default)]
    pub seconds_left: Option<f64>,
}

/// The service at a glance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Status {
    /// Version of this program.
    pub version: String,
    /// Hardware class on which runs are measured that name none.
    pub hardware_class: String,
    /// All hardware classes on which runs are measured, this one first.
    pub classes: Vec<ClassStatus>,
    /// Runs under way.
    pub running: u32,
    /// Runs that wait.
    pub queued: u32,
    /// Seconds that the oldest waiting run has waited; 0 when none waits.
    pub oldest_seconds: f64,
    /// Seconds that the waiting runs are expected to take, one after the other.
    pub expected_seconds: f64,
    /// The service also measures what nobody asked for, first of all a heatmap for the start page.
    pub idle_work: bool,
    /// Other machines measure the runs of this service.
    pub elsewhere: bool,
    /// These machines, by name.
    pub machines: Vec<MachineStatus>,
    /// Algorithms offered.
    pub algorithms: u32,
    /// What keeps something from being offered, e.g. a plugin that does not load; one sentence each.
    pub problems: Vec<String>,
}
