//! The distance to one object, and the points that it is represented by.

use ocb_fields::{Ball, BallTree, Bounds, Lattice, Nearest, cover, inside, odd_edges};
use ocb_triangles::vector::Vector;
use opencollbench_plugin::Mesh;

/// How much larger the cells of the outer lattice are.
const COARSER: f64 = 3.0;
/// How much a distance at a node may be too large, in cells.
const SLACK: f64 = 0.1;
/// How far a point of the surface may be from the nearest of the points that stand for it, in cells.
const REACH: f64 = 0.5;
/// Points in a leaf of the tree.
const LEAF: usize = 8;

/// Distances at the nodes of a lattice, negative inside a closed object.
#[derive(Debug)]
struct Sampled {
    lattice: Lattice,
    bounds: Bounds,
    values: Vec<f32>,
}

/// One object.
#[derive(Debug)]
pub struct Field {
    /// Close to the object, and up to its longest side away from it.
    levels: [Sampled; 2],
    /// The box of the object.
    bounds: Bounds,
    /// Closed objects have an inside.
    pub closed: bool,
    /// How far a value close to the object may be from the true distance.
    pub error: f64,
    /// How far a point of the surface may be from the next of `points`.
    pub reach: f64,
    /// Points all over the surface.
    pub points: BallTree,
}

/// The distance of a point from an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Interpolated; negative inside.
    Known(f64),
    /// Beyond the lattices; at least this.
    AtLeast(f64),
}

impl Field {
    /// With so many cells along the longest side.
    pub fn new(mesh: &Mesh<'_>, resolution: usize) -> Self {
        let bounds = Bounds::of(mesh);
        let longest = bounds.longest_side();
        // All vertices may lie in one point.
        let cell = if longest > 0.0 { longest / resolution as f64 } else { 1.0 };
        let closed = odd_edges(mesh) == 0;
        let nearest = Nearest::new(mesh);
        let level = |margin, spacing| Sampled::new(mesh, &nearest, Lattice::around(&bounds, margin, spacing), closed);
        let levels = [level(2.0 * cell, cell), level(longest, COARSER * cell)];
        let reach = REACH * cell;
        let points = cover(mesh, reach).into_iter().map(|center| Ball { center, radius: 0.0 }).collect();
        let error = (0.75f64.sqrt() + SLACK) * cell;
        Self { levels, bounds, closed, error, reach, points: BallTree::new(points, LEAF) }
    }

    /// The distance of a point.
    #[inline]
    pub fn at(&self, point: Vector) -> Value {
        let level = self.levels.iter().find(|level| level.bounds.squared_distance(point) == 0.0);
        level.map_or_else(
            || Value::AtLeast(self.bounds.squared_distance(point).sqrt()),
            |level| Value::Known(level.interpolate(point)),
        )
    }
}

impl Sampled {
    fn new(mesh: &Mesh<'_>, nearest: &Nearest, lattice: Lattice, closed: bool) -> Self {
        let mut near = 0;
        let slack = SLACK * lattice.spacing;
        let mut values: Vec<f32> =
            lattice.each().map(|at| nearest.distance(lattice.node(at), slack, &mut near) as f32).collect();
        if closed {
            let within = inside(mesh, &lattice);
            values.iter_mut().zip(within).filter(|(_, within)| *within).for_each(|(value, _)| *value = -*value);
        }
        Self { bounds: lattice.bounds(), lattice, values }
    }

    /// Linear along each axis between the eight nodes around.
    #[inline(always)]
    fn interpolate(&self, point: Vector) -> f64 {
        let place: Vector = core::array::from_fn(|i| (point[i] - self.lattice.origin[i]) / self.lattice.spacing);
        let cell: [usize; 3] = core::array::from_fn(|i| (place[i] as usize).min(self.lattice.nodes[i] - 2));
        let [x, y, z]: Vector = core::array::from_fn(|i| place[i] - cell[i] as f64);
        let first = self.lattice.index(cell);
        let (row, layer) = (self.lattice.nodes[0], self.lattice.nodes[0] * self.lattice.nodes[1]);
        let along = |at: usize| {
            let (from, to) = (f64::from(self.values[at]), f64::from(self.values[at + 1]));
            from + x * (to - from)
        };
        let across = |at: usize| {
            let (from, to) = (along(at), along(at + row));
            from + y * (to - from)
        };
        let (from, to) = (across(first), across(first + layer));
        from + z * (to - from)
    }
}
