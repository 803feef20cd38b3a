//! Student's distribution, for few processes.

use std::f64::consts::FRAC_2_PI;

/// Beyond so many degrees of freedom it is the normal one to three digits; rounding down is the safe side.
const MOST: f64 = 200.0;

/// The `t` that is exceeded in size with probability `error`, with so many degrees of freedom, rounded down (at least 1).
pub fn quantile(error: f64, freedom: f64) -> f64 {
    // Nothing varies at all: any number will do.
    let freedom = if freedom.is_nan() { 1 } else { freedom.clamp(1.0, MOST) as u32 };
    let (mut lo, mut hi) = (0.0, 1.0);
    while exceeded(hi, freedom) > error {
        (lo, hi) = (hi, 2.0 * hi);
    }
    for _ in 0..60 {
        let middle = 0.5 * (lo + hi);
        if exceeded(middle, freedom) > error { lo = middle } else { hi = middle }
    }
    hi
}

/// Probability that `|T| > t`: a finite sum for whole degrees of freedom (Abramowitz and Stegun 26.7.3 and 26.7.4).
fn exceeded(t: f64, freedom: u32) -> f64 {
    let angle = t.atan2(f64::from(freedom).sqrt());
    let (sin, cos) = angle.sin_cos();
    let odd = freedom % 2 == 1;
    // The terms go up by two powers of the cosine each, up to the power freedom - 2.
    let (mut term, mut sum) = (if odd { cos } else { 1.0 }, 0.0);
    for k in 0..freedom / 2 {
        sum += term;
        let k = f64::from(2 * k + if odd { 2 } else { 1 });
        term *= cos * cos * k / (k + 1.0);
    }
    let within = if odd { FRAC_2_PI * (angle + sin * sum) } else { sin * sum };
    1.0 - within
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_agrees_with_the_printed_tables() {
        for (error, freedom, printed) in [
            (0.05, 1.0, 12.706),
            (0.05, 2.0, 4.303),
            (0.05, 4.0, 2.776),
            (0.05, 5.0, 2.571),
            (0.01, 4.9, 4.604),
            (0.01, 9.0, 3.250),
            (0.001, 30.0, 3.646),
            (0.001, 4.0, 8.610),
            (0.05, 1e9, 1.972),
        ] {
            assert!((quantile(error, freedom) - printed).abs() < 6e-4, "{error} {freedom}");
        }
        assert!(quantile(0.05, f64::NAN).is_finite());
    }
}
