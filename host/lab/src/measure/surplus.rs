//! Work that a process did with its questions although it belongs to building.
//!
//! A structure may be built with the first question, or a piece with each of many. Such a question takes longer in that
//! process than in others, and the median over processes would hide it. So what a process took beyond what its questions
//! usually take is counted as building: all of it where it is much, and else what single questions took far beyond.

use ocb_core::statistics::{Statistic, quantile};

/// A question that took longer than twice its usual time and so much more met something else than its own work.
const FAR_NS: f64 = 20_000.0;
/// More than this share of all questions' usual time is no noise.
const MUCH: f64 = 0.1;
/// Fewer times do not tell what is usual for a question.
const TIMES: usize = 3;
/// Then it is what this share of the process's questions take at most.
const USUAL: f64 = 0.95;

/// What a question usually takes, from its times in all processes; nothing from too few.
pub fn usual(times: &[(u32, f64)]) -> Option<f64> {
    let mut all: Vec<f64> = times.iter().map(|(_, ns)| *ns).collect();
    Statistic::Median.of(&mut all).filter(|_| times.len() >= TIMES)
}

/// The surplus of one process, nanoseconds: for each of its questions the configuration and the time. `usual` is what that
/// configuration usually takes.
pub fn surplus_ns(asked: &[(u32, f64)], usual: impl Fn(u32) -> Option<f64>) -> f64 {
    if asked.is_empty() {
        return 0.0;
    }
    let known: Option<Vec<[f64; 2]>> =
        asked.iter().map(|&(configuration, ns)| Some([ns, usual(configuration)?])).collect();
    let told = known.is_some();
    let within = known.unwrap_or_else(|| {
        let mut sorted: Vec<f64> = asked.iter().map(|(_, ns)| *ns).collect();
        sorted.sort_by(f64::total_cmp);
        let most = quantile(&sorted, USUAL);
        asked.iter().map(|&(_, ns)| [ns, ns.min(most)]).collect()
    });
    let far: f64 = within.iter().filter(|[ns, usual]| *ns > 2.0 * usual + FAR_NS).map(|[ns, usual]| ns - usual).sum();
    let all: f64 = within.iter().map(|[ns, usual]| ns - usual).sum();
    let expected: f64 = within.iter().map(|[_, usual]| usual).sum();
    if told && all > MUCH * expected { all.max(far) } else { far }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A process of a thousand questions of 10 us, some of which take more.
    fn surplus(processes: usize, more: impl Fn(usize) -> f64) -> f64 {
        let asked: Vec<(u32, f64)> = (0..1000).map(|i| (i as u32, 10_000.0 + more(i))).collect();
        let times = vec![(0, 10_000.0); processes];
        surplus_ns(&asked, |_| usual(&times))
    }

    #[test]
    fn noise_is_no_surplus() {
        assert_eq!(surplus_ns(&[], |_| None), 0.0);
        assert_eq!(surplus(5, |i| [-500.0, 500.0][i % 2]), 0.0);
        // Cold caches in the first questions, and a machine that is a little slower all the time.
        assert_eq!(surplus(5, |i| if i < 20 { 15_000.0 } else { 0.0 }), 0.0);
        assert_eq!(surplus(5, |_| 800.0), 0.0);
        assert_eq!(surplus(1, |i| (i % 100) as f64), 0.0);
    }

    #[test]
    fn what_is_built_with_questions_is_found_to_the_last_nanosecond() {
        for processes in [1, 5] {
            // All with one question.
            let found = surplus(processes, |i| if i == 0 { 3e7 } else { 0.0 });
            assert_eq!(found, 3e7, "{processes}");
        }
        // A piece with each of many, each piece too small to stand out.
        assert_eq!(surplus(5, |i| if i < 300 { 15_000.0 } else { 0.0 }), 300.0 * 15_000.0);
        assert_eq!(surplus(5, |_| 2_000.0), 2e6);
    }
}
