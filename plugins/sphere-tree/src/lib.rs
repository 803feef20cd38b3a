#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod sphere;

use ocb_hierarchy::{Method, Plain, Tree};
use opencollbench_plugin::{About, Mesh};
use sphere::Sphere;

/// A hierarchy of spheres.
pub type SphereTree = Plain<Sphere>;

opencollbench_plugin::export!(SphereTree: distance contacts counts);

impl Method for Sphere {
    const ABOUT: About = About {
        id: c"sphere-tree",
        name: c"Sphere tree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"P. M. Hubbard: Approximating Polyhedra with Spheres for Time-Critical Collision Detection, ACM Transactions on Graphics 15(3), 1996",
        ..About::new()
    };

    type Hierarchy = Tree<Sphere>;

    fn build(mesh: &Mesh<'_>) -> Tree<Sphere> {
        Tree::build(mesh)
    }
}
