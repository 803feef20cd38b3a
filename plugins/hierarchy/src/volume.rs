//! What a bounding volume must be able to do.

use ocb_triangles::Triangle;
use ocb_triangles::vector::Vector;

use crate::Relative;

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
