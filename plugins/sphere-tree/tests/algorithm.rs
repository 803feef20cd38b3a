//! sphere-tree answers as every algorithm must.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_sphere_tree::SphereTree;
use support::algorithm::Terms;

algorithm!(Terms::exact(|| vec![SphereTree::default()]));
