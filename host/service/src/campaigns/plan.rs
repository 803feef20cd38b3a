//! What a campaign measures: what of the suite is missing on its hardware class now, and public runs of another class or oracle.

use std::collections::{HashMap, HashSet};

use crate::campaigns::course::Campaigns;
use crate::engine::Engine;
use crate::model::{RunSpec, State, Visibility};
use crate::runs::sql::RunRow;
use crate::suite::known::{Known, scenario};
use crate::suite::planning::AT_ONCE;
use crate::{EngineError, Result};

/// A run to come.
pub struct Due {
    /// What is asked.
    pub spec: RunSpec,
    /// The run that it repeats.
    pub repeats: Option<RunRow>,
    /// It belongs to the suite.
    pub of_suite: bool,
}

impl Due {
    /// Whose run it will be; the service's own belong to nobody.
    pub fn owner(&self) -> Option<&str> {
        self.repeats.as_ref().and_then(|run| run.owner.as_deref()).filter(|_| !self.of_suite)
    }

    /// Whether the others can be measured all the same without it: an object was taken away, say.
    pub fn can_be_left_out(&self, because: &EngineError) -> bool {
        !self.of_suite && matches!(because, EngineError::Invalid(_) | EngineError::NotFound(_))
    }
}

impl Engine {
    /// How long measuring all of it is expected to take, in seconds.
    pub(crate) async fn seconds_for(&self, due: &[Due]) -> Result<f64> {
        let (mut seconds, mut found) = (0.0, HashSet::new());
        for due in due {
            match self.estimate(&due.spec, due.owner()).await {
                Ok(expected) => {
                    seconds += expected.total_seconds;
                    // Runs of one scenario share its configurations, unless each draws its own.
                    let shared = !due.of_suite || self.inner.suite.document.seed.is_some();
                    if shared && !found.insert(scenario(&due.spec)?) {
                        seconds -= expected.configuration_seconds;
                    }
                }
                Err(e) if due.can_be_left_out(&e) => {}
                Err(e) => return Err(e),
            }
        }
        Ok(seconds)
    }
}

impl Campaigns {
    /// What is to be queued besides a campaign's own runs, whatever became of these.
    pub(crate) async fn due(&self, suite: bool, people: bool, class: &str, own: &[RunRow]) -> Result<Vec<Due>> {
        let mut due = if suite { self.due_of_the_suite(class, own).await? } else { Vec::new() };
        if people {
            due.extend(self.due_of_people(class, own).await?);
        }
        Ok(due)
    }

    /// Algorithms that were measured together are measured together again, so that old and new runs stand in pairs.
    async fn due_of_the_suite(&self, class: &str, own: &[RunRow]) -> Result<Vec<Due>> {
        let mut known = self.suite_runs.known(class).await?;
        for row in own.iter().filter(|row| row.suite.is_some()) {
            for algorithm in &row.spec.algorithms {
                known.add(&row.spec, algorithm, None, Known::Waiting)?;
            }
        }
        let stored = self.store.suite_runs().await?;
        let mut before: HashMap<[String; 2], &RunRow> = HashMap::new();
        for row in stored.iter().filter(|row| row.state == State::Done) {
            let scenario = scenario(&row.spec)?;
            for algorithm in &row.spec.algorithms {
                before.entry([scenario.clone(), algorithm.clone()]).or_insert(row);
            }
        }
        let (public, mut due) = (self.registry.public(), Vec::new());
        for spec in self.suite_runs.suite.scenarios() {
            let name = scenario(&spec)?;
            let mut groups: Vec<(Option<&RunRow>, Vec<String>)> = Vec::new();
            let missing = public.iter().filter(|a| a.queries.contains(&spec.query) && known.of(a, &spec).is_none());
            for algorithm in missing {
                let old = before.get(&[name.clone(), algorithm.id.clone()]).copied();
                let fits = |(of, members): &&mut (Option<&RunRow>, Vec<String>)| {
                    of.map(|run| &run.id) == old.map(|run| &run.id) && (old.is_some() || members.len() < AT_ONCE)
                };
                match groups.iter_mut().find(fits) {
                    Some((_, members)) => members.push(algorithm.id.clone()),
                    None => groups.push((old, vec![algorithm.id.clone()])),
                }
            }
            due.extend(groups.into_iter().map(|(old, algorithms)| Due {
                spec: RunSpec { algorithms, hardware_class: self.suite_runs.classes.named(class), ..spec.clone() },
                repeats: old.cloned(),
                of_suite: true,
            }));
        }
        Ok(due)
    }

    async fn due_of_people(&self, class: &str, own: &[RunRow]) -> Result<Vec<Due>> {
        let mut due = Vec::new();
        let stored = self.store.runs_of_the_agreeing().await?;
        for newest in newest_of_families(&stored, own, |row| self.suite_runs.is_of_now(row, class)) {
            if self.objects.visibility_of(newest).await? != Visibility::Public {
                continue;
            }
            let mut spec = RunSpec { hardware_class: self.suite_runs.classes.named(class), ..newest.spec.clone() };
            // Of what was withdrawn since, nothing is measured.
            spec.algorithms.retain(|name| self.registry.choose(name, None).is_ok_and(|found| found.is_some()));
            if !spec.algorithms.is_empty() {
                due.push(Due { spec, repeats: Some(newest.clone()), of_suite: false });
            }
        }
        Ok(due)
    }
}

/// A run and its repetitions are one family: of each the newest public result, unless one of them is of now, or waits. The runs
/// come newest first.
fn newest_of_families<'r>(runs: &'r [RunRow], own: &[RunRow], of_now: impl Fn(&RunRow) -> bool) -> Vec<&'r RunRow> {
    let by_id: HashMap<&str, &RunRow> = runs.iter().map(|row| (row.id.as_str(), row)).collect();
    let first = |row: &'r RunRow| {
        let mut first = row.id.as_str();
        let mut next = row.rerun_of.as_deref();
        while let Some(id) = next {
            first = id;
            next = by_id.get(id).and_then(|row| row.rerun_of.as_deref());
        }
        first
    };
    let mut families: Vec<(&str, Vec<&RunRow>)> = Vec::new();
    let mut places: HashMap<&str, usize> = HashMap::new();
    for row in runs {
        let name = first(row);
        let place = *places.entry(name).or_insert_with(|| {
            families.push((name, Vec::new()));
            families.len() - 1
        });
        families[place].1.push(row);
    }
    let tried = |id: &str| own.iter().any(|row| row.rerun_of.as_deref() == Some(id));
    let settled = |row: &&RunRow| row.state != State::Done || of_now(row) || tried(&row.id);
    families
        .into_iter()
        .filter(|(name, members)| !tried(name) && !members.iter().any(settled))
        .filter_map(|(_, members)| members.into_iter().find(|row| row.visibility == Visibility::Public && !row.private))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(id: &str, rerun_of: Option<&str>, state: State, oracle: u32) -> RunRow {
        RunRow {
            rerun_of: rerun_of.map(str::to_owned),
            state,
            expected_seconds: f64::from(oracle),
            visibility: Visibility::Public,
            ..crate::store::tests::run(id, Some("account:1"), 5, 1)
        }
    }

    /// Those that are due where what is of the oracle 3 is of now.
    fn due(runs: &[RunRow], own: &[RunRow]) -> Vec<String> {
        let of_now = |row: &RunRow| row.expected_seconds == 3.0;
        newest_of_families(runs, own, of_now).into_iter().map(|row| row.id.clone()).collect()
    }

    #[test]
    fn of_a_run_and_its_repetitions_the_newest_is_due_unless_one_is_of_now() {
        use State::{Done, Queued};
        let (old, of_now) = (run("a", None, Done, 1), run("n", None, Done, 3));
        assert_eq!(due(&[of_now, old.clone()], &[]), ["a"]);
        let again = run("b", Some("a"), Done, 2);
        assert_eq!(due(&[again.clone(), old.clone()], &[]), ["b"], "side by side with what is newest");
        assert_eq!(due(std::slice::from_ref(&again), &[]), ["b"], "its owner has taken the first away");
        let now = run("c", Some("b"), Done, 3);
        assert!(due(&[now, again.clone(), old.clone()], &[]).is_empty());
        assert!(due(&[run("c", Some("b"), Queued, 1), again.clone(), old.clone()], &[]).is_empty());
        // One machine and another in turn: the first has been measured there.
        let first = run("a", None, Done, 3);
        assert!(due(&[again.clone(), first], &[]).is_empty());
        // What failed in this campaign is not tried by it again.
        let failed = run("f", Some("b"), State::Failed, 3);
        assert!(due(&[again.clone(), old.clone()], &[failed]).is_empty());
        let hidden = RunRow { visibility: Visibility::Private, ..again };
        assert_eq!(due(&[hidden, old.clone()], &[]), ["a"]);
        assert!(due(&[RunRow { private: true, ..old }], &[]).is_empty());
    }
}
