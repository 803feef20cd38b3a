use proptest::prelude::*;

use super::*;

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (1.0 + a.abs().max(b.abs()))
}

#[test]
fn each_statistic_by_hand() {
    let of = |s: Statistic| s.of(&mut [7.0, 1.0, 3.0, 1.0, 8.0]).unwrap();
    assert_eq!(of(Statistic::Mean), 4.0);
    assert_eq!(of(Statistic::Median), 3.0);
    assert_eq!(of(Statistic::Min), 1.0);
    assert_eq!(of(Statistic::Max), 8.0);
    // Deviations 3 -3 -1 -3 4: squares sum to 44.
    assert!(close(of(Statistic::StandardDeviation), (44.0f64 / 5.0).sqrt()));
    // Distances to 3: 4 2 0 2 5.
    assert_eq!(of(Statistic::Mad), 2.0);
}

#[test]
fn even_counts_take_the_middle_of_two() {
    assert_eq!(Statistic::Median.of(&mut [4.0, 1.0, 2.0, 8.0]), Some(3.0));
    // Distances to 3: 1 2 1 5.
    assert_eq!(Statistic::Mad.of(&mut [4.0, 1.0, 2.0, 8.0]), Some(1.5));
}

#[test]
fn nothing_has_no_statistic_and_one_value_is_itself() {
    use Statistic::*;
    for s in [Mean, Median, Min, Max, StandardDeviation, Mad] {
        assert_eq!(s.of(&mut []), None);
        let expected = if matches!(s, StandardDeviation | Mad) { 0.0 } else { 5.0 };
        assert_eq!(s.of(&mut [5.0]), Some(expected));
    }
}

#[test]
fn quantiles_are_of_type_seven() {
    let values = [1.0, 2.0, 4.0, 8.0];
    for (q, expected) in [(0.0, 1.0), (0.25, 1.75), (0.5, 3.0), (0.75, 5.0), (0.95, 7.4), (1.0, 8.0)] {
        assert!(close(quantile(&values, q), expected), "{q}");
    }
    assert_eq!(quantile(&[3.0], 0.7), 3.0);
}

#[test]
fn the_fence_reaches_one_and_a_half_interquartile_ranges() {
    // Quartiles 2 and 4: fence -1 to 7; its ends are no outliers.
    let fence = iqr_fence(&[1.0, 2.0, 3.0, 4.0, 100.0]);
    assert_eq!(fence, Fence { lo: -1.0, hi: 7.0 });
    assert!(fence.contains(7.0) && fence.contains(-1.0) && !fence.contains(7.001));
    assert!(iqr_fence(&[]).contains(1e300));
}

#[test]
fn the_bootstrap_is_repeatable_and_near_the_normal_interval() {
    let values: Vec<f64> = (0..400).map(|i| f64::from(i % 20)).collect();
    let mean = |v: &mut [f64]| Statistic::Mean.of(v).unwrap();
    let (lo, hi) = bootstrap_interval(&values, mean, 7);
    assert_eq!(bootstrap_interval(&values, mean, 7), (lo, hi));
    assert_ne!(bootstrap_interval(&values, mean, 8), (lo, hi));
    // Mean 9.5, standard deviation sqrt((400 - 1) / 12) = 5.766: 1.96 standard errors are 0.565.
    assert!((lo - (9.5 - 0.565)).abs() < 0.08 && (hi - (9.5 + 0.565)).abs() < 0.08, "{lo} {hi}");
}

#[test]
fn the_maximum_is_bounded_from_below_only() {
    assert_eq!(maximum_interval(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]), (2.0, 7.0));
    assert_eq!(maximum_interval(&[3.0]), (3.0, 3.0));
}

#[test]
fn short_distributions_are_exact() {
    assert_eq!(ecdf(&[1.0, 2.0, 2.0, 5.0], 512), [(1.0, 0.25), (2.0, 0.75), (5.0, 1.0)]);
    assert_eq!(ecdf(&[], 512), []);
    assert_eq!(ecdf(&[4.0], 2), [(4.0, 1.0)]);
}

proptest! {
    #[test]
    fn selection_agrees_with_sorting(mut values in prop::collection::vec(-1e6..1e6f64, 1..200), q in 0.0..=1.0f64) {
        let median = Statistic::Median.of(&mut values.clone()).unwrap();
        let selected = select_quantile(&mut values.clone(), q);
        values.sort_unstable_by(f64::total_cmp);
        prop_assert!(close(median, quantile(&values, 0.5)));
        prop_assert!(close(selected, quantile(&values, q)));
    }

    #[test]
    fn long_distributions_keep_both_ends_and_stay_monotone(mut values in prop::collection::vec(0u32..1_000, 1..2_000)) {
        values.sort_unstable();
        let values: Vec<f64> = values.into_iter().map(f64::from).collect();
        let points = ecdf(&values, 64);
        prop_assert!(points.len() <= 64);
        prop_assert_eq!(points[0].0, values[0]);
        prop_assert_eq!(points[points.len() - 1], (values[values.len() - 1], 1.0));
        prop_assert!(points.windows(2).all(|w| w[0].0 < w[1].0 && w[0].1 < w[1].1));
        for (x, share) in points {
            prop_assert_eq!(share, values.iter().filter(|&&y| y <= x).count() as f64 / values.len() as f64);
        }
    }
}

#[test]
fn shares_have_wilsons_interval_and_nothing_seen_has_a_bound() {
    // Newcombe (1998), table I, method 3: 81 of 263 and 15 of 148.
    for (count, n, expected) in [(81, 263, [0.2553, 0.3662]), (15, 148, [0.0624, 0.1605])] {
        let (lo, hi) = share_interval(count, n);
        assert!((lo - expected[0]).abs() < 5e-5 && (hi - expected[1]).abs() < 5e-5, "{lo} {hi}");
    }
    assert_eq!(share_interval(0, 300), (0.0, 0.01));
    assert_eq!(share_interval(0, 1), (0.0, 1.0));
    assert!(share_interval(5, 5).1 >= 1.0 - 1e-12);
}
