//! How often something was seen.

use serde::{Deserialize, Serialize};

/// The standard normal's 97.5 % quantile.
const Z: f64 = 1.959_963_984_540_054;

/// A share of some cases with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Share {
    /// How many were seen.
    pub seen: u32,
    /// Of how many.
    pub of: u32,
    /// Lower end of the interval (Wilson 1927).
    pub lo: f64,
    /// Upper end; where none was seen, three divided by the number of cases.
    pub hi: f64,
}

impl Share {
    /// `seen` of `of` cases.
    pub fn of(seen: u32, of: u32) -> Self {
        let n = f64::from(of);
        if of == 0 {
            return Self { seen, of, lo: 0.0, hi: 1.0 };
        }
        let p = f64::from(seen) / n;
        let (middle, half) = (p + Z * Z / (2.0 * n), Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt());
        let [lo, hi] = [middle - half, middle + half].map(|x| (x / (1.0 + Z * Z / n)).clamp(0.0, 1.0));
        match seen {
            0 => Self { seen, of, lo: 0.0, hi: (3.0 / n).min(1.0) },
            _ => Self { seen, of, lo, hi },
        }
    }

    /// The share itself; 0 of no cases.
    pub fn value(&self) -> f64 {
        if self.of == 0 { 0.0 } else { f64::from(self.seen) / f64::from(self.of) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_wilsons() {
        // 10 of 100, as computed by hand: (0.1 + 0.0192 -+ 0.0614) / 1.0384.
        let share = Share::of(10, 100);
        assert!((share.lo - 0.0552).abs() < 1e-4 && (share.hi - 0.1744).abs() < 1e-4, "{share:?}");
        assert_eq!((Share::of(0, 100).hi, Share::of(0, 0).hi), (0.03, 1.0));
    }
}
