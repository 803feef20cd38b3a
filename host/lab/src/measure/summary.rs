//! From what was measured to the numbers of tables and pages.

use std::borrow::Cow;

use ocb_core::comparison::{Comparison, Interval, ranks};
use ocb_core::configuration::Placed;
use ocb_core::oracle::Pair;
use ocb_core::query::{Answer, Counters, Query, Semantics};
use ocb_core::record::{ContactScore, Record, Verdict};
use ocb_core::resolution::Resolution;
use ocb_core::sampling::controls::Control;
use ocb_core::statistics::{Statistic, maximum_interval};
use ocb_core::validation::{Precision, Terms};

use ocb_sandbox::clock::Clock;
use ocb_sandbox::{PassFacts, Profile, SetUp, integrity};

use super::contract::contract;
use super::state::precision;
use super::waiting::kept_waiting;
use super::{Measured, by_unit, controls};
use crate::machine::Machine;
use crate::model::{
    Agreement, AlgorithmInfo, AlgorithmResult, ContactQuality, ContractClass, Draw, Environment, Estimated,
    OutcomeInfo, Reference, TimeSummary, Timing, TimingCheck, VerdictCount,
};
use crate::pairing::Pairing;

/// What the answers were given to.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The two objects.
    pub pairing: &'a Pairing,
    /// The configurations with their truths.
    pub placed: &'a [Placed],
    /// The question.
    pub query: Query,
    /// What counts as an object.
    pub semantics: Semantics,
    /// Asked among them.
    pub controls: &'a [Control],
    /// Asked in the order of a trajectory.
    pub coherent: bool,
}

/// What the algorithms of one arithmetic were asked.
pub(super) struct Seen<'a> {
    pub pair: Pair<'a>,
    placed: Cow<'a, [Placed]>,
    pub controls: Cow<'a, [Control]>,
    pub semantics: Semantics,
    pub query: Query,
}

impl<'a> Asked<'a> {
    fn seen_in(&self, precision: Precision) -> Seen<'a> {
        let Self { pairing, query, semantics, .. } = *self;
        let (mut placed, mut controls) = (Cow::from(self.placed), Cow::from(self.controls));
        if rounds(pairing, precision) {
            placed.to_mut().iter_mut().for_each(|placed| *placed = placed.seen_in(precision));
            controls.to_mut().iter_mut().for_each(|control| control.placed = control.placed.seen_in(precision));
        }
        Seen { pair: pairing.seen_in(precision).pair(), placed, controls, semantics, query }
    }
}

/// Do algorithms of this arithmetic get other numbers than those of the files?
fn rounds(pairing: &Pairing, precision: Precision) -> bool {
    precision == Precision::Single && pairing.rounded.is_some()
}

/// The numbers of one algorithm, and of the reference algorithm what was measured in the same rounds.
pub fn summarise(
    measured: &Measured,
    asked: Asked,
    compared: Option<Comparison>,
    reference: Option<&Measured>,
) -> AlgorithmResult {
    let records = &measured.records;
    let Asked { pairing, query, semantics, coherent, .. } = asked;
    let precision = precision(&measured.algorithm.info);
    let seen = asked.seen_in(precision);
    let controls = controls::summary(&measured.controls, &seen);
    let terms = Terms { query, semantics, precision };
    let without_failure = || OutcomeInfo::without_failure(records.len(), measured.budget_limited);
    let outcome = measured.outcome.clone().unwrap_or_else(without_failure);
    let mean = |of: fn(Counters) -> Option<u64>| {
        Statistic::Mean.of(&mut records.iter().filter_map(|r| Some(of(r.counters?)? as f64)).collect::<Vec<_>>())
    };
    let set_up = |of: fn(&SetUp) -> f64| {
        Statistic::Median.of(&mut measured.set_ups.iter().map(of).collect::<Vec<_>>()).map(|ns| ns / 1e6)
    };
    let time = compared.map(|compared| time_summary(measured, compared));
    let units = by_unit::of(measured, reference, time.as_ref());
    AlgorithmResult {
        algorithm: measured.algorithm.info.id.clone(),
        name: measured.algorithm.info.name.clone(),
        builds: measured.algorithm.info.builds.clone(),
        n: records.len() as u32,
        of: measured.of as u32,
        budget_limited: measured.budget_limited,
        time,
        ratio: compared.and_then(|compared| compared.ratio).map(Estimated::from),
        class: Some(contract(&measured.algorithm, records.iter().map(|r| &r.answer), query, coherent)),
        rank: None,
        // Of one that failed the outcome says enough.
        unranked: controls::unranked(&controls)
            .or_else(|| Some(kept_waiting(&measured.passes, &reference?.passes)?.into()))
            .filter(|_| outcome.completed()),
        controls: Some(controls),
        timing: Some(timing(&measured.passes)),
        verdicts: verdicts(measured),
        wrong: records.iter().filter(|r| r.verdict.is_wrong()).count() as u32,
        by_unit: units.iter().map(by_unit::Found::info).collect(),
        depends_on_unit: by_unit::dependence(&units),
        rounded: rounds(pairing, precision),
        grazing: agreement(records, &seen),
        resolution: Some(Resolution::of(&seen.pair, &seen.placed, records, terms)),
        contacts: contact_quality(records),
        bv_tests_mean: mean(|c| c.bv_tests),
        primitive_tests_mean: mean(|c| c.primitive_tests),
        load_ms: set_up(|s| s.load_ns),
        build_ms: set_up(|s| s.build_ns),
        memory_bytes: measured.memory_bytes,
        preliminary: false,
        place_so_far: None,
        outcome,
    }
}

/// The numbers of one algorithm while it is measured: nothing of what only the whole run decides.
pub fn preliminary(measured: &Measured, asked: Asked, compared: Option<Comparison>) -> AlgorithmResult {
    AlgorithmResult {
        preliminary: true,
        unranked: None,
        controls: None,
        timing: None,
        by_unit: Vec::new(),
        depends_on_unit: None,
        ..summarise(measured, asked, compared, None)
    }
}

/// Of the answers that are not scored: how many say what exact arithmetic says?
fn agreement(records: &[Record], asked: &Seen) -> Agreement {
    let mut all = Agreement::default();
    for record in records.iter().filter(|r| r.verdict == Verdict::Undecidable) {
        let placed = &asked.placed[record.configuration as usize];
        let truth = asked.pair.asked(&placed.configuration, &placed.truth, asked.semantics);
        let said = match record.answer {
            Answer::Collision { hit, .. } => hit,
            Answer::Contacts { total, .. } => total > 0,
            Answer::Distance { .. } | Answer::GaveUp | Answer::Unsupported => continue,
        };
        all.n += 1;
        all.agree += u32::from(said == truth.hit);
    }
    all
}

/// All lists of contacts together; absent when there are none.
fn contact_quality(records: &[Record]) -> Option<ContactQuality> {
    let scores: Vec<ContactScore> = records.iter().filter_map(|r| r.contacts).collect();
    let sum = |scores: &mut dyn Iterator<Item = &ContactScore>| {
        scores.fold(ContactScore { found: Some(0), ..ContactScore::default() }, |all, s| ContactScore {
            listed: all.listed + s.listed,
            genuine: all.genuine + s.genuine,
            robust: all.robust + s.robust,
            found: all.found.zip(s.found).map(|(x, y)| x + y),
        })
    };
    let (all, whole) = (sum(&mut scores.iter()), sum(&mut scores.iter().filter(|s| s.found.is_some())));
    (!scores.is_empty()).then(|| ContactQuality {
        precision: all.precision(),
        listed: all.listed,
        recall: whole.recall(),
        robust: whole.robust,
    })
}

fn time_summary(measured: &Measured, compared: Comparison) -> TimeSummary {
    let mut times: Vec<f64> = measured.records.iter().map(|r| r.time_ns).collect();
    times.sort_unstable_by(f64::total_cmp);
    let (lo, hi) = maximum_interval(&times);
    TimeSummary {
        mean_ns: compared.mean_ns.into(),
        median_ns: compared.median_ns.into(),
        p95_ns: compared.p95_ns.into(),
        max_ns: Estimated { value: times[times.len() - 1], lo, hi },
        below_resolution: measured.records.iter().filter(|r| r.below_resolution).count() as u32,
    }
}

fn timing(passes: &[PassFacts]) -> Timing {
    let sum = |of: fn(&PassFacts) -> u32| passes.iter().map(of).sum::<u32>();
    let batches = || passes.iter().flat_map(|pass| &pass.batches);
    let warm_n: u32 = batches().map(|batch| batch.questions).sum();
    let warm_ns: f64 = batches().map(|batch| batch.together_ns).sum();
    let check = |finding: integrity::Finding| TimingCheck {
        check: finding.check.name().into(),
        found: finding.found,
        allowed: finding.check.allowed(),
    };
    Timing {
        processes: passes.len() as u32,
        disturbed_blocks: sum(|pass| pass.blocks[1]),
        blocks: sum(|pass| pass.blocks[0]),
        warm_ns: (warm_n > 0).then(|| warm_ns / f64::from(warm_n)),
        warm_n,
        checks: integrity::measured(passes).into_iter().map(check).collect(),
    }
}

/// Ranks what may be ranked, each contract class for itself: every question answered, control questions included, nothing
/// wrong, under all layers of the jail.
pub fn rank(results: &mut [AlgorithmResult], profile: Profile) {
    let fair = |r: &AlgorithmResult| {
        let silent = r.verdicts.iter().any(|v| v.verdict.is_silent());
        let completed = r.outcome.completed() && r.unranked.is_none();
        profile == Profile::Production && completed && r.wrong == 0 && !silent
    };
    let ratio =
        |r: &AlgorithmResult| r.ratio.filter(|_| fair(r)).map(|r| Interval { value: r.value, lo: r.lo, hi: r.hi });
    let mut classes: Vec<Option<ContractClass>> = Vec::new();
    for result in results.iter() {
        if !classes.contains(&result.class) {
            classes.push(result.class);
        }
    }
    for class in classes {
        let alike = |r: &AlgorithmResult| ratio(r).filter(|_| r.class == class);
        let ratios: Vec<Option<Interval>> = results.iter().map(alike).collect();
        for (result, rank) in results.iter_mut().zip(ranks(&ratios)) {
            result.rank = rank.or(result.rank);
        }
    }
}

fn verdicts(measured: &Measured) -> Vec<VerdictCount> {
    let all = Verdict::NAMES.map(|(verdict, _)| verdict);
    let count = |verdict| measured.records.iter().filter(|r| r.verdict == verdict).count() as u32;
    all.into_iter().map(|verdict| VerdictCount { verdict, count: count(verdict) }).filter(|v| v.count > 0).collect()
}

/// The machine and its clock while all this was measured; absent when no runner came as far as its clock.
pub fn environment(
    machine: &Machine,
    profile: Profile,
    all: &[&Measured],
    reference: Option<&AlgorithmInfo>,
    draw: Draw,
) -> Option<Environment> {
    let clocks: Vec<_> = all.iter().flat_map(|m| &m.clocks).collect();
    let median = |of: fn(&ocb_sandbox::ClockFacts) -> f64| {
        Statistic::Median.of(&mut clocks.iter().map(|c| of(c)).collect::<Vec<_>>())
    };
    Some(Environment {
        cpu: machine.cpu.clone(),
        cpus: machine.allowed.len() as u32,
        memory_bytes: machine.memory_bytes,
        kernel: machine.kernel.clone(),
        hardware_class: machine.hardware_class.clone(),
        clock: clocks.first()?.kind.as_str().to_owned(),
        clock_drift: Some(Clock::get().drift()),
        null_ns: Estimated {
            value: median(|c| c.null_median_ns)?,
            lo: median(|c| c.null_p05_ns)?,
            hi: median(|c| c.null_p95_ns)?,
        },
        disturbed: all.iter().flat_map(|m| &m.passes).map(|pass| u64::from(pass.disturbed)).sum(),
        calibration_ns: calibration(all),
        reference: reference
            .map(|info| Reference { algorithm: info.id.clone(), plugin_sha256: info.plugin_sha256.clone() }),
        draw: Some(draw),
        jail: all.iter().find(|m| !m.layers.is_empty()).map(|m| m.layers.clone()).unwrap_or_default(),
        profile: profile.as_str().into(),
        version: env!("CARGO_PKG_VERSION").into(),
    })
}

/// The speed of the measuring CPU over all passes; nothing when there was none.
fn calibration(all: &[&Measured]) -> Option<Estimated> {
    let passes = || all.iter().flat_map(|m| &m.passes);
    let at = |i: usize| passes().map(move |pass| pass.calibration_ns[i]);
    let value = Statistic::Median.of(&mut at(1).collect::<Vec<_>>())?;
    let (lo, hi) = (at(0).fold(f64::INFINITY, f64::min), at(2).fold(0.0, f64::max));
    Some(Estimated { value, lo, hi })
}
