//! Where decisions begin to fail: share of wrong ones by powers of ten of the true distance and of the margin.

use ocb_chart::{Axis, Chart, Form, Point, Scale};
use ocb_core::resolution::{Decade, Threshold};
use ocb_core::statistics::share_interval;

use super::series;
use crate::model::AlgorithmResult;

/// False alarms to the right of the middle, missed collisions to the left.
pub fn chart(results: &[AlgorithmResult]) -> Chart {
    let line = |(place, result): (usize, &AlgorithmResult)| {
        let resolution = result.resolution.as_ref()?;
        let mut points = side(&resolution.misses, -1.0);
        points.reverse();
        points.extend(side(&resolution.false_hits, 1.0));
        Some(series(&result.name, place, Form::Line, points))
    };
    Chart {
        kind: "resolution".into(),
        preliminary: false,
        title: "Where decisions begin to fail".into(),
        finding: finding(results),
        x: Axis::new("crossing: margin / S  ←  |  →  apart: distance / S (logarithmic)", "of S", Scale::Signed),
        y: Axis::new("wrong decisions, share", "share", Scale::Linear),
        series: results.iter().enumerate().filter_map(line).collect(),
        notes: vec![
            "Left: missed collisions, by the depth of the crossing; right: false alarms, by the distance; each as a \
             share of the scene's size S, by powers of ten."
                .into(),
            "Every decision counts, including those without a verdict. Bars: Wilson's 95 % intervals.".into(),
        ],
    }
}

/// A point in the middle of each power of ten.
fn side(threshold: &Threshold, sign: f64) -> Vec<Point> {
    let point = |Decade { exponent, n, wrong }: &Decade| {
        let (lo, hi) = share_interval(u64::from(*wrong), u64::from(*n));
        let share = f64::from(*wrong) / f64::from(*n);
        let at = Point::at(sign * 10f64.powf(f64::from(*exponent) + 0.5), share, u64::from(*n)).within(lo, hi);
        let faults = if sign < 0.0 { (u64::from(*wrong), 0) } else { (0, u64::from(*wrong)) };
        Point { missed: faults.0, false_alarms: faults.1, ..at }
    };
    threshold.decades.iter().map(point).collect()
}

fn finding(results: &[AlgorithmResult]) -> String {
    let eps = |r: &AlgorithmResult| r.resolution.as_ref().and_then(|r| r.eps.filter(|_| r.seen));
    let worst = results.iter().filter_map(|r| Some((r, eps(r)?))).max_by(|(_, a), (_, b)| a.total_cmp(b));
    match worst {
        Some((result, eps)) => format!("{} makes wrong decisions up to {eps:.1e} of the scene's size.", result.name),
        None => "No decision was wrong.".into(),
    }
}
