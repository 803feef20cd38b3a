#![doc = include_str!("../README.md")]
#![expect(clippy::needless_range_loop, reason = "kernels number axes, edges and lanes, of several arrays at once")]

mod boxes;
mod build;
mod collide;
mod faces;
mod nearest;
mod obb;
mod queue;
mod relative;
mod rounding;
mod stack;
mod tree;
mod waiting;

use ocb_lanes::Path;
use ocb_triangles::Frame;
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Refusal, Separation,
};
use tree::Tree;

/// Oriented boxes, sixteen pairs at once.
#[derive(Debug)]
pub struct Fast {
    path: Path,
    overlapping: collide::Open,
    within: nearest::Open,
}

const WIDTH: i32 = 16;

impl Default for Fast {
    fn default() -> Self {
        Self {
            path: Path::widest(WIDTH as usize),
            overlapping: collide::Open::default(),
            within: nearest::Open::default(),
        }
    }
}

opencollbench_plugin::export!(Fast: distance contacts counters parameters);

impl Algorithm for Fast {
    const ABOUT: About = About {
        id: c"ocb-fast",
        name: c"OCB Fast",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"S. Gottschalk, M. C. Lin, D. Manocha: OBBTree, SIGGRAPH 1996",
        ..About::new()
    };

    type Object = Object;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Object> {
        if mesh.triangles.is_empty() { Err(Refusal::Unsupported) } else { Ok(Object(Tree::new(&mesh))) }
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let mut found = Collision::Apart;
        let visit = |a, b| {
            found = Collision::Pair(a, b);
            false
        };
        self.path.run(collide::Contacts::new(&pair(a, b), &mut self.overlapping, work, visit));
        Ok(found)
    }
}

/// A mesh as [`Fast`] keeps it.
#[derive(Debug)]
pub struct Object(Tree);

impl Object {
    /// Bytes of memory.
    pub fn bytes(&self) -> usize {
        self.0.bytes()
    }
}

/// Two objects in one query.
struct Pair<'a> {
    a: &'a Tree,
    b: &'a Tree,
    frame: Frame,
    relative: relative::Relative,
}

fn pair<'a>(a: Placed<'a, Fast>, b: Placed<'a, Fast>) -> Pair<'a> {
    let frame = Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation());
    let (a, b) = (&a.object.0, &b.object.0);
    Pair { a, b, frame, relative: relative::Relative::new(&frame, a, b) }
}

impl Contacts for Fast {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        let visit = |a, b| {
            found.push(a, b);
            true
        };
        self.path.run(collide::Contacts::new(&pair(a, b), &mut self.overlapping, work, visit));
        Ok(())
    }
}

impl Distance for Fast {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(self.path.run(nearest::Nearest::new(&pair(a, b), &mut self.within, work)))
    }
}

impl Parameters for Fast {
    const PARAMETERS: &'static [&'static Parameter] =
        &[&Parameter::integer(c"width", c"Most numbers in a register: 16 (AVX-512), 8 (AVX2) or 1", 1, WIDTH, WIDTH)];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "width" {
            return Err(Refusal::Unsupported);
        }
        self.path = Path::widest(value as usize);
        Ok(())
    }
}
