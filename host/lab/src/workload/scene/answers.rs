//! What one algorithm answered about a scene, and when.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::time::Duration;

use ocb_core::query::Answer;
use ocb_core::statistics::Statistic;
use ocb_sandbox::{Observation, Outcome, PassFacts, SetUp, Time, integrity};

use crate::measure::{Stop, outcome_info, surplus};
use crate::model::OutcomeInfo;

/// A pass ends when lists of contacts with so many pairs together are in memory.
const PAIRS: u64 = 1 << 24;

/// One process.
pub struct Round {
    /// What it did before the first query; in the end with what it built while it was asked.
    pub set_up: SetUp,
    times: Vec<Option<Time>>,
    facts: PassFacts,
}

impl Round {
    /// Nothing asked yet, of so many queries.
    pub fn new(set_up: SetUp, queries: usize) -> Self {
        Self { set_up, times: vec![None; queries], facts: PassFacts::default() }
    }

    /// The time of a query that was answered undisturbed.
    fn undisturbed(&self, number: usize) -> Option<f64> {
        self.times.get(number).copied().flatten().filter(|time| !time.disturbed).map(|time| time.ns)
    }
}

/// All processes of one algorithm.
pub struct Answers {
    /// So many queries of the order are asked.
    pub reach: usize,
    /// The budget let it come no further.
    pub cut: bool,
    /// Wall time of its passes.
    pub spent: Duration,
    /// Those that count.
    pub rounds: Vec<Round>,
    /// How it ended; absent when it did all that was asked.
    pub outcome: Option<OutcomeInfo>,
    /// The first answer to each query, and others.
    first: Vec<Option<Answer>>,
    others: HashMap<u32, Vec<Answer>>,
    pairs: u64,
}

impl Answers {
    /// Nothing asked yet, of so many queries.
    pub fn new(queries: usize) -> Self {
        Self {
            reach: queries,
            cut: false,
            spent: Duration::ZERO,
            rounds: Vec::new(),
            outcome: None,
            first: vec![None; queries],
            others: HashMap::new(),
            pairs: 0,
        }
    }

    /// An answer in this pass, in the original's numbers.
    pub fn observe(&mut self, seen: Observation, stop: &Stop) -> ControlFlow<()> {
        let number = seen.configuration as usize;
        if let (Some(time), Some(round)) = (seen.time, self.rounds.last_mut()) {
            round.times[number] = Some(time);
        }
        let others = self.others.get(&seen.configuration);
        if !self.first[number].iter().chain(others.into_iter().flatten()).any(|known| *known == seen.answer) {
            self.pairs += if let Answer::Contacts { pairs, .. } = &seen.answer { pairs.len() as u64 } else { 0 };
            match &mut self.first[number] {
                first @ None => *first = Some(seen.answer),
                Some(_) => self.others.entry(seen.configuration).or_default().push(seen.answer),
            }
        }
        if self.pairs > PAIRS || stop.asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// A pass is over.
    pub fn end_pass(&mut self, facts: PassFacts) {
        if let Some(round) = self.rounds.last_mut() {
            round.set_up.build_ns += facts.beside_ns;
            round.facts = facts;
        }
    }

    /// Notes the first cause of its end.
    pub fn end(&mut self, outcome: &Outcome) {
        self.outcome.get_or_insert_with(|| outcome_info(outcome));
    }

    /// After the last pass: times that do not fit together are not believed, and what queries took beyond their usual time was
    /// building.
    pub fn conclude(&mut self) {
        let facts: Vec<PassFacts> = self.rounds.iter().map(|round| round.facts.clone()).collect();
        if let Some(finding) = integrity::violated(&facts) {
            self.end(&Outcome::TimingIntegrity { finding });
        }
        let surplus = |round: &Round| {
            let asked = (0..round.times.len()).filter_map(|i| Some((i as u32, round.undisturbed(i)?)));
            surplus::surplus_ns(&asked.collect::<Vec<_>>(), |i| surplus::usual(&self.undisturbed(i as usize)))
        };
        let surpluses: Vec<f64> = self.rounds.iter().map(surplus).collect();
        for (round, surplus_ns) in self.rounds.iter_mut().zip(surpluses) {
            round.set_up.build_ns += surplus_ns;
        }
    }

    fn undisturbed(&self, number: usize) -> Vec<(u32, f64)> {
        (0..).zip(&self.rounds).filter_map(|(round, it)| Some((round, it.undisturbed(number)?))).collect()
    }

    /// Round and time of a query; times that are too long only where there is no other.
    pub fn official(&self, number: usize) -> Vec<(u32, f64)> {
        let undisturbed = self.undisturbed(number);
        if !undisturbed.is_empty() {
            return undisturbed;
        }
        let late = |round: &Round| round.times.get(number).copied().flatten().map(|time| time.ns);
        (0..).zip(&self.rounds).filter_map(|(round, it)| Some((round, late(it)?))).collect()
    }

    /// The median of the official times; nothing where the query was not asked for its time.
    pub fn time_ns(&self, number: usize) -> Option<f64> {
        Statistic::Median.of(&mut self.official(number).iter().map(|(_, ns)| *ns).collect::<Vec<_>>())
    }

    /// Every different answer to a query.
    pub fn of(&self, number: usize) -> impl Iterator<Item = &Answer> {
        self.first[number].iter().chain(self.others.get(&(number as u32)).into_iter().flatten())
    }
}

#[cfg(test)]
mod tests {
    use ocb_core::instance::Instance;

    use super::*;

    fn asked(answers: &mut Answers, configuration: u32, ns: f64, disturbed: bool, hit: bool) {
        let time = Some(Time { ns, below_resolution: false, disturbed });
        let answer = Answer::Collision { hit, pair: None };
        let seen = Observation { configuration, instance: Instance::default(), answer, time };
        assert!(answers.observe(seen, &Stop::default()).is_continue());
    }

    #[test]
    fn disturbed_times_count_only_where_there_is_no_other_and_each_answer_is_kept_once() {
        let mut answers = Answers::new(3);
        for (ns, disturbed, hit) in [(10.0, false, true), (900.0, true, true), (30.0, false, false)] {
            answers.rounds.push(Round::new(SetUp::default(), 3));
            asked(&mut answers, 0, ns, disturbed, hit);
            asked(&mut answers, 1, ns, true, true);
        }
        assert_eq!(answers.official(0), [(0, 10.0), (2, 30.0)]);
        assert_eq!(answers.time_ns(1), Some(30.0));
        assert_eq!([0, 1, 2].map(|number| answers.of(number).count()), [2, 1, 0]);
        assert_eq!(answers.time_ns(2), None);
    }

    #[test]
    fn what_the_first_query_built_is_building() {
        let mut answers = Answers::new(100);
        for _ in 0..3 {
            answers.rounds.push(Round::new(SetUp { load_ns: 0.0, build_ns: 5.0 }, 100));
            (0..100).for_each(|number| asked(&mut answers, number, 1e4, false, true));
        }
        asked(&mut answers, 0, 4e7, false, true);
        answers.conclude();
        let built: Vec<f64> = answers.rounds.iter().map(|round| round.set_up.build_ns).collect();
        assert_eq!(built, [5.0, 5.0, 5.0 + 4e7 - 1e4]);
        assert_eq!(answers.outcome, None);
    }

    #[test]
    fn lists_of_contacts_do_not_fill_the_memory() {
        let mut answers = Answers::new(1);
        answers.rounds.push(Round::new(SetUp::default(), 1));
        let list = |first: u32| Answer::Contacts { total: 1 << 16, pairs: vec![[first, 0]; 1 << 16] };
        let mut observe = |first: u32| {
            let seen = Observation { configuration: 0, instance: Instance::default(), answer: list(first), time: None };
            answers.observe(seen, &Stop::default()).is_break()
        };
        assert!(!(0..256).any(&mut observe) && !observe(7) && observe(256));
    }
}
