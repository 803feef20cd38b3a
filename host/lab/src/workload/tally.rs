//! What one algorithm did with the queries of a recording so far.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use ocb_core::record::Verdict;
use ocb_core::statistics::{Statistic, quantile};
use ocb_core::workload::Recorded;

use super::recorded::Truths;
use super::table::WorkloadRow;
use crate::algorithm::Algorithm;
use crate::model::{AlgorithmOnWorkload, EndedPair, GroupTimes, OutcomeInfo, PairTime, TotalTime, Track};

/// One query that was answered.
pub struct Answered {
    /// Place in the recording.
    pub row: u32,
    /// Median of the times.
    pub time_ns: f64,
    /// Round and time.
    pub times: Vec<(u32, f64)>,
    /// The gravest of all rounds.
    pub verdict: Verdict,
    /// The objects certainly collide, as surfaces.
    pub hit: bool,
}

/// One algorithm in one order.
pub struct Tally {
    algorithm: Arc<Algorithm>,
    of: u64,
    /// Queries of each group that it can be asked.
    of_group: HashMap<u64, u32>,
    /// Place in the recording, time, verdict.
    answered: Vec<(u32, f64, Verdict)>,
    /// Sum of the times of each round.
    rounds: Vec<f64>,
    build_ns: f64,
    pairs: BTreeMap<[u32; 2], PairTime>,
    ended: Vec<EndedPair>,
}

impl Tally {
    /// Nothing asked yet.
    pub fn new(algorithm: &Arc<Algorithm>, passes: u32) -> Self {
        Self {
            algorithm: algorithm.clone(),
            of: 0,
            of_group: HashMap::new(),
            answered: Vec::new(),
            rounds: vec![0.0; passes as usize],
            build_ns: 0.0,
            pairs: BTreeMap::new(),
            ended: Vec::new(),
        }
    }

    /// It answers queries of this kind.
    pub fn is_asked(&mut self, rows: &[u32], queries: &[Recorded]) {
        self.of += rows.len() as u64;
        for &row in rows {
            *self.of_group.entry(queries[row as usize].group).or_default() += 1;
        }
    }

    /// What was measured of a part.
    pub fn add(&mut self, objects: [u32; 2], answered: &[Answered]) {
        let pair = self.pairs.entry(objects).or_insert(PairTime { objects, n: 0, hits: 0, wrong: 0, ns: 0.0 });
        for Answered { row, time_ns, times, verdict, hit } in answered {
            pair.n += 1;
            pair.hits += u64::from(*hit);
            pair.wrong += u64::from(verdict.is_wrong());
            pair.ns += time_ns;
            self.answered.push((*row, *time_ns, *verdict));
            // A round without this query counts it as the others do.
            for (round, sum) in (0..).zip(&mut self.rounds) {
                *sum += times.iter().find(|(of, _)| *of == round).map_or(*time_ns, |(_, ns)| *ns);
            }
        }
    }

    /// It has built something that was not built before, in each of its processes.
    pub fn built(&mut self, mut builds_ns: Vec<f64>) {
        self.build_ns += Statistic::Median.of(&mut builds_ns).unwrap_or(0.0);
    }

    /// A process of it has ended before all was asked: one of this pair of objects, or of the whole scene.
    pub fn ended(&mut self, objects: Option<[u32; 2]>, outcome: OutcomeInfo) {
        self.ended.push(EndedPair { objects, outcome });
    }

    /// Id of the algorithm.
    pub fn algorithm(&self) -> &str {
        &self.algorithm.info.id
    }

    /// Place in the recording, time and verdict of each answered query.
    pub fn answered(&self) -> &[(u32, f64, Verdict)] {
        &self.answered
    }

    /// Each answered query, in the order of the recording, with what is known of it.
    pub fn rows(&self, track: Track, known: &Truths) -> impl Iterator<Item = WorkloadRow> {
        let mut answered = self.answered.clone();
        answered.sort_unstable_by_key(|(row, ..)| *row);
        let algorithm: Arc<str> = self.algorithm.info.id.as_str().into();
        answered.into_iter().map(move |(row, time_ns, verdict)| WorkloadRow {
            algorithm: algorithm.clone(),
            track,
            row,
            time_ns,
            verdict,
            hit: known.hits[row as usize].unwrap_or(false),
            triangles: known.triangles[row as usize],
        })
    }

    /// The whole.
    pub fn result(self, queries: &[Recorded]) -> AlgorithmOnWorkload {
        let count = |of: fn(Verdict) -> bool| self.answered.iter().filter(|(.., verdict)| of(*verdict)).count() as u64;
        let total = (!self.answered.is_empty()).then(|| TotalTime {
            ns: self.answered.iter().map(|(_, ns, _)| ns).sum(),
            lowest_ns: self.rounds.iter().copied().fold(f64::INFINITY, f64::min),
            highest_ns: self.rounds.iter().copied().fold(0.0, f64::max),
        });
        let (wrong, missed) = (count(Verdict::is_wrong), count(|verdict| verdict == Verdict::FalseNegative));
        let (undecided, silent) = (count(|verdict| verdict == Verdict::Undecidable), count(Verdict::is_silent));
        let groups = self.groups(queries);
        let mut pairs: Vec<PairTime> = self.pairs.into_values().collect();
        pairs.sort_by(|a, b| b.ns.total_cmp(&a.ns));
        AlgorithmOnWorkload {
            algorithm: self.algorithm.info.id.clone(),
            name: self.algorithm.info.name.clone(),
            of: self.of,
            n: self.answered.len() as u64,
            total,
            build_ns: self.build_ns,
            wrong,
            missed,
            undecided,
            silent,
            groups,
            pairs,
            ended: self.ended,
        }
    }

    fn groups(&self, queries: &[Recorded]) -> Option<GroupTimes> {
        let mut groups: HashMap<u64, (u32, f64)> = HashMap::new();
        for (row, ns, _) in &self.answered {
            let (n, sum) = groups.entry(queries[*row as usize].group).or_default();
            (*n, *sum) = (*n + 1, *sum + ns);
        }
        let whole = groups.into_iter().filter(|(group, (n, _))| self.of_group.get(group) == Some(n));
        let mut whole: Vec<(f64, u64)> = whole.map(|(group, (_, ns))| (ns, group)).collect();
        whole.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let &(max_ns, worst) = whole.last()?;
        let times: Vec<f64> = whole.iter().map(|(ns, _)| *ns).collect();
        let [median_ns, p95_ns] = [0.5, 0.95].map(|q| quantile(&times, q));
        Some(GroupTimes { n: whole.len() as u64, median_ns, p95_ns, max_ns, worst })
    }
}
