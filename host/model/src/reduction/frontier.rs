//! Speed against error: what algorithms gain when answers may change by more.

use ocb_chart::{Axis, Chart, Form, Point, Scale, Series};

use crate::{AlgorithmOnWorkload, WorkloadResult};

/// Styles of series.
const STYLES: usize = 8;

/// The mean time of a query of each algorithm that answered everything right, about the objects and about the bodies for each of these
/// tolerances, in the first order. All results are of the same algorithms.
pub fn frontier(objects: &WorkloadResult, bodies: &[(f64, &WorkloadResult)]) -> Chart {
    let mut series = Vec::new();
    for (at, algorithm) in objects.tracks[0].algorithms.iter().enumerate() {
        let of_objects = point(algorithm).map(|point| Point { name: None, x: None, ..point });
        let of_bodies = bodies.iter().filter_map(|(tolerance, replay)| {
            let point = point(replay.tracks[0].algorithms.get(at)?)?;
            Some(Point { x: Some(*tolerance), ..point })
        });
        let points: Vec<Point> = of_objects.into_iter().chain(of_bodies).collect();
        if !points.is_empty() {
            let style = Some((series.len() % STYLES) as u8);
            series.push(Series { name: algorithm.name.clone(), style, form: Form::Line, points });
        }
    }
    Chart {
        kind: "frontier".into(),
        title: "Time of a query against tolerance".into(),
        finding: String::new(),
        x: Axis {
            lane: Some("objects".into()),
            ..Axis::new("certified tolerance of answers, unit of the scene (logarithmic)", "", Scale::Log)
        },
        y: Axis::new("mean time of a query (logarithmic)", "ns", Scale::Log),
        series,
        notes: vec![
            "For each tolerance the simplest bodies are chosen anew and certified for every recorded query. In the lane: the objects \
             themselves. Bars: from the fastest to the slowest round of processes. Algorithms with a wrong or a missing answer are \
             left out there."
                .into(),
        ],
        preliminary: false,
    }
}

fn point(algorithm: &AlgorithmOnWorkload) -> Option<Point> {
    let total = algorithm.total.filter(|_| algorithm.is_fair())?;
    let mean = |ns: f64| ns / algorithm.n as f64;
    Some(Point::at(0.0, mean(total.ns), algorithm.n).within(mean(total.lowest_ns), mean(total.highest_ns)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replay(ns: f64, wrong: u64) -> WorkloadResult {
        serde_json::from_value(serde_json::json!({
            "program": "p", "libraries": [], "objects": [], "seen": 10, "queries": 10, "left_out": [], "groups": 1, "hits": 0,
            "recorded": { "claims": [], "largest_error": 0.0, "false_answers": [], "seconds": null },
            "timeline": { "from": [], "queries": [], "hits": [], "series": [] }, "passes": 1, "seed": 5,
            "tracks": [{ "track": "shuffled", "algorithms": [{
                "algorithm": "a", "name": "A", "of": 10, "n": 10, "total": { "ns": ns, "lowest_ns": 0.9 * ns, "highest_ns": 2.0 * ns },
                "build_ns": 1.0, "wrong": wrong, "missed": 0, "undecided": 0, "silent": 0, "groups": null, "pairs": [], "ended": [],
            }] }],
        }))
        .unwrap()
    }

    #[test]
    fn objects_stand_in_the_lane_and_what_was_wrong_is_left_out() {
        let [objects, fine, coarse, wrong] =
            [(1000.0, 0), (500.0, 0), (100.0, 0), (1.0, 1)].map(|(ns, bad)| replay(ns, bad));
        let chart = frontier(&objects, &[(0.1, &fine), (0.2, &wrong), (0.4, &coarse)]);
        let points: Vec<_> = chart.series[0].points.iter().map(|it| (it.x, it.y, it.y_lo, it.y_hi, it.n)).collect();
        let at = |x, y: f64| (x, y, Some(0.9 * y), Some(2.0 * y), 10);
        assert_eq!(points, [at(None, 100.0), at(Some(0.1), 50.0), at(Some(0.4), 10.0)]);
        assert_eq!(frontier(&wrong, &[]).series, []);
    }
}
