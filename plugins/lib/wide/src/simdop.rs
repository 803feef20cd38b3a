//! Discrete oriented polytopes, sixteen children to a node: one of B against sixteen of A at once.

mod collide;
mod directions;
mod dops;
mod nearest;
mod tree;
mod turn;

use directions::Directions;
use ocb_lanes::Path;
use opencollbench_plugin::{About, Answer, Count, Mesh, Parameter, Refusal, Separation, Uncounted};
pub use tree::Tree;

use crate::{Method, Pair, WIDTH};

/// The method of `simdop`.
#[derive(Debug)]
pub struct SimDop {
    directions: Directions,
}

const K: i32 = 18;

impl Default for SimDop {
    fn default() -> Self {
        Self { directions: Directions::new(K as usize) }
    }
}

/// Pairs of nodes that are still to be opened in a query.
#[derive(Debug, Default)]
pub struct Open {
    overlapping: Vec<[u32; 2]>,
    within: nearest::Open,
}

impl Method for SimDop {
    const ABOUT: About = About {
        id: c"simdop",
        name: c"SIMDop",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"T. Tan, R. Weller, G. Zachmann: SIMDop, SIMD optimized bounding volume hierarchies, IROS 2019",
        ..About::new()
    };
    const PARAMETERS: &'static [&'static Parameter] = &[
        &Parameter::integer(
            c"k",
            c"Planes of a DOP: 6, 14, 18 or 26; the largest of these that is not above k",
            6,
            26,
            K,
        ),
        &WIDTH,
    ];

    type Tree = Tree;
    type Open = Open;

    fn build(&self, mesh: &Mesh<'_>) -> Tree {
        Tree::new(mesh, &self.directions)
    }

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "k" {
            return Err(Refusal::Unsupported);
        }
        self.directions = Directions::new(value as usize);
        Ok(())
    }

    fn each_contact(
        path: Path,
        pair: &Pair<'_, Tree>,
        open: &mut Open,
        listener: Option<&mut dyn Count>,
        visit: &mut dyn FnMut(u32, u32) -> bool,
    ) {
        match listener {
            None => path.run(collide::Contacts::new(pair, &mut open.overlapping, &mut Uncounted, visit)),
            Some(mut work) => path.run(collide::Contacts::new(pair, &mut open.overlapping, &mut work, visit)),
        }
    }

    fn nearest(path: Path, pair: &Pair<'_, Tree>, open: &mut Open, listener: Option<&mut dyn Count>) -> Separation {
        match listener {
            None => path.run(nearest::Nearest::new(pair, &mut open.within, &mut Uncounted)),
            Some(mut work) => path.run(nearest::Nearest::new(pair, &mut open.within, &mut work)),
        }
    }
}
