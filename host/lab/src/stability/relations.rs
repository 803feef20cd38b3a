//! One method on one relation between answers.

use ocb_core::configuration::{Class, Configuration};
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::validation::Precision;
use ocb_stability::draw::Draw;
use ocb_stability::relations::{Breach, Relation, Said};
use ocb_stability::{Posed, families};

use super::Selection;
use super::ask::{Asker, Got};
use super::judge::Known;
use super::repro::{Place, written};
use crate::Result;
use crate::model::{RelationResult, RelationStep};

/// Families and values whose first questions are the ones that further questions are made of.
const BASES: [(&str, f64); 7] = [
    ("vertex-face", 1e-3),
    ("edge-edge", 1e-6),
    ("coplanar", 1e-7),
    ("slivers", 1e3),
    ("stacked-boxes", 1e-4),
    ("deep", 1.7),
    ("broken-mesh", 0.3),
];
/// Other questions before one is asked again.
const BETWEEN: usize = 10;

/// What a method said to one question; `None` when it could not be asked.
fn said(asker: &mut Asker, posed: &Posed, others: &[Configuration]) -> Result<Option<Said>> {
    let all = [Query::CollisionFirst, Query::CollisionAll, Query::Proximity];
    let queries: Vec<Query> = all.into_iter().filter(|query| asker.offers(*query, Semantics::Surface)).collect();
    let last = std::iter::once(&posed.configuration);
    let questions: Vec<_> = others.iter().chain(last).flat_map(|c| queries.iter().map(|query| (*query, *c))).collect();
    let got = asker.ask(&posed.a, &posed.b, Semantics::Surface, &questions)?;
    let mut said = Said::default();
    for got in &got[got.len() - queries.len()..] {
        match got {
            Got::Answer(Answer::Collision { hit, .. }, _) => said.hit = Some(*hit),
            Got::Answer(Answer::Contacts { total, .. }, _) => said.contacts = Some(*total),
            Got::Answer(Answer::Distance { distance, points, .. }, _) => {
                said.distance = Some(*distance);
                said.points = *points;
            }
            Got::Answer(Answer::GaveUp | Answer::Unsupported, _) => {}
            // What breaks is counted by its family.
            Got::Declined(_) | Got::Broken(_) | Got::Hung(_) => return Ok(None),
        }
    }
    Ok(Some(said))
}

/// Tries it on every base.
pub fn relation(asker: &mut Asker, relation: Relation, selection: &Selection) -> Result<RelationResult> {
    let [id, ..] = relation.words();
    let mut found = RelationResult {
        relation: id.into(),
        tried: 0,
        decisions: 0,
        distances: 0,
        grazing: 0,
        steps: Vec::new(),
        first: None,
    };
    let steps = relation.steps().iter().copied().filter(|at| selection.has(*at));
    found.steps = steps.map(|at| RelationStep { at, tried: 0, decisions: 0, distances: 0 }).collect();
    for seed in selection.seeds() {
        for (number, (name, value)) in BASES.iter().enumerate() {
            let questions =
                families::by_id(name).and_then(|family| family.questions(seed, *value).ok()).unwrap_or_default();
            let Some(base) = questions.get(seed as usize % questions.len().max(1)).map(|question| &question.posed)
            else {
                continue;
            };
            let Some(before) = said(asker, base, &[])? else { continue };
            for step in 0..found.steps.len() {
                let seed_of = u64::from(seed) << 8 | number as u64;
                one(asker, relation, base, &before, step, seed_of, &mut found)?;
            }
        }
    }
    Ok(found)
}

/// One base at one amount.
fn one(
    asker: &mut Asker,
    relation: Relation,
    base: &Posed,
    before: &Said,
    step: usize,
    seed: u64,
    found: &mut RelationResult,
) -> Result<()> {
    let at = found.steps[step].at;
    let draw = &mut Draw::new(seed);
    let derived = relation.derive(base, before, at, draw);
    let others: Vec<Configuration> = match relation {
        Relation::Again => (0..BETWEEN).map(|_| turned(base, draw)).collect(),
        _ => Vec::new(),
    };
    let mut answers = Vec::new();
    for posed in &derived {
        match said(asker, posed, &others)? {
            Some(said) => answers.push(said),
            None => return Ok(()),
        }
    }
    let known: Vec<Known> = std::iter::once(base).chain(&derived).map(Known::of).collect();
    let tau = known.iter().map(|known| known.tau(asker.precision)).fold(0.0, f64::max);
    found.tried += 1;
    found.steps[step].tried += 1;
    let Some(breach) = relation.breach(base, before, at, &derived, &answers, tau) else { return Ok(()) };
    if breach == Breach::Decision && !relation.strict() && known.iter().any(|known| grazes(known, asker.precision)) {
        found.grazing += 1;
        return Ok(());
    }
    let step = &mut found.steps[step];
    match breach {
        Breach::Decision => (step.decisions, found.decisions) = (step.decisions + 1, found.decisions + 1),
        Breach::Distance => (step.distances, found.distances) = (step.distances + 1, found.distances + 1),
    }
    if found.first.is_none() {
        let posed = derived.first().unwrap_or(base);
        let place = Place { part: relation.words()[0], at, seed: (seed >> 8) as u32 };
        let triangles = [&posed.a, &posed.b].map(|mesh| mesh.triangles().len() as u32);
        let (expected, got) = (tell(before), answers.iter().map(tell).collect::<Vec<_>>().join("; "));
        let expected = format!("{} Before: {expected}", relation.words()[2]);
        found.first = Some(written(asker, posed, triangles, expected, got, &place));
    }
    Ok(())
}

/// The same objects somewhere else.
fn turned(base: &Posed, draw: &mut Draw) -> Configuration {
    let mut other = base.configuration;
    other.pose_b.linear = draw.rotation();
    other.pose_b.translation += draw.direction();
    other
}

fn grazes(known: &Known, precision: Precision) -> bool {
    known.truth(Semantics::Surface).is_some_and(|truth| match precision {
        Precision::Single => truth.class32 == Class::Grazing,
        Precision::Double => truth.class64 == Class::Grazing,
    })
}

fn tell(said: &Said) -> String {
    let hit = said.hit.map(|hit| if hit { "collision".to_owned() } else { "no collision".to_owned() });
    let distance = said.distance.map(|distance| format!("distance {distance:e}"));
    let contacts = said.contacts.map(|contacts| format!("{contacts} contacts"));
    [hit, contacts, distance].into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// The powers of two around 1 at which the unit changes nothing.
pub fn unit_safe(relations: &[RelationResult]) -> Option<[i32; 2]> {
    let unit = relations.iter().find(|relation| relation.relation == Relation::Unit.words()[0])?;
    let holds = |step: &&RelationStep| step.tried > 0 && step.decisions + step.distances == 0;
    let below = unit.steps.iter().rev().filter(|step| step.at < 0.0).take_while(holds).last();
    let above = unit.steps.iter().filter(|step| step.at > 0.0).take_while(holds).last();
    (below.is_some() || above.is_some()).then(|| [below, above].map(|step| step.map_or(0, |step| step.at as i32)))
}
