//! Old and new results side by side.

use crate::Result;
use crate::board;
use crate::model::{AlgorithmResult, Compared, ComparedResult, Estimated};
use crate::objects::Objects;
use crate::results::sql::StoredResult;
use crate::runs::sql::RunRow;
use crate::store::Store;

/// Each algorithm of each of these runs, as far as the viewer may see the run, with what was measured before.
pub async fn side_by_side(
    store: &Store,
    objects: &Objects,
    runs: &[RunRow],
    viewer: Option<&str>,
) -> Result<Vec<Compared>> {
    let mut all = Vec::new();
    for row in runs {
        if !objects.may_see(row, viewer).await? {
            continue;
        }
        let before = run_before(store, objects, row, viewer).await?;
        let new = store.results(&row.id).await?;
        let old = match &before {
            Some(before) => store.results(&before.id).await?,
            None => Vec::new(),
        };
        for algorithm in &row.spec.algorithms {
            all.push(compared(row, before.as_ref(), algorithm, &old, &new));
        }
    }
    Ok(all)
}

/// The run that this one repeats, when it is there for the viewer.
async fn run_before(store: &Store, objects: &Objects, row: &RunRow, viewer: Option<&str>) -> Result<Option<RunRow>> {
    let Some(id) = &row.rerun_of else { return Ok(None) };
    let Some(before) = store.run(id).await? else { return Ok(None) };
    Ok(if objects.may_see(&before, viewer).await? { Some(before) } else { None })
}

fn compared(
    row: &RunRow,
    before: Option<&RunRow>,
    algorithm: &str,
    old: &[StoredResult],
    new: &[StoredResult],
) -> Compared {
    let of = |all: &[StoredResult]| all.iter().find(|stored| stored.result.algorithm == algorithm).cloned();
    let (old, new) = (of(old), of(new));
    let [question, scene, distance] = board::scenario_words(&row.spec, [&row.object_a_name, &row.object_b_name]);
    let median = |stored: &Option<StoredResult>| stored.as_ref().and_then(|stored| median(&stored.result));
    let named = new.as_ref().or(old.as_ref());
    Compared {
        run: row.id.clone(),
        state: row.state,
        of_suite: row.suite.is_some(),
        question,
        scene,
        distance,
        algorithm: algorithm.to_owned(),
        name: named.map_or(algorithm, |stored| &stored.result.name).to_owned(),
        ratio: median(&old).zip(median(&new)).and_then(|(old, new)| ratio(old, new)),
        same_file: old.as_ref().zip(new.as_ref()).is_some_and(|(old, new)| old.plugin_sha256 == new.plugin_sha256),
        old: before.zip(old).map(|(before, old)| side(before, &old)),
        new: new.map(|new| side(row, &new)),
    }
}

fn median(result: &AlgorithmResult) -> Option<Estimated> {
    result.time.map(|time| time.median_ns)
}

fn side(row: &RunRow, stored: &StoredResult) -> ComparedResult {
    let machine = row.environment.as_ref();
    let result = &stored.result;
    ComparedResult {
        run: row.id.clone(),
        finished_us: row.finished_us.unwrap_or(row.created_us),
        cpu: machine.map_or_else(String::new, |machine| machine.cpu.clone()),
        hardware_class: machine.map_or_else(String::new, |machine| machine.hardware_class.clone()),
        version: machine.map_or_else(String::new, |machine| machine.version.clone()),
        oracle: row.set.as_ref().and_then(|set| set.oracle),
        plugin_sha256: stored.plugin_sha256.clone(),
        outcome: result.outcome.name,
        n: result.n,
        wrong: result.wrong,
        median_ns: median(result),
    }
}

/// As far apart as both intervals allow. What was too quick for the clock has no ratio.
fn ratio(old: Estimated, new: Estimated) -> Option<Estimated> {
    let quick = [old.value, old.lo, old.hi].iter().any(|ns| *ns <= 0.0);
    (!quick).then(|| Estimated { value: new.value / old.value, lo: new.lo / old.hi, hi: new.hi / old.lo })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_is_as_wide_as_both_intervals_allow() {
        let of = |lo, value, hi| Estimated { value, lo, hi };
        assert_eq!(ratio(of(8.0, 10.0, 16.0), of(4.0, 5.0, 6.0)), Some(of(0.25, 0.5, 0.75)));
        assert_eq!(ratio(of(0.0, 1.0, 2.0), of(1.0, 1.0, 1.0)), None);
    }
}
