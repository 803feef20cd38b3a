//! The configurations for which advice is given: what the scene will ask, as far as anybody can say beforehand.

use ocb_advice::Watch;
use ocb_core::configuration::{Method, Placed, Sampling, Separation};
use ocb_core::oracle::Shape;
use ocb_core::sampling::{Plan, SamplingError};
use rayon::prelude::*;

/// Configurations by the sphere method, the same number at every relative distance, in the order of their finding;
/// nothing when it was stopped.
///
/// Seeds give samples that have nothing to do with each other.
pub fn sample(
    [a, b]: [&Shape; 2],
    distances: &[f64],
    count: u32,
    seed: u64,
    what: &str,
    watch: &dyn Watch,
) -> Result<Vec<Placed>, SamplingError> {
    let each = count.div_ceil(distances.len().max(1) as u32);
    let mut all = Vec::new();
    for (number, &distance) in distances.iter().enumerate() {
        let method = Method::Sphere { sampling: Sampling::Count { count: each }, seed };
        let plan = Plan::new(a, b, &method, Separation::Relative { distance })?;
        let done = std::sync::atomic::AtomicU64::new(u64::from(each) * number as u64);
        let total = u64::from(each) * distances.len() as u64;
        let found: Option<Vec<_>> = (0..plan.units())
            .into_par_iter()
            .map(|unit| {
                let done = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                watch.step(what, done + 1, total);
                (!watch.stopped()).then(|| plan.place(unit))
            })
            .collect();
        all.extend(plan.gather(found.ok_or(SamplingError::Stopped)?).placed);
    }
    Ok(all)
}
