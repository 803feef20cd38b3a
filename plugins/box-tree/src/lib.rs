#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod nearest_first;
mod query;
mod relative;
mod tree;

use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Refusal, Scene, Separation,
};
use query::Traversal;
use tree::Tree;

/// A hierarchy of boxes in object space, traversed for both objects at once.
#[derive(Debug)]
pub struct BoxTree {
    leaf_size: usize,
    /// Memory of the traversals, kept from query to query.
    open: query::Open,
}

const LEAF_SIZE: i32 = 2;

impl Default for BoxTree {
    fn default() -> Self {
        Self { leaf_size: LEAF_SIZE as usize, open: query::Open::default() }
    }
}

opencollbench_plugin::export!(BoxTree: distance contacts counts parameters scene);

impl Algorithm for BoxTree {
    const ABOUT: About = About {
        id: c"box-tree",
        name: c"BoxTree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"G. Zachmann: Minimal Hierarchical Collision Detection, VRST 2002",
        ..About::new()
    };

    type Object = Tree;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Tree> {
        Ok(Tree::build(&mesh, self.leaf_size))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let mut found = Collision::Apart;
        Traversal::new(a, b, work).each_contact(&mut self.open, |a, b| {
            found = Collision::Pair(a, b);
            false
        });
        Ok(found)
    }
}

impl Contacts for BoxTree {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        Traversal::new(a, b, work).each_contact(&mut self.open, |a, b| {
            found.push(a, b);
            true
        });
        Ok(())
    }
}

impl Distance for BoxTree {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(Traversal::new(a, b, work).nearest(&mut self.open))
    }
}

/// A tree knows nothing of other objects.
impl Scene for BoxTree {}

impl Parameters for BoxTree {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::integer(c"leaf_size", c"Most triangles in a leaf", 1, query::MAX_LEAF as i32, LEAF_SIZE)];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "leaf_size" {
            return Err(Refusal::Unsupported);
        }
        self.leaf_size = (value as usize).clamp(1, query::MAX_LEAF);
        Ok(())
    }
}
