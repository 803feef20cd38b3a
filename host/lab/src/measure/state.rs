//! What one algorithm has answered so far.

use std::sync::Arc;
use std::time::Duration;

use ocb_core::agreement::Said;
use ocb_core::configuration::Placed;
use ocb_core::instance::{AskedAs, Instance};
use ocb_core::query::{Answer, Counters, Query, Semantics};
use ocb_core::record::{Record, TriangleTests, Verdict};
use ocb_core::statistics::Statistic;
use ocb_core::units::Tally;
use ocb_core::validation::{Judged, Precision, Terms, judge};
use ocb_sandbox::{ClockFacts, Ending, Observation, Outcome, PassFacts, Session, SetUp, integrity};
use rayon::prelude::*;

use super::by_unit::{UNITS, unit};
use super::process_pass::Purpose;
use super::weave::Reach;
use super::{outcome_info, surplus};
use crate::algorithm::Algorithm;
use crate::model::{AlgorithmInfo, OutcomeInfo};
use crate::pairing::Pairing;

/// One algorithm while it is measured.
pub struct MeasuringState {
    /// The algorithm.
    pub algorithm: Arc<Algorithm>,
    /// How far into the shared order it came.
    pub reach: Reach,
    /// The budget let it come no further.
    pub cut: bool,
    /// Questions answered.
    pub done: u64,
    /// Wall time of its timed passes.
    pub spent: Duration,
    /// Configurations of the set, and the controls behind them.
    cells: Vec<Cell>,
    own: usize,
    unjudged: Vec<(u32, AskedAs, Answer)>,
    triangle_tests: Option<TriangleTests>,
    passes: Vec<PassFacts>,
    /// What the process under way was asked undisturbed, with the times.
    asked: Vec<(u32, f64)>,
    /// Of each official pass: the number of its process, and what that was asked.
    sequences: Vec<(usize, Vec<(u32, f64)>)>,
    set_ups: Vec<SetUp>,
    memory_bytes: Option<u64>,
    clocks: Vec<ClockFacts>,
    layers: Vec<String>,
    outcome: Option<OutcomeInfo>,
}

/// One configuration, or one control.
#[derive(Default)]
struct Cell {
    /// Round and official time, nanoseconds.
    times: Vec<(u32, f64)>,
    below: u32,
    /// The same where the supervisor was kept from looking: longer than it took.
    late: Vec<(u32, f64)>,
    /// The first answer, or the first with a graver verdict.
    judged: Option<(Answer, Judged)>,
    /// As what that one was asked for.
    asked: AskedAs,
    counters: Option<Counters>,
    /// What the first answer came down to, how far right distances may lie from it, and how many answers contradict it.
    first: Option<Said>,
    slack: f64,
    flips: u32,
    /// Process and time in other units, nanoseconds.
    elsewhere: Vec<(u32, f64)>,
    /// Its answers in each unit.
    tallies: [Tally; UNITS],
}

impl Cell {
    /// Those that count: where there is no other, one that is too long.
    fn official(&self) -> &[(u32, f64)] {
        if self.times.is_empty() { &self.late } else { &self.times }
    }

    fn said(&mut self, said: Said) {
        let first = *self.first.get_or_insert(said);
        self.flips += u32::from(first.contradicts(said, self.slack));
    }

    /// Counts an answer to the unit in which it was given.
    fn count(&mut self, asked: AskedAs, verdict: Verdict) {
        let tally = &mut self.tallies[unit(asked.process)];
        tally.answers += 1;
        tally.wrong += u32::from(verdict.is_wrong());
        tally.missed += u32::from(verdict == Verdict::FalseNegative);
    }

    /// The same without other units, and without the pairs of a list of contacts, of which there may be many.
    fn sketch(&self) -> Self {
        let short = |answer: &Answer| match answer {
            Answer::Contacts { total, .. } => Answer::Contacts { total: *total, pairs: Vec::new() },
            other => other.clone(),
        };
        Self {
            times: self.times.clone(),
            below: self.below,
            late: self.late.clone(),
            judged: self.judged.as_ref().map(|(answer, judged)| (short(answer), *judged)),
            asked: self.asked,
            counters: self.counters,
            flips: self.flips,
            ..Self::default()
        }
    }

    fn keep(&mut self, asked: AskedAs, answer: Answer, judged: Judged) {
        let graver = |(_, known): &(Answer, Judged)| judged.verdict.gravity() > known.verdict.gravity();
        if self.judged.as_ref().is_none_or(graver) {
            (self.asked, self.judged) = (asked, Some((answer, judged)));
        }
    }
}

/// The arithmetic that an algorithm declares.
pub fn precision(algorithm: &AlgorithmInfo) -> Precision {
    if algorithm.single_precision { Precision::Single } else { Precision::Double }
}

/// All that was measured of one algorithm.
pub struct Measured {
    /// The algorithm.
    pub algorithm: Arc<Algorithm>,
    /// In the order of the set; only what was reached.
    pub records: Vec<Record>,
    /// What it counted for each triangle, where that adds up.
    pub triangle_tests: Option<TriangleTests>,
    /// Of every control the gravest verdict; absent where it was not asked.
    pub controls: Vec<Option<Verdict>>,
    /// Configurations in the set.
    pub of: usize,
    /// How the runner ended; absent when it did all that was asked.
    pub outcome: Option<OutcomeInfo>,
    /// Stopped by the budget before the whole set.
    pub budget_limited: bool,
    /// In each process the time to load the plugin and to build both structures, with what was built while it was asked.
    pub set_ups: Vec<SetUp>,
    /// Largest peak memory of the processes.
    pub memory_bytes: Option<u64>,
    /// The clock of each process.
    pub clocks: Vec<ClockFacts>,
    /// What each official pass showed.
    pub passes: Vec<PassFacts>,
    /// Layers of the jail.
    pub layers: Vec<String>,
    /// Round and time of every official time, by configuration.
    pub times: Vec<Vec<(u32, f64)>>,
    /// Number of the process and time of every time in other units, by configuration.
    pub elsewhere: Vec<Vec<(u32, f64)>>,
    /// The answers in each unit, by configuration.
    pub tallies: Vec<[Tally; UNITS]>,
    /// Wall seconds per question with everything around it.
    pub seconds_per_query: Option<f64>,
}

impl MeasuringState {
    /// Nothing measured yet. There is one `slack` for each configuration, of which the first `own` are the set's: how far two
    /// right distances may lie apart.
    pub fn new(algorithm: Arc<Algorithm>, slack: &[f64], own: usize) -> Self {
        Self {
            algorithm,
            reach: Reach::default(),
            cut: false,
            done: 0,
            spent: Duration::ZERO,
            cells: slack.iter().map(|&slack| Cell { slack, ..Cell::default() }).collect(),
            own,
            unjudged: Vec::new(),
            triangle_tests: None,
            asked: Vec::new(),
            sequences: Vec::new(),
            set_ups: Vec::new(),
            memory_bytes: None,
            clocks: Vec::new(),
            passes: Vec::new(),
            layers: Vec::new(),
            outcome: None,
        }
    }

    /// The arithmetic that it declares.
    pub fn precision(&self) -> Precision {
        precision(&self.algorithm.info)
    }

    /// It died; no further pass.
    pub fn ended(&self) -> bool {
        self.outcome.is_some()
    }

    /// Notes the first cause of its end.
    pub fn end(&mut self, outcome: OutcomeInfo) {
        self.outcome.get_or_insert(outcome);
    }

    /// A fresh process has built both structures. What it took for that in another unit is in no number: a plugin that
    /// recognises the unit could build less there.
    pub fn begin_process(&mut self, session: &Session, purpose: Purpose) {
        if purpose != Purpose::Elsewhere {
            self.set_ups.push(session.set_up());
        }
        self.asked.clear();
        self.clocks.push(*session.clock());
        self.layers = session.layers().to_vec();
    }

    /// A process has left.
    pub fn end_process(&mut self, ending: &Ending) {
        self.memory_bytes = self.memory_bytes.max(ending.memory_peak_bytes);
    }

    /// An answer of a timed pass in this process, in the original's numbers.
    pub fn observe(&mut self, purpose: Purpose, process: u32, seen: Observation) {
        if let Some(time) = seen.time {
            let cell = &mut self.cells[seen.configuration as usize];
            match purpose {
                Purpose::Official(round) if time.disturbed => cell.late.push((round, time.ns)),
                Purpose::Official(round) => {
                    cell.times.push((round, time.ns));
                    cell.below += u32::from(time.below_resolution);
                    self.asked.push((seen.configuration, time.ns));
                }
                Purpose::Look => cell.times.push((0, time.ns)),
                Purpose::Elsewhere | Purpose::Counting => cell.elsewhere.push((process, time.ns)),
            }
            self.done += 1;
        }
        let asked = AskedAs { process: Some(process), instance: seen.instance };
        self.answered(seen.configuration, asked, seen.answer);
    }

    /// An official pass is over.
    pub fn end_pass(&mut self, facts: PassFacts) {
        if let Some(set_up) = self.set_ups.last_mut() {
            set_up.build_ns += facts.beside_ns;
        }
        self.passes.push(facts);
        self.sequences.push((self.set_ups.len() - 1, std::mem::take(&mut self.asked)));
    }

    /// The times of the last pass, over these configurations, do not count: the machine was taken away from it. Its answers
    /// do.
    pub fn forget(&mut self, round: u32, configurations: &[u32]) {
        self.passes.pop();
        self.sequences.pop();
        for i in configurations {
            let cell = &mut self.cells[*i as usize];
            let before = cell.times.len() + cell.late.len();
            cell.times.retain(|(of, _)| *of != round);
            cell.late.retain(|(of, _)| *of != round);
            // At most one time of a round is in a cell.
            cell.below = cell.below.min(cell.times.len() as u32);
            self.done -= (before - cell.times.len() - cell.late.len()) as u64;
        }
    }

    /// An answer of the untimed pass.
    pub fn count(&mut self, configuration: u32, answer: Answer, counters: Option<Counters>) {
        self.cells[configuration as usize].counters = counters;
        self.done += 1;
        self.answered(configuration, AskedAs { process: None, instance: Instance::default() }, answer);
    }

    /// The untimed pass is over: what it counted for each triangle.
    pub fn end_counting(&mut self, queries: usize, tests: Option<[Vec<u32>; 2]>) {
        self.triangle_tests = tests.map(|tests| TriangleTests { queries: queries as u32, tests });
    }

    /// The answer that was judged in an earlier pass needs no second look; every other one does.
    fn answered(&mut self, configuration: u32, asked: AskedAs, answer: Answer) {
        let cell = &mut self.cells[configuration as usize];
        cell.said(Said::of(&answer));
        let known = cell.judged.as_ref().filter(|(known, _)| *known == answer).map(|(_, judged)| judged.verdict);
        match known {
            Some(verdict) => cell.count(asked, verdict),
            None => self.unjudged.push((configuration, asked, answer)),
        }
    }

    /// Compares the new answers with the truth, on the CPUs that do not measure. The gravest verdict of all passes
    /// stands; an algorithm that is right only sometimes is not right.
    pub fn judge<'p>(
        &mut self,
        pairing: &Pairing,
        placed: impl Fn(u32) -> &'p Placed + Sync,
        query: Query,
        semantics: Semantics,
    ) {
        let terms = Terms { query, semantics, precision: self.precision() };
        let pair = pairing.seen_in(terms.precision).pair();
        let one = |i: u32, answer: &Answer| judge(&pair, &placed(i).seen_in(terms.precision), terms, answer);
        let judged: Vec<Judged> = self.unjudged.par_iter().map(|(i, _, answer)| one(*i, answer)).collect();
        for ((i, asked, answer), judged) in self.unjudged.drain(..).zip(judged) {
            self.cells[i as usize].count(asked, judged.verdict);
            self.cells[i as usize].keep(asked, answer, judged);
        }
    }

    /// It may have a place: it has not died, and no answer so far, to a control or to another, was wrong or missing.
    pub fn fair(&self) -> bool {
        let fair = |(_, judged): &(Answer, Judged)| !judged.verdict.is_wrong() && !judged.verdict.is_silent();
        !self.ended() && self.cells.iter().filter_map(|cell| cell.judged.as_ref()).all(fair)
    }

    /// The official times so far, with the round of each, by configuration.
    pub fn times(&self) -> Vec<Vec<(u32, f64)>> {
        self.cells[..self.own].iter().map(|cell| cell.official().to_vec()).collect()
    }

    /// The answers that stand for its configurations.
    pub fn answers(&self) -> impl Iterator<Item = &Answer> {
        self.cells[..self.own].iter().filter_map(|cell| cell.judged.as_ref()).map(|(answer, _)| answer)
    }

    /// What was measured of these configurations so far; in its records, their places stand for them. Whether the times fit
    /// together is found out at the end.
    pub fn so_far(&self, numbers: &[u32]) -> Measured {
        let cells = numbers.iter().map(|number| self.cells[*number as usize].sketch()).collect();
        let mut state = Self { cells, ..Self::new(self.algorithm.clone(), &[], numbers.len()) };
        state.set_ups.clone_from(&self.set_ups);
        (state.cut, state.spent) = (self.cut, self.spent);
        (state.memory_bytes, state.outcome) = (self.memory_bytes, self.outcome.clone());
        state.into_measured()
    }

    /// The medians over the passes. Times that do not fit together are not believed, and that is its outcome.
    pub fn into_measured(mut self) -> Measured {
        if let (None, Some(finding)) = (&self.outcome, integrity::violated(&self.passes)) {
            self.end(outcome_info(&Outcome::TimingIntegrity { finding }));
        }
        let of = self.own;
        let queries: usize = self.cells.iter().map(|c| c.times.len() + c.late.len() + c.elsewhere.len()).sum();
        for (process, asked) in &self.sequences {
            let usual = |configuration: u32| surplus::usual(&self.cells[configuration as usize].times);
            self.set_ups[*process].build_ns += surplus::surplus_ns(asked, usual);
        }
        let verdict = |cell: Cell| cell.judged.map(|(_, judged)| judged.verdict);
        let controls = self.cells.split_off(of).into_iter().map(verdict).collect();
        let (mut records, mut times) = (Vec::new(), Vec::with_capacity(of));
        let (mut elsewhere, mut tallies) = (Vec::with_capacity(of), Vec::with_capacity(of));
        for (configuration, cell) in (0..).zip(self.cells) {
            let official = cell.official().to_vec();
            let passes = official.len() as u32;
            let median = Statistic::Median.of(&mut official.iter().map(|(_, ns)| *ns).collect::<Vec<_>>());
            times.push(official);
            elsewhere.push(cell.elsewhere);
            tallies.push(cell.tallies);
            if let (Some(time_ns), Some((answer, Judged { verdict, contacts }))) = (median, cell.judged) {
                let below_resolution = 2 * cell.below >= passes;
                let counters = cell.counters;
                records.push(Record {
                    configuration,
                    time_ns,
                    below_resolution,
                    passes,
                    counters,
                    answer,
                    asked: cell.asked,
                    verdict,
                    contacts,
                    flips: cell.flips,
                });
            }
        }
        Measured {
            budget_limited: self.outcome.is_none() && self.cut,
            algorithm: self.algorithm,
            triangle_tests: self.triangle_tests,
            records,
            controls,
            of,
            outcome: self.outcome,
            set_ups: self.set_ups,
            memory_bytes: self.memory_bytes,
            clocks: self.clocks,
            passes: self.passes,
            layers: self.layers,
            times,
            elsewhere,
            tallies,
            seconds_per_query: (queries > 0).then(|| self.spent.as_secs_f64() / queries as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ocb_core::record::Verdict;

    #[test]
    fn answers_that_contradict_the_first_one_are_counted() {
        let mut cell = Cell { slack: 0.5, ..Cell::default() };
        for said in [Said::Distance(1.0), Said::Distance(1.25), Said::Distance(2.0), Said::Nothing] {
            cell.said(said);
        }
        assert_eq!(cell.flips, 2);
    }

    #[test]
    fn an_answer_counts_in_the_unit_of_its_process() {
        let mut cell = Cell::default();
        let asked = |process| AskedAs { process, instance: Instance::default() };
        for (process, verdict) in [
            (None, Verdict::Correct),
            (Some(4), Verdict::Correct),
            (Some(0), Verdict::FalseNegative),
            (Some(2), Verdict::FalsePositive),
            (Some(1), Verdict::GaveUp),
        ] {
            cell.count(asked(process), verdict);
        }
        let counted = cell.tallies.map(|Tally { answers, wrong, missed }| [answers, wrong, missed]);
        assert_eq!(counted, [[2, 0, 0], [2, 2, 1], [1, 0, 0]]);
    }

    #[test]
    fn the_gravest_verdict_of_all_passes_stands_with_its_answer() {
        let hit = |hit| Answer::Collision { hit, pair: None };
        let judged = |verdict| Judged { verdict, contacts: None };
        let mut cell = Cell::default();
        let mut number = 0;
        let mut stands = |answer: Answer, verdict| {
            let asked = AskedAs { process: Some(number), instance: Instance::default() };
            number += 1;
            cell.keep(asked, answer, judged(verdict));
            cell.judged.clone().map(|(answer, judged)| (answer, judged.verdict))
        };
        assert_eq!(stands(hit(true), Verdict::Correct), Some((hit(true), Verdict::Correct)));
        assert_eq!(stands(Answer::GaveUp, Verdict::GaveUp), Some((Answer::GaveUp, Verdict::GaveUp)));
        assert_eq!(stands(hit(true), Verdict::Correct), Some((Answer::GaveUp, Verdict::GaveUp)));
        assert_eq!(stands(hit(false), Verdict::FalseNegative), Some((hit(false), Verdict::FalseNegative)));
        assert_eq!(stands(hit(true), Verdict::WrongWitness), Some((hit(false), Verdict::FalseNegative)));
        // Asked for by the fourth process.
        assert_eq!(cell.asked.process, Some(3));
    }
}
