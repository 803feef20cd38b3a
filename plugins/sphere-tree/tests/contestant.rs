//! sphere-tree answers as every contestant must.

#[path = "../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

use ocb_sphere_tree::SphereTree;
use support::contestant::Terms;

contestant!(Terms::exact(|| vec![SphereTree::default()]));
