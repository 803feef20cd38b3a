//! The rows as a picture: one panel per object and workload, a line per algorithm, time on a logarithmic axis.

use ocb_chart::{Axis, Chart, Form, Point, Scale, Series, svg};

use crate::report::Row;

/// A picture that stands alone: title, axis with unit, intervals, n.
pub fn svg(rows: &[Row], machine: &str) -> String {
    let mut groups: Vec<(String, Vec<&Row>)> = Vec::new();
    for row in rows.iter().filter(|row| row.median_ns.is_some()) {
        let title = format!("{}, {}", row.object, row.workload);
        match groups.iter_mut().find(|(known, _)| *known == title) {
            Some((_, members)) => members.push(row),
            None => groups.push((title, vec![row])),
        }
    }
    let charts: Vec<Chart> = groups.into_iter().map(|(title, members)| panel(title, members, machine)).collect();
    svg::page(&charts)
}

fn panel(title: String, mut members: Vec<&Row>, machine: &str) -> Chart {
    members.sort_by(|x, y| x.median_ns.map(|m| m[0]).partial_cmp(&y.median_ns.map(|m| m[0])).expect("numbers"));
    let line = |(place, row): (usize, &&Row)| {
        let [median, lo, hi] = row.median_ns?;
        let point = Point {
            x_lo: Some(lo),
            x_hi: Some(hi),
            filled: row.rank.is_some(),
            ..Point::at(median, place as f64, u64::from(row.n))
        };
        let name =
            if row.wrong > 0 { format!("{} ({} wrong)", row.algorithm, row.wrong) } else { row.algorithm.clone() };
        Some(Series { name, style: Some(0), form: Form::Line, points: vec![point] })
    };
    Chart {
        kind: "algorithms".into(),
        preliminary: false,
        title,
        finding: String::new(),
        x: Axis::new("median time per query with its 95 % interval (logarithmic)", "ns", Scale::Log),
        y: Axis::new("", "", Scale::Rows),
        series: members.iter().enumerate().filter_map(line).collect(),
        notes: vec![format!("Filled: nothing wrong, ranked. Hollow: wrong answers or no rank. {machine}")],
    }
}
