#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

use ocb_bodies::{Body, Found, Pair, Surface};
use ocb_triangles::Frame;
use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, Count, Distance, Mesh, Parameter, Parameters, Placed, Refusal,
    Separation,
};

/// GJK between two convex objects.
#[derive(Debug, Default)]
pub struct Convex {
    dent: f64,
}

opencollbench_plugin::export!(Convex: distance counts parameters);

impl Algorithm for Convex {
    const ABOUT: About = About {
        id: c"convex",
        name: c"GJK for convex objects",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"E. G. Gilbert, D. W. Johnson, S. S. Keerthi: A Fast Procedure for Computing the Distance Between Complex Objects in Three-Dimensional Space, IEEE Journal of Robotics and Automation 4(2), 1988",
        capabilities: &[Capability::Solid],
        ..About::new()
    };

    type Object = Body;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Body> {
        Surface::of(&mesh)
            .and_then(|surface| Body::new(&surface, self.dent))
            .map_err(|why| Refusal::Error(format!("unsupported mesh: this is for convex objects alone, and {why}")))
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let mut pair = Pair::new(a.object, b.object, frame(&a, &b), work);
        let meet = pair.meet() && pair.room() <= 0.0;
        Ok(if meet { Collision::Somewhere } else { Collision::Apart })
    }

    /// The surfaces do not meet: then bodies that do are one inside the other.
    fn inside(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<bool> {
        Ok(Pair::new(a.object, b.object, frame(&a, &b), work).meet())
    }
}

impl Distance for Convex {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        let frame = frame(&a, &b);
        let mut pair = Pair::new(a.object, b.object, frame, work);
        Ok(match pair.nearest() {
            Found::Apart(closest) => Separation {
                distance: closest.squared.sqrt(),
                points: Some([frame.to_world(closest.a), frame.to_world(closest.b)]),
                triangles: None,
            },
            Found::Meeting => Separation { distance: pair.room().max(0.0), points: None, triangles: None },
        })
    }
}

impl Parameters for Convex {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::real(c"dent", c"Deepest dent that is taken for none, as a share of the size", 0.0, 0.1, 0.0)];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "dent" {
            return Err(Refusal::Unsupported);
        }
        self.dent = value;
        Ok(())
    }
}

fn frame(a: &Placed<'_, Convex>, b: &Placed<'_, Convex>) -> Frame {
    Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation())
}
