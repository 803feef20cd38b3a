//! Was an algorithm kept from its CPU far more than the reference algorithm in the same rounds?
//!
//! What it certainly waited is taken off its times, to some microseconds. Where that is most of the time, and the reference was
//! left in peace, the rest is no comparison. On a machine that is busy for all, all wait alike.

use ocb_core::statistics::Statistic;
use ocb_sandbox::PassFacts;

use crate::model::UnrankedCause;

/// Waiting for more than this share of the time, and so many times the reference's share, takes the rank away.
const SHARE: f64 = 0.5;
const TIMES: f64 = 5.0;
/// Who computed for less, nanoseconds, may have met one time slice or none.
const LEAST_NS: f64 = 1e7;

/// The cause, if it was.
pub fn kept_waiting(own: &[PassFacts], reference: &[PassFacts]) -> Option<UnrankedCause> {
    let sum = |of: &[PassFacts], i: usize| of.iter().map(|pass| pass.asked_ns[i]).sum::<f64>();
    let computed_ns = |of: &[PassFacts]| sum(of, 0) - sum(of, 1);
    if computed_ns(own).min(computed_ns(reference)) < LEAST_NS {
        return None;
    }
    let asked = own.iter().filter(|pass| pass.asked_ns[0] > 0.0);
    let share = Statistic::Median.of(&mut asked.map(|pass| pass.asked_ns[1] / pass.asked_ns[0]).collect::<Vec<_>>())?;
    let reference = sum(reference, 1) / sum(reference, 0);
    (share > SHARE && share > TIMES * reference).then_some(UnrankedCause::KeptWaiting { share, reference })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Five processes that computed for 10 ms each and waited so long, ms.
    fn passes(waited: [f64; 5]) -> Vec<PassFacts> {
        waited.map(|ms| PassFacts { asked_ns: [1e7 + ms * 1e6, ms * 1e6], ..PassFacts::default() }).to_vec()
    }

    #[test]
    fn who_alone_is_kept_from_its_cpu_has_no_rank() {
        let (peace, waits) = (passes([0.0, 0.1, 0.0, 0.0, 0.2]), passes([30.0, 30.0, 0.0, 30.0, 0.0]));
        let cause = kept_waiting(&waits, &peace).unwrap();
        assert!(matches!(cause, UnrankedCause::KeptWaiting { share, .. } if (share - 0.75).abs() < 1e-9), "{cause:?}");
        // Two processes of five do not move a median, and where all wait nobody is singled out.
        assert_eq!(kept_waiting(&passes([30.0, 30.0, 0.0, 0.0, 0.0]), &peace), None);
        assert_eq!(kept_waiting(&waits, &passes([3.0; 5])), None);
        // A few questions meet a time slice or they do not.
        let short = |ms: f64| vec![PassFacts { asked_ns: [1e6 + ms * 1e6, ms * 1e6], ..PassFacts::default() }; 5];
        assert_eq!(kept_waiting(&short(4.0), &peace), None);
        assert_eq!(kept_waiting(&waits, &short(0.0)), None);
        assert_eq!(kept_waiting(&waits, &[]), None);
    }
}
