//! Times of ways to answer the same questions, in this process, one after the other.

use std::hint::black_box;
use std::time::Instant;

use ocb_core::configuration::{Configuration, Placed};
use ocb_core::numbers::Numbers;
use ocb_core::statistics::bootstrap_interval;
use serde::{Deserialize, Serialize};

use crate::watch::Watch;

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// A way to answer.
pub type Way<'a> = Box<dyn Fn(&Configuration) + 'a>;

/// A way that asks, whatever the answer is.
pub fn way<'a, T>(ask: impl Fn(&Configuration) -> T + 'a) -> Way<'a> {
    Box::new(move |configuration| {
        black_box(ask(configuration));
    })
}

/// For every way the nanoseconds of every configuration, the median of `passes`; in each pass every configuration is
/// asked of all ways in turn, so that whatever disturbs the machine disturbs all of them. The turns are drawn anew each time:
/// a way that always came second would find the caches as the first one left them. `None` when it was stopped.
pub fn times(ways: &[Way], configurations: &[Placed], passes: usize, watch: &dyn Watch) -> Option<Vec<Vec<f64>>> {
    let mut all = vec![vec![Vec::with_capacity(passes); configurations.len()]; ways.len()];
    let total = (passes * configurations.len()) as u64;
    let mut turns: Vec<usize> = (0..ways.len()).collect();
    let mut numbers = Numbers::new(0);
    for pass in 0..passes {
        for (i, placed) in configurations.iter().enumerate() {
            numbers.shuffle(&mut turns);
            for &turn in &turns {
                let start = Instant::now();
                ways[turn](black_box(&placed.configuration));
                all[turn][i].push(start.elapsed().as_nanos() as f64);
            }
            watch.step("measuring", (pass * configurations.len() + i + 1) as u64, total);
            if watch.stopped() {
                return None;
            }
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_unstable_by(f64::total_cmp);
        times[times.len() / 2]
    };
    Some(all.into_iter().map(|way| way.into_iter().map(median).collect()).collect())
}

/// The mean with its interval over the configurations.
pub fn mean(times: &[f64]) -> Measured {
    let mean = |x: &mut [f64]| x.iter().sum::<f64>() / x.len() as f64;
    let (lo, hi) = bootstrap_interval(times, mean, 0);
    Measured { value: mean(&mut times.to_vec()), lo, hi }
}

/// How many times as long the first takes for all configurations together, with its interval over them.
pub fn ratio(first: &[f64], second: &[f64]) -> Measured {
    let numbers: Vec<f64> = (0..first.len()).map(|i| i as f64).collect();
    let ratio = |x: &mut [f64]| {
        let sum = |times: &[f64]| x.iter().map(|&i| times[i as usize]).sum::<f64>();
        sum(first) / sum(second)
    };
    let (lo, hi) = bootstrap_interval(&numbers, ratio, 0);
    Measured { value: ratio(&mut numbers.clone()), lo, hi }
}
