use nalgebra::Point3;
use proptest::prelude::*;

use super::*;

/// Two triangles over the edge 1-2, and a vertex that no triangle uses:
///
/// ```text
/// 2---3
/// |\  |      4
/// | \ |
/// 0---1
/// ```
fn strip() -> Mesh {
    let corners = [(0., 0.), (1., 0.), (0., 1.), (1., 1.), (3., 0.)];
    let positions = corners.iter().map(|&(x, y)| Point3::new(x, y, 0.0)).collect();
    Mesh::new(positions, vec![[0, 1, 2], [1, 3, 2]]).unwrap()
}

/// Five configurations: three on the first triangle (10, 20, 90), two on the second (30, 50).
fn five() -> VertexMap {
    VertexMap::new(&strip(), &[0, 0, 1, 1, 0])
}
const VALUES: [f64; 5] = [10.0, 20.0, 30.0, 50.0, 90.0];

#[track_caller]
fn check(statistic: Statistic, expected: [f64; 3]) {
    let got = five().aggregate(&VALUES, statistic, Outliers::Keep);
    let [first, edge, second] = expected;
    for (v, expected) in [(0, first), (1, edge), (2, edge), (3, second)] {
        let value = got.values[v].unwrap();
        assert!((value - expected).abs() < 1e-12, "{statistic:?} at vertex {v}: {value}, by hand {expected}");
    }
    assert_eq!(got.values[4], None);
    assert_eq!(got.counts, [3, 5, 5, 2, 0]);
    assert_eq!(got.dropped, [0; 5]);
}

#[test]
fn every_statistic_by_hand() {
    // Vertex 0 hears 10 20 90, vertex 3 hears 30 50, the vertices of the common edge hear all five.
    check(Statistic::Mean, [120.0 / 3.0, 200.0 / 5.0, 80.0 / 2.0]);
    check(Statistic::Median, [20.0, 30.0, 40.0]);
    check(Statistic::Min, [10.0, 10.0, 30.0]);
    check(Statistic::Max, [90.0, 90.0, 50.0]);
    // Squared deviations from 40: 900 400 2500; 900 400 100 100 2500; 100 100.
    check(Statistic::StandardDeviation, [(3800.0f64 / 3.0).sqrt(), 800.0f64.sqrt(), 10.0]);
    // Distances to the median: 10 0 70; 20 10 0 20 60; 10 10.
    check(Statistic::Mad, [10.0, 20.0, 10.0]);
}

#[test]
fn density_counts_configurations() {
    let density = five().density(None);
    assert_eq!(density.values, [3.0, 5.0, 5.0, 2.0, 0.0].map(Some));
    assert_eq!(density.range(), Some([0.0, 5.0]));
    let chosen = five().density(Some(&[true, false, true, false, true]));
    assert_eq!(chosen.counts, [2, 3, 3, 1, 0]);
}

#[test]
fn the_global_fence_is_that_of_all_configurations() {
    // Quartiles of 10 20 30 50 96 are 20 and 50: the fence ends at 95.
    let got = five().aggregate(&[10.0, 20.0, 30.0, 50.0, 96.0], Statistic::Mean, Outliers::Global);
    assert_eq!(got.values, [Some(15.0), Some(27.5), Some(27.5), Some(40.0), None]);
    assert_eq!((got.counts, got.dropped), (vec![2, 4, 4, 2, 0], vec![1, 1, 1, 0, 0]));
    // With 95 instead, nothing lies outside.
    let got = five().aggregate(&[10.0, 20.0, 30.0, 50.0, 95.0], Statistic::Max, Outliers::Global);
    assert_eq!((got.values[0], got.dropped), (Some(95.0), vec![0; 5]));
}

#[test]
fn a_vertex_whose_values_are_all_outliers_has_none_but_says_so() {
    let map = VertexMap::new(&strip(), &[0, 0, 0, 0, 0, 0, 0, 1]);
    let got = map.aggregate(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 1e6], Statistic::Median, Outliers::Global);
    assert_eq!((got.values[3], got.counts[3], got.dropped[3]), (None, 0, 1));
}

#[test]
fn a_vertex_needs_eight_values_for_a_fence_of_its_own() {
    let aggregate = |n: usize| {
        let mut values: Vec<f64> = (1..n).map(|i| i as f64).collect();
        values.push(1_000.0);
        VertexMap::new(&strip(), &vec![0; n]).aggregate(&values, Statistic::Max, Outliers::PerVertex)
    };
    assert_eq!((aggregate(7).values[0], aggregate(7).dropped[0]), (Some(1_000.0), 0));
    assert_eq!((aggregate(8).values[0], aggregate(8).dropped[0]), (Some(7.0), 1));
}

#[test]
fn what_was_not_measured_counts_nowhere() {
    let got = five().aggregate(&[10.0, f64::NAN, 30.0, 50.0, f64::NAN], Statistic::Mean, Outliers::Global);
    assert_eq!(got.values, [Some(10.0), Some(30.0), Some(30.0), Some(40.0), None]);
    assert_eq!((got.counts, got.dropped), (vec![1, 3, 3, 2, 0], vec![0; 5]));
}

#[test]
fn a_difference_has_a_value_where_both_maps_have_one() {
    let map = five();
    let a = map.aggregate(&VALUES, Statistic::Mean, Outliers::Keep);
    let b = map.aggregate(&[1.0, f64::NAN, f64::NAN, f64::NAN, 3.0], Statistic::Mean, Outliers::Keep);
    let difference = a.minus(&b).unwrap();
    assert_eq!(difference.values, [Some(38.0), Some(38.0), Some(38.0), None, None]);
    assert_eq!(difference.counts, [2, 2, 2, 0, 0]);
    assert_eq!(b.minus(&a).unwrap().range(), Some([-38.0, -38.0]));
    let short = VertexValues { values: vec![None], counts: vec![0], dropped: vec![0] };
    assert_eq!(a.minus(&short), None);
}

#[test]
fn a_vertex_named_twice_hears_once() {
    let mesh = strip();
    let mut triangles = mesh.triangles().to_vec();
    triangles.push([3, 3, 0]);
    let mesh = Mesh::new(mesh.positions().to_vec(), triangles).unwrap();
    assert_eq!(VertexMap::new(&mesh, &[2, 2]).density(None).counts, [2, 0, 0, 2, 0]);
}

#[test]
fn nothing_measured_gives_an_empty_map() {
    let got = VertexMap::new(&strip(), &[]).aggregate(&[], Statistic::Mean, Outliers::Global);
    assert_eq!((got.range(), got.counts), (None, vec![0; 5]));
}

/// A mesh of random triangles over `n` vertices, and random configurations on it.
fn scene() -> impl Strategy<Value = (Mesh, Vec<u32>, Vec<f64>)> {
    (3usize..20, 1usize..30, 0usize..200).prop_flat_map(|(n, m, k)| {
        let index = 0..n as u32;
        let triangles = prop::collection::vec([index.clone(), index.clone(), index], m);
        let on = prop::collection::vec((0..=m as u32, 0.0..1e3f64, 0..20), k);
        (triangles, on).prop_map(move |(mut triangles, on)| {
            triangles.push([0, 1, 2]);
            // On a parabola, so that no three vertices are in line.
            let positions = (0..n).map(|i| Point3::new(i as f64, (i * i) as f64, 0.0)).collect();
            let values = on.iter().map(|&(_, x, k)| if k == 0 { 50.0 * x } else { x }).collect();
            (Mesh::new(positions, triangles).unwrap(), on.iter().map(|c| c.0).collect(), values)
        })
    })
}

proptest! {
    #[test]
    fn the_mean_is_the_sum_divided_by_the_assignments((mesh, on, values) in scene()) {
        let got = VertexMap::new(&mesh, &on).aggregate(&values, Statistic::Mean, Outliers::Keep);
        for v in 0..mesh.positions().len() as u32 {
            let mine: Vec<f64> =
                on.iter().zip(&values).filter(|(t, _)| mesh.triangles()[**t as usize].contains(&v)).map(|(_, &x)| x).collect();
            prop_assert_eq!(got.counts[v as usize] as usize, mine.len());
            match got.values[v as usize] {
                None => prop_assert!(mine.is_empty()),
                Some(mean) => prop_assert!((mean - mine.iter().sum::<f64>() / mine.len() as f64).abs() < 1e-9),
            }
        }
    }

    #[test]
    fn kept_and_dropped_are_all_assignments((mesh, on, values) in scene()) {
        let map = VertexMap::new(&mesh, &on);
        for outliers in [Outliers::Keep, Outliers::PerVertex, Outliers::Global] {
            let got = map.aggregate(&values, Statistic::Median, outliers);
            for v in 0..map.vertices() {
                prop_assert_eq!((got.counts[v] + got.dropped[v]) as usize, map.configurations_of(v).len());
                prop_assert_eq!(got.values[v].is_some(), got.counts[v] > 0);
            }
        }
    }
}
