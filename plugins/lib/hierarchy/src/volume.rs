//! What a bounding volume, and a hierarchy of them, must be able to do.

use ocb_triangles::Triangle;
use ocb_triangles::vector::Vector;

use crate::{Leaves, Relative};

/// A bounding volume in the frame of its object.
///
/// Rounding: the gap of two volumes, as computed, may be larger than the distance of the nearest two points of their
/// triangles by at most [`crate::SHARE`] times the lengths of the query. Each implementation says why it is.
pub trait Volume: Sized {
    /// What the tests of one query share.
    type Shared;
    /// A volume of B in A's frame.
    type Placed;

    /// Around at least one triangle; `radius` is the length of the object's longest corner.
    fn around(triangles: &[Triangle], radius: f64) -> Self;

    /// The direction along which the triangles inside are split.
    fn split_along(&self, triangles: &[Triangle]) -> Vector;

    /// How large it is, to decide which of two to open.
    fn size(&self) -> f64;

    /// Prepares a query.
    fn share(relative: &Relative) -> Self::Shared;

    /// Moves a volume of B to A's frame.
    fn place(&self, shared: &Self::Shared) -> Self::Placed;

    /// How far apart the volumes are at least; 0 or less when they may meet.
    fn gap(&self, b: &Self::Placed, shared: &Self::Shared) -> f64;

    /// Whether there is a gap of more than `slack`.
    #[inline(always)]
    fn apart(&self, b: &Self::Placed, shared: &Self::Shared, slack: f64) -> bool {
        self.gap(b, shared) > slack
    }
}

/// A binary hierarchy of volumes, as a query goes down it.
pub trait Hierarchy {
    /// Its volumes.
    type Volume: Volume;
    /// A node, and what is known of it from the way down.
    type At: Copy;

    /// Where to begin.
    fn root(&self) -> Self::At;

    /// What bounds all triangles from here on down.
    fn volume<'s>(&'s self, at: &'s Self::At) -> &'s Self::Volume;

    /// Whether there is a triangle here and no children.
    fn is_leaf(&self, at: &Self::At) -> bool;

    /// The children of a node that is no leaf.
    fn children(&self, at: &Self::At) -> [Self::At; 2];

    /// Where the triangle of a leaf stands in the leaves.
    fn triangle(&self, at: &Self::At) -> usize;

    /// All triangles.
    fn leaves(&self) -> &Leaves;
}
