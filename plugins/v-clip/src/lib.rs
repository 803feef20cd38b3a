#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod clip;
mod faces;
mod memory;
mod polyhedron;
mod query;
mod step;
mod walk;

use memory::Memory;
use ocb_bodies::{Body, Surface, TOLERANCE};
use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, Count, Distance, Mesh, Parameter, Parameters, Placed, Refusal,
    Scene, Separation,
};
use polyhedron::Polyhedron;
use query::{Query, Relation};

/// V-Clip between two convex objects.
#[derive(Debug)]
pub struct VClip {
    dent: f64,
    coherent: bool,
    loaded: u32,
    memory: Memory,
    work: Work,
}

/// What all queries so far have taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Pairs of features that walks looked at.
    pub steps: u64,
    /// Queries that GJK answered instead.
    pub fallbacks: u64,
}

/// A convex object.
#[derive(Debug)]
pub struct Object {
    /// Unlike that of any other object of the same instance.
    id: u32,
    body: Body,
    /// None where rounding leaves no faces to walk on.
    polyhedron: Option<Polyhedron>,
}

opencollbench_plugin::export!(VClip: distance counts parameters scene);

impl Default for VClip {
    fn default() -> Self {
        Self { dent: 0.0, coherent: true, loaded: 0, memory: Memory::default(), work: Work::default() }
    }
}

impl VClip {
    /// What all queries so far have taken.
    pub fn work(&self) -> Work {
        self.work
    }

    /// How the bodies lie; none where only GJK can tell.
    fn relation(&mut self, query: &Query<'_>, count: &mut impl Count) -> Option<Relation> {
        let objects = query.objects();
        let start = if self.coherent { self.memory.of(objects) } else { None };
        let (relation, at, work) = query.ask(start, count);
        self.memory.keep(objects, at);
        self.work.steps += work.steps;
        self.work.fallbacks += work.fallbacks;
        relation
    }
}

impl Algorithm for VClip {
    const ABOUT: About = About {
        id: c"v-clip",
        name: c"V-Clip for convex objects",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"B. Mirtich: V-Clip: Fast and Robust Polyhedral Collision Detection, ACM Transactions on Graphics 17(3), 1998",
        capabilities: &[Capability::Solid, Capability::Coherent],
        ..About::new()
    };

    type Object = Object;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Object> {
        let refused = |why| Refusal::Error(format!("unsupported mesh: this is for convex objects alone, and {why}"));
        let surface = Surface::of(&mesh).map_err(refused)?;
        let body = Body::new(&surface, self.dent).map_err(refused)?;
        let polyhedron = Polyhedron::new(&surface, body.middle, TOLERANCE.max(self.dent) * body.size);
        self.loaded += 1;
        Ok(Object { id: self.loaded, body, polyhedron })
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let query = Query::new(&a, &b);
        let meet = match self.relation(&query, work) {
            Some(Relation::Apart(_)) => false,
            Some(Relation::Crossing) => true,
            Some(Relation::Meeting) => query.room(work) <= 0.0,
            None => query.meet(work) && query.room(work) <= 0.0,
        };
        Ok(if meet { Collision::Somewhere } else { Collision::Apart })
    }

    /// The surfaces do not meet: then bodies that do are one inside the other.
    fn inside(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<bool> {
        let query = Query::new(&a, &b);
        Ok(match self.relation(&query, work) {
            Some(relation) => !matches!(relation, Relation::Apart(_)),
            None => query.meet(work),
        })
    }
}

impl Distance for VClip {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        let query = Query::new(&a, &b);
        let overlapping = |distance: f64| Separation { distance, points: None, triangles: None };
        let relation = self.relation(&query, work).unwrap_or_else(|| query.nearest(work));
        Ok(match relation {
            Relation::Apart(closest) => Separation {
                distance: closest.squared.sqrt(),
                points: Some([query.frame.to_world(closest.a), query.frame.to_world(closest.b)]),
                triangles: None,
            },
            Relation::Crossing => overlapping(0.0),
            Relation::Meeting => overlapping(query.room(work).max(0.0)),
        })
    }
}

/// The features of every pair are remembered.
impl Scene for VClip {}

impl Parameters for VClip {
    const PARAMETERS: &'static [&'static Parameter] = &[
        &Parameter::integer(
            c"coherence",
            c"1: starts where the previous query ended; 0: always at the first vertices",
            0,
            1,
            1,
        ),
        &Parameter::real(c"dent", c"Deepest dent that is taken for none, as a share of the size", 0.0, 0.1, 0.0),
    ];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        match name {
            "coherence" => self.coherent = value != 0.0,
            "dent" => self.dent = value,
            _ => return Err(Refusal::Unsupported),
        }
        Ok(())
    }
}
