//! Levels of detail, and what they certainly say about the objects they stand for.
//!
//! A level of detail is another mesh with two lengths for each of its triangles `i`:
//!
//! * the **thickness** `e_i`: every point of the object lies within `e_i` of some triangle `i` of the level;
//! * the **deviation** `g_i`: every point of triangle `i` lies within `g_i` of the object.
//!
//! For levels of A and B then, `d_ij` being the distance of triangle `i` of A's level to triangle `j` of B's,
//!
//! ```text
//! min over ij of max(0, d_ij - e_i - e_j)  <=  distance(A, B)  <=  min over ij of (d_ij + g_i + g_j)
//! ```
//!
//! *Proof.* Let `a` and `b` be nearest points of the objects. `a` is within `e_i` of a point of some `i`, `b` within `e_j`
//! of one of some `j`; those two points are at least `d_ij` apart, so `|a - b| >= d_ij - e_i - e_j`. And nearest points
//! of any `i` and `j` are within `g_i` and `g_j` of points of the objects, which are at most `d_ij + g_i + g_j` apart.
//!
//! # Rounding
//!
//! * A pose is no perfect rotation: where a frame of the hierarchies exists, no entry of `M^T M - 1` exceeds 1e-6, so
//!   that `|M x|^2 <= (1 + 3e-6) |x|^2` and lengths of the object grow by less than 2e-6. Every length is stretched so much.
//!   Other poses get the interval that says nothing.
//! * `d_ij` is an interval that holds whatever f64 does (`oracle::closest`); sums and differences with it are rounded outwards.
//! * In the hierarchy a box's bound is less by the largest thickness below it, in f32, rounded up.

mod search;

use crate::oracle::Shape;

pub use search::{Answer, Interval, LodPair};

/// A mesh that stands for an object, with the lengths that say how well.
///
/// What [`Lod::new`] is given is believed; who finds the lengths proves them.
#[derive(Clone, Debug)]
pub struct Lod {
    shape: Shape,
    /// `None`: the object itself.
    leeway: Option<Leeway>,
}

#[derive(Clone, Debug)]
struct Leeway {
    /// Of every triangle: thickness and deviation.
    lengths: Vec<[f64; 2]>,
    /// The largest thickness below every slot of the hierarchy.
    reach: Vec<f32>,
}

/// Why lengths are none of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LodError {
    /// Not one of each for every triangle.
    #[error("{lengths} lengths do not fit {triangles} triangles; there must be one of each kind for every triangle")]
    Count {
        /// How many there are.
        lengths: usize,
        /// How many triangles.
        triangles: usize,
    },
    /// Negative, infinite or not a number.
    #[error("a length of triangle {triangle} is not a finite number of at least 0")]
    Length {
        /// The triangle, from 0.
        triangle: usize,
    },
}

impl Lod {
    /// The object itself: no thickness, no deviation.
    pub fn exact(shape: Shape) -> Self {
        Self { shape, leeway: None }
    }

    /// A level with its certified lengths, in the object's own unit.
    pub fn new(shape: Shape, thickness: &[f64], deviation: &[f64]) -> Result<Self, LodError> {
        let triangles = shape.triangles().len();
        for lengths in [thickness, deviation] {
            if lengths.len() != triangles {
                return Err(LodError::Count { lengths: lengths.len(), triangles });
            }
            // Written so that NaN fails.
            if let Some(triangle) = lengths.iter().position(|x| !(0.0..f64::INFINITY).contains(x)) {
                return Err(LodError::Length { triangle });
            }
        }
        let reach = shape.tree().reach(thickness);
        let lengths = thickness.iter().zip(deviation).map(|(e, g)| [*e, *g]).collect();
        Ok(Self { shape, leeway: Some(Leeway { lengths, reach }) })
    }

    /// The mesh, made ready for queries.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Thickness and deviation of a triangle.
    fn lengths(&self, triangle: u32) -> [f64; 2] {
        self.leeway.as_ref().map_or([0.0; 2], |l| l.lengths[triangle as usize])
    }

    /// What a bound can be wider at most, whatever the configuration: the largest thickness plus deviation of a triangle.
    pub fn width(&self) -> f64 {
        self.leeway.iter().flat_map(|l| &l.lengths).map(|[e, g]| e + g).fold(0.0, f64::max)
    }
}
