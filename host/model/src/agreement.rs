//! How far the answers that are not scored agree with exact arithmetic, and how good lists of contacts are.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// How many of some answers agree with exact arithmetic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Agreement {
    /// Answers.
    pub n: u32,
    /// Those that say what exact arithmetic says.
    pub agree: u32,
}

/// Lists of contacts against the complete ones, all configurations together. Pairs within the precision band are free.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ContactQuality {
    /// Share of the listed pairs that meet or are within tau of it; absent when nothing was listed.
    pub precision: Option<f64>,
    /// Pairs listed.
    pub listed: u64,
    /// Share of the pairs crossing by more than tau that were listed, over the lists that fit the host's buffer; absent
    /// when there is no such pair.
    pub recall: Option<f64>,
    /// Such pairs.
    pub robust: u64,
}
