//! The adversarial search on one method, beside uniform questions.

use std::sync::Arc;

use ocb_core::configuration::Configuration;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::query::{Query, Semantics};
use ocb_core::stock;
use ocb_stability::search::{Found, Goal, Heard, climb, uniform};
use ocb_stability::{Posed, Rule};

use super::ask::{Asker, Got};
use super::judge::{Known, told};
use super::repro::{Place, written};
use crate::Result;
use crate::model::SearchResult;

/// Questions allowed to each search.
const MOST: u32 = 300;
const OBJECT: &str = "torus-knot";
const TRIANGLES: u32 = 500;
const SEED: u64 = 1;

/// A method of searching.
type Search = fn(&Pair, u64, u32, Goal, &mut dyn FnMut(&Configuration) -> Heard) -> Found;

/// Searches for a wrong decision (or distance) and for the longest time; `None` when nothing is offered.
pub fn search(asker: &mut Asker) -> Result<Option<SearchResult>> {
    let offered = [Query::CollisionFirst, Query::Proximity].into_iter().find(|q| asker.offers(*q, Semantics::Surface));
    let (Some(query), Some(mesh)) = (offered, stock::generate(OBJECT, TRIANGLES).map(Arc::new)) else {
        return Ok(None);
    };
    let shape = Shape::new(mesh.clone());
    let pair = Pair::new(&shape, &shape);
    let posed = |c: &Configuration| Posed { configuration: *c, ..Posed::new(&mesh, &mesh, c.pose_b) };
    let mut last = None;
    let mut run = |asker: &mut Asker, search: Search, goal: Goal| -> Result<Option<Found>> {
        let (mut found, precision, stop) = (None, asker.precision, asker.stop);
        asker.converse(&mesh, &mesh, |ask| {
            let mut heard = |c: &Configuration| {
                // A failure ends the search.
                if stop.asked() {
                    return Heard { failed: true, cost: 0.0 };
                }
                let got = ask(query, c);
                let failed = goal == Goal::Failure
                    && Known::of(&posed(c)).tally(&got, query, false, Rule::Judged, precision, None).failed();
                if failed {
                    last = Some(got.clone());
                }
                Heard { failed, cost: if let Got::Answer(_, ns) = got { ns } else { 0.0 } }
            };
            found = Some(search(&pair, SEED, MOST, goal, &mut heard));
        })?;
        Ok(found)
    };
    let drawn = run(asker, uniform, Goal::Failure)?;
    let climbed = run(asker, climb, Goal::Failure)?;
    let costly = run(asker, climb, Goal::Cost)?;
    let usual = run(asker, uniform, Goal::Cost)?;
    let cost = |found: Option<Found>| found.map_or(0.0, |found| found.costliest.0);
    let number = |found: &Option<Found>| found.as_ref().and_then(|found| found.first).map(|(number, _)| number);
    let failing = climbed.as_ref().and_then(|found| found.first).map(|(_, c)| posed(&c));
    let first = failing.zip(last).map(|(posed, got)| {
        let place = Place { part: super::SEARCH, at: 0.0, seed: SEED as u32 };
        let expected = Known::of(&posed).expected(Semantics::Surface);
        let size = [mesh.triangles().len() as u32; 2];
        written(asker, &posed, size, expected, told(&got), &place)
    });
    Ok(Some(SearchResult {
        most: MOST,
        climbing: number(&climbed),
        uniform: number(&drawn),
        costliest_climbing_ns: cost(costly),
        costliest_uniform_ns: cost(usual),
        first,
    }))
}
