//! Oriented boxes, four children to a node: sixteen pairs of boxes or triangles at once, exact at the leaves.

mod boxes;
mod build;
mod collide;
mod faces;
mod narrow;
mod nearest;
mod obb;
mod queue;
mod relative;
mod rounding;
mod stack;
mod tree;
mod waiting;

use ocb_lanes::{Lanes, Path};
use ocb_triangles::Frame;
use opencollbench_plugin::{About, Count, Mesh, Parameter, Separation, Uncounted};
use relative::Relative;
pub use tree::Tree;

use crate::{Method, Pair, WIDTH};

/// The method of `ocb-fast`.
#[derive(Debug, Default)]
pub struct Fast;

/// What is still to be done in a query.
#[derive(Debug, Default)]
pub struct Open {
    overlapping: collide::Open,
    within: nearest::Open,
}

/// Two objects in one query, and what all kernels share.
struct Placed<'a> {
    a: &'a Tree,
    b: &'a Tree,
    frame: &'a Frame,
    relative: Relative,
}

impl<'a> Placed<'a> {
    #[inline(always)]
    fn new<L: Lanes>(pair: &'a Pair<'a, Tree>) -> Self {
        let Pair { a, b, frame } = pair;
        Self { a, b, frame, relative: Relative::new::<L>(frame, a, b) }
    }
}

impl Method for Fast {
    const ABOUT: About = About {
        id: c"ocb-fast",
        name: c"OCB Fast",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"S. Gottschalk, M. C. Lin, D. Manocha: OBBTree, SIGGRAPH 1996",
        ..About::new()
    };
    const PARAMETERS: &'static [&'static Parameter] = &[&WIDTH];

    type Tree = Tree;
    type Open = Open;

    fn build(&self, mesh: &Mesh<'_>) -> Tree {
        Tree::new(mesh)
    }

    fn each_contact(
        path: Path,
        pair: &Pair<'_, Tree>,
        open: &mut Open,
        listener: Option<&mut dyn Count>,
        visit: &mut dyn FnMut(u32, u32) -> bool,
    ) {
        match listener {
            None => path.run(collide::Query { pair, open: &mut open.overlapping, work: &mut Uncounted, visit }),
            Some(mut work) => path.run(collide::Query { pair, open: &mut open.overlapping, work: &mut work, visit }),
        }
    }

    fn nearest(path: Path, pair: &Pair<'_, Tree>, open: &mut Open, listener: Option<&mut dyn Count>) -> Separation {
        match listener {
            None => path.run(nearest::Query { pair, open: &mut open.within, work: &mut Uncounted }),
            Some(mut work) => path.run(nearest::Query { pair, open: &mut open.within, work: &mut work }),
        }
    }
}
