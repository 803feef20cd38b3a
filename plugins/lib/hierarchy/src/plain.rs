//! The plugin around a hierarchy that has nothing to set.

use std::fmt;

use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Placed, Separation,
};

use crate::{Hierarchy, Open, Query, Search};

/// A method that is its hierarchy and nothing else; its volume is the type that stands for it.
pub trait Method: 'static {
    /// Who made it.
    const ABOUT: About;
    /// What a query goes down.
    type Hierarchy: Hierarchy + 'static;

    /// The hierarchy of a mesh.
    fn build(mesh: &Mesh<'_>) -> Self::Hierarchy;
}

/// The method as an algorithm: collision, all contacts and distance, exact.
pub struct Plain<M: Method> {
    /// Memory of the traversals, kept from query to query.
    open: Open<<M::Hierarchy as Hierarchy>::At>,
}

impl<M: Method> Default for Plain<M> {
    fn default() -> Self {
        Self { open: Open::default() }
    }
}

impl<M: Method> fmt::Debug for Plain<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", M::ABOUT.id)
    }
}

impl<M: Method> Algorithm for Plain<M> {
    const ABOUT: About = M::ABOUT;

    type Object = M::Hierarchy;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<M::Hierarchy> {
        Ok(M::build(&mesh))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        Ok(query(a, b, work).first_contact(&mut self.open))
    }
}

impl<M: Method> Contacts for Plain<M> {
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

impl<M: Method> Distance for Plain<M> {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(query(a, b, work).nearest(&mut self.open, &Search::default()))
    }
}

fn query<'a, M: Method, C: Count>(
    a: Placed<'a, Plain<M>>,
    b: Placed<'a, Plain<M>>,
    work: &'a mut C,
) -> Query<'a, M::Hierarchy, C> {
    Query::new([a.object, b.object], [a.pose, b.pose], work)
}
