//! Control questions, and why an algorithm that ran to its end has no rank all the same.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// What an algorithm made of the control questions: questions like the set's, drawn from the run's seed and mixed into its
/// order, so that the set's answer cannot be guessed. They are in no record, time or count of verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Controls {
    /// Answered.
    pub n: u32,
    /// Drawn for the run.
    pub of: u32,
    /// Of the answered, those that collide.
    pub crossing: u32,
    /// Answered wrongly in at least one process.
    pub wrong: u32,
    /// Not answered although asked.
    pub silent: u32,
    /// Probability, at most, that a plugin that guesses half of its answers gives no wrong one to these.
    pub guess: f64,
}

/// Why an algorithm has no rank although it failed nowhere else.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Unranked {
    /// What happened.
    #[serde(flatten)]
    pub cause: UnrankedCause,
    /// The same as one sentence.
    pub message: String,
}

/// What takes a rank away.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case", tag = "cause")]
pub enum UnrankedCause {
    /// Control questions were answered wrongly.
    WrongControls {
        /// So many.
        wrong: u32,
        /// Of these.
        n: u32,
    },
    /// Control questions were left without an answer.
    SilentControls {
        /// So many.
        silent: u32,
        /// Of these.
        n: u32,
    },
    /// The budget, or the objects, allowed too few control questions.
    FewControls {
        /// Answered.
        n: u32,
        /// Drawn.
        of: u32,
        /// Needed.
        least: u32,
    },
    /// It waited for its CPU far more than the reference algorithm in the same rounds. Nobody is accused: something else on the
    /// machine may have met its processes alone.
    KeptWaiting {
        /// Share of its processes' time, the median over them.
        share: f64,
        /// The same of the reference algorithm, over all its processes.
        reference: f64,
    },
}

impl From<UnrankedCause> for Unranked {
    fn from(cause: UnrankedCause) -> Self {
        Self { message: cause.sentence(), cause }
    }
}

impl UnrankedCause {
    fn sentence(&self) -> String {
        match *self {
            Self::WrongControls { wrong, n } => format!("{wrong} of {n} control questions were answered wrongly."),
            Self::SilentControls { silent, n } => format!("It did not answer {silent} of {n} control questions."),
            Self::FewControls { of, least, .. } if of < least => {
                format!("Only {of} control questions could be generated for these objects, and a rank needs {least}.")
            }
            Self::FewControls { n, least, .. } => format!(
                "Only {n} control questions were answered within the time budget, and a rank needs {least}; increase \
                 the budget."
            ),
            Self::KeptWaiting { share, reference } => format!(
                "Its processes waited for their CPU for {:.0} % of the time, those of the reference algorithm for \
                 {:.1} %, so the correction of its times is too large; measure it again.",
                100.0 * share,
                100.0 * reference
            ),
        }
    }
}
