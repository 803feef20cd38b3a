//! What readers of all formats share: one set of limits, and one sentence for a file that is refused.

pub mod fault;
pub mod limits;
pub(super) mod lines;
pub(super) mod polygon;
pub(super) mod surface;
pub(super) mod words;

pub use fault::Fault;
