//! Stock objects, made here: free of any licence, each with as many triangles as wanted.
//!
//! All are centred at the middle of their bounding box, whose diagonal is 1; coordinates are exact in f32, so that
//! algorithms that compute in single and in double precision see the same object. All consist of closed parts that face
//! outwards; parts may overlap, as in objects made by hand. The same name and count give the same mesh on every
//! machine. The id contains the count (`stock:torus-knot@8000`), because a run must name exactly what it measured.

mod builder;
mod castle;
mod chair;
mod lustre;
mod pipes;
mod round;
mod solids;
mod sponge;
mod wreath;

use builder::{Detail, Soup, Vector};
use nalgebra::Point3;

use crate::mesh::Mesh;

/// An object that is made on demand.
#[derive(Clone, Copy, Debug)]
pub struct StockObject {
    /// Name, as in `stock:NAME@TRIANGLES`.
    pub name: &'static str,
    /// What it is and what it is good for, one sentence.
    pub description: &'static str,
    /// Triangles when nothing is said.
    pub default_triangles: u32,
    /// Fewest triangles it can be made of.
    pub lowest_triangles: u32,
    make: fn(Detail) -> Soup,
}

/// Most triangles of a stock object.
pub const MAX_TRIANGLES: u32 = 1_000_000;

const OBJECTS: &[StockObject] = &[
    StockObject {
        name: "castle",
        description: "Walls, towers with cone roofs, a gatehouse and a keep: large flat parts beside many small ones.",
        default_triangles: 20_000,
        lowest_triangles: 500,
        make: castle::castle,
    },
    StockObject {
        name: "sponge",
        description: "A rounded block full of pores that run into each other: far more surface inside than outside.",
        default_triangles: 60_000,
        lowest_triangles: 500,
        make: sponge::sponge,
    },
    StockObject {
        name: "pipes",
        description: "A maze of winding pipes that never meet: long thin parts side by side.",
        default_triangles: 30_000,
        lowest_triangles: 500,
        make: pipes::pipes,
    },
    StockObject {
        name: "lustre",
        description: "A chandelier with arms, candles, drops and strings of beads: extremely concave.",
        default_triangles: 30_000,
        lowest_triangles: 500,
        make: lustre::lustre,
    },
    StockObject {
        name: "chair",
        description: "A turned wooden chair: sticks around a seat, with wide openings.",
        default_triangles: 20_000,
        lowest_triangles: 500,
        make: chair::chair,
    },
    StockObject {
        name: "wreath",
        description: "Twigs, leaves and berries on a ring: hundreds of small parts in each other's way.",
        default_triangles: 30_000,
        lowest_triangles: 500,
        make: wreath::wreath,
    },
    StockObject {
        name: "torus-knot",
        description: "A tube in the shape of the (2, 5) torus knot: smooth, and concave everywhere.",
        default_triangles: 20_000,
        lowest_triangles: 500,
        make: round::torus_knot,
    },
    StockObject {
        name: "gear",
        description: "A spur gear with 16 teeth, hub and bore: a machine part that meshes with itself.",
        default_triangles: 15_000,
        lowest_triangles: 500,
        make: round::gear,
    },
    StockObject {
        name: "sphere",
        description: "A ball of nearly equal triangles: every direction alike.",
        default_triangles: 10_000,
        lowest_triangles: 500,
        make: round::sphere,
    },
    StockObject {
        name: "box",
        description: "A box with finely cut flat sides: many triangles in one plane.",
        default_triangles: 5_000,
        lowest_triangles: 500,
        make: cuboid,
    },
];

/// The stock objects, the most telling first.
pub fn list() -> &'static [StockObject] {
    OBJECTS
}

/// Makes a stock object with about `triangles` triangles (within 10 %); `None` for an unknown name or a count outside
/// its `lowest_triangles` to [`MAX_TRIANGLES`].
pub fn generate(name: &str, triangles: u32) -> Option<Mesh> {
    let object = OBJECTS.iter().find(|o| o.name == name)?;
    (object.lowest_triangles..=MAX_TRIANGLES)
        .contains(&triangles)
        .then(|| builder::fit(triangles, object.make).into_mesh())
}

fn cuboid(detail: Detail) -> Soup {
    let mut soup = Soup::default();
    soup.add(solids::cuboid(detail, Point3::origin(), Vector::new(0.5, 0.4, 0.3)));
    soup
}

#[cfg(test)]
mod tests;
