//! The rows as a chart of speed against accuracy.

use ocb_chart::{Axis, Chart, Form, Point, Scale, Series};

use super::family::{base, family};
use super::frontier::{comparable, whole};
use crate::model::{Accuracy, BoardRow, Estimated};

/// Accuracy to the right, speed upwards; a series per algorithm, its settings joined, and the frontier of each class.
pub fn chart(rows: &[BoardRow], accuracy: Accuracy, kind: &str, finding: &str) -> Chart {
    let shown: Vec<(&BoardRow, Point)> = rows.iter().filter_map(|row| Some((row, point(row, accuracy)?))).collect();
    let mut bases: Vec<&str> = shown.iter().map(|(row, _)| base(&row.algorithm)).collect();
    bases.sort_by_key(|id| (family(id).0, *id));
    bases.dedup();
    let series = |id: &str| {
        let mut points: Vec<Point> =
            shown.iter().filter(|(row, _)| base(&row.algorithm) == id).map(|(_, point)| point.clone()).collect();
        points.sort_by(|a, b| a.y.total_cmp(&b.y));
        let (style, name) = family(id);
        Series { name: name.into(), style: Some(style), form: Form::Line, points }
    };
    let mut all: Vec<Series> = frontiers(&shown);
    all.extend(bases.into_iter().map(series));
    let hidden = rows.iter().filter(|row| row.n > 0).count() - shown.len();
    Chart {
        kind: kind.into(),
        preliminary: false,
        title: "Speed against accuracy".into(),
        finding: finding.into(),
        x: axis(accuracy, &shown),
        y: Axis::new("queries per second (logarithmic), by the mean time", "1/s", Scale::Log),
        series: all,
        notes: notes(accuracy, hidden),
    }
}

fn axis(accuracy: Accuracy, shown: &[(&BoardRow, Point)]) -> Axis {
    let n = shown.iter().filter(|(_, p)| p.x.is_none()).map(|(row, _)| row.n).min();
    let bound = n.map_or_else(String::new, |n| format!(" (< {:.1e} at 95 %)", 3.0 / n as f64));
    let share = |what: &str| Axis {
        lane: Some(format!("none seen{bound}")),
        ..Axis::new(&format!("{what}, share of configurations (logarithmic); better to the left"), "share", Scale::Log)
    };
    match accuracy {
        Accuracy::Wrong => share("wrong answers"),
        Accuracy::Missed => share("missed collisions"),
        Accuracy::FalseAlarms => share("false alarms"),
        Accuracy::Digits => Axis::new(
            "digits of the scene's size told apart, -log10 eps*; better to the right",
            "digits",
            Scale::Linear,
        ),
        Accuracy::Distance => Axis {
            lane: Some("never outside".into()),
            ..Axis::new(
                "worst error of a distance, in units of u S (logarithmic); better to the left",
                "u S",
                Scale::Log,
            )
        },
    }
}

fn point(row: &BoardRow, accuracy: Accuracy) -> Option<Point> {
    let rate = row.rate.filter(|_| comparable(row))?;
    let plain = Point {
        name: Some(row.name.clone()),
        y: rate.value,
        n: row.n,
        filled: row.frontier && row.missed == 0,
        missed: row.missed,
        false_alarms: row.false_alarms,
        words: words(row, rate),
        ..Point::default()
    }
    .within(rate.lo, rate.hi);
    let share = |share: Option<Estimated>| {
        let share = share?;
        let x = Some(share.value).filter(|x| *x > 0.0);
        Some(Point { x, x_lo: x.and(Some(share.lo)), x_hi: Some(share.hi), ..plain.clone() })
    };
    match accuracy {
        Accuracy::Wrong => share(row.wrong_share),
        Accuracy::Missed => share(row.missed_share),
        Accuracy::FalseAlarms => share(row.false_alarm_share),
        Accuracy::Digits => {
            Some(Point { x: Some(-row.eps?.log10()), at_least: !row.eps_seen && row.wrong == 0, ..plain })
        }
        Accuracy::Distance => {
            Some(Point { x: row.distance_error.filter(|e| *e > 0.0), ..plain }).filter(|_| row.distance_error.is_some())
        }
    }
}

fn words(row: &BoardRow, rate: Estimated) -> String {
    let wrong = match row.wrong {
        0 => format!("no wrong answer in {} (less than {:.1e} at 95 %)", row.n, 3.0 / row.n as f64),
        wrong => {
            let (missed, alarms) = (row.missed, row.false_alarms);
            format!(
                "{wrong} of {} answers wrong, {missed} missed collisions and {alarms} false alarms among them",
                row.n
            )
        }
    };
    let [value, lo, hi] = [rate.value, rate.lo, rate.hi].map(whole);
    format!("{}: {value} queries per second ({lo} to {hi}), {wrong}; {}.", row.name, row.family)
}

/// A thin line through those on the frontier, for each class.
fn frontiers(shown: &[(&BoardRow, Point)]) -> Vec<Series> {
    let mut classes: Vec<&str> = shown.iter().map(|(row, _)| row.class.as_str()).collect();
    classes.sort_unstable();
    classes.dedup();
    let line = |class: &str| {
        let on = shown.iter().filter(|(row, _)| row.frontier && row.class == class);
        let mut points: Vec<Point> =
            on.map(|(_, p)| Point { x: p.x, y: p.y, n: p.n, filled: p.filled, ..Point::default() }).collect();
        points.sort_by(|a, b| a.y.total_cmp(&b.y));
        Series { name: format!("frontier: {class}"), style: None, form: Form::Rule, points }
    };
    classes.into_iter().map(line).collect()
}

fn notes(accuracy: Accuracy, hidden: usize) -> Vec<String> {
    let mut notes = vec![
        "Grey line: the frontier of speed and accuracy. Filled: on it; hollow: not on it, or a collision was missed.".into(),
        "Bars are 95 % intervals: of the speed over the processes, of shares Wilson's. Settings of one algorithm are joined.".into(),
    ];
    notes.extend(match accuracy {
        Accuracy::Digits => Some(
            "Arrow: no wrong answer was seen, so the true value may be better than these configurations can show."
                .to_owned(),
        ),
        Accuracy::Distance => None,
        _ => Some("None seen: with n answers and none wrong, the share is below 3/n at 95 %.".to_owned()),
    });
    if hidden > 0 {
        notes.push(format!("{hidden} more are not shown: they failed or have no such value; see the table."));
    }
    notes
}
