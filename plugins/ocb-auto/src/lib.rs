#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod features;
pub mod rules;

use features::{Ball, Features};
use ocb_triangles::{Frame, distance};
use ocb_wide::{Wide, fast, simdop};
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Refusal, Separation,
};
use rules::{Choice, Query, RULES, choose};

/// Chooses a method for each configuration.
#[derive(Debug, Default)]
pub struct Auto {
    fast: Wide<fast::Fast>,
    simdop: Wide<simdop::SimDop>,
    /// What to take without asking the rules.
    always: Option<Choice>,
}

opencollbench_plugin::export!(Auto: distance contacts counts parameters);

/// A mesh as every method keeps it.
#[derive(Debug)]
pub struct Object {
    ball: Ball,
    fast: fast::Tree,
    simdop: simdop::Tree,
}

impl Object {
    /// Bytes of memory.
    pub fn bytes(&self) -> usize {
        self.fast.bytes() + self.simdop.bytes()
    }
}

impl Auto {
    /// Comparing the balls is one BV test.
    fn choose(&self, query: Query, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Choice {
        self.always.unwrap_or_else(|| {
            work.bv_tests(1);
            choose(&RULES, query, &Features::new(&frame(a, b), &a.object.ball, &b.object.ball))
        })
    }
}

fn frame(a: Placed<'_, Auto>, b: Placed<'_, Auto>) -> Frame {
    Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation())
}

fn for_fast<'a>(placed: Placed<'a, Auto>) -> Placed<'a, Wide<fast::Fast>> {
    Placed { object: &placed.object.fast, pose: placed.pose }
}

fn for_simdop<'a>(placed: Placed<'a, Auto>) -> Placed<'a, Wide<simdop::SimDop>> {
    Placed { object: &placed.object.simdop, pose: placed.pose }
}

impl Algorithm for Auto {
    const ABOUT: About = About {
        id: c"ocb-auto",
        name: c"OCB Auto",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        ..About::new()
    };

    type Object = Object;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Object> {
        Ok(Object { fast: self.fast.load_mesh(mesh)?, simdop: self.simdop.load_mesh(mesh)?, ball: Ball::around(&mesh) })
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        match self.choose(Query::Collision, a, b, work) {
            Choice::Nothing => Ok(Collision::Apart),
            Choice::Fast | Choice::CollisionFirst => self.fast.collide(for_fast(a), for_fast(b), work),
            Choice::SimDop => self.simdop.collide(for_simdop(a), for_simdop(b), work),
        }
    }
}

impl Contacts for Auto {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        match self.choose(Query::Contacts, a, b, work) {
            Choice::Nothing => Ok(()),
            Choice::Fast | Choice::CollisionFirst => self.fast.contacts(for_fast(a), for_fast(b), found, work),
            Choice::SimDop => self.simdop.contacts(for_simdop(a), for_simdop(b), found, work),
        }
    }
}

impl Distance for Auto {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        match self.choose(Query::Distance, a, b, work) {
            Choice::SimDop => return self.simdop.distance(for_simdop(a), for_simdop(b), work),
            Choice::CollisionFirst => {
                if let Collision::Pair(i, j) = self.fast.collide(for_fast(a), for_fast(b), work)?
                    && let Some(common) = common_point(a, b, [i, j])
                {
                    return Ok(common);
                }
            }
            Choice::Nothing | Choice::Fast => {}
        }
        self.fast.distance(for_fast(a), for_fast(b), work)
    }
}

/// A point of two triangles that meet; none when rounding has led past it.
fn common_point(a: Placed<'_, Auto>, b: Placed<'_, Auto>, ids: [u32; 2]) -> Option<Separation> {
    let frame = frame(a, b);
    let of_a = frame.place_a(&a.object.fast.mesh().triangle(ids[0]));
    let of_b = frame.place_b(&b.object.fast.mesh().triangle(ids[1]));
    let closest = distance(&of_a, &of_b);
    let points = [frame.to_world(closest.a), frame.to_world(closest.b)];
    (closest.squared == 0.0).then_some(Separation { distance: 0.0, points: Some(points), triangles: Some(ids) })
}

/// What the parameter's numbers stand for.
const ALWAYS: [Option<Choice>; 4] = [None, Some(Choice::Fast), Some(Choice::SimDop), Some(Choice::CollisionFirst)];

impl Parameters for Auto {
    const PARAMETERS: &'static [&'static Parameter] = &[&Parameter::integer(
        c"method",
        c"0: by the rules; always 1: ocb-fast, 2: simdop, 3: ocb-fast, a distance query after a collision query",
        0,
        ALWAYS.len() as i32 - 1,
        0,
    )];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "method" {
            return Err(Refusal::Unsupported);
        }
        self.always = *ALWAYS.get(value as usize).ok_or(Refusal::Unsupported)?;
        Ok(())
    }
}
