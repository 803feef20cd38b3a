//! Exact answers about two triangles by a way that has nothing in common with the oracle's.
//!
//! Two triangles are as far apart as the origin is from the convex hull of the nine differences of their corners. By
//! Caratheodory's theorem the hull's nearest point lies in a simplex of at most three of the nine, at the foot of the
//! perpendicular from the origin; and the origin lies in the hull when it lies in a simplex of at most four. So all
//! 9 + 36 + 84 + 126 simplices are asked, in integers, and no case is special: not coplanar triangles, not those without
//! area, not those with common corners.

use dashu_int::{
    IBig,
    ops::{Abs, BitTest},
};
use nalgebra::Point3;
use ocb_core::pose::Pose;

/// A point on the grid.
pub type Whole = [IBig; 3];

/// Points of a scene as integers.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Per object the mapped points, in units of the grid.
    pub points: [Vec<Whole>; 2],
    /// The grid's unit is two to this power.
    exponent: i32,
}

/// A squared length in squared units of the grid, as a fraction.
#[derive(Clone, Debug)]
pub struct Squared {
    numerator: IBig,
    denominator: IBig,
    exponent: i32,
}

/// `mantissa * 2^exponent`.
fn parts(x: f64) -> (i64, i32) {
    let raw = ((x.to_bits() >> 52) & 0x7ff) as i32;
    let fraction = (x.to_bits() & ((1 << 52) - 1)) as i64;
    let mantissa = if raw == 0 { fraction } else { fraction + (1 << 52) };
    (if x.is_sign_negative() { -mantissa } else { mantissa }, raw.max(1) - 1075)
}

/// The largest power of two of which all numbers are multiples.
fn grid_of(numbers: impl Iterator<Item = f64>) -> i32 {
    numbers.filter(|x| *x != 0.0).map(parts).map(|(m, e)| e + m.trailing_zeros() as i32).min().unwrap_or(0)
}

/// The number in units of `2^exponent`.
fn whole(x: f64, exponent: i32) -> IBig {
    let (m, e) = parts(x);
    if m == 0 {
        return IBig::ZERO;
    }
    let zeros = m.trailing_zeros() as i32;
    IBig::from(m >> zeros) << usize::try_from(e + zeros - exponent).expect("a multiple of the grid's unit")
}

impl Grid {
    /// All points where the poses put them, without rounding.
    pub fn new(objects: [(&Pose, &[Point3<f64>]); 2]) -> Self {
        let entries = || objects.iter().flat_map(|(pose, _)| pose.linear.iter().copied());
        let coordinates = || objects.iter().flat_map(|(_, points)| points.iter().flat_map(|p| p.coords.data.0[0]));
        let shifts = || objects.iter().flat_map(|(pose, _)| pose.translation.iter().copied());
        let (linear, local) = (grid_of(entries()), grid_of(coordinates()));
        let exponent = (linear + local).min(grid_of(shifts()));
        let points = objects.map(|(pose, points)| {
            let m: [[IBig; 3]; 3] = [0, 1, 2].map(|i| [0, 1, 2].map(|k| whole(pose.linear[(i, k)], linear)));
            let shift: Whole = [0, 1, 2].map(|i| whole(pose.translation[i], exponent));
            let lift = (linear + local - exponent) as usize;
            let map = |p: &Point3<f64>| {
                let x: Whole = [0, 1, 2].map(|k| whole(p[k], local));
                [0, 1, 2].map(|i| (dot(&m[i], &x) << lift) + &shift[i])
            };
            points.iter().map(map).collect()
        });
        Self { points, exponent }
    }

    /// Squared distance of two triangles, given by the numbers of their corners; 0 exactly when they meet.
    pub fn squared_distance(&self, a: [usize; 3], b: [usize; 3]) -> Squared {
        let corners = a.iter().flat_map(|&i| b.iter().map(move |&j| (i, j)));
        let differences: Vec<Whole> = corners.map(|(i, j)| minus(&self.points[0][i], &self.points[1][j])).collect();
        let (numerator, denominator) = origin_to_hull(&differences);
        Squared { numerator, denominator, exponent: 2 * self.exponent }
    }
}

impl Squared {
    /// Is there no distance at all?
    pub fn is_zero(&self) -> bool {
        self.numerator == IBig::ZERO
    }

    /// Of another fraction in squared lengths (no grid).
    pub fn is(&self, numerator: &IBig, denominator: &IBig) -> bool {
        compare(&(&self.numerator * denominator), self.exponent, &(numerator * &self.denominator), 0).is_eq()
    }

    /// Is the smaller one strictly smaller? Both of one grid.
    pub fn less_than(&self, other: &Self) -> bool {
        &self.numerator * &other.denominator < &other.numerator * &self.denominator
    }

    /// How the square of a number that is not negative stands to this.
    pub fn square_against(&self, x: f64) -> std::cmp::Ordering {
        assert!(x >= 0.0, "{x} is no length");
        if x == f64::INFINITY {
            return std::cmp::Ordering::Greater;
        }
        let (m, e) = parts(x);
        compare(&(IBig::from(m) * IBig::from(m) * &self.denominator), 2 * e, &self.numerator, self.exponent)
    }

    /// Is the distance in the closed interval?
    pub fn root_is_in(&self, (lo, hi): (f64, f64)) -> bool {
        self.square_against(lo).is_le() && self.square_against(hi).is_ge()
    }
}

/// `x 2^p` against `y 2^q`.
fn compare(x: &IBig, p: i32, y: &IBig, q: i32) -> std::cmp::Ordering {
    // Far apart in size: no shifting by thousands of bits.
    let size = |v: &IBig, e: i32| (v.clone().abs().bit_len() as i64) + i64::from(e);
    if x > &IBig::ZERO && y > &IBig::ZERO && size(x, p).abs_diff(size(y, q)) > 2 {
        return size(x, p).cmp(&size(y, q));
    }
    let least = p.min(q);
    (x << (p - least) as usize).cmp(&(y << (q - least) as usize))
}

fn minus(x: &Whole, y: &Whole) -> Whole {
    std::array::from_fn(|i| &x[i] - &y[i])
}

fn dot(x: &Whole, y: &Whole) -> IBig {
    &x[0] * &y[0] + &x[1] * &y[1] + &x[2] * &y[2]
}

fn cross(x: &Whole, y: &Whole) -> Whole {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &x[j] * &y[k] - &x[k] * &y[j]
    })
}

/// Squared distance of the origin from the convex hull of nine points, as a fraction.
fn origin_to_hull(p: &[Whole]) -> (IBig, IBig) {
    let n = p.len();
    let products: Vec<Vec<IBig>> = p.iter().map(|x| p.iter().map(|y| dot(x, y)).collect()).collect();
    let crosses: Vec<Vec<Whole>> = p.iter().map(|x| p.iter().map(|y| cross(x, y)).collect()).collect();
    let determinant = |i: usize, j: usize, k: usize| dot(&crosses[i][j], &p[k]);
    let mut best = (products[0][0].clone(), IBig::ONE);
    let mut offer = |numerator: IBig, denominator: IBig| {
        if &numerator * &best.1 < &best.0 * &denominator {
            best = (numerator, denominator);
        }
    };
    let mut signs = vec![0i32; n * n * n];
    for i in 0..n {
        offer(products[i][i].clone(), IBig::ONE);
        for j in i + 1..n {
            // The foot lies between both points.
            let (after_i, before_j) = (&products[i][i] - &products[i][j], &products[j][j] - &products[i][j]);
            let length = &after_i + &before_j;
            if after_i >= IBig::ZERO && before_j >= IBig::ZERO && length > IBig::ZERO {
                offer(dot(&crosses[i][j], &crosses[i][j]), length);
            }
            for k in j + 1..n {
                let volume = determinant(i, j, k);
                signs[(i * n + j) * n + k] = signum(&volume);
                let (ij, jk, ki) = (&crosses[i][j], &crosses[j][k], &crosses[k][i]);
                let normal: Whole = std::array::from_fn(|x| &ij[x] + &jk[x] + &ki[x]);
                let area = dot(&normal, &normal);
                // The foot's weights.
                if area > IBig::ZERO && [jk, ki, ij].iter().all(|side| dot(&normal, side) >= IBig::ZERO) {
                    offer(&volume * &volume, area);
                }
            }
        }
    }
    let sign = |i: usize, j: usize, k: usize| signs[(i * n + j) * n + k];
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                for l in k + 1..n {
                    let around = [sign(j, k, l), -sign(i, k, l), sign(i, j, l), -sign(i, j, k)];
                    // Four zeros: a flat one, whose parts have been asked.
                    let same = around.iter().all(|s| *s >= 0) || around.iter().all(|s| *s <= 0);
                    if same && around != [0; 4] {
                        return (IBig::ZERO, IBig::ONE);
                    }
                }
            }
        }
    }
    best
}

fn signum(x: &IBig) -> i32 {
    match x.cmp(&IBig::ZERO) {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}
