//! Places, the Pareto frontier, and what is to be seen in words.

use ocb_core::comparison::{Interval, ranks};

use super::filter::in_order;
use super::row::WRONG;
use crate::model::{Accuracy, BoardRow};

/// Gives places by speed, and finds who is on the frontier of speed and this accuracy.
pub fn place(rows: &mut [BoardRow], accuracy: Accuracy) {
    let time = |row: &BoardRow| {
        let rate = row.rate.filter(|_| row.reason.is_none())?;
        Some(Interval { value: 1.0 / rate.value, lo: 1.0 / rate.hi, hi: 1.0 / rate.lo })
    };
    let places = ranks(&rows.iter().map(time).collect::<Vec<_>>());
    let on: Vec<bool> = rows.iter().map(|row| on_frontier(row, rows, accuracy)).collect();
    for ((row, rank), frontier) in rows.iter_mut().zip(&places).zip(on) {
        (row.rank, row.frontier) = (*rank, frontier);
        row.tied = rank.is_some() && places.iter().filter(|other| *other == rank).count() > 1;
    }
    in_order(rows);
}

/// It was measured on the same as the others: it has a mark in the chart, even with wrong answers.
pub fn comparable(row: &BoardRow) -> bool {
    row.rate.is_some() && row.reason.as_deref().is_none_or(|reason| reason == WRONG)
}

fn on_frontier(row: &BoardRow, rows: &[BoardRow], accuracy: Accuracy) -> bool {
    let Some((speed, right)) = both(row, accuracy) else { return false };
    let mut others = rows.iter().filter(|other| !std::ptr::eq(*other, row)).filter_map(|other| both(other, accuracy));
    let beaten = |(s, r): (f64, f64)| s >= speed && r >= right && (s > speed || r > right);
    !others.any(beaten)
}

/// Speed and accuracy, more is better.
fn both(row: &BoardRow, accuracy: Accuracy) -> Option<(f64, f64)> {
    let rate = row.rate.filter(|_| comparable(row))?.value;
    let right = match accuracy {
        Accuracy::Wrong => -row.wrong_share?.value,
        Accuracy::Missed => -row.missed_share?.value,
        Accuracy::FalseAlarms => -row.false_alarm_share?.value,
        // Nothing wrong seen may be any number of digits.
        Accuracy::Digits if !row.eps_seen && row.wrong == 0 => f64::INFINITY,
        Accuracy::Digits => -row.eps?.log10(),
        Accuracy::Distance => -row.distance_error?,
    };
    Some((rate, right))
}

/// Who is fastest without a wrong answer, and by how much.
pub fn finding(rows: &[BoardRow]) -> String {
    let mut clean: Vec<(&BoardRow, crate::model::Estimated)> =
        rows.iter().filter(|row| comparable(row) && row.wrong == 0).filter_map(|row| Some((row, row.rate?))).collect();
    clean.sort_by(|(_, a), (_, b)| b.value.total_cmp(&a.value));
    let Some((first, rate)) = clean.first() else {
        let any = rows.iter().any(comparable);
        return if any { "Every algorithm gave a wrong answer." } else { "There is nothing to compare here." }.into();
    };
    let head = format!("Fastest with no wrong answer seen: {}, {} queries per second", first.name, whole(rate.value));
    let Some((second, next)) = clean.get(1) else { return format!("{head}; every other one gave a wrong answer.") };
    let overlap = rate.lo <= next.hi;
    let decided = if overlap { "overlap, so the order is not decided" } else { "do not overlap" };
    format!("{head}, {:.1} times the next ({}); the 95 % intervals {decided}.", rate.value / next.value, second.name)
}

/// A whole number with commas between thousands.
pub fn whole(value: f64) -> String {
    let digits = format!("{value:.0}");
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i) % 3 == 0 {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
