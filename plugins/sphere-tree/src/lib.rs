#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod sphere;

use ocb_hierarchy::{Open, Query, Search, Tree};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Placed, Separation,
};
use sphere::Sphere;

/// A hierarchy of spheres.
#[derive(Debug, Default)]
pub struct SphereTree {
    /// Memory of the traversals, kept from query to query.
    open: Open<u32>,
}

opencollbench_plugin::export!(SphereTree: distance contacts counters);

impl Algorithm for SphereTree {
    const ABOUT: About = About {
        id: c"sphere-tree",
        name: c"Sphere tree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"P. M. Hubbard: Approximating Polyhedra with Spheres for Time-Critical Collision Detection, ACM Transactions on Graphics 15(3), 1996",
        ..About::new()
    };

    type Object = Tree<Sphere>;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Tree<Sphere>> {
        Ok(Tree::build(&mesh))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        Ok(query(a, b, work).first_contact(&mut self.open))
    }
}

impl Contacts for SphereTree {
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

impl Distance for SphereTree {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(query(a, b, work).nearest(&mut self.open, &Search::default()))
    }
}

fn query<'a, C: Count>(
    a: Placed<'a, SphereTree>,
    b: Placed<'a, SphereTree>,
    work: &'a mut C,
) -> Query<'a, Tree<Sphere>, C> {
    Query::new([a.object, b.object], [a.pose, b.pose], work)
}
