//! Does what the supervisor saw from outside fit together? The thresholds come from honest plugins (`sandbox/README.md`
//! says how far those are from them); a check with too little to go by says nothing.

use std::fmt;

use ocb_core::statistics::quantile;

use crate::pass::{Batched, PassFacts};

/// The checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// Questions in a batch against the same questions alone.
    Batches,
    /// Questions exactly as before against their first time.
    Repeats,
    /// What the runner computes while nothing is asked.
    BetweenQueries,
    /// Processor time against wall time.
    ProcessorTime,
    /// The shape of the distribution of times in one process against another.
    TailShape,
}

impl Check {
    /// Its name in outcomes and files.
    pub fn name(self) -> &'static str {
        match self {
            Check::Batches => "batches",
            Check::Repeats => "repeats",
            Check::BetweenQueries => "between queries",
            Check::ProcessorTime => "processor time",
            Check::TailShape => "tail shape",
        }
    }

    /// What honest plugins stay within.
    pub fn allowed(self) -> [f64; 2] {
        match self {
            Check::Batches => [0.5, 2.0],
            Check::Repeats => [0.4, 2.5],
            Check::BetweenQueries => [0.0, 0.1],
            // A runner that is not asked in time goes to sleep, so less says nothing.
            Check::ProcessorTime => [0.0, 1.1],
            Check::TailShape => [1.0, 3.0],
        }
    }

    fn all() -> [Check; 5] {
        [Check::Batches, Check::Repeats, Check::BetweenQueries, Check::ProcessorTime, Check::TailShape]
    }

    /// The measured value; absent when there is too little to go by.
    fn found(self, passes: &[PassFacts]) -> Option<f64> {
        match self {
            Check::Batches => {
                let telling = |batch: &&Batched| batch.alone_ns >= f64::from(batch.questions) * TELLING_NS;
                let batches = passes.iter().flat_map(|pass| &pass.batches).filter(telling);
                median(batches.map(|batch| batch.together_ns / batch.alone_ns), LEAST_BATCHES)
            }
            Check::Repeats => {
                let telling = passes.iter().flat_map(|pass| &pass.repeats).filter(|[first, _]| *first >= TELLING_NS);
                median(telling.map(|[first, again]| again / first), LEAST_REPEATS)
            }
            Check::BetweenQueries => {
                let [paused, computed] = [0, 1].map(|i| passes.iter().map(|pass| pass.pauses_ns[i]).sum::<f64>());
                (paused >= LEAST_NS).then(|| computed / paused)
            }
            Check::ProcessorTime => {
                let stolen = passes.iter().any(|pass| pass.steal.is_none_or(|share| share > 0.01));
                let busy = |i: usize| passes.iter().filter_map(|pass| pass.busy_ns).map(|ns| ns[i]).sum::<f64>();
                (!stolen && busy(0) >= LEAST_BUSY_NS).then(|| busy(1) / busy(0))
            }
            Check::TailShape => {
                // Where most of a pass was disturbed, the rest of it is no fair sample.
                let whole = |pass: &PassFacts| pass.timed >= LEAST_TIMES && 2 * pass.timed >= pass.reached;
                let telling = |pass: &&PassFacts| whole(pass) && pass.times_ns[0] >= TELLING_NS;
                let shapes = passes.iter().filter(telling).map(|pass| pass.times_ns[2] / pass.times_ns[0]);
                let (least, most, n) = shapes.fold((f64::INFINITY, 0.0f64, 0), |(least, most, n), shape| {
                    (least.min(shape), most.max(shape), n + 1)
                });
                (n >= 2).then(|| most / least)
            }
        }
    }
}

/// The median of at least so many: what happens to a few of them on a busy machine says nothing of a plugin.
fn median(ratios: impl Iterator<Item = f64>, least: usize) -> Option<f64> {
    let mut ratios: Vec<f64> = ratios.collect();
    ratios.sort_by(f64::total_cmp);
    (ratios.len() >= least).then(|| quantile(&ratios, 0.5))
}

/// Times shorter than this are too near the clock's own spread to be compared, nanoseconds.
const TELLING_NS: f64 = 1000.0;
const LEAST_BATCHES: usize = 5;
const LEAST_REPEATS: usize = 16;
const LEAST_TIMES: usize = 500;
/// Pauses, and the rest of the time, that say something.
const LEAST_NS: f64 = 8e6;
/// A wait that began before a pass counts when it ends, some milliseconds for each of them on a busy machine.
const LEAST_BUSY_NS: f64 = 500e6;

/// A check that a plugin's passes do not meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// Which.
    pub check: Check,
    /// What was measured.
    pub found: f64,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.check.allowed();
        let (name, found) = (self.check.name(), self.found);
        let what = match self.check {
            Check::Batches => "its questions took in batches, as a share of the same questions alone,",
            Check::Repeats => "its questions took the second time, as a share of the first,",
            Check::BetweenQueries => "of the time in which nothing was asked, it computed",
            Check::ProcessorTime => "of the time in which it was asked, it computed or waited for its processor for",
            Check::TailShape => "the spread of its times in one process differs from another one's by a factor of",
        };
        write!(f, "{name}: {what} {found:.2}, and {low} to {high} is what honest plugins show")
    }
}

/// Every check's value where there is enough to go by.
pub fn measured(passes: &[PassFacts]) -> Vec<Finding> {
    Check::all().into_iter().filter_map(|check| Some(Finding { check, found: check.found(passes)? })).collect()
}

/// The first check that the passes do not meet.
pub fn violated(passes: &[PassFacts]) -> Option<Finding> {
    measured(passes).into_iter().find(|finding| {
        let [low, high] = finding.check.allowed();
        !(low..=high).contains(&finding.found)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn batches(questions: u32, alone_ns: f64, together_ns: f64) -> Vec<Batched> {
        vec![Batched { questions, alone_ns, together_ns }; 6]
    }

    /// A long, honest pass.
    fn honest() -> PassFacts {
        PassFacts {
            timed: 1000,
            batches: batches(100, 1.1e6, 1e6),
            repeats: vec![[1e4, 0.9e4]; 20],
            pauses_ns: [16e6, 1e3],
            busy_ns: Some([300e6, 299e6]),
            steal: Some(0.0),
            times_ns: [5e3, 1e4, 2e4],
            ..PassFacts::default()
        }
    }

    #[test]
    fn honest_passes_meet_every_check_and_short_ones_say_nothing() {
        assert_eq!(violated(&[honest(), honest()]), None);
        assert_eq!(measured(&[honest(), honest()]).len(), 5);
        assert_eq!(measured(&[PassFacts::default()]), []);
        // Times near the clock's spread say nothing about a batch or a repeat.
        let fast = PassFacts { batches: batches(100, 5e4, 1e3), repeats: vec![[500.0, 1.0]; 20], ..honest() };
        assert_eq!(violated(&[fast]), None);
        // One batch that met something says nothing either.
        let mut odd = honest();
        odd.batches[0].together_ns = 1e9;
        assert_eq!(violated(&[odd]), None);
        // On a machine that is taken away now and then, processor time says nothing.
        assert_eq!(violated(&[PassFacts { steal: Some(0.05), busy_ns: Some([300e6, 450e6]), ..honest() }]), None);
    }

    #[test]
    fn each_lie_meets_its_own_check() {
        let lies = [
            (Check::Batches, PassFacts { batches: batches(100, 1.1e6, 0.1e6), ..honest() }),
            (Check::Batches, PassFacts { batches: batches(100, 1.1e6, 5e6), ..honest() }),
            (Check::Repeats, PassFacts { repeats: vec![[1e4, 1e2]; 20], ..honest() }),
            (Check::BetweenQueries, PassFacts { pauses_ns: [16e6, 8e6], ..honest() }),
            (Check::ProcessorTime, PassFacts { busy_ns: Some([300e6, 540e6]), ..honest() }),
            (Check::TailShape, PassFacts { times_ns: [1.9e4, 2e4, 2.1e4], ..honest() }),
        ];
        for (check, lie) in lies {
            // In every process, except for the shape, which is compared between them.
            let passes = if check == Check::TailShape { [honest(), lie] } else { [lie.clone(), lie] };
            let found = violated(&passes).unwrap_or_else(|| panic!("{check:?} is not seen"));
            assert_eq!(found.check, check, "{found}");
            assert!(found.to_string().starts_with(check.name()), "{found}");
        }
    }
}
