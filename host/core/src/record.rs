//! One algorithm on one configuration.

use serde::{Deserialize, Serialize};

use crate::instance::AskedAs;
use crate::query::{Answer, Counters};

/// A list of contacts compared with the complete one; pairs within the precision band are free either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactScore {
    /// Pairs in the answer, as many as the host's buffer took.
    pub listed: u64,
    /// Those of them that meet, or are within tau of it.
    pub genuine: u64,
    /// Pairs of the truth that cross by more than tau.
    pub robust: u64,
    /// Those of them in the answer; absent when the list was longer than the host's buffer.
    pub found: Option<u64>,
}

impl ContactScore {
    /// Share of the listed pairs that are contacts; absent when nothing was listed.
    pub fn precision(&self) -> Option<f64> {
        (self.listed > 0).then(|| self.genuine as f64 / self.listed as f64)
    }

    /// Share of the robust pairs that were listed; absent when there is none, or the list was cut.
    pub fn recall(&self) -> Option<f64> {
        self.found.filter(|_| self.robust > 0).map(|found| found as f64 / self.robust as f64)
    }
}

/// The comparison of one answer with the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Agrees with the truth.
    Correct,
    /// A missed collision: the worst error.
    FalseNegative,
    /// Says hit where there is none.
    FalsePositive,
    /// Distance above the truth by more than tau.
    DistanceOver,
    /// Distance below the truth by more than tau.
    DistanceUnder,
    /// Witness points or triangles do not realise the claimed answer.
    WrongWitness,
    /// Not a number, negative, or a triangle id out of range.
    Invalid,
    /// Inside the declared precision band, the answer agrees with exact arithmetic or not; not scored.
    Undecidable,
    /// The algorithm said that it could not decide.
    GaveUp,
    /// The algorithm does not answer this query.
    Unsupported,
}

impl Verdict {
    /// Counts as a wrong answer.
    pub fn is_wrong(self) -> bool {
        use Verdict::*;
        matches!(self, FalseNegative | FalsePositive | DistanceOver | DistanceUnder | WrongWitness | Invalid)
    }

    /// No answer was given: neither right nor wrong.
    pub fn is_silent(self) -> bool {
        matches!(self, Self::GaveUp | Self::Unsupported)
    }

    /// Which of several verdicts on the same configuration stands for it: the graver one.
    pub fn gravity(self) -> u8 {
        match self {
            Self::Correct => 0,
            Self::Undecidable => 1,
            Self::Unsupported => 2,
            Self::GaveUp => 3,
            wrong => 4 + u8::from(wrong == Self::FalseNegative),
        }
    }

    /// Every verdict with its name in files, in the order of their declaration.
    pub const NAMES: [(Self, &'static str); 10] = [
        (Self::Correct, "correct"),
        (Self::FalseNegative, "false_negative"),
        (Self::FalsePositive, "false_positive"),
        (Self::DistanceOver, "distance_over"),
        (Self::DistanceUnder, "distance_under"),
        (Self::WrongWitness, "wrong_witness"),
        (Self::Invalid, "invalid"),
        (Self::Undecidable, "undecidable"),
        (Self::GaveUp, "gave_up"),
        (Self::Unsupported, "unsupported"),
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].1
    }

    /// The verdict of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.into_iter().find(|(_, known)| *known == name).map(|(verdict, _)| verdict)
    }
}

/// In how many primitive tests each triangle took part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TriangleTests {
    /// The counted queries.
    pub queries: u32,
    /// One number per triangle of A, and of B, over all of them.
    pub tests: [Vec<u32>; 2],
}

/// One algorithm on one configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Index of the configuration in its set.
    pub configuration: u32,
    /// Time of the query in nanoseconds by the supervisor's clock, null round trip subtracted; the median over passes.
    pub time_ns: f64,
    /// Whether that time lies below the clock's resolution (then `time_ns` is the resolution, an upper bound).
    pub below_resolution: bool,
    /// How many passes the time is the median of.
    pub passes: u32,
    /// Counters from the separate untimed pass, when the algorithm has them.
    pub counters: Option<Counters>,
    /// The answer of the first pass, or of the first with a graver verdict.
    pub answer: Answer,
    /// As what the question was put that `answer` answers.
    pub asked: AskedAs,
    /// Its comparison with the truth.
    pub verdict: Verdict,
    /// For a list of contacts.
    pub contacts: Option<ContactScore>,
    /// How many of its answers to equivalent instances contradict the first one.
    pub flips: u32,
}
