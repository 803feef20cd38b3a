//! One method on one family.

use std::collections::HashMap;

use ocb_core::query::{Query, Semantics};
use ocb_core::statistics::Statistic;
use ocb_stability::sweep::{Threshold, bisect, thresholds};
use ocb_stability::{Family, Question};

use super::ask::{Asker, Got};
use super::judge::Known;
use super::{Selection, repro};
use crate::Result;
use crate::model::{FamilyResult, StepResult, Tally, Timed};

/// More than so many times the median is slow, ...
const SLOW: f64 = 10.0;
/// ... where it can be seen at all beside what else the machine does, nanoseconds.
const SEEN_NS: f64 = 20_000.0;
/// So many suspects are asked again, so often each.
const SUSPECTS: usize = 6;
const AGAIN: u32 = 3;
/// Halvings between two steps.
const HALVINGS: u32 = 5;

/// A question with where it comes from.
struct Item {
    step: usize,
    seed: u32,
    question: Question,
    /// Position among all items of the question with the same answer.
    same_as: Option<usize>,
}

/// What came of one item with one query.
struct Seen {
    item: usize,
    query: Query,
    got: Got,
    tally: Tally,
}

/// Asks all of it.
pub fn family(asker: &mut Asker, family: &Family, selection: &Selection) -> Result<FamilyResult> {
    let steps: Vec<f64> = match selection.at {
        // One value, whether it is a step or lies between two.
        Some(at) => vec![at],
        None => family.parameter.steps.to_vec(),
    };
    let mut tallies = vec![Tally::default(); steps.len()];
    let mut items: Vec<Item> = Vec::new();
    for (step, &at) in steps.iter().enumerate() {
        for seed in selection.seeds() {
            match family.questions(seed, at) {
                Err(_) => tallies[step].refused += 1,
                Ok(questions) => add(&mut items, questions, step, seed),
            }
        }
    }
    let mut seen = ask(asker, family, &items)?;
    mark_slow(asker, &items, &mut seen)?;
    for one in &seen {
        tallies[items[one.item].step].add(&one.tally);
    }
    let step_result = |step, at, tally| {
        let timed = |query| timed(seen.iter().filter(|one| one.query == query && items[one.item].step == step));
        let [collision, distance] = [Query::CollisionFirst, Query::Proximity].map(timed);
        StepResult { at, tally, collision, distance }
    };
    let mut tally = Tally::default();
    tallies.iter().for_each(|step| tally.add(step));
    let failed: Vec<bool> = tallies.iter().map(Tally::failed).collect();
    let mut found = Vec::new();
    if selection.at.is_none() {
        for threshold in thresholds(&family.parameter, &failed) {
            found.push(if family.parameter.continuous {
                narrow(asker, family, selection, threshold)?
            } else {
                threshold
            });
        }
    }
    let at = found.first().map(|threshold: &Threshold| threshold.fails);
    let failing = |one: &&Seen| one.tally.failed();
    // At the threshold's own step, for bisection asks values that are none.
    let near = |one: &&Seen| at.is_none_or(|at| closest(&steps, at) == items[one.item].step);
    let first = seen.iter().filter(failing).find(near).or_else(|| seen.iter().find(failing));
    let first = match first {
        None => None,
        Some(one) => {
            let item = &items[one.item];
            let place = repro::Place { part: family.id, at: steps[item.step], seed: item.seed };
            let unsteady = one.tally.unsteady > 0;
            Some(repro::repro(asker, &item.question, one.query, &one.got, unsteady, &place)?)
        }
    };
    Ok(FamilyResult {
        family: family.id.into(),
        state: tally.state(),
        tally,
        steps: steps
            .iter()
            .zip(&tallies)
            .enumerate()
            .map(|(step, (&at, &tally))| step_result(step, at, tally))
            .collect(),
        thresholds: found.into_iter().map(Into::into).collect(),
        first,
    })
}

/// The median time of what was answered.
fn timed<'s>(seen: impl Iterator<Item = &'s Seen>) -> Option<Timed> {
    let mut times: Vec<f64> =
        seen.filter_map(|one| if let Got::Answer(_, ns) = one.got { Some(ns) } else { None }).collect();
    Statistic::Median.of(&mut times).map(|median_ns| Timed { n: times.len() as u32, median_ns })
}

/// The questions of one seed at one step.
fn add(items: &mut Vec<Item>, questions: Vec<Question>, step: usize, seed: u32) {
    let base = items.len();
    items.extend(questions.into_iter().map(|question| {
        let same_as = question.same_as.map(|i| base + i);
        Item { step, seed, question, same_as }
    }));
}

/// The step that is nearest to a value.
fn closest(steps: &[f64], value: f64) -> usize {
    let distance = |i: &usize| (steps[*i] - value).abs();
    (0..steps.len()).min_by(|i, j| distance(i).total_cmp(&distance(j))).unwrap_or(0)
}

/// The queries of a family, as far as the algorithm offers them.
fn queries(asker: &Asker, family: &Family, semantics: Semantics) -> Vec<Query> {
    let mut wanted = vec![Query::CollisionFirst, Query::Proximity];
    if family.all_contacts {
        wanted.push(Query::CollisionAll);
    }
    // A list has no meaning for solid bodies.
    wanted.retain(|query| asker.offers(*query, semantics));
    wanted
}

/// Asks items that share their objects in one process.
fn ask(asker: &mut Asker, family: &Family, items: &[Item]) -> Result<Vec<Seen>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut by_objects: HashMap<(String, String, bool), usize> = HashMap::new();
    for (i, item) in items.iter().enumerate() {
        let posed = &item.question.posed;
        let key = (posed.a.sha256(), posed.b.sha256(), item.question.solid);
        let group = *by_objects.entry(key).or_insert_with(|| {
            groups.push(Vec::new());
            groups.len() - 1
        });
        groups[group].push(i);
    }
    let mut seen: Vec<Seen> = Vec::new();
    for group in groups {
        let Question { posed, solid, .. } = &items[group[0]].question;
        let semantics = if *solid { Semantics::Solid } else { Semantics::Surface };
        let queries = queries(asker, family, semantics);
        if queries.is_empty() {
            let none = Got::Declined("not offered".into());
            let tally = Tally { unsupported: 1, ..Tally::default() };
            let unasked =
                group.iter().map(|&item| Seen { item, query: Query::CollisionFirst, got: none.clone(), tally });
            seen.extend(unasked);
            continue;
        }
        let asked: Vec<(Query, usize)> = queries.iter().flat_map(|&q| group.iter().map(move |&i| (q, i))).collect();
        let questions: Vec<_> = asked.iter().map(|&(q, i)| (q, items[i].question.posed.configuration)).collect();
        let answers = asker.ask(&posed.a, &posed.b, semantics, &questions)?;
        let known: HashMap<usize, Known> = group.iter().map(|&i| (i, Known::of(&items[i].question.posed))).collect();
        let answer_of: HashMap<(Query, usize), usize> = asked.iter().enumerate().map(|(k, &key)| (key, k)).collect();
        for (&(query, item), got) in asked.iter().zip(&answers) {
            let rule = items[item].question.rule;
            let earlier = items[item].same_as.and_then(|i| answer_of.get(&(query, i))).map(|&k| &answers[k]);
            let tally = known[&item].tally(got, query, *solid, rule, asker.precision, earlier);
            seen.push(Seen { item, query, got: got.clone(), tally });
        }
    }
    Ok(seen)
}

/// Marks what took more than ten times the median of its query on objects of this size, and does so again; the slowest few.
fn mark_slow(asker: &mut Asker, items: &[Item], seen: &mut [Seen]) -> Result<()> {
    let size = |item: &Item| (item.question.posed.a.triangles().len(), item.question.posed.b.triangles().len());
    let mut times: HashMap<_, Vec<f64>> = HashMap::new();
    for one in seen.iter() {
        if let Got::Answer(_, ns) = one.got {
            times.entry((one.query, size(&items[one.item]))).or_default().push(ns);
        }
    }
    times.values_mut().for_each(|times| times.sort_by(f64::total_cmp));
    let mut suspects: Vec<(f64, usize, f64)> = Vec::new();
    for (place, one) in seen.iter().enumerate() {
        let Got::Answer(_, ns) = one.got else { continue };
        let item = &items[one.item];
        let all = &times[&(one.query, size(item))];
        let limit = (SLOW * all[all.len() / 2]).max(SEEN_NS);
        if ns > limit && !item.question.solid {
            suspects.push((ns, place, limit));
        }
    }
    // On a busy machine many take long by chance, and the slowest are the most likely to be slow by themselves.
    suspects.sort_by(|one, other| other.0.total_cmp(&one.0));
    for (_, place, limit) in suspects.into_iter().take(SUSPECTS) {
        let one = &mut seen[place];
        let posed = &items[one.item].question.posed;
        let shortest = asker.shortest(&posed.a, &posed.b, (one.query, posed.configuration), AGAIN)?;
        one.tally.slow = u32::from(shortest.is_some_and(|time| time.as_nanos() as f64 > limit));
    }
    Ok(())
}

/// Between the last step that holds and the first that fails.
fn narrow(asker: &mut Asker, family: &Family, selection: &Selection, threshold: Threshold) -> Result<Threshold> {
    let mut fault = None;
    let found = bisect(threshold, HALVINGS, |at| {
        let one = Selection { at: Some(at), ..selection.clone() };
        fails(asker, family, &one).unwrap_or_else(|error| {
            fault.get_or_insert(error);
            false
        })
    });
    fault.map_or(Ok(found), Err)
}

fn fails(asker: &mut Asker, family: &Family, selection: &Selection) -> Result<bool> {
    let at = selection.at.unwrap_or_default();
    let mut items = Vec::new();
    for seed in selection.seeds() {
        add(&mut items, family.questions(seed, at).unwrap_or_default(), 0, seed);
    }
    Ok(ask(asker, family, &items)?.iter().any(|one| one.tally.failed()))
}

/// The last offset before the first that fails.
pub fn offset_safe(families: &[FamilyResult]) -> Option<f64> {
    let steps = &families.iter().find(|family| family.family == "offset")?.steps;
    steps.iter().take_while(|step| !step.tally.failed() && step.tally.agrees > 0).last().map(|step| step.at)
}
