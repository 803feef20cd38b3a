//! Where methods fail: one method's results over all families, relations and reported failures.

use ocb_core::query::Query;
use ocb_stability::Harder;
use ocb_stability::sweep::Threshold;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Everything known, and what it means.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StabilityTable {
    /// The families, in the order of the tables.
    pub families: Vec<FamilyInfo>,
    /// The relations, in the order of the tables.
    pub relations: Vec<RelationInfo>,
    /// The reported failures.
    pub failures: Vec<FailureInfo>,
    /// One entry per method that was tried, by id.
    pub methods: Vec<Stability>,
}

/// A family of hard questions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FamilyInfo {
    /// Short name, as on the command line.
    pub id: String,
    /// Name.
    pub name: String,
    /// What it tests.
    pub sentence: String,
    /// Where such failures were seen.
    pub source: String,
    /// What is swept, with its unit.
    pub parameter: String,
    /// Between two steps the threshold is narrowed by bisection.
    pub continuous: bool,
    /// In which direction of the parameter it gets harder.
    pub harder: HarderWhen,
    /// It asks for more than the interface promises to plugins: wrong answers are shown and are no fault.
    pub beyond: bool,
}

/// Which values of a parameter are harder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum HarderWhen {
    /// Large ones.
    Large,
    /// Small ones.
    Small,
    /// Those far from 0.
    Far,
}

impl From<Harder> for HarderWhen {
    fn from(harder: Harder) -> Self {
        match harder {
            Harder::Up => Self::Large,
            Harder::Down => Self::Small,
            Harder::Outward => Self::Far,
        }
    }
}

/// A relation between answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RelationInfo {
    /// Short name.
    pub id: String,
    /// Name.
    pub name: String,
    /// What must hold.
    pub sentence: String,
}

/// A failure that somebody reported.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FailureInfo {
    /// Short name.
    pub id: String,
    /// Where it was reported.
    pub source: String,
    /// Address of the report.
    pub url: String,
    /// What was seen there.
    pub seen: String,
    /// The numbers are the report's own, and not made after its description.
    pub numbers_reported: bool,
}

/// One method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Stability {
    /// The algorithm with its settings.
    pub algorithm: String,
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// SHA-256 of the plugin file.
    pub plugin_sha256: String,
    /// It computes in f32 and is judged in the wider band.
    pub single_precision: bool,
    /// Seeds per value of a parameter.
    pub seeds: u32,
    /// When, microseconds since the epoch.
    pub created_us: i64,
    /// Everything that was asked for was asked; false when the time ran out.
    pub complete: bool,
    /// By family.
    pub families: Vec<FamilyResult>,
    /// By relation.
    pub relations: Vec<RelationResult>,
    /// By reported failure.
    pub failures: Vec<FailureResult>,
    /// The same surfaces cut into other triangles.
    pub tessellations: Vec<TessellationResult>,
    /// The adversarial search.
    pub search: Option<SearchResult>,
    /// The powers of two between which another unit of length changes no answer; absent when not even the smallest tried
    /// on either side leaves it.
    pub unit_safe: Option<[i32; 2]>,
    /// The farthest offset from the origin up to which nothing is wrong; absent when none is.
    pub offset_safe: Option<f64>,
}

/// How a cell of the table looks: the gravest of what is in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum CellState {
    /// Every answer that can be judged is right.
    Agrees,
    /// Some answer took more than ten times the median on objects of this size.
    Slow,
    /// Some answer is wrong.
    Wrong,
    /// Some question ended the process, was not answered in time, or answered with no number.
    Broken,
    /// The method does not answer such questions.
    Unsupported,
    /// The host refuses such objects, so that no method sees them.
    Refused,
}

/// Counts of answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Tally {
    /// Right, as far as can be judged.
    pub agrees: u32,
    /// Of those: within rounding of the other answer, where either is allowed.
    pub grazing: u32,
    /// Missed collisions.
    pub misses: u32,
    /// False alarms.
    pub false_alarms: u32,
    /// Wrong distances, nearest points or pairs.
    pub distances: u32,
    /// Another answer than to the same question before.
    pub unsteady: u32,
    /// Crash, hang, or no number.
    pub broken: u32,
    /// More than ten times the median time.
    pub slow: u32,
    /// Not answered: not offered, or given up.
    pub unsupported: u32,
    /// Refused by the host.
    pub refused: u32,
}

impl Tally {
    /// Wrong answers of every kind.
    pub fn wrong(&self) -> u32 {
        self.misses + self.false_alarms + self.distances + self.unsteady
    }

    /// Questions that were asked.
    pub fn asked(&self) -> u32 {
        self.agrees + self.wrong() + self.broken + self.unsupported
    }

    /// Something must be mended.
    pub fn failed(&self) -> bool {
        self.wrong() + self.broken > 0
    }

    /// The gravest of all.
    pub fn state(&self) -> CellState {
        match self {
            t if t.broken > 0 => CellState::Broken,
            t if t.wrong() > 0 => CellState::Wrong,
            t if t.slow > 0 => CellState::Slow,
            t if t.agrees > 0 => CellState::Agrees,
            t if t.unsupported > 0 => CellState::Unsupported,
            _ => CellState::Refused,
        }
    }

    /// Both together.
    pub fn add(&mut self, other: &Self) {
        self.agrees += other.agrees;
        self.grazing += other.grazing;
        self.misses += other.misses;
        self.false_alarms += other.false_alarms;
        self.distances += other.distances;
        self.unsteady += other.unsteady;
        self.broken += other.broken;
        self.slow += other.slow;
        self.unsupported += other.unsupported;
        self.refused += other.refused;
    }
}

/// One method on one family.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FamilyResult {
    /// The family.
    pub family: String,
    /// The gravest of what was seen.
    pub state: CellState,
    /// All steps together.
    pub tally: Tally,
    /// Step by step, ascending.
    pub steps: Vec<StepResult>,
    /// Where it starts to fail: one for each side on which it does.
    pub thresholds: Vec<ThresholdInfo>,
    /// The first failing question, made as small as it still fails.
    pub first: Option<FailingCase>,
}

/// Between what holds and what fails.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ThresholdInfo {
    /// The last value at which nothing fails; absent when the easiest fails already.
    pub holds: Option<f64>,
    /// The first value at which something fails.
    pub fails: f64,
}

impl From<Threshold> for ThresholdInfo {
    fn from(Threshold { holds, fails }: Threshold) -> Self {
        Self { holds, fails }
    }
}

/// One value of the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StepResult {
    /// The value.
    pub at: f64,
    /// What was seen.
    pub tally: Tally,
    /// What its collision queries took (first contact); absent when none was answered, and in results of older versions.
    #[serde(default)]
    pub collision: Option<Timed>,
    /// What its distance queries took.
    #[serde(default)]
    pub distance: Option<Timed>,
}

/// Times of several queries, measured from outside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Timed {
    /// Queries.
    pub n: u32,
    /// Their median, nanoseconds.
    pub median_ns: f64,
}

/// One method on one relation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RelationResult {
    /// The relation.
    pub relation: String,
    /// How often it was tried.
    pub tried: u32,
    /// Decisions that differ.
    pub decisions: u32,
    /// Distances that differ.
    pub distances: u32,
    /// Decisions that differ within rounding of the other one, where they may.
    pub grazing: u32,
    /// By the amount of what was changed.
    pub steps: Vec<RelationStep>,
    /// The first question between whose answers it does not hold.
    pub first: Option<FailingCase>,
}

/// One amount of a relation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct RelationStep {
    /// The amount, 0 when there is none.
    pub at: f64,
    /// How often it was tried.
    pub tried: u32,
    /// Decisions that differ.
    pub decisions: u32,
    /// Distances that differ.
    pub distances: u32,
}

/// One method on one reported failure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FailureResult {
    /// The reported failure.
    pub id: String,
    /// How it went.
    pub state: CellState,
    /// What is true.
    pub expected: String,
    /// What was answered.
    pub got: String,
}

/// One method on one cutting of a surface into triangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TessellationResult {
    /// The surface.
    pub object: String,
    /// How it is cut.
    pub cut: String,
    /// Triangles of each object.
    pub triangles: u32,
    /// The question.
    pub query: Query,
    /// Questions that were answered.
    pub n: u32,
    /// Median time, nanoseconds.
    pub median_ns: f64,
    /// The median, over the same questions, of this time divided by that for the original.
    pub ratio: f64,
    /// Decisions that differ from those for the original.
    pub decisions: u32,
    /// The largest difference of a distance from that for the original, in lengths of the object.
    pub distance: f64,
    /// Answers that are wrong for the surface as it is cut.
    pub wrong: u32,
}

/// The search from anywhere toward failures and long times, beside as many uniform questions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SearchResult {
    /// Questions allowed to each.
    pub most: u32,
    /// The number of the first wrong answer of the search; absent when there was none.
    pub climbing: Option<u32>,
    /// The same for uniform questions.
    pub uniform: Option<u32>,
    /// The longest time that the search found, nanoseconds.
    pub costliest_climbing_ns: f64,
    /// The longest time of as many uniform questions.
    pub costliest_uniform_ns: f64,
    /// The wrong answer that the search found.
    pub first: Option<FailingCase>,
}

/// A question that fails, complete.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FailingCase {
    /// The value of the parameter.
    pub at: f64,
    /// The seed.
    pub seed: u32,
    /// What is true.
    pub expected: String,
    /// What was answered.
    pub got: String,
    /// Triangles of A and B before they were made fewer.
    pub triangles_before: [u32; 2],
    /// Triangles of A and B now.
    pub triangles: [u32; 2],
    /// Object A as OBJ.
    pub a: String,
    /// Object B as OBJ.
    pub b: String,
    /// Pose of A, row-major 4x4; NaN and infinity as words.
    pub pose_a: Vec<String>,
    /// Pose of B.
    pub pose_b: Vec<String>,
    /// The command line that asks it again.
    pub command: String,
}
