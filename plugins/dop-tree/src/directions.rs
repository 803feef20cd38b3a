//! The directions of k-DOPs, and which of them bound any other direction.

use ocb_triangles::vector::{Vector, dot};

use crate::dop::Dop;

/// The directions of a k-DOP; the opposite ones are not listed.
pub trait Directions<const N: usize> {
    /// The three axes first.
    const DIRECTIONS: [Vector; N];

    /// Which positive sums of directions make the direction (x, y, z) with x >= y >= z >= 0: sums of the first so many unit
    /// vectors, or of the other pairs of them.
    fn parts(sorted: Vector) -> [(f64, Unit); 3];
}

/// A sum of unit vectors, numbered by size of the coordinate.
pub type Unit = [bool; 3];

const X: Unit = [true, false, false];
const Y: Unit = [false, true, false];
const Z: Unit = [false, false, true];
const XY: Unit = [true, true, false];
const XZ: Unit = [true, false, true];
const YZ: Unit = [false, true, true];
const XYZ: Unit = [true, true, true];

/// A factor and the reach that it multiplies.
#[derive(Clone, Copy, Debug)]
pub struct Term {
    pub factor: f64,
    pub direction: usize,
    /// 1 for the opposite direction.
    pub opposite: usize,
}

impl Directions<3> for Dop<3> {
    const DIRECTIONS: [Vector; 3] = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];

    fn parts([x, y, z]: Vector) -> [(f64, Unit); 3] {
        [(x, X), (y, Y), (z, Z)]
    }
}

impl Directions<7> for Dop<7> {
    /// With the corners of a cube.
    const DIRECTIONS: [Vector; 7] =
        [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [1., 1., 1.], [1., 1., -1.], [1., -1., 1.], [1., -1., -1.]];

    fn parts([x, y, z]: Vector) -> [(f64, Unit); 3] {
        [(z, XYZ), (x - z, X), (y - z, Y)]
    }
}

impl Directions<9> for Dop<9> {
    /// With the edges of a cube.
    const DIRECTIONS: [Vector; 9] = [
        [1., 0., 0.],
        [0., 1., 0.],
        [0., 0., 1.],
        [1., 1., 0.],
        [1., -1., 0.],
        [1., 0., 1.],
        [1., 0., -1.],
        [0., 1., 1.],
        [0., 1., -1.],
    ];

    fn parts([x, y, z]: Vector) -> [(f64, Unit); 3] {
        if x >= y + z {
            [(y, XY), (z, XZ), (x - (y + z), X)]
        } else {
            [(0.5 * ((x + y) - z), XY), (0.5 * ((x + z) - y), XZ), (0.5 * ((y + z) - x), YZ)]
        }
    }
}

impl Directions<13> for Dop<13> {
    /// With both.
    const DIRECTIONS: [Vector; 13] = [
        [1., 0., 0.],
        [0., 1., 0.],
        [0., 0., 1.],
        [1., 1., 1.],
        [1., 1., -1.],
        [1., -1., 1.],
        [1., -1., -1.],
        [1., 1., 0.],
        [1., -1., 0.],
        [1., 0., 1.],
        [1., 0., -1.],
        [0., 1., 1.],
        [0., 1., -1.],
    ];

    fn parts([x, y, z]: Vector) -> [(f64, Unit); 3] {
        [(x - y, X), (y - z, XY), (z, XYZ)]
    }
}

/// The three directions whose sum, with factors that are not negative, is the given direction.
///
/// No point of a DOP lies farther in that direction than the same sum of its reaches, whatever the DOP; and on the DOP whose
/// reaches are all as a cube's corner has them, one does: these are the planes through the corner that Zachmann's method finds
/// by comparing all of them.
pub fn extreme<const N: usize>(direction: Vector) -> [Term; 3]
where
    Dop<N>: Directions<N>,
{
    let mut order = [0, 1, 2];
    order.sort_unstable_by(|&i, &j| direction[j].abs().total_cmp(&direction[i].abs()));
    let sorted = order.map(|axis: usize| direction[axis].abs());
    Dop::<N>::parts(sorted).map(|(factor, unit)| {
        let mut sum = [0.0; 3];
        for (axis, part) in order.into_iter().zip(unit) {
            sum[axis] = if part { 1f64.copysign(direction[axis]) } else { 0.0 };
        }
        let same = |d: &Vector, sign: f64| (0..3).all(|k| d[k] == sign * sum[k]);
        let found = Dop::<N>::DIRECTIONS.iter().position(|d| same(d, 1.0) || same(d, -1.0)).unwrap_or(0);
        let opposite = usize::from(!same(&Dop::<N>::DIRECTIONS[found], 1.0));
        Term { factor, direction: found, opposite }
    })
}

/// Lengths of the directions.
#[inline(always)]
pub fn lengths<const N: usize>() -> [f64; N]
where
    Dop<N>: Directions<N>,
{
    Dop::<N>::DIRECTIONS.map(|direction| dot(direction, direction).sqrt())
}
