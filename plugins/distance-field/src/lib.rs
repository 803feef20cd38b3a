#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod field;
mod query;

use field::Field;
use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, Count, Distance, Mesh, Parameter, Parameters, Placed, Refusal,
    Separation,
};

/// The distance to each object, sampled on lattices, asked at points of the other.
#[derive(Debug)]
pub struct DistanceField {
    resolution: usize,
    /// Memory of the traversals, kept from query to query.
    open: Vec<query::Next>,
}

const RESOLUTION: i32 = 48;

impl Default for DistanceField {
    fn default() -> Self {
        Self::with_resolution(RESOLUTION as usize)
    }
}

impl DistanceField {
    /// With so many cells along an object's longest side.
    pub fn with_resolution(resolution: usize) -> Self {
        Self { resolution, open: Vec::new() }
    }
}

opencollbench_plugin::export!(DistanceField: distance counts parameters);

impl Algorithm for DistanceField {
    const ABOUT: About = About {
        id: c"distance-field",
        name: c"Distance field",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"A. Fuhrmann, G. Sobottka, C. Gross: Distance Fields for Rapid Collision Detection in Physically Based Modeling, GraphiCon 2003",
        capabilities: &[Capability::Solid],
        ..About::new()
    };

    type Object = Field;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Field> {
        Ok(Field::new(&mesh, self.resolution))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let meet = query::meet(a, b, &mut self.open, work) || query::meet(b, a, &mut self.open, work);
        Ok(if meet { Collision::Somewhere } else { Collision::Apart })
    }

    /// Below 0 is inside, so [`Self::collide`] has asked this already.
    fn inside(&mut self, _: Placed<'_, Self>, _: Placed<'_, Self>, _: &mut impl Count) -> Answer<bool> {
        Ok(false)
    }
}

impl Distance for DistanceField {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        let there = query::distance(a, b, &mut self.open, work);
        let back = if there == Some(0.0) { there } else { query::distance(b, a, &mut self.open, work) };
        let nearest = there.into_iter().chain(back).reduce(f64::min).ok_or(Refusal::GaveUp)?;
        Ok(Separation { distance: nearest, points: None, triangles: None })
    }
}

impl Parameters for DistanceField {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::integer(c"resolution", c"Cells along the object's longest side", 8, 192, RESOLUTION)];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "resolution" {
            return Err(Refusal::Unsupported);
        }
        self.resolution = value as usize;
        Ok(())
    }
}
