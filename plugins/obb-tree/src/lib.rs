#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod obb;

use obb::Obb;
use ocb_hierarchy::{Open, Query, Search, Tree};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Placed, Separation,
};

/// A hierarchy of oriented boxes.
#[derive(Debug, Default)]
pub struct ObbTree {
    /// Memory of the traversals, kept from query to query.
    open: Open<u32>,
}

opencollbench_plugin::export!(ObbTree: distance contacts counters);

impl Algorithm for ObbTree {
    const ABOUT: About = About {
        id: c"obb-tree",
        name: c"OBBTree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"S. Gottschalk, M. C. Lin, D. Manocha: OBBTree: A Hierarchical Structure for Rapid Interference Detection, SIGGRAPH 1996",
        ..About::new()
    };

    type Object = Tree<Obb>;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Tree<Obb>> {
        Ok(Tree::build(&mesh))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        Ok(query(a, b, work).first_contact(&mut self.open))
    }
}

impl Contacts for ObbTree {
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

impl Distance for ObbTree {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(query(a, b, work).nearest(&mut self.open, &Search::default()))
    }
}

fn query<'a, C: Count>(a: Placed<'a, ObbTree>, b: Placed<'a, ObbTree>, work: &'a mut C) -> Query<'a, Tree<Obb>, C> {
    Query::new([a.object, b.object], [a.pose, b.pose], work)
}
