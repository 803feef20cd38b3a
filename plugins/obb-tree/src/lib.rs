#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod obb;

use obb::Obb;
use ocb_hierarchy::{Method, Plain, Tree};
use opencollbench_plugin::{About, Mesh};

/// A hierarchy of oriented boxes.
pub type ObbTree = Plain<Obb>;

opencollbench_plugin::export!(ObbTree: distance contacts counts);

impl Method for Obb {
    const ABOUT: About = About {
        id: c"obb-tree",
        name: c"OBBTree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"S. Gottschalk, M. C. Lin, D. Manocha: OBBTree: A Hierarchical Structure for Rapid Interference Detection, SIGGRAPH 1996",
        ..About::new()
    };

    type Hierarchy = Tree<Obb>;

    fn build(mesh: &Mesh<'_>) -> Tree<Obb> {
        Tree::build(mesh)
    }
}
