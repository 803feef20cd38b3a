//! Does what the supervisor saw from outside fit together? A second line: what these checks find would have gained nothing
//! (`pass.rs`), but a plugin that tries has no rank. The thresholds are far from what honest plugins show
//! (`sandbox/README.md`); a check with too little to go by says nothing.

use std::fmt;

use ocb_core::statistics::quantile;

use crate::pass::{Batched, PassFacts};

/// The checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// Questions that come again in a batch against the same questions alone.
    Batches,
    /// What the runner computes while nothing is asked.
    BetweenQueries,
}

impl Check {
    /// Its name in outcomes and files.
    pub fn name(self) -> &'static str {
        match self {
            Check::Batches => "batches",
            Check::BetweenQueries => "between queries",
        }
    }

    /// What honest plugins stay within.
    pub fn allowed(self) -> [f64; 2] {
        match self {
            // Warm caches make short questions three times as fast in a batch; nothing honest makes long ones ten times.
            Check::Batches => [0.1, 20.0],
            Check::BetweenQueries => [0.0, 0.1],
        }
    }

    fn all() -> [Check; 2] {
        [Check::Batches, Check::BetweenQueries]
    }

    /// The measured value; absent when there is too little to go by.
    fn found(self, passes: &[PassFacts]) -> Option<f64> {
        match self {
            Check::Batches => {
                let telling = |batch: &&Batched| batch.alone_ns >= f64::from(batch.questions) * TELLING_NS;
                let batches = passes.iter().flat_map(|pass| &pass.batches).filter(telling);
                let mut ratios: Vec<f64> = batches.map(|batch| batch.together_ns / batch.alone_ns).collect();
                ratios.sort_by(f64::total_cmp);
                // What happens to a few of them on a busy machine says nothing of a plugin.
                (ratios.len() >= LEAST_BATCHES).then(|| quantile(&ratios, 0.5))
            }
            Check::BetweenQueries => {
                let time = |pass: &PassFacts| pass.asked_ns[0] + pass.rested_ns;
                let asked = passes.iter().filter(|pass| time(pass) > 0.0);
                let mut shares: Vec<f64> = asked.map(|pass| pass.beside_ns / time(pass)).collect();
                shares.sort_by(f64::total_cmp);
                // As a question's time is the median over the processes, so is what was computed beside it.
                (passes.iter().map(time).sum::<f64>() >= LEAST_NS).then(|| quantile(&shares, 0.5))
            }
        }
    }
}

/// Questions shorter than this are too near the clock's own spread, and to what warm caches change, nanoseconds.
const TELLING_NS: f64 = 5000.0;
const LEAST_BATCHES: usize = 3;
/// Passes that say something, nanoseconds.
const LEAST_NS: f64 = 1e6;

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
            Check::Batches => "the time of its repeated queries, as a share of the first time, was",
            Check::BetweenQueries => "the time that it computed between queries, as a share of the whole time, was",
        };
        write!(f, "{name}: {what} {found:.2}; {low} to {high} is expected")
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
            batches: batches(100, 1.1e6, 1e6),
            asked_ns: [20e6, 0.0],
            rested_ns: 16e6,
            beside_ns: 1e3,
            ..PassFacts::default()
        }
    }

    #[test]
    fn honest_passes_meet_every_check_and_short_ones_say_nothing() {
        assert_eq!(violated(&[honest(), honest()]), None);
        assert_eq!(measured(&[honest(), honest()]).len(), 2);
        assert_eq!(measured(&[PassFacts::default()]), []);
        // Times near the clock's spread say nothing about a batch: some methods are three times as fast warm as cold.
        let fast = PassFacts { batches: batches(100, 5e4, 1e3), ..honest() };
        assert_eq!(violated(&[fast]), None);
        // One batch that met something says nothing either.
        let mut odd = honest();
        odd.batches[0].together_ns = 1e9;
        assert_eq!(violated(&[odd]), None);
        // Nor does one process of three that the machine kept busy.
        let kept = PassFacts { beside_ns: 20e6, ..honest() };
        assert_eq!(violated(&[honest(), kept, honest()]), None);
    }

    #[test]
    fn each_lie_meets_its_own_check() {
        let lies = [
            (Check::Batches, PassFacts { batches: batches(100, 1.1e6, 0.01e6), ..honest() }),
            (Check::BetweenQueries, PassFacts { beside_ns: 8e6, ..honest() }),
        ];
        for (check, lie) in lies {
            let found = violated(&[lie.clone(), lie]).unwrap_or_else(|| panic!("{check:?} is not seen"));
            assert_eq!(found.check, check, "{found}");
            assert!(found.to_string().starts_with(check.name()), "{found}");
        }
    }
}
