//! The configurations for which advice is given: what the scene will ask, as far as anybody can say beforehand.

use ocb_core::configuration::{Method, Placed, Sampling, Separation};
use ocb_core::oracle::Shape;
use ocb_core::sampling::{Plan, SamplingError};
use rayon::prelude::*;

use crate::question::Question;
use crate::watch::Watch;

/// So many configurations are a good sample to choose by.
pub const CONFIGURATIONS: u32 = 400;
/// And so many others to check by.
pub const HELD_OUT: u32 = 1_000;
/// Relative distances of a scene that asks how far apart the objects are.
const DISTANCES: [f64; 4] = [0.003, 0.03, 0.1, 0.3];
/// The same for a clearance, as shares of it: on both sides, more and more clearly.
const AROUND: [f64; 6] = [0.25, 0.75, 1.25, 2.0, 4.0, 8.0];

/// Relative distances (surface distance over A's longest side) that fit a question.
pub fn usual_distances(question: Question, longest_side: f64) -> Vec<f64> {
    match question {
        Question::Clearance { clearance } if clearance > 0.0 => AROUND.map(|x| x * clearance / longest_side).to_vec(),
        Question::Clearance { .. } | Question::Distance { .. } => DISTANCES.to_vec(),
    }
}

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
