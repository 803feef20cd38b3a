//! Why no contact is lost: what single precision may be off in the kernels, and who pays for it.
//!
//! `u` is a rounding, 2^-24 of its result. The kernels never *accept* anything: they tell pairs apart, or bound
//! distances, and what they cannot tell is left to the tests in double precision of `ocb-triangles`. So only one
//! direction has to be shown: **two points of A and B that coincide are never told apart, and no bound is on the
//! wrong side of the distance.** Terms of second order in `u` are paid for by rounding the sums below up.
//!
//! **Lengths.** Everything is in A's unit and seen from A. `P` bounds the vectors in A's nodes, `Q` those in B's
//! (both are taken from the tree, [`super::tree::Tree::radius`]), `t` is the translation, and `S` is `P + Q` and the sum of
//! its magnitudes: no less than `P + Q + |t|`. Whatever a kernel subtracts is shorter than `S`.
//!
//! **Placing a point of B.** `fma(r0, x, fma(r1, y, fma(r2, z, t)))`: rotation and translation have been rounded
//! once (`u`), every term passes at most four roundings (three fused ones, or six of which a term meets at most
//! four): off by `5 u (|r0 x| + |r1 y| + |r2 z| + |t|)` in each coordinate. A row of the rotation has length 1, so
//! the three sums together are at most `sqrt(3) Q + |t|` (Cauchy and Schwarz), and the point is off by `5 sqrt(3) u
//! S < 9 u S`. A corner in a leaf has been rounded before: `u P` and `u Q`. The middle of a box has not: the box was
//! made around the rounded middle. With the difference of two such points (`u S`) and its scalar product with a
//! direction (three roundings, `3 u S` times the direction's length, by Cauchy and Schwarz again) every projection
//! is off by less than `15 u S`.
//!
//! **The slack** is `32 u S`, plus `8 k S` where `k` is how far the two rotations given are from orthonormal, plus
//! `16 * 2^-52` of the world's lengths for what was computed in double precision before. It is a displacement: B's
//! boxes are enlarged by it in each of their axes and so hold a ball of that radius around every point they held
//! before. It is infinite when the units are further apart than 2^40: then nothing is told apart.
//!
//! **Directions are free.** Any vector separates: if all of B lies beyond all of A along `m`, they are apart,
//! whatever `m` is and however it was computed. So the numbers of a direction *are* the direction; only projections
//! on it count.
//!
//! **Boxes.** A box is `|a_k . (x - c)| <= h_k` for its axes as they are stored (see [`super::obb::Obb`]). Stored
//! axes are off orthonormal by `sqrt(3) u`, placed ones by `9 u` more. Along A's axis `k`, B reaches as far as
//! `sum_j |a_k . b_j| h_j`: the products are off by `9 u + 3 u`, writing B's points as `c + sum y_j b_j` costs `4 u
//! sum h` (a nearly orthonormal matrix and its inverse transposed), the sum four roundings: less than `32 u sum h`
//! altogether. Along B's axes the same holds for A. Each stored half side has [`super::obb::SPARE`]` = 128 u` times
//! the sum of all three to spare, which reaches any direction, since the magnitudes of three orthonormal axes'
//! products with a unit vector add up to 1 at least. Half sides of B are brought to A's unit, a power of two, and
//! enlarged by the slack in one or two roundings: `2 u` of them, in the spare.
//!
//! **Spheres.** No point of a box is further from its middle than the root of the squares of the stored half sides: axes
//! off orthonormal by `10 u` add less than that much of it, which is in the spare, and sides that are longer by the slack
//! have a diagonal that is longer by no less. The squared distance of the middles, the roots and the square of their sum are
//! off by less than `2^-19`; the kernel takes off `2^-16`.
//!
//! **Bounds of distances of boxes.** Gaps along the three axes of one box are parts of one vector, up to `2 sqrt(3)
//! u` of its length. Along the line of the middles, both reaches are products with the same numbers that make the
//! squared length: off by `3 u sum h`, in the spare, and by `4 u S`, in the slack. Squares, products and the inverse
//! are off by less than `2^-19`; the kernel takes off `2^-16`.
//!
//! **Triangles, told apart.** The direction is a vector product of two edges, `|d|` and `|e|` long, and off by `2
//! sqrt(2) u |d| |e|` from perpendicular to them; edges are shorter than `2 P` or `2 Q`. So a triangle's own edge,
//! which should not move along the direction, does by up to `6 u P |d| |e|`; a third corner is off by another `6 u P
//! |d| |e|` for the scalar product and `2 u P |d| |e|` for its edge; the same with `Q` for B. The difference of the
//! two reference corners adds `4 u S |d| |e|`, and the displacements of the corners `11 u S |d| |e|`. As `P + Q <=
//! S`, a gap of `29 u S |d| |e|` is certain: the kernel asks for the slack times the sums of magnitudes of the
//! edges, which are no less than `|d| |e|`.
//!
//! **Distances of triangles.** Upper bound: the two points are sums of corners and edges with parameters in [0, 1],
//! so they are off their triangles by less than the slack, however badly the parameters were computed. Lower bound:
//! the gap along the vector between them, divided by its length, less the slack; the quotient is off by less than
//! `2^-19`, and `2^-16` is taken off. Neither depends on how good the points are.
//!
//! **Small numbers.** Products of two edges, or squares, may be smaller than single precision can hold. They are then off by
//! a few times 2^-149, and every comparison of such asks for `1e-36` more.

/// A rounding of single precision, relative to its result.
pub const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;

/// The slack, relative to the lengths of a query.
pub const SLACK: f64 = 32.0 * ROUNDING;
