#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod rectangle;
mod rss;

use ocb_hierarchy::{Open, Query, Search, Tree};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Refusal, Separation,
};
use rss::Rss;

/// A hierarchy of rectangle swept spheres.
#[derive(Debug)]
pub struct RssTree {
    search: Search,
    /// Memory of the traversals, kept from query to query.
    open: Open<u32>,
}

/// What PQP's functions take when they are not told otherwise.
const QUEUE_SIZE: i32 = 2;

impl Default for RssTree {
    fn default() -> Self {
        Self { search: Search { queue_size: QUEUE_SIZE as usize, ..Search::default() }, open: Open::default() }
    }
}

opencollbench_plugin::export!(RssTree: distance contacts counts parameters);

impl Algorithm for RssTree {
    const ABOUT: About = About {
        id: c"rss-tree",
        name: c"RSS tree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"E. Larsen, S. Gottschalk, M. C. Lin, D. Manocha: Fast Proximity Queries with Swept Sphere Volumes, TR99-018, University of North Carolina, 1999",
        ..About::new()
    };

    type Object = Tree<Rss>;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Tree<Rss>> {
        Ok(Tree::build(&mesh))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        Ok(query(a, b, work).first_contact(&mut self.open))
    }
}

impl Contacts for RssTree {
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

impl Distance for RssTree {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(query(a, b, work).nearest(&mut self.open, &self.search))
    }
}

impl Parameters for RssTree {
    const PARAMETERS: &'static [&'static Parameter] = &[
        &Parameter::real(
            c"rel_err",
            c"Error allowed, relative to the distance; both errors must be set",
            0.0,
            1.0,
            0.0,
        ),
        &Parameter::real(
            c"abs_err",
            c"Error allowed, in the unit of the meshes; both errors must be set",
            0.0,
            1e9,
            0.0,
        ),
        &Parameter::integer(c"queue_size", c"Most pairs in the queue; 2 is depth first", 2, 1 << 24, QUEUE_SIZE),
    ];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        match name {
            "rel_err" => self.search.relative_error = value,
            "abs_err" => self.search.absolute_error = value,
            "queue_size" => self.search.queue_size = value as usize,
            _ => return Err(Refusal::Unsupported),
        }
        Ok(())
    }
}

fn query<'a, C: Count>(a: Placed<'a, RssTree>, b: Placed<'a, RssTree>, work: &'a mut C) -> Query<'a, Tree<Rss>, C> {
    Query::new([a.object, b.object], [a.pose, b.pose], work)
}
