#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod bounds;
mod cuts;

use bounds::Bounds;
use cuts::Cuts;
use ocb_hierarchy::{Method, Plain};
use opencollbench_plugin::{About, Mesh};

/// A hierarchy of boxes of which each node keeps one side.
pub type RestrictedBoxTree = Plain<Bounds>;

opencollbench_plugin::export!(RestrictedBoxTree: distance contacts counts);

impl Method for Bounds {
    const ABOUT: About = About {
        id: c"restricted-box-tree",
        name: c"Restricted BoxTree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"G. Zachmann: Minimal Hierarchical Collision Detection, VRST 2002",
        ..About::new()
    };

    type Hierarchy = Cuts;

    fn build(mesh: &Mesh<'_>) -> Cuts {
        Cuts::build(mesh)
    }
}
