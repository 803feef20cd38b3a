//! Times of ways to answer the same questions, in this process, one after the other.

use std::hint::black_box;
use std::time::Instant;

use ocb_advice::{Measured, Watch};
use ocb_core::configuration::Configuration;
use ocb_core::numbers::Numbers;
use ocb_core::statistics::bootstrap_interval;

/// A way to answer.
pub struct Way<'a> {
    ask: Box<dyn Fn(&Configuration) + 'a>,
    /// Of which configurations; of all, if it is empty.
    only: Vec<bool>,
}

impl Way<'_> {
    fn is_asked(&self, configuration: usize) -> bool {
        self.only.is_empty() || self.only[configuration]
    }
}

/// A way that asks, whatever the answer is.
pub fn way<'a, T>(ask: impl Fn(&Configuration) -> T + 'a) -> Way<'a> {
    way_of(Vec::new(), ask)
}

/// The same for these configurations only.
pub fn way_of<'a, T>(only: Vec<bool>, ask: impl Fn(&Configuration) -> T + 'a) -> Way<'a> {
    let ask = Box::new(move |configuration: &Configuration| {
        black_box(ask(configuration));
    });
    Way { ask, only }
}

/// For every way the nanoseconds of every configuration, the median of `passes`, and nothing where it is not asked; in
/// each pass every configuration is asked of all ways in turn, so that whatever disturbs the machine disturbs all of them.
/// The turns are drawn anew each time: a way that always came second would find the caches as the first one left them.
/// `None` when it was stopped.
pub fn times(
    ways: &[Way],
    configurations: &[Configuration],
    passes: usize,
    watch: &dyn Watch,
) -> Option<Vec<Vec<Option<f64>>>> {
    let mut all = vec![vec![Vec::with_capacity(passes); configurations.len()]; ways.len()];
    let total = (passes * configurations.len()) as u64;
    let mut turns: Vec<usize> = (0..ways.len()).collect();
    let mut numbers = Numbers::new(0);
    for pass in 0..passes {
        for (i, configuration) in configurations.iter().enumerate() {
            numbers.shuffle(&mut turns);
            for &turn in turns.iter().filter(|&&turn| ways[turn].is_asked(i)) {
                let start = Instant::now();
                (ways[turn].ask)(black_box(configuration));
                all[turn][i].push(start.elapsed().as_nanos() as f64);
            }
            watch.step("measuring", (pass * configurations.len() + i + 1) as u64, total);
            if watch.stopped() {
                return None;
            }
        }
    }
    let median = |mut times: Vec<f64>| -> Option<f64> {
        times.sort_unstable_by(f64::total_cmp);
        times.get(times.len() / 2).copied()
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

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use ocb_advice::Unwatched;
    use ocb_core::pose::Pose;

    use super::*;

    #[test]
    fn who_is_asked_about_some_has_times_of_these() {
        let configuration = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
        let (all, some) = (Cell::new(0), Cell::new(0));
        let ways = [way(|_| all.set(all.get() + 1)), way_of(vec![false, true, true], |_| some.set(some.get() + 1))];
        let measured = times(&ways, &[configuration; 3], 5, &Unwatched).expect("nobody stops it");
        assert_eq!((all.get(), some.get()), (15, 10));
        let there: Vec<Vec<bool>> = measured.iter().map(|times| times.iter().map(Option::is_some).collect()).collect();
        assert_eq!(there, [[true; 3], [false, true, true]]);
    }
}
