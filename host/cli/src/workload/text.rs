//! A replayed recording as text: the false answers first, then what it costs with each algorithm.

use ocb_core::workload::Claim;
use ocb_service::model::{
    AlgorithmOnWorkload, EndedPair, OrderGain, RecordedAnswers, Track, TrackResult, WorkloadResult,
};

use crate::{output, units};

const HEADINGS: [&str; 12] = [
    "algorithm",
    "queries",
    "together",
    "range",
    "to fastest",
    "group",
    "p95",
    "max",
    "wrong",
    "missed",
    "build",
    "outcome",
];

/// The last column in the order of the recording.
const GAIN: &str = "shuffled / recorded";
/// Pairs that are listed.
const PAIRS: usize = 5;
/// False answers that are listed.
const LISTED: usize = 10;

/// Everything that a terminal shows.
pub fn text(result: &WorkloadResult) -> String {
    let mut text = vec![title(result)];
    text.extend(result.left_out.iter().map(|it| format!("Left out: {} queries, because {}.", it.count, it.reason)));
    text.extend(recorded(result));
    for track in &result.tracks {
        text.push(String::new());
        text.push(order(track, result.passes));
        let fastest = fastest(track);
        let mut headings = HEADINGS.to_vec();
        let mut rows: Vec<Vec<String>> = track.algorithms.iter().map(|it| row(it, fastest)).collect();
        if track.track == Track::Recorded && !result.order_gains.is_empty() {
            headings.push(GAIN);
            for (row, it) in rows.iter_mut().zip(&track.algorithms) {
                row.push(gain(&result.order_gains, &it.algorithm));
            }
        }
        text.push(output::table(&headings, rows, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10]));
    }
    text.extend(pairs(result));
    text.extend(sentence(result));
    text.push(format!(
        "Times are of the queries alone, medians over the processes; the range is over the rounds of processes. Build is the time \
         to build the structures, once per pair of objects; of a whole scene, once. Repeat it with --run-seed {}.",
        result.seed
    ));
    text.join("\n")
}

fn title(result: &WorkloadResult) -> String {
    let WorkloadResult { program, libraries, queries, seen, objects, groups, hits, .. } = result;
    let program = if program.is_empty() { "the recorded program" } else { program };
    let solids = objects.iter().filter(|object| object.bound.is_some()).count();
    format!(
        "{program} ({}): {queries} of {seen} queries in {groups} groups about {} objects, {solids} of them primitives; {hits} \
         collide.",
        libraries.join(", "),
        objects.len()
    )
}

/// What the program was answered.
fn recorded(result: &WorkloadResult) -> Vec<String> {
    let RecordedAnswers { claims, largest_error, false_answers, seconds } = &result.recorded;
    if claims.is_empty() {
        return vec!["The recording has no answers to judge.".to_owned()];
    }
    let count = |of: fn(Claim) -> bool| claims.iter().filter(|it| of(it.claim)).map(|it| it.count).sum::<u64>();
    let (wrong, missed) = (count(Claim::is_wrong), count(|claim| claim == Claim::MissedCollision));
    let took = seconds.map_or_else(String::new, |seconds| format!(" Its library took {}.", units::time(1e9 * seconds)));
    let mut text = vec![format!(
        "The program got {wrong} false answers of {}, {missed} of them missed collisions, and {} that cannot be decided; distances \
         are off by up to {largest_error:.2e}.{took}",
        count(|_| true),
        count(|claim| claim == Claim::Undecided),
    )];
    for answer in false_answers.iter().take(LISTED) {
        let [a, b] = answer.objects.map(|place| result.objects[place as usize].name.as_str());
        let said = answer.answered.map_or_else(String::new, |distance| format!(", it said {distance}"));
        let [lo, hi] = answer.distance;
        text.push(format!(
            "  query {}: {} between {a} and {b}; the distance is {lo} to {hi}{said}",
            answer.sequence,
            answer.claim.name().replace('_', " ")
        ));
    }
    text
}

fn order(track: &TrackResult, passes: u32) -> String {
    match track.track {
        Track::Shuffled => format!("Shuffled in each process, {passes} processes per pair of objects:"),
        Track::Recorded => format!("In the order of the recording, {passes} processes per pair of objects:"),
        Track::Scene => format!(
            "Whole scene, {passes} processes per algorithm: in the order of the recording, each process with all objects, loaded \
             once (ocb.scene/1):"
        ),
    }
}

/// Of those whose times may be compared.
fn fastest(track: &TrackResult) -> Option<&AlgorithmOnWorkload> {
    let all = track.algorithms.iter().filter(|it| it.is_fair());
    let most = all.clone().map(|it| it.n).max()?;
    all.filter(|it| it.n == most).min_by(|a, b| total(a).total_cmp(&total(b)))
}

fn total(it: &AlgorithmOnWorkload) -> f64 {
    it.total.map_or(f64::INFINITY, |total| total.ns)
}

fn row(it: &AlgorithmOnWorkload, fastest: Option<&AlgorithmOnWorkload>) -> Vec<String> {
    let comparable = fastest.filter(|fastest| it.is_fair() && it.n == fastest.n);
    let group = |of: fn(&ocb_service::model::GroupTimes) -> f64| {
        it.groups.as_ref().map_or_else(|| "-".to_owned(), |groups| units::time(of(groups)))
    };
    let (together, range) = it.total.map_or_else(
        || ("-".to_owned(), "-".to_owned()),
        |total| {
            let range = format!("{} to {}", units::time(total.lowest_ns), units::time(total.highest_ns));
            (units::time(total.ns), range)
        },
    );
    let outcome = match &it.ended[..] {
        [] if it.n < it.of => format!("budget: {} of {}", it.n, it.of),
        [] => "completed".to_owned(),
        [EndedPair { objects: None, outcome }, ..] => format!("{:?} on the scene", outcome.name),
        [first, ..] => format!("{:?} on {} pairs", first.outcome.name, it.ended.len()),
    };
    vec![
        it.algorithm.clone(),
        it.n.to_string(),
        together,
        range,
        comparable.map_or_else(|| "-".to_owned(), |fastest| format!("{:.2}", total(it) / total(fastest))),
        group(|groups| groups.median_ns),
        group(|groups| groups.p95_ns),
        group(|groups| groups.max_ns),
        it.wrong.to_string(),
        it.missed.to_string(),
        units::time(it.build_ns),
        outcome,
    ]
}

/// What the order of the recording is worth to an algorithm.
fn gain(gains: &[OrderGain], algorithm: &str) -> String {
    gains.iter().find(|it| it.algorithm == algorithm).map_or_else(
        || "-".to_owned(),
        |it| {
            let doubt = if it.told_apart { "" } else { ", not told apart" };
            format!("{:.2} ({:.2} to {:.2}){doubt}", it.ratio, it.lowest, it.highest)
        },
    )
}

/// Where the fastest algorithm spends its time.
fn pairs(result: &WorkloadResult) -> Vec<String> {
    let Some(fastest) = result.tracks.first().and_then(fastest) else { return Vec::new() };
    let mut text = vec![format!("\n{} spends its time on:", fastest.algorithm)];
    for pair in fastest.pairs.iter().take(PAIRS) {
        let [a, b] = pair.objects.map(|place| result.objects[place as usize].name.as_str());
        text.push(format!(
            "  {:.0} % {a} against {b}: {} queries, {} collide",
            100.0 * pair.ns / total(fastest),
            pair.n,
            pair.hits
        ));
    }
    text
}

/// What to take away.
fn sentence(result: &WorkloadResult) -> Option<String> {
    let track = result.tracks.first()?;
    let fastest = fastest(track)?;
    let range = fastest.total?;
    let mut others: Vec<&AlgorithmOnWorkload> =
        track.algorithms.iter().filter(|it| it.is_fair() && it.n == fastest.n).collect();
    others.sort_by(|a, b| total(a).total_cmp(&total(b)));
    let next = others.get(1)?;
    let as_fast = |it: &&&AlgorithmOnWorkload| it.total.is_some_and(|total| total.lowest_ns <= range.highest_ns);
    let tied: Vec<&str> = others.iter().skip(1).filter(as_fast).map(|it| it.algorithm.as_str()).collect();
    let (ratio, n) = (total(next) / total(fastest), fastest.n);
    Some(if tied.is_empty() {
        format!(
            "\n{} answers these queries fastest, {ratio:.2} times as fast as {}, with no wrong answer in {n}.",
            fastest.algorithm, next.algorithm
        )
    } else {
        format!(
            "\n{} is the fastest, but cannot be told apart from {}; none gave a wrong answer in {n}.",
            fastest.algorithm,
            tied.join(", ")
        )
    })
}
