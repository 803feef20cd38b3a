#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![expect(clippy::needless_range_loop, reason = "kernels number directions and lanes, of several arrays at once")]

mod collide;
mod directions;
mod dops;
mod nearest;
mod tree;
mod turn;

use directions::Directions;
use ocb_lanes::Path;
use ocb_triangles::Frame;
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Refusal, Separation,
};
use tree::Tree;

/// k-DOPs, sixteen children at once.
#[derive(Debug)]
pub struct SimDop {
    path: Path,
    directions: Directions,
    /// Pairs of nodes that are still to be opened, kept from query to query for their memory.
    overlapping: Vec<[u32; 2]>,
    within: nearest::Open,
}

const K: i32 = 18;
const WIDTH: i32 = 16;

impl Default for SimDop {
    fn default() -> Self {
        Self {
            path: Path::widest(WIDTH as usize),
            directions: Directions::new(K as usize),
            overlapping: Vec::new(),
            within: nearest::Open::new(),
        }
    }
}

opencollbench_plugin::export!(SimDop: distance contacts counters parameters);

impl Algorithm for SimDop {
    const ABOUT: About = About {
        id: c"simdop",
        name: c"SIMDop",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        paper: c"T. Tan, R. Weller, G. Zachmann: SIMDop, SIMD optimized bounding volume hierarchies, IROS 2019",
        ..About::new()
    };

    type Object = Object;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Object> {
        if mesh.triangles.is_empty() {
            return Err(Refusal::Unsupported);
        }
        Ok(Object(Tree::new(&mesh, &self.directions)))
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

/// A mesh as [`SimDop`] keeps it.
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
}

fn pair<'a>(a: Placed<'a, SimDop>, b: Placed<'a, SimDop>) -> Pair<'a> {
    let frame = Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation());
    Pair { a: &a.object.0, b: &b.object.0, frame }
}

impl Contacts for SimDop {
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

impl Distance for SimDop {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(self.path.run(nearest::Nearest::new(&pair(a, b), &mut self.within, work)))
    }
}

impl Parameters for SimDop {
    const PARAMETERS: &'static [&'static Parameter] = &[
        &Parameter::integer(
            c"k",
            c"Planes of a DOP: 6, 14, 18 or 26; the largest of these that is not above k",
            6,
            26,
            K,
        ),
        &Parameter::integer(c"width", c"Most numbers in a register: 16 (AVX-512), 8 (AVX2) or 1", 1, WIDTH, WIDTH),
    ];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        match name {
            "k" => self.directions = Directions::new(value as usize),
            "width" => self.path = Path::widest(value as usize),
            _ => return Err(Refusal::Unsupported),
        }
        Ok(())
    }
}
