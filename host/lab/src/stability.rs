//! Where methods fail: asks one algorithm, in the jail, everything that `ocb-stability` makes, and judges what it says.

mod ask;
mod families;
mod judge;
mod relations;
mod reported;
mod repro;
mod search;
mod tessellations;

use std::time::{Duration, Instant};

use ocb_sandbox::Policy;
use ocb_stability::relations::Relation;
use ocb_stability::{corpus, families as catalogue};

use crate::algorithm::{Algorithm, Runner};
use crate::machine::Machine;
use crate::measure::{Stop, precision};
use crate::model::{FailureInfo, FamilyInfo, RelationInfo, Stability, StabilitySpec, StabilityTable};
use crate::now_us;
use crate::{LabError, Result};
use ask::Asker;

/// Which part of everything.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// Families and relations by their short names, `reported` for the reported failures; empty: all.
    pub parts: Vec<String>,
    /// Only this value of the parameter.
    pub at: Option<f64>,
    /// Only this seed.
    pub seed: Option<u32>,
    /// Seeds per value; 0 stands for the usual number.
    pub seeds: u32,
    /// No new family, relation or failure is begun after so long.
    pub budget: Option<Duration>,
}

/// Seeds per value when nothing is said.
pub const SEEDS: u32 = 3;

impl Selection {
    /// What a stability run of the service asks.
    pub fn of(spec: &StabilitySpec) -> Self {
        Self { parts: spec.parts.clone(), seeds: spec.seeds.unwrap_or(0), ..Self::default() }
    }

    /// Names that stand for nothing are refused.
    pub fn check(&self) -> Result<()> {
        let known: Vec<&str> = names().collect();
        match self.parts.iter().find(|part| !known.contains(&part.as_str())) {
            Some(part) => {
                Err(LabError::Invalid(format!("Unknown family or relation {part:?}; available: {}.", known.join(", "))))
            }
            None => Ok(()),
        }
    }

    fn wants(&self, part: &str) -> bool {
        self.parts.is_empty() || self.parts.iter().any(|wanted| wanted == part)
    }

    fn seeds(&self) -> std::ops::Range<u32> {
        match (self.seed, self.seeds) {
            (Some(seed), _) => seed..seed + 1,
            (None, 0) => 0..SEEDS,
            (None, seeds) => 0..seeds,
        }
    }

    fn has(&self, at: f64) -> bool {
        self.at.is_none_or(|wanted| wanted == at)
    }
}

/// The names of the parts that are neither families nor relations: reported failures, other triangles, adversarial search.
const REPORTED: &str = "reported";
const TESSELLATIONS: &str = "tessellations";
const SEARCH: &str = "search";

/// Everything that can be selected.
fn names() -> impl Iterator<Item = &'static str> {
    let families = catalogue::all().map(|family| family.id);
    families.chain(Relation::ALL.map(|relation| relation.words()[0])).chain([REPORTED, TESSELLATIONS, SEARCH])
}

/// What there is to try, without any method.
pub fn table() -> StabilityTable {
    let family = |f: &ocb_stability::Family| FamilyInfo {
        id: f.id.into(),
        name: f.name.into(),
        sentence: f.sentence.into(),
        source: f.source.into(),
        parameter: f.parameter.name.into(),
        continuous: f.parameter.continuous,
        harder: f.parameter.harder.into(),
        beyond: f.beyond,
    };
    let relation = |r: Relation| {
        let [id, name, sentence] = r.words().map(str::to_owned);
        RelationInfo { id, name, sentence }
    };
    let failure = |r: corpus::Reported| FailureInfo {
        id: r.id,
        source: r.source,
        url: r.url,
        seen: r.seen,
        numbers_reported: r.numbers_reported,
    };
    StabilityTable {
        families: catalogue::all().map(family).collect(),
        relations: Relation::ALL.map(relation).to_vec(),
        failures: corpus::all().into_iter().map(failure).collect(),
        methods: Vec::new(),
    }
}

/// A jail for small objects: a question takes microseconds, and one that takes seconds hangs. It is timed as in runs.
fn policy(machine: &Machine) -> Policy {
    Policy {
        runner_cpu: Some(machine.measuring_cpu()),
        supervisor_cpu: Some(machine.supervisor_cpu()),
        load_seconds: 5.0,
        build_seconds: 5.0,
        query_seconds: 2.0,
        trial_seconds: 120.0,
        rough_clock: true,
        ..Policy::default()
    }
}

/// The parts that are selected, in the order in which they are tried.
pub fn parts(selection: &Selection) -> Vec<&'static str> {
    names().filter(|name| selection.wants(name)).collect()
}

/// What is known of an algorithm before anything was tried; not complete.
pub fn begin(algorithm: &Algorithm, selection: &Selection) -> Stability {
    let info = &algorithm.info;
    Stability {
        algorithm: info.id.clone(),
        name: info.name.clone(),
        version: info.version.clone(),
        plugin_sha256: info.plugin_sha256.clone(),
        single_precision: info.single_precision,
        seeds: selection.seeds().len() as u32,
        created_us: now_us(),
        complete: false,
        families: Vec::new(),
        relations: Vec::new(),
        failures: Vec::new(),
        tessellations: Vec::new(),
        search: None,
        unit_safe: None,
        offset_safe: None,
    }
}

/// Tries one part on the algorithm and adds what it finds. Blocks, so it wants a thread of its own. Times are taken, so the
/// caller holds the right to measure.
///
/// # Errors
/// `Stopped` when it was; then nothing is added.
pub fn part(
    runner: &Runner,
    machine: &Machine,
    algorithm: &Algorithm,
    selection: &Selection,
    name: &str,
    found: &mut Stability,
    stop: &Stop,
) -> Result<()> {
    let _quiet = machine.keep_off();
    let launcher = runner.launcher(algorithm, Policy { threads: algorithm.threads, ..policy(machine) });
    let mut asker = Asker::new(&launcher, algorithm, precision(&algorithm.info), stop);
    if let Some(family) = catalogue::by_id(name) {
        found.families.push(families::family(&mut asker, family, selection)?);
    } else if name == REPORTED {
        found.failures = reported::failures(&mut asker)?;
    } else if name == TESSELLATIONS {
        found.tessellations = tessellations::tessellations(&mut asker)?;
    } else if name == SEARCH {
        found.search = search::search(&mut asker)?;
    } else if let Some(relation) = Relation::ALL.into_iter().find(|r| r.words()[0] == name) {
        found.relations.push(relations::relation(&mut asker, relation, selection)?);
    }
    found.unit_safe = relations::unit_safe(&found.relations);
    found.offset_safe = families::offset_safe(&found.families);
    Ok(())
}

/// Tries everything selected on one algorithm; says what it is at. As [`part`] it blocks and takes times.
pub fn run(
    runner: &Runner,
    machine: &Machine,
    algorithm: &Algorithm,
    selection: &Selection,
    stop: &Stop,
    at: &dyn Fn(&str),
) -> Result<Stability> {
    selection.check()?;
    let begun = Instant::now();
    let mut found = begin(algorithm, selection);
    for name in parts(selection) {
        if selection.budget.is_some_and(|budget| begun.elapsed() > budget) {
            return Ok(found);
        }
        at(name);
        part(runner, machine, algorithm, selection, name, &mut found, stop)?;
    }
    found.complete = true;
    Ok(found)
}
