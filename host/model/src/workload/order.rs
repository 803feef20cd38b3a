//! What the order of a recording is worth to an algorithm.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{AlgorithmOnWorkload, Track, TrackResult};

/// How many times as fast an algorithm answers the queries of a recording in their order as in random order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct OrderGain {
    /// Algorithm id.
    pub algorithm: String,
    /// Total time in random order over that in the order of the recording. Below 1, the order slows it down.
    pub ratio: f64,
    /// Smallest ratio of any round in random order to any in the order of the recording.
    pub lowest: f64,
    /// Largest such ratio.
    pub highest: f64,
    /// There were several rounds, and those of both orders do not overlap: the order makes a difference.
    pub told_apart: bool,
}

impl OrderGain {
    /// None if not all queries were measured in both orders.
    fn of(shuffled: &AlgorithmOnWorkload, recorded: &AlgorithmOnWorkload) -> Option<Self> {
        let all = |it: &AlgorithmOnWorkload| it.n == it.of && it.ended.is_empty();
        let (from, to) = (shuffled.total?, recorded.total?);
        if !(all(shuffled) && all(recorded) && to.ns > 0.0 && to.lowest_ns > 0.0) {
            return None;
        }
        let ratio = from.ns / to.ns;
        // The sum of medians may lie outside the sums of the rounds.
        let (lowest, highest) = (ratio.min(from.lowest_ns / to.highest_ns), ratio.max(from.highest_ns / to.lowest_ns));
        let repeated = from.lowest_ns < from.highest_ns && to.lowest_ns < to.highest_ns;
        let told_apart = repeated && (lowest > 1.0 || highest < 1.0);
        Some(Self { algorithm: shuffled.algorithm.clone(), ratio, lowest, highest, told_apart })
    }
}

/// The gain of each algorithm that was asked all of its queries in both orders, the largest first.
pub fn order_gains(tracks: &[TrackResult]) -> Vec<OrderGain> {
    let of = |track| tracks.iter().find(|it| it.track == track);
    let (Some(shuffled), Some(recorded)) = (of(Track::Shuffled), of(Track::Recorded)) else { return Vec::new() };
    let gain = |it: &AlgorithmOnWorkload| {
        let same = recorded.algorithms.iter().find(|other| other.algorithm == it.algorithm)?;
        OrderGain::of(it, same)
    };
    let mut gains: Vec<OrderGain> = shuffled.algorithms.iter().filter_map(gain).collect();
    gains.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    gains
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TotalTime;

    fn measured(algorithm: &str, n: u64, [ns, lowest_ns, highest_ns]: [f64; 3]) -> AlgorithmOnWorkload {
        AlgorithmOnWorkload {
            algorithm: algorithm.to_owned(),
            name: String::new(),
            of: 10,
            n,
            total: Some(TotalTime { ns, lowest_ns, highest_ns }),
            build_ns: 0.0,
            wrong: 0,
            missed: 0,
            undecided: 0,
            silent: 0,
            groups: None,
            pairs: Vec::new(),
            ended: Vec::new(),
        }
    }

    fn tracks(shuffled: Vec<AlgorithmOnWorkload>, recorded: Vec<AlgorithmOnWorkload>) -> Vec<TrackResult> {
        let of = |track, algorithms| TrackResult { track, algorithms };
        vec![of(Track::Recorded, recorded), of(Track::Shuffled, shuffled)]
    }

    #[test]
    fn a_gain_is_told_only_where_the_rounds_of_both_orders_do_not_overlap() {
        let gains = order_gains(&tracks(
            vec![
                measured("steady", 10, [100.0, 95.0, 110.0]),
                measured("coherent", 10, [400.0, 390.0, 420.0]),
                measured("slowed", 10, [50.0, 45.0, 55.0]),
                measured("once", 10, [400.0, 400.0, 400.0]),
            ],
            vec![
                measured("coherent", 10, [100.0, 98.0, 120.0]),
                measured("steady", 10, [98.0, 90.0, 105.0]),
                measured("slowed", 10, [100.0, 90.0, 110.0]),
                measured("once", 10, [200.0, 200.0, 200.0]),
            ],
        ));
        let told: Vec<(&str, f64, bool)> = gains.iter().map(|it| (&*it.algorithm, it.ratio, it.told_apart)).collect();
        assert_eq!(
            told,
            [("coherent", 4.0, true), ("once", 2.0, false), ("steady", 100.0 / 98.0, false), ("slowed", 0.5, true)]
        );
        assert_eq!((gains[0].lowest, gains[0].highest), (390.0 / 120.0, 420.0 / 98.0));
    }

    #[test]
    fn a_ratio_lies_within_its_range_though_a_sum_of_medians_may_not() {
        let gains = order_gains(&tracks(
            vec![measured("a", 10, [80.0, 90.0, 95.0])],
            vec![measured("a", 10, [100.0, 99.0, 101.0])],
        ));
        assert!(gains[0].lowest <= gains[0].ratio && gains[0].ratio <= gains[0].highest, "{gains:?}");
    }

    #[test]
    fn only_whole_replays_in_both_orders_are_compared() {
        let time = [100.0, 95.0, 110.0];
        let part = tracks(vec![measured("a", 9, time)], vec![measured("a", 10, time)]);
        assert_eq!(order_gains(&part), []);
        let other = tracks(vec![measured("a", 10, time)], vec![measured("b", 10, time)]);
        assert_eq!(order_gains(&other), []);
        assert_eq!(order_gains(&part[..1]), []);
    }
}
