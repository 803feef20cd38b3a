//! Repro archives: a run with all that its answers follow from, as one file that can be asked again anywhere.
//!
//! Every recorded answer says as which equivalent instance its question was put, and instances follow from the seed. So the
//! same question can be put to the same file in a fresh jail, and the answer must come back bit for bit. Control questions are no
//! records: they are not in the archive and not put again. An algorithm that
//! keeps something from one question to the next may answer otherwise: it meets the questions in another order.

mod again;
mod pack;
mod unpack;

pub use again::Questions;
pub use pack::Packing;
pub use unpack::Unpacked;

/// Version of the archive's format.
const FORMAT: u32 = 2;
/// The file that lists all others.
const RECIPE: &str = "recipe.json";
