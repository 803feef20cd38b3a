//! The sphere method: B stands on a sphere around A in some rotation and is moved toward A until the surfaces are the
//! wanted distance apart [OpenCollBench 2020, 3.1; Trenkel 2007].

use super::approach::Approach;
use super::low_discrepancy::{self, Sample};
use super::paper_pattern::Pattern;
use crate::configuration::{Placed, Sampling, Separation};
use crate::oracle::Shape;

/// No set has more configurations than this.
pub const MAX_CONFIGURATIONS: u64 = 10_000_000;

/// Why no set can be sampled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SamplingError {
    /// A set of none.
    #[error("the number of configurations must be at least 1")]
    NoConfigurations,
    /// More than [`MAX_CONFIGURATIONS`].
    #[error(
        "{0} configurations are too many; at most {MAX_CONFIGURATIONS} are possible: choose larger steps or a smaller number"
    )]
    TooMany(u64),
    /// Steps outside (0, 180].
    #[error("{name} must be more than 0 and at most 180 degrees, not {value}")]
    Degrees {
        /// Which step.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// Negative, infinite or not a number.
    #[error("the relative distance must be a number from 0 to 1000, not {0}")]
    RelativeDistance(f64),
}

/// Number of rays, known before anything is computed.
///
/// [`Sampling::Steps`] and [`Sampling::PaperCompat`] give the number of the paper's pattern with arc steps,
/// `rows(move) * rows(rotate) * round(360/rotate)` where `rows(s)` is the sum over `k < round(180/s)` of
/// `round(360/s * sin((k + 1/2) * 180/round(180/s)))`: 194,688 for 20 and 20 degrees.
pub fn count(sampling: &Sampling) -> Result<u64, SamplingError> {
    let n = match *sampling {
        Sampling::Count { count } => u64::from(count),
        Sampling::Steps { rotate, move_by } | Sampling::PaperCompat { rotate, move_by } => {
            check_degrees("rotate-by", rotate)?;
            check_degrees("move-by", move_by)?;
            // The pattern itself is only laid out when it is not absurdly fine.
            let estimate = (4.0 * std::f64::consts::PI / move_by.to_radians().powi(2))
                * (8.0 * std::f64::consts::PI.powi(2) / rotate.to_radians().powi(3));
            if estimate > 2.0 * MAX_CONFIGURATIONS as f64 {
                return Err(SamplingError::TooMany(estimate as u64));
            }
            Pattern::new(rotate, move_by).len()
        }
    };
    match n {
        0 => Err(SamplingError::NoConfigurations),
        n if n > MAX_CONFIGURATIONS => Err(SamplingError::TooMany(n)),
        n => Ok(n),
    }
}

fn check_degrees(name: &'static str, value: f64) -> Result<(), SamplingError> {
    // Written so that NaN fails. Below 0.01 degrees one circle alone has 36,000 places.
    if value > 0.01 && value <= 180.0 { Ok(()) } else { Err(SamplingError::Degrees { name, value }) }
}

/// What to sample; [`Plan::place`] may be called from many threads.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    approach: Approach<'a>,
    pattern: Option<Pattern>,
    len: u64,
    seed: u64,
}

impl<'a> Plan<'a> {
    /// Plans the rays; nothing is placed yet.
    pub fn new(
        a: &'a Shape,
        b: &'a Shape,
        sampling: &Sampling,
        relative_distance: f64,
        seed: u64,
    ) -> Result<Self, SamplingError> {
        let len = count(sampling)?;
        if !(0.0..=1000.0).contains(&relative_distance) {
            return Err(SamplingError::RelativeDistance(relative_distance));
        }
        let pattern = match *sampling {
            Sampling::PaperCompat { rotate, move_by } => Some(Pattern::new(rotate, move_by)),
            Sampling::Steps { .. } | Sampling::Count { .. } => None,
        };
        let separation = Separation::Relative { distance: relative_distance };
        Ok(Self { approach: Approach::new(a, b, separation), pattern, len, seed })
    }

    /// Number of rays.
    pub fn len(&self) -> u64 {
        self.len
    }

    /// Never: a plan has at least one ray.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Configuration `index`, a pure function of it; `None` when B never comes that close on its ray.
    ///
    /// A stands where its file puts it; B is rotated about the centre of its bounding box, which moves along a ray through
    /// the centre of A's. The certified distance is within `tau32` of the relative distance times
    /// L, and for relative distance 0 it lies in `(2 tau32, 4 tau32]` (see
    /// [`Pair::tau`](crate::oracle::Pair::tau)), so that the question is fair
    /// even to an algorithm that computes in single precision.
    pub fn place(&self, index: u64) -> Option<Placed> {
        assert!(index < self.len, "configuration {index} of {}", self.len);
        let (direction, rotation): Sample = match &self.pattern {
            Some(pattern) => pattern.sample(index),
            None => low_discrepancy::sample(index, self.seed),
        };
        self.approach.place(&direction, &rotation)
    }
}
