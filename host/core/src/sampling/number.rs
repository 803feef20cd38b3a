//! How many configurations a method gives, known before anything is computed.

use super::paper_pattern::Pattern;
use super::{MAX_CONFIGURATIONS, SamplingError};
use crate::configuration::{Method, Sampling};

/// Number of configurations before any is missed; the grid's steps give about so many. 0 for a file.
///
/// [`Sampling::Steps`] and [`Sampling::PaperCompat`] give the number of the paper's pattern with arc steps,
/// `rows(move) * rows(rotate) * round(360/rotate)` where `rows(s)` is the sum over `k < round(180/s)` of
/// `round(360/s * sin((k + 1/2) * 180/round(180/s)))`: 194,688 for 20 and 20 degrees.
pub fn count(method: &Method) -> Result<u64, SamplingError> {
    let n = match *method {
        Method::Sphere { sampling, .. } | Method::Grid { sampling, .. } => of_sampling(&sampling)?,
        Method::Trajectory { center_distance, count } => {
            // Written so that NaN fails.
            if !(0.0..=1000.0).contains(&center_distance) {
                return Err(SamplingError::CenterDistance(center_distance));
            }
            u64::from(count)
        }
        Method::Random { count, hit_share, .. } => {
            if !(hit_share > 0.0 && hit_share < 1.0) {
                return Err(SamplingError::HitShare(hit_share));
            }
            u64::from(count)
        }
        Method::File { .. } => return Ok(0),
    };
    match n {
        0 => Err(SamplingError::NoConfigurations),
        n if n > MAX_CONFIGURATIONS => Err(SamplingError::TooMany(n)),
        n => Ok(n),
    }
}

fn of_sampling(sampling: &Sampling) -> Result<u64, SamplingError> {
    match *sampling {
        Sampling::Count { count } => Ok(u64::from(count)),
        Sampling::Steps { rotate, move_by } | Sampling::PaperCompat { rotate, move_by } => {
            check_degrees("rotate-by", rotate)?;
            check_degrees("move-by", move_by)?;
            // The pattern itself is only laid out when it is not absurdly fine.
            let estimate = (4.0 * std::f64::consts::PI / move_by.to_radians().powi(2))
                * (8.0 * std::f64::consts::PI.powi(2) / rotate.to_radians().powi(3));
            if estimate > 2.0 * MAX_CONFIGURATIONS as f64 {
                return Err(SamplingError::TooMany(estimate as u64));
            }
            Ok(Pattern::new(rotate, move_by).len())
        }
    }
}

fn check_degrees(name: &'static str, value: f64) -> Result<(), SamplingError> {
    // Written so that NaN fails. Below 0.01 degrees one circle alone has 36,000 places.
    if value > 0.01 && value <= 180.0 { Ok(()) } else { Err(SamplingError::Degrees { name, value }) }
}
