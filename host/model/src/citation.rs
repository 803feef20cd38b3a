//! How something here is cited.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// The stable link of a run or a plugin, and how it is cited.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Citation {
    /// Where it is found as long as it is kept.
    #[schema(example = "https://bench.example/r/0193f1a0-0000-7000-8000-000000000000")]
    pub link: String,
    /// An entry for BibTeX.
    pub bibtex: String,
    /// A CITATION.cff, version 1.2.0.
    pub cff: String,
}
