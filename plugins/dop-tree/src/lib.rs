#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod directions;
mod dop;

use dop::Dop;
use ocb_hierarchy::{Open, Query, Search, Tree};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Refusal, Separation,
};

/// A hierarchy of discrete oriented polytopes.
#[derive(Debug)]
pub struct DopTree {
    k: u32,
    /// Memory of the traversals, kept from query to query.
    open: Open<u32>,
}

const K: i32 = 18;

impl Default for DopTree {
    fn default() -> Self {
        Self { k: K as u32, open: Open::default() }
    }
}

/// A mesh as dop-tree keeps it: what one k needs, and no more.
#[derive(Debug)]
pub enum Dops {
    /// Boxes.
    K6(Tree<Dop<3>>),
    /// Boxes with their corners cut off.
    K14(Tree<Dop<7>>),
    /// Boxes with their edges cut off.
    K18(Tree<Dop<9>>),
    /// Both.
    K26(Tree<Dop<13>>),
}

/// Calls a query of two objects of one run, which have the same k.
macro_rules! query {
    ($a:expr, $b:expr, $work:expr, |$query:ident| $ask:expr) => {
        query!($a, $b, $work, |$query| $ask, K6 K14 K18 K26)
    };
    ($a:expr, $b:expr, $work:expr, |$query:ident| $ask:expr, $($k:ident)+) => {
        match ($a.object, $b.object) {
            $((Dops::$k(a), Dops::$k(b)) => {
                let mut $query = Query::new([a, b], [$a.pose, $b.pose], $work);
                Ok($ask)
            })+
            _ => Err(Refusal::Error("two objects of one run must have been loaded with the same k".into())),
        }
    };
}

opencollbench_plugin::export!(DopTree: distance contacts counts parameters);

impl Algorithm for DopTree {
    const ABOUT: About = About {
        id: c"dop-tree",
        name: c"DOP-Tree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"G. Zachmann: Rapid Collision Detection by Dynamically Aligned DOP-Trees, VRAIS 1998",
        ..About::new()
    };

    type Object = Dops;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Dops> {
        Ok(match self.k {
            6 => Dops::K6(Tree::build(&mesh)),
            14 => Dops::K14(Tree::build(&mesh)),
            18 => Dops::K18(Tree::build(&mesh)),
            _ => Dops::K26(Tree::build(&mesh)),
        })
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        query!(a, b, work, |query| query.first_contact(&mut self.open))
    }
}

impl Contacts for DopTree {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        query!(a, b, work, |query| query.all_contacts(&mut self.open, found))
    }
}

impl Distance for DopTree {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        query!(a, b, work, |query| query.nearest(&mut self.open, &Search::default()))
    }
}

impl Parameters for DopTree {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::integer(c"k", c"Planes of a volume: 6, 14, 18 or 26", 6, 26, K)];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "k" {
            return Err(Refusal::Unsupported);
        }
        let k = value as u32;
        if ![6, 14, 18, 26].contains(&k) {
            return Err(Refusal::Error(format!("k is 6, 14, 18 or 26, not {k}")));
        }
        self.k = k;
        Ok(())
    }
}
