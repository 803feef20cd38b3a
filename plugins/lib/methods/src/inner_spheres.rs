//! Spheres that fill an object; the plugin's README says what they do.

mod packing;
mod query;

use ocb_fields::{BallTree, odd_edges};
use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, Count, Distance, Mesh, Parameter, Parameters, Placed, Refusal,
    Separation,
};
use query::Traversal;

/// Each object as spheres that fill it, in a tree.
#[derive(Debug)]
pub struct InnerSpheres {
    spheres: usize,
    /// Memory of the traversals, kept from query to query.
    open: Vec<query::Pair>,
}

const SPHERES: i32 = 4096;

impl Default for InnerSpheres {
    fn default() -> Self {
        Self { spheres: SPHERES as usize, open: Vec::new() }
    }
}

impl InnerSpheres {
    /// With so many spheres per object.
    pub fn with_spheres(spheres: usize) -> Self {
        Self { spheres, ..Self::default() }
    }

    /// Is a sphere of A no further from a sphere of B than this? They lie inside the objects, so that "yes" is never wrong.
    pub fn within(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, reach: f64, work: &mut impl Count) -> bool {
        Traversal::new(a, b).within(reach, &mut self.open, work)
    }

    /// How much space the spheres of both objects have in common, in cubed units of length: the penetration volume, which
    /// the plugin interface has no question for. The true one is never smaller.
    pub fn common_volume(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>) -> f64 {
        Traversal::new(a, b).common_volume(&mut self.open)
    }
}

impl Algorithm for InnerSpheres {
    const ABOUT: About = About {
        id: c"inner-spheres",
        name: c"Inner sphere tree",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"R. Weller, G. Zachmann: Inner Sphere Trees for Proximity and Penetration Queries, RSS 2009",
        capabilities: &[Capability::Solid],
        ..About::new()
    };

    type Object = BallTree;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<BallTree> {
        let odd = odd_edges(&mesh);
        if odd > 0 {
            return Err(Refusal::Error(format!(
                "unsupported mesh: inner spheres need a closed one, and {odd} edges of this one belong to an odd number of \
                 triangles"
            )));
        }
        let spheres = packing::pack(&mesh, self.spheres);
        if spheres.is_empty() {
            return Err(Refusal::Error(
                "unsupported mesh: it is closed but so thin that no node of the lattice lies inside; ask for more spheres"
                    .into(),
            ));
        }
        Ok(BallTree::new(spheres, 1))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let meet = self.within(a, b, 0.0, work);
        Ok(if meet { Collision::Somewhere } else { Collision::Apart })
    }

    /// Spheres fill an object, so [`Self::collide`] has asked this already.
    fn inside(&mut self, _: Placed<'_, Self>, _: Placed<'_, Self>, _: &mut impl Count) -> Answer<bool> {
        Ok(false)
    }
}

impl Distance for InnerSpheres {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        let distance = Traversal::new(a, b).distance(&mut self.open, work);
        // The nearest points of the spheres do not lie on the surfaces, so they are no witnesses.
        Ok(Separation { distance, points: None, triangles: None })
    }
}

impl Parameters for InnerSpheres {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::integer(c"spheres", c"Most spheres per object", 8, 65_536, SPHERES)];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "spheres" {
            return Err(Refusal::Unsupported);
        }
        self.spheres = value as usize;
        Ok(())
    }
}
