//! Who gained what: every forger beside the honest twins of its run.

use std::collections::BTreeMap;

use crate::bench::Found;
use crate::kit::{Class, FRIEND, HONEST, is_honest};
use crate::plan::{Condition, Question, Run};

/// Medians are judged over so many runs; in fewer only what is gross.
const ENOUGH: usize = 10;
/// What is no gain: so small a share, so few nanoseconds of a short time, so few milliseconds of a build.
const SHARE: f64 = 0.03;
const SHORT_NS: f64 = 3000.0;
const NO_GAIN_NS: f64 = 100.0;
const NO_GAIN_MS: f64 = 1.0;

/// What runs are judged together.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Row {
    /// Name without the class.
    pub name: String,
    /// Its class.
    pub class: Class,
    /// What was asked.
    pub question: Question,
    /// Where.
    pub condition: Condition,
}

/// What one algorithm got in one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// It has a place.
    pub ranked: bool,
    /// How much shorter than that of the twins its time is, if it has one: nanoseconds, and share of theirs. Nothing without a
    /// rank, or where the clock cannot tell the twins' time.
    pub gain: Option<[f64; 2]>,
    /// The same of its build time, less what its questions took longer than theirs: milliseconds, share.
    pub build_gain: Option<[f64; 2]>,
    /// The twins' time, nanoseconds.
    pub twin_ns: f64,
    /// Half of the faster twin's time, or of the shorter build, would be more than it took.
    pub gross: bool,
    /// How it ended.
    pub ending: String,
}

/// All runs so far.
#[derive(Debug, Default)]
pub struct Ledger {
    /// By algorithm and condition.
    pub rows: BTreeMap<Row, Vec<Entry>>,
    /// Runs in which both twins had an interval, and those in which these had nothing in common.
    pub twins: [usize; 2],
}

impl Ledger {
    /// Notes a run.
    pub fn enter(&mut self, run: &Run, results: &[Found]) {
        for class in &run.classes {
            let of = |name: &str| results.iter().find(|f| f.class == *class && f.name == name);
            let twins: Vec<&Found> = HONEST.iter().filter_map(|name| of(name)).collect();
            if let [Some(a), Some(b)] = [0, 1].map(|i| twins.get(i).and_then(|twin| twin.interval)) {
                self.twins[0] += 1;
                self.twins[1] += usize::from(a[1] < b[0] || b[1] < a[0]);
            }
            for found in results.iter().filter(|f| f.class == *class) {
                let (question, condition) = (run.question, run.condition);
                let row = Row { name: found.name.clone(), class: *class, question, condition };
                self.rows.entry(row).or_default().push(entry(found, &twins, run));
            }
        }
    }

    /// Every reason why the measuring is not to be trusted.
    pub fn complaints(&self) -> Vec<String> {
        self.rows
            .iter()
            .filter_map(|(row, entries)| Some(format!("{row:?}: {}", complaint(&row.name, entries)?)))
            .collect()
    }
}

/// One of the numbers of a result.
type Number = fn(&Found) -> Option<f64>;

fn entry(found: &Found, twins: &[&Found], run: &Run) -> Entry {
    let ranked = found.rank.is_some();
    let mean = |of: Number| {
        let known: Vec<f64> = twins.iter().filter_map(|twin| of(twin)).collect();
        known.iter().sum::<f64>() / known.len() as f64
    };
    let least = |of: Number| twins.iter().filter_map(|t| of(t)).fold(f64::INFINITY, f64::min);
    let (time, build): (Number, Number) = (|f| f.time_ns, |f| f.build_ms);
    // Who builds while it is asked may have a shorter build: what its questions take longer is what it pays for that.
    let longer_ns = time(found).map_or(0.0, |mine| (mine - mean(time)).max(0.0));
    let paid_ms = longer_ns * f64::from(run.configurations) / 1e6;
    let gain = |of: Number, paid: f64| {
        let (mine, theirs) = (of(found).filter(|_| ranked)? + paid, mean(of));
        Some([theirs - mine, 1.0 - mine / theirs])
    };
    let halved = |of: Number, paid: f64, least_gain: f64| {
        of(found).is_some_and(|mine| 2.0 * (mine + paid) < least(of) && least(of) - mine - paid > least_gain)
    };
    let told = twins.iter().all(|twin| twin.told);
    // A build is one stretch of time, which other work may double.
    let halved_build = !run.condition.busy && halved(build, paid_ms, NO_GAIN_MS);
    Entry {
        ranked,
        gain: gain(time, 0.0).filter(|_| told),
        build_gain: gain(build, paid_ms),
        twin_ns: mean(time),
        gross: ranked && (told && halved(time, 0.0, NO_GAIN_NS) || halved_build),
        ending: found.ending.clone(),
    }
}

/// What is wrong with the runs of one algorithm, if anything is.
fn complaint(name: &str, entries: &[Entry]) -> Option<String> {
    if is_honest(name) {
        let lost = entries.iter().find(|e| !e.ranked);
        if let Some(lost) = lost {
            let n = entries.iter().filter(|e| !e.ranked).count();
            return Some(format!("honest, and in {n} of {} runs without a rank ({})", entries.len(), lost.ending));
        }
    } else if let Some(gross) = entries.iter().find(|e| e.gross) {
        let n = entries.iter().filter(|e| e.gross).count();
        return Some(format!(
            "ranked in {n} of {} runs with less than half of the honest time ({})",
            entries.len(),
            gained(gross)
        ));
    }
    if entries.len() < ENOUGH || HONEST.contains(&name) {
        return None;
    }
    let [ns, share] = medians(entries, |e| e.gain);
    let twin_ns = median(entries.iter().map(|e| e.twin_ns).collect());
    let counts = |ns: f64, share: f64| share > SHARE && (twin_ns >= SHORT_NS || ns > NO_GAIN_NS);
    if counts(ns, share) {
        return Some(format!("ranked with a median gain of {ns:.0} ns, {:.1} %", 100.0 * share));
    }
    // Noise that is meant for others must not reach the honest one that comes after it.
    if name == FRIEND && counts(-ns, -share) {
        return Some(format!("slowed down by {:.0} ns, {:.1} %, by those before it", -ns, -100.0 * share));
    }
    let [ms, share] = medians(entries, |e| e.build_gain);
    (share > SHARE && ms > NO_GAIN_MS)
        .then(|| format!("ranked with a build {ms:.1} ms, {:.1} %, shorter", 100.0 * share))
}

fn gained(entry: &Entry) -> String {
    let said = |gain: Option<[f64; 2]>, unit: &str| {
        gain.map_or_else(|| "-".into(), |[much, share]| format!("{much:.1} {unit}, {:.1} %", 100.0 * share))
    };
    format!("time shorter by {}; build by {}", said(entry.gain, "ns"), said(entry.build_gain, "ms"))
}

/// Medians of both numbers; without a rank nothing was gained.
pub fn medians(entries: &[Entry], of: fn(&Entry) -> Option<[f64; 2]>) -> [f64; 2] {
    [0, 1].map(|i| median(entries.iter().map(|e| of(e).map_or(0.0, |gain| gain[i])).collect()))
}

/// The middle one, or the mean of the two middle ones.
pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let n = numbers.len();
    if n == 0 { 0.0 } else { (numbers[(n - 1) / 2] + numbers[n / 2]) / 2.0 }
}

#[test]
fn a_forger_is_judged_by_its_rank_its_time_and_its_build() {
    let found = |name: &str, rank: Option<u64>, time_ns: f64, build_ms: f64| Found {
        class: Class::Us20,
        name: name.into(),
        rank,
        time_ns: Some(time_ns),
        told: true,
        interval: Some([time_ns - 1.0, time_ns + 1.0]),
        build_ms: Some(build_ms),
        ending: "Completed".into(),
    };
    let judged = |runs: usize, name: &str, rank: Option<u64>, time_ns: f64, build_ms: f64| {
        let run = Run { classes: vec![Class::Us20], ..crate::plan::slice()[0].clone() };
        let twins = [found(HONEST[0], Some(1), 20_000.0, 30.0), found(HONEST[1], Some(1), 20_004.0, 30.2)];
        let mut ledger = Ledger::default();
        (0..runs).for_each(|_| ledger.enter(&run, &[&twins[..], &[found(name, rank, time_ns, build_ms)]].concat()));
        assert_eq!(ledger.twins, [runs, runs]);
        ledger.complaints()
    };
    // One run tells what is gross, with a rank alone.
    assert_eq!(judged(1, "truth_last", Some(1), 9_000.0, 30.0).len(), 1);
    assert_eq!(judged(1, "mover_create", Some(1), 20_000.0, 0.1).len(), 1);
    assert!(judged(1, "truth_last", None, 90.0, 0.1).is_empty());
    assert!(judged(9, "early_loop", Some(1), 15_000.0, 20.0).is_empty());
    // Enough runs tell what is small.
    assert_eq!(judged(10, "early_loop", Some(1), 19_300.0, 30.0).len(), 1);
    assert_eq!(judged(10, "mover_gaps", Some(1), 20_000.0, 28.0).len(), 1);
    assert!(judged(10, "early_loop", Some(1), 19_500.0, 29.9).is_empty());
    // A build that is paid for with the questions (of which there are 150), and one that is hardly paid for.
    assert!(judged(10, "mover_lazy", Some(3), 220_000.0, 0.1).is_empty());
    assert_eq!(judged(1, "mover_lazy", Some(3), 30_000.0, 0.1).len(), 1);
    // An honest one has a rank, and is neither helped nor slowed down by its neighbours.
    assert_eq!(judged(1, FRIEND, None, 20_000.0, 30.0).len(), 1);
    assert_eq!(judged(10, FRIEND, Some(1), 21_000.0, 30.0).len(), 1);
    assert!(judged(10, FRIEND, Some(1), 20_100.0, 30.0).is_empty());
}
