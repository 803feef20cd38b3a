//! The runs whose results a viewer finds, and these results.

use super::{Circumstances, Measured};
use crate::machine::Machine;
use crate::model::{AlgorithmResult, State, Visibility};
use crate::objects::Objects;
use crate::runs::sql::RunRow;
use crate::store::Store;
use crate::{Profile, Result, boxed};

/// Finished runs that are looked at, at most: the newest.
const MOST_RUNS: i64 = 1000;

/// The finished runs whose results this viewer may see in lists and comparisons, the newest first: public ones, and
/// the viewer's own; then those of suites.
#[boxed]
pub async fn visible_runs(store: &Store, objects: &Objects, viewer: Option<&str>) -> Result<Vec<RunRow>> {
    let mut visible = Vec::new();
    for row in store.finished_runs(viewer, MOST_RUNS).await? {
        let own = viewer.is_some() && row.owner.as_deref() == viewer;
        if objects.may_see(&row, viewer).await? && (own || objects.visibility_of(&row).await? == Visibility::Public) {
            visible.push(row);
        }
    }
    visible.extend(store.suite_runs().await?.into_iter().filter(|row| row.state == State::Done));
    Ok(visible)
}

/// The results of one run; none when it was never measured.
#[boxed]
pub async fn measured_of(store: &Store, row: &RunRow) -> Result<Vec<Measured>> {
    let Some(machine) = &row.environment else { return Ok(Vec::new()) };
    let ranked = machine.profile == Profile::Production.as_str();
    let circumstances = circumstances(row, [&machine.cpu, &machine.hardware_class], ranked);
    let results = store.results(&row.id).await?.into_iter();
    Ok(results.map(|stored| Measured::of(&circumstances, &stored.plugin_sha256, stored.result)).collect())
}

/// The results so far of a run that is being measured here.
pub fn measured_so_far(
    machine: &Machine,
    profile: Profile,
    row: &RunRow,
    results: &[AlgorithmResult],
) -> Vec<Measured> {
    let ranked = profile == Profile::Production;
    let circumstances = circumstances(row, [&machine.cpu, &machine.hardware_class], ranked);
    results.iter().map(|result| Measured::of(&circumstances, "", result.clone())).collect()
}

fn circumstances<'a>(row: &'a RunRow, machine: [&'a str; 2], ranked: bool) -> Circumstances<'a> {
    Circumstances {
        run: &row.id,
        finished_us: row.finished_us.unwrap_or(row.created_us),
        spec: &row.spec,
        names: [&row.object_a_name, &row.object_b_name],
        machine,
        ranked,
        preview: row.preview.as_ref(),
        set: row.set.as_ref(),
    }
}
