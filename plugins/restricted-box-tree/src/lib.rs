#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod bounds;
mod cuts;

use cuts::{At, Cuts};
use ocb_hierarchy::{Open, Query, Search};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Placed, Separation,
};

/// A hierarchy of boxes of which each node keeps one side.
#[derive(Debug, Default)]
pub struct RestrictedBoxTree {
    /// Memory of the traversals, kept from query to query.
    open: Open<At>,
}

opencollbench_plugin::export!(RestrictedBoxTree: distance contacts counters);

impl Algorithm for RestrictedBoxTree {
    const ABOUT: About = About {
        id: c"restricted-box-tree",
        name: c"Restricted BoxTree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"G. Zachmann: Minimal Hierarchical Collision Detection, VRST 2002",
        ..About::new()
    };

    type Object = Cuts;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Cuts> {
        Ok(Cuts::build(&mesh))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        Ok(query(a, b, work).first_contact(&mut self.open))
    }
}

impl Contacts for RestrictedBoxTree {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        query(a, b, work).all_contacts(&mut self.open, found);
        Ok(())
    }
}

impl Distance for RestrictedBoxTree {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(query(a, b, work).nearest(&mut self.open, &Search::default()))
    }
}

fn query<'a, C: Count>(
    a: Placed<'a, RestrictedBoxTree>,
    b: Placed<'a, RestrictedBoxTree>,
    work: &'a mut C,
) -> Query<'a, Cuts, C> {
    Query::new([a.object, b.object], [a.pose, b.pose], work)
}
