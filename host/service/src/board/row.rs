//! The results of one algorithm, over all scenarios that are left.

use ocb_core::record::Verdict;
use ocb_core::resolution::Resolution;
use ocb_core::statistics::share_interval;

use super::{Measured, family, keys};
use crate::model::{AlgorithmResult, BoardRow, Estimated};

/// One row per algorithm with its settings, in no order; over the scenarios that are expected, or those that occur.
pub fn rows(left: &[Measured], expected: &[(String, String)]) -> Vec<BoardRow> {
    let mut scenarios: Vec<(&str, &str)> =
        expected.iter().map(|(scene, distance)| (scene.as_str(), distance.as_str())).collect();
    let mut algorithms: Vec<&str> = Vec::new();
    for m in left {
        let scenario = (m.scene.value.as_str(), m.distance.value.as_str());
        if !scenarios.contains(&scenario) {
            scenarios.push(scenario);
        }
        if !algorithms.contains(&m.result.algorithm.as_str()) {
            algorithms.push(&m.result.algorithm);
        }
    }
    let row = |algorithm: &&str| {
        let mut own: Vec<&Measured> = left.iter().filter(|m| m.result.algorithm == *algorithm).collect();
        let newest = own.iter().max_by_key(|m| m.finished_us)?.plugin_sha256.as_str();
        own.retain(|m| m.plugin_sha256 == newest);
        let best = scenarios.iter().filter_map(|scenario| best(&own, *scenario)).collect::<Vec<_>>();
        combined(&best, scenarios.len() as u32)
    };
    algorithms.iter().filter_map(row).collect()
}

/// The run with the most configurations in this scenario, of those the newest. Runs of a suite all have the same number; of these
/// the newest oracle decides.
fn best<'a>(own: &[&'a Measured], (scene, distance): (&str, &str)) -> Option<&'a Measured> {
    let here = own.iter().filter(|m| m.scene.value == scene && m.distance.value == distance);
    let better = |m: &&&Measured| match m.suite {
        Some(_) => (m.oracle, 0, m.finished_us),
        None => (None, m.result.n, m.finished_us),
    };
    here.max_by_key(better).copied()
}

fn combined(best: &[&Measured], of: u32) -> Option<BoardRow> {
    let first = best.first()?;
    let results = || best.iter().map(|m| &m.result);
    let n: u64 = results().map(|r| u64::from(r.n)).sum();
    let count = |verdict| results().map(|r| u64::from(verdicts(r, verdict))).sum::<u64>();
    let wrong = results().map(|r| u64::from(r.wrong)).sum();
    let (missed, false_alarms) = (count(Verdict::FalseNegative), count(Verdict::FalsePositive));
    let resolution = results().filter_map(|r| r.resolution.clone()).reduce(|a, b| a.and(&b)).unwrap_or_default();
    let Resolution { eps, seen, distance, .. } = resolution;
    let scenarios = results().filter(|r| r.n > 0).count() as u32;
    Some(BoardRow {
        algorithm: first.result.algorithm.clone(),
        name: first.result.name.clone(),
        family: family::family(&first.result.algorithm).1.into(),
        class: first.result.class.map(|class| keys::class(&class).words).unwrap_or_default(),
        rank: None,
        tied: false,
        reason: why_not(best, of),
        frontier: false,
        n,
        wrong,
        missed,
        false_alarms,
        wrong_share: share(wrong, n),
        missed_share: share(missed, n),
        false_alarm_share: share(false_alarms, n),
        eps,
        eps_seen: seen,
        distance_error: distance.map(|error| error.worst()),
        rate: rate(best),
        build_ms: results().filter_map(|r| r.build_ms).reduce(f64::max),
        memory_bytes: results().filter_map(|r| r.memory_bytes).max(),
        stability: None,
        scenarios,
        of,
        finished_us: best.iter().map(|m| m.finished_us).min().unwrap_or_default(),
        runs: best.iter().map(|m| m.run.clone()).collect(),
        oracle: best.iter().filter_map(|m| m.oracle).min(),
        hardware_class: first.hardware.value.clone(),
        plugin_sha256: first.plugin_sha256.clone(),
        builds: first.result.builds.clone(),
    })
}

fn verdicts(result: &AlgorithmResult, verdict: Verdict) -> u32 {
    result.verdicts.iter().filter(|v| v.verdict == verdict).map(|v| v.count).sum()
}

fn share(count: u64, n: u64) -> Option<Estimated> {
    (n > 0).then(|| {
        let (lo, hi) = share_interval(count, n);
        Estimated { value: count as f64 / n as f64, lo, hi }
    })
}

/// Questions per second with every scenario asked equally often. The scenarios are independent, so the halves of their
/// intervals add up as squares.
fn rate(best: &[&Measured]) -> Option<Estimated> {
    let times: Vec<Estimated> = best.iter().filter_map(|m| m.result.time.map(|time| time.mean_ns)).collect();
    let k = times.len() as f64;
    let mean = times.iter().map(|t| t.value).sum::<f64>() / k;
    let half = |of: fn(&Estimated) -> f64| times.iter().map(|t| of(t).powi(2)).sum::<f64>().sqrt() / k;
    let (below, above) = (half(|t| t.value - t.lo), half(|t| t.hi - t.value));
    // An interval may reach down to no time at all; a rate may not reach up to infinity.
    let shortest = (mean - below).max(f64::MIN_POSITIVE.max(1e-3 * mean));
    (mean > 0.0).then(|| Estimated { value: 1e9 / mean, lo: 1e9 / (mean + above), hi: 1e9 / shortest })
}

/// Why it can have no place, if so.
fn why_not(best: &[&Measured], of: u32) -> Option<String> {
    if let Some(standing) = best.iter().find_map(|m| m.standing.clone()) {
        return Some(standing);
    }
    if let Some(failed) = best.iter().find(|m| !m.result.outcome.completed()) {
        return Some(failed.result.outcome.message.clone());
    }
    if best.iter().any(|m| m.result.n == 0 || m.result.time.is_none()) {
        return Some("Nothing was measured.".into());
    }
    if best.iter().any(|m| !m.ranked) {
        return Some("Measured in the development profile, without some layers of the jail.".into());
    }
    if let Some((n, all)) = best.iter().find_map(|m| m.preview) {
        return Some(format!("A preview: {n} of {all} configurations were measured. Refine the run to compare it."));
    }
    let silent =
        |r: &AlgorithmResult| r.verdicts.iter().filter(|v| v.verdict.is_silent()).map(|v| v.count).sum::<u32>();
    let silent: u32 = best.iter().map(|m| silent(&m.result)).sum();
    if silent > 0 {
        return Some(format!("It did not answer {silent} queries."));
    }
    if (best.len() as u32) < of {
        return Some(format!("Measured on {} of {of} scenarios: its speed cannot be compared.", best.len()));
    }
    let wrong = best.iter().any(|m| m.result.wrong > 0);
    match best.iter().find_map(|m| m.result.unranked.as_ref()) {
        Some(unranked) if !wrong || !is_typical(best) => Some(unranked.message.clone()),
        _ => wrong.then(|| WRONG.to_owned()),
    }
}

/// Its share of wrong answers tells what it is worth: of the control questions it did not answer far more wrongly than of the
/// others. Where it did, its mark in the chart would be a lie.
fn is_typical(best: &[&Measured]) -> bool {
    const FAR_MORE: f64 = 4.0;
    let sum = |of: &dyn Fn(&AlgorithmResult) -> u32| best.iter().map(|m| f64::from(of(&m.result))).sum::<f64>();
    let share = |wrong: f64, n: f64| wrong / n.max(1.0);
    let (controls, wrong_controls) =
        (|r: &AlgorithmResult| r.controls.map_or(0, |c| c.n), |r: &AlgorithmResult| r.controls.map_or(0, |c| c.wrong));
    share(sum(&wrong_controls), sum(&controls)) <= FAR_MORE * share(sum(&|r| r.wrong), sum(&|r| r.n))
}

/// Wrong answers take the place away, but not the mark in the chart.
pub const WRONG: &str = "It gave wrong answers: the time of a wrong answer does not count.";
