//! Files that other programs read. Vertex and triangle order is always the mesh's own.

pub mod glb;
pub mod ply;

use crate::colormap::{Colormap, Scale};

/// What a coloured file says about its colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Id of the run.
    pub run: String,
    /// Algorithm id; empty for density.
    pub algorithm: String,
    /// What was subtracted: an algorithm, or one of another run (`run/algorithm`); the values are differences then.
    pub against: Option<String>,
    /// The selection of configurations that went in; all of them when absent.
    pub selection: Option<String>,
    /// Name of the measure, e.g. `time`.
    pub measure: String,
    /// Name of the statistic, e.g. `median`.
    pub statistic: String,
    /// What was done with outliers, e.g. `keep`.
    pub outliers: String,
    /// Unit of the values, e.g. `ns`.
    pub unit: String,
    /// Values at the two ends of the colours.
    pub range: [f64; 2],
    /// How values are spread over the colours.
    pub scale: Scale,
    /// Which colours.
    pub colormap: Colormap,
    /// Configurations that went in.
    pub n: u64,
}

#[cfg(test)]
mod tests;
