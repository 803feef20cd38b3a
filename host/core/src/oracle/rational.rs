//! A non-negative fraction of integers and the f64 neighbours of its square root.

use dashu_int::{
    IBig, UBig,
    ops::{BitTest, SquareRoot},
};

/// `numerator / denominator`, both kept exactly; the denominator is positive.
pub(super) struct Ratio {
    numerator: UBig,
    denominator: UBig,
}

impl Ratio {
    pub(super) fn new(numerator: IBig, denominator: IBig) -> Self {
        let magnitude = |x: IBig| x.into_parts().1;
        Self { numerator: magnitude(numerator), denominator: magnitude(denominator) }
    }

    pub(super) fn less_than(&self, other: &Self) -> bool {
        &self.numerator * &other.denominator < &other.numerator * &self.denominator
    }

    /// `sqrt(self) * 2^exponent` between two f64 numbers: equal when it is one, neighbours otherwise.
    pub(super) fn sqrt(&self, exponent: i32) -> (f64, f64) {
        if self.numerator == UBig::ZERO {
            return (0.0, 0.0);
        }
        // Scale by 4^k so that the quotient has 125 to 128 bits and its integer root 63 or 64.
        let excess = self.numerator.bit_len() as i64 - self.denominator.bit_len() as i64;
        let k = (126 - excess).div_euclid(2);
        let (scaled, lost) = if k >= 0 {
            (&self.numerator << (2 * k) as usize, false)
        } else {
            let shift = (-2 * k) as usize;
            (&self.numerator >> shift, self.numerator.trailing_zeros().unwrap_or(0) < shift)
        };
        let quotient = &scaled / &self.denominator;
        let root = quotient.sqrt();
        let exact = !lost && &root * &root * &self.denominator == scaled;
        let root = u128::try_from(&root).expect("the root of a number of 128 bits has 64");
        enclose(root, exact, exponent as i64 - k)
    }
}

/// `[lo, hi]` around `x * 2^exponent`, where the true factor is `x` or, unless `exact`, in `(x, x + 1)`.
fn enclose(x: u128, exact: bool, exponent: i64) -> (f64, f64) {
    let drop = (128 - x.leading_zeros()).saturating_sub(53);
    let head = x >> drop;
    let exact = exact && head << drop == x;
    let exponent = exponent + i64::from(drop);
    let scale = |m: u128| {
        // Two exact factors, because 2^exponent alone may leave the range although the product does not.
        let half = (exponent / 2).clamp(-1020, 1020) as i32;
        let rest = (exponent - i64::from(half)).clamp(-1020, 1020) as i32;
        m as f64 * 2f64.powi(half) * 2f64.powi(rest)
    };
    let (lo, hi) = (scale(head), scale(if exact { head } else { head + 1 }));
    // Below the normal range the scaling itself rounds: step outward.
    if lo < f64::MIN_POSITIVE { (lo.next_down().max(0.0), hi.next_up()) } else { (lo, hi) }
}
