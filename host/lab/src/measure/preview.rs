//! How a comparison stands that was measured in part, and what the rest would add.

use ocb_core::comparison::Interval;
use ocb_core::sequential::{self, Contest, Look, Rival, Standing};

use super::contract::contract;
use super::{MeasuringState, Task};
use crate::model::{Beside, ContractClass, Estimated, Preview};

/// What counts as no difference where nobody says.
const PRECISION: f64 = 0.05;

/// One contract class: which algorithms, and their times.
type Class = (ContractClass, Vec<usize>, Vec<Vec<Vec<(u32, f64)>>>);

/// What is known after `n` configurations and so many looks.
pub fn preview(task: &Task, states: &[MeasuringState], n: usize, looks: u32) -> Preview {
    let classes = classes(task, states);
    let precision = task.part.precision.unwrap_or(PRECISION);
    let look = Look {
        number: looks,
        comparisons: classes.iter().map(|(_, members, _)| members.len() - 1).sum(),
        precision,
        rounds: task.passes,
        of: task.part.of,
    };
    let (mut beside, mut found, mut settled) = (Vec::new(), Vec::new(), true);
    for (_, members, times) in &classes {
        let times: Vec<_> = times.iter().map(Vec::as_slice).collect();
        let Some(contest) = sequential::contest(&times, &look) else { continue };
        let name = |index: usize| states[members[index]].algorithm.info.id.as_str();
        settled &= contest.settled();
        let of_class = others(&contest, name);
        found.extend(finding(&of_class, precision));
        beside.extend(of_class);
    }
    if found.is_empty() {
        found.push(
            "No two algorithms answer the same query without a wrong answer, so there is nothing to compare.".into(),
        );
    }
    let of = task.part.of;
    let more = more(&beside, n as u64, of);
    Preview { n: n as u32, of, precision, looks, settled, beside, finding: found.join(" "), more }
}

/// Those that may have a place, by what they deliver.
fn classes(task: &Task, states: &[MeasuringState]) -> Vec<Class> {
    let mut classes: Vec<Class> = Vec::new();
    let algorithms = states.iter().enumerate().take(task.algorithms.len());
    for (index, state) in algorithms.filter(|(_, state)| state.fair()) {
        let (class, times) = (contract(&state.algorithm, state.answers(), task.query, task.coherent()), state.times());
        match classes.iter_mut().find(|(known, ..)| *known == class) {
            Some((_, members, all)) => {
                members.push(index);
                all.push(times);
            }
            None => classes.push((class, vec![index], vec![times])),
        }
    }
    classes
}

fn others<'a>(contest: &Contest, name: impl Fn(usize) -> &'a str) -> Vec<Beside> {
    let estimated = |interval: Option<Interval>| interval.map(Estimated::from);
    let beside = |rival: &Rival| Beside {
        algorithm: name(rival.index).into(),
        fastest: name(contest.fastest).into(),
        ratio: estimated(rival.ratio),
        whole: estimated(rival.whole),
        standing: rival.standing,
    };
    let mut all: Vec<Beside> = contest.rivals.iter().map(beside).collect();
    all.sort_by(|x, y| value(x).total_cmp(&value(y)));
    all
}

fn value(beside: &Beside) -> f64 {
    beside.ratio.map_or(f64::INFINITY, |ratio| ratio.value)
}

/// Who is fastest, who is as fast, and what is open; the nearest first. Nothing where one is alone.
fn finding(beside: &[Beside], precision: f64) -> Option<String> {
    let nearest = beside.first()?;
    let fastest = &nearest.fastest;
    let of =
        |standing| beside.iter().filter(|b| b.standing == standing).map(|b| b.algorithm.as_str()).collect::<Vec<_>>();
    let (equal, open) = (of(Standing::Equal), of(Standing::Open));
    let mut parts = Vec::new();
    if !open.is_empty() {
        parts.push(format!("not decided between {fastest} and {}", open.join(", ")));
    }
    if !equal.is_empty() {
        let percent = (1e5 * precision).round() / 1e3;
        parts.push(format!("{fastest} and {} are equally fast to within {percent} %", equal.join(", ")));
    }
    match (parts.is_empty(), nearest.ratio) {
        (true, Some(Estimated { value, lo, hi })) => {
            let next = &nearest.algorithm;
            Some(format!(
                "{fastest} is fastest; the next, {next}, takes {value:.2} times as long ({lo:.2} to {hi:.2})."
            ))
        }
        _ => Some(format!("Fastest algorithm: {}.", parts.join("; "))),
    }
}

/// What all configurations would add.
fn more(beside: &[Beside], n: u64, of: u64) -> String {
    // The nearest rival's interval is the one that matters.
    let nearest = beside.iter().min_by(|x, y| value(x).total_cmp(&value(y)));
    let narrower = nearest.and_then(|b| {
        let half = |interval: Estimated| 50.0 * (interval.hi - interval.lo) / interval.value;
        let (now, then) = (half(b.ratio?), half(b.whole?));
        // Beyond that nothing is known, and a number would say too much.
        (now < 100.0)
            .then(|| format!(" narrow the interval of {} from about ±{now:.1} % to ±{then:.1} %, and", b.algorithm))
    });
    format!(
        "All {of} configurations, {:.1} times as many, would{} show wrong answers as rare as 1 in {}; {n} show those of \
         1 in {} (95 %).",
        of as f64 / n as f64,
        narrower.unwrap_or_default(),
        rarest(of),
        rarest(n),
    )
}

/// Wrong answers of this share are seen at least once with 95 %: the rule of three.
fn rarest(n: u64) -> u64 {
    (n / 3).max(1)
}
