//! The preliminary results of the runs under way. They are kept in memory only and dropped when their run ends, in whatever way.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use ocb_core::configuration::ConfigurationSet;
use ocb_lab::columns::RecordColumns;
use ocb_lab::measure::{Preliminary, rank};

use crate::Profile;
use crate::model::AlgorithmResult;
use crate::runs::remaining::Remaining;

/// Runs by id: one that is carried out here, and those of measuring machines that this process or another service hears from.
#[derive(Default)]
pub struct UnderWay {
    runs: Mutex<HashMap<String, Showing>>,
}

struct Showing {
    /// Set while its machine is heard from: nothing is shown after that.
    until: Option<Instant>,
    /// The configurations that the records are of, while the whole set is being found.
    beginning: Option<Arc<ConfigurationSet>>,
    results: Vec<SoFar>,
    /// Places are given only under all layers of the jail.
    profile: Profile,
    /// Grows with each change.
    version: u64,
    begun: Instant,
    remaining: Remaining,
    seconds_left: f64,
}

struct SoFar {
    place: usize,
    version: u64,
    result: AlgorithmResult,
    records: Arc<RecordColumns>,
    /// What the first look counted. The rounds have no counters; those that stay are counted behind them.
    counted: Option<Arc<RecordColumns>>,
}

impl SoFar {
    /// The algorithm at this place, with the tests that were counted before where there are no others.
    fn after(
        before: Option<Self>,
        place: usize,
        version: u64,
        (mut result, mut records): (AlgorithmResult, RecordColumns),
    ) -> Self {
        if records.has_tests() {
            let records = Arc::new(records);
            return Self { place, version, result, counted: Some(records.clone()), records };
        }
        let Some(Self { result: old, counted: Some(counted), .. }) = before else {
            return Self { place, version, result, records: Arc::new(records), counted: None };
        };
        records.take_tests(&counted);
        (result.bv_tests_mean, result.primitive_tests_mean) = (old.bv_tests_mean, old.primitive_tests_mean);
        Self { place, version, result, records: Arc::new(records), counted: Some(counted) }
    }
}

impl Showing {
    /// The places that the results would have if the run ended now; none in a contract class in which one of them was not
    /// compared with the reference yet. One result moves others.
    fn give_places(&mut self) {
        let mut ranked: Vec<_> = self.results.iter().map(|it| it.result.clone()).collect();
        let uncompared: Vec<_> =
            ranked.iter().filter(|it| it.wrong == 0 && it.ratio.is_none()).map(|it| it.class).collect();
        rank(&mut ranked, self.profile);
        for (so_far, AlgorithmResult { rank, class, .. }) in self.results.iter_mut().zip(ranked) {
            let rank = rank.filter(|_| !uncompared.contains(&class));
            if so_far.result.place_so_far != rank {
                so_far.result.place_so_far = rank;
                so_far.version = self.version;
            }
        }
    }
}

/// Until it is dropped, this run may show something.
pub struct Shown {
    under_way: Arc<UnderWay>,
    run: String,
    begun: Instant,
}

impl Shown {
    /// The machine that measures the run is at work; if it is not heard from for so long, the run shows nothing any more.
    pub fn heard(&self, lease: Duration) {
        if let Some(showing) = self.under_way.lock().get_mut(&self.run).filter(|it| it.begun == self.begun) {
            showing.until = Some(Instant::now() + lease);
        }
    }

    /// Does it still show something?
    pub fn is_heard(&self) -> bool {
        self.under_way.of(&self.run, |showing| showing.begun == self.begun).unwrap_or(false)
    }
}

impl Drop for Shown {
    fn drop(&mut self) {
        let mut runs = self.under_way.lock();
        // Another attempt may have begun.
        if runs.get(&self.run).is_some_and(|it| it.begun == self.begun) {
            runs.remove(&self.run);
        }
    }
}

impl UnderWay {
    /// This run is under way now, in a jail like this. So many algorithms take turns, and earlier runs would have taken so many
    /// seconds.
    pub fn begin(self: &Arc<Self>, run: &str, profile: Profile, algorithms: usize, expected: f64) -> Shown {
        let mut remaining = Remaining::new(algorithms, expected);
        let begun = Instant::now();
        let showing = Showing {
            until: None,
            beginning: None,
            results: Vec::new(),
            profile,
            version: 0,
            begun,
            seconds_left: remaining.tell(0.0),
            remaining,
        };
        self.lock().insert(run.to_owned(), showing);
        Shown { under_way: self.clone(), run: run.to_owned(), begun }
    }

    /// The run was ended.
    pub fn forget(&self, run: &str) {
        self.lock().remove(run);
    }

    /// Updates the estimate of the remaining time.
    pub fn estimate(&self, run: &str, from: impl FnOnce(&mut Remaining)) {
        if let Some(showing) = self.lock().get_mut(run) {
            from(&mut showing.remaining);
            showing.seconds_left = showing.remaining.tell(showing.begun.elapsed().as_secs_f64());
        }
    }

    /// How long the run will still take.
    pub fn seconds_left(&self, run: &str) -> Option<f64> {
        self.of(run, |showing| showing.seconds_left)
    }

    /// The records will be of these configurations, until the whole set is stored.
    pub fn begins_with(&self, run: &str, set: ConfigurationSet) {
        if let Some(showing) = self.lock().get_mut(run) {
            showing.beginning = Some(Arc::new(set));
        }
    }

    /// The algorithm at this place of the run's list has something to show.
    pub fn show(&self, run: &str, place: usize, Preliminary { result, records, seconds }: Preliminary) {
        if let Some(seconds) = seconds {
            self.estimate(run, |remaining| remaining.looked(place, seconds));
        }
        if let Some(showing) = self.lock().get_mut(run) {
            showing.version += 1;
            let before = showing.results.iter().position(|it| it.place == place);
            let before = before.map(|at| showing.results.remove(at));
            showing.results.push(SoFar::after(before, place, showing.version, (result, records)));
            showing.results.sort_by_key(|it| it.place);
            showing.give_places();
        }
    }

    /// The results that are newer than a version, and the newest version.
    pub fn newer(&self, run: &str, than: u64) -> (Vec<AlgorithmResult>, u64) {
        self.of(run, |showing| {
            let newer = showing.results.iter().filter(|it| it.version > than);
            (newer.map(|it| it.result.clone()).collect(), showing.version)
        })
        .unwrap_or((Vec::new(), than))
    }

    /// The numbers of the run's algorithms so far.
    pub fn results(&self, run: &str) -> Vec<AlgorithmResult> {
        self.newer(run, 0).0
    }

    /// Numbers and records of one algorithm so far.
    pub fn records(&self, run: &str, algorithm: &str) -> Option<(AlgorithmResult, Arc<RecordColumns>)> {
        self.of(run, |showing| {
            let found = showing.results.iter().find(|it| it.result.algorithm == algorithm)?;
            Some((found.result.clone(), found.records.clone()))
        })?
    }

    /// The beginning of a set that is still being found.
    pub fn beginning(&self, run: &str) -> Option<Arc<ConfigurationSet>> {
        self.of(run, |showing| showing.beginning.clone())?
    }

    fn of<T>(&self, run: &str, read: impl FnOnce(&Showing) -> T) -> Option<T> {
        let mut runs = self.lock();
        let silent = |showing: &Showing| showing.until.is_some_and(|until| until < Instant::now());
        if runs.get(run).is_some_and(silent) {
            runs.remove(run);
        }
        runs.get(run).map(read)
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<String, Showing>> {
        self.runs.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Estimated;
    use crate::store::tests::fixtures;

    fn preliminary(algorithm: &str, n: u32) -> Preliminary {
        let result =
            AlgorithmResult { preliminary: true, ratio: None, rank: None, ..fixtures::result(algorithm, n).result };
        Preliminary { result, records: RecordColumns::default(), seconds: Some(f64::from(n)) }
    }

    #[test]
    fn preliminary_results_belong_to_one_run_and_end_with_it() {
        let under_way = Arc::new(UnderWay::default());
        under_way.show("run", 0, preliminary("a", 9));
        let shown = under_way.begin("run", Profile::Production, 2, 50.0);
        assert_eq!((under_way.seconds_left("run"), under_way.seconds_left("other")), (Some(50.0), None));
        assert!(under_way.results("run").is_empty(), "nothing is under way that it could be of");
        under_way.show("run", 1, preliminary("b", 1));
        under_way.show("run", 0, preliminary("a", 2));
        let n = |run, than| under_way.newer(run, than).0.iter().map(|r| r.n).collect::<Vec<_>>();
        assert_eq!((n("run", 0), n("run", 1), n("other", 0)), (vec![2, 1], vec![2], vec![]));
        under_way.show("run", 1, preliminary("b", 5));
        assert_eq!((n("run", 2), under_way.newer("run", 3)), (vec![5], (vec![], 3)));
        assert!(under_way.records("run", "b").is_some() && under_way.records("other", "b").is_none());
        assert_eq!(under_way.seconds_left("run"), Some(2.0 + 5.0));
        let places = || under_way.results("run").iter().map(|r| r.place_so_far).collect::<Vec<_>>();
        let timed = |algorithm: &str, ratio: f64, wrong: u32| {
            let mut shown = preliminary(algorithm, 5);
            shown.result.ratio = Some(Estimated { value: ratio, lo: 0.9 * ratio, hi: 1.1 * ratio });
            shown.result.wrong = wrong;
            shown
        };
        assert_eq!(places(), [None, None], "they were compared with nothing");
        under_way.show("run", 0, timed("a", 2.0, 0));
        assert_eq!(places(), [None, None], "the other one may be faster");
        under_way.show("run", 1, timed("b", 0.5, 0));
        assert_eq!(places(), [Some(2), Some(1)]);
        assert_eq!(n("run", under_way.newer("run", 0).1 - 1), [5, 5], "who was moved is new, too");
        under_way.show("run", 1, timed("b", 0.5, 1));
        assert_eq!(places(), [Some(1), None], "who is wrong has no place");
        assert!(under_way.results("run").iter().all(|r| r.rank.is_none()));
        drop(shown);
        assert!(under_way.results("run").is_empty() && under_way.records("run", "b").is_none());
    }

    #[test]
    fn tests_that_the_first_look_counted_are_shown_until_others_are() {
        let under_way = Arc::new(UnderWay::default());
        let _shown = under_way.begin("run", Profile::Production, 1, 50.0);
        let with = |tests: &[(u32, Option<u64>)], mean| {
            let mut shown = preliminary("a", tests.len() as u32);
            shown.result.bv_tests_mean = mean;
            shown.records.configuration = tests.iter().map(|(number, _)| *number).collect();
            shown.records.bv_tests = tests.iter().map(|(_, tests)| *tests).collect();
            shown.records.primitive_tests = vec![None; tests.len()];
            shown
        };
        let seen = || {
            let (result, records) = under_way.records("run", "a").unwrap();
            (result.bv_tests_mean, records.bv_tests.clone())
        };
        under_way.show("run", 0, with(&[(7, None)], None));
        assert_eq!(seen(), (None, vec![None]), "nothing was counted");
        under_way.show("run", 0, with(&[(7, Some(30)), (3, Some(50))], Some(40.0)));
        under_way.show("run", 0, with(&[(3, None)], None));
        assert_eq!(seen(), (Some(40.0), vec![Some(50)]));
        under_way.show("run", 0, with(&[(3, None), (4, None), (7, None)], None));
        assert_eq!(seen(), (Some(40.0), vec![Some(50), None, Some(30)]), "of a configuration that was left out, too");
        under_way.show("run", 0, with(&[(3, Some(51)), (4, None)], Some(51.0)));
        under_way.show("run", 0, with(&[(4, None), (3, None)], None));
        assert_eq!(seen(), (Some(51.0), vec![None, Some(51)]));
    }

    #[test]
    fn a_run_is_shown_while_its_machine_is_heard_from() {
        let under_way = Arc::new(UnderWay::default());
        let begin = |run| under_way.begin(run, Profile::Production, 1, 50.0);
        let (first, other) = (begin("run"), begin("other"));
        under_way.show("run", 0, preliminary("a", 2));
        first.heard(Duration::from_secs(60));
        assert_eq!((first.is_heard(), under_way.results("run").len()), (true, 1));
        first.heard(Duration::ZERO);
        std::thread::sleep(Duration::from_millis(2));
        assert!(!first.is_heard() && other.is_heard() && under_way.results("run").is_empty());
        // Another machine takes the run, and the first one is forgotten later.
        let second = begin("run");
        under_way.show("run", 0, preliminary("a", 3));
        first.heard(Duration::ZERO);
        drop(first);
        assert_eq!((second.is_heard(), under_way.results("run").len()), (true, 1));
    }
}
