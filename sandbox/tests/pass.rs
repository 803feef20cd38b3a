//! A pass asks every question once for the time that counts, and some of them again to see whether that was honest.

mod common;

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::time::Duration;

use common::{apart, fixture, launcher, start};
use ocb_core::instance::{Instance, Presented};
use ocb_core::query::{Answer, Query};
use ocb_sandbox::integrity::{self, Check};
use ocb_sandbox::{Observation, Outcome, PassFacts, PassPlan};

const QUESTIONS: u32 = 500;

fn plan(order: &[u32]) -> PassPlan<'_> {
    PassPlan { query: Query::CollisionFirst, order, coherent: false, seed: 7, allowance: Duration::from_secs(50) }
}

/// One pass of the fixture over so many distances: what was seen, and the facts.
fn pass(defines: &[&str], plan: &PassPlan<'_>, stop_after: usize) -> (Vec<Observation>, PassFacts, Outcome) {
    let mut session = start(&launcher(), &fixture(defines)).unwrap();
    let mut seen = Vec::new();
    let present = |configuration: u32, _: Instance| Presented {
        configuration: apart(0.004 * f64::from(configuration)),
        swapped: false,
    };
    let (facts, ended) = session.pass(plan, &present, &mut |observation| {
        seen.push(observation);
        if seen.len() < stop_after { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let ending = session.finish();
    assert_eq!(ended.err().unwrap_or(Outcome::Completed), ending.outcome);
    (seen, facts, ending.outcome)
}

#[test]
fn every_question_has_one_official_time_and_all_answers_are_told() {
    let order: Vec<u32> = (0..QUESTIONS).rev().collect();
    let (seen, facts, outcome) = pass(&["WORK=2000"], &plan(&order), usize::MAX);
    assert_eq!((outcome, facts.reached), (Outcome::Completed, order.len()));
    let mut times = BTreeMap::new();
    for observation in &seen {
        let hit = observation.configuration < 250;
        assert!(matches!(observation.answer, Answer::Collision { hit: said, .. } if said == hit), "{observation:?}");
        if let Some(time) = observation.time {
            assert!(time.ns > 0.0 && times.insert(observation.configuration, time).is_none(), "{observation:?}");
        }
    }
    assert_eq!(times.len(), order.len());
    assert!(facts.blocks[0] >= QUESTIONS / 64 && facts.blocks[1] <= facts.blocks[0]);
    assert_eq!(facts.disturbed as usize, times.values().filter(|time| time.disturbed).count());
    // What was asked again beside the official questions: the warm-up, batches, repeats, disturbed blocks.
    assert!(seen.len() > order.len() + 16);
    assert!(facts.calibration_ns[0] > 0.0 && facts.calibration_ns[0] <= facts.calibration_ns[2]);
}

#[test]
fn the_order_of_a_coherent_set_is_kept() {
    let order: Vec<u32> = (0..QUESTIONS).collect();
    let (seen, ..) = pass(&[], &PassPlan { coherent: true, ..plan(&order) }, usize::MAX);
    let mut first: Vec<u32> = Vec::new();
    for observation in seen.iter().filter(|o| o.instance == Instance::default()).skip_while(|o| o.configuration != 0) {
        // Exact repeats go back; everything else goes on by one.
        if observation.configuration as usize == first.len() {
            first.push(observation.configuration);
        }
    }
    assert_eq!(first, order);
}

#[test]
fn a_pass_ends_when_it_shall() {
    let order: Vec<u32> = (0..QUESTIONS).collect();
    let (seen, facts, outcome) = pass(&[], &plan(&order), 200);
    assert_eq!((seen.len(), outcome), (200, Outcome::Completed));
    assert!(facts.reached < 300);
    let (seen, facts, _) = pass(&[], &PassPlan { allowance: Duration::ZERO, ..plan(&order) }, usize::MAX);
    assert_eq!((facts.reached, seen.iter().filter(|o| o.time.is_some()).count()), (0, 0));
    // A crash in the middle keeps what was answered before.
    let (seen, facts, outcome) = pass(&["CRASH_AFTER=300"], &plan(&order), usize::MAX);
    assert!(matches!(outcome, Outcome::Signaled { .. }), "{outcome:?}");
    assert!(facts.reached < 400 && seen.len() <= 300 && seen.len() > 100, "{} {}", facts.reached, seen.len());
}

#[test]
fn remembering_is_seen_where_questions_come_again() {
    let order: Vec<u32> = (0..2 * QUESTIONS).collect();
    // Who is kept waiting may look like somebody who computes: one pass of a few has to show it.
    let (mut told, mut seen) = (0, None);
    for _ in 0..5 {
        let facts = pass(&["WORK=100000", "MEMOISES"], &plan(&order), usize::MAX).1;
        let measured = integrity::measured(std::slice::from_ref(&facts));
        if measured.iter().any(|finding| matches!(finding.check, Check::Batches | Check::Repeats)) {
            told += 1;
        } else {
            // A machine too busy to measure has nothing to show.
            assert!(5 * facts.blocks[1] > facts.blocks[0], "a quiet machine has batches and repeats: {facts:?}");
        }
        seen = integrity::violated(std::slice::from_ref(&facts)).map(|finding| finding.check);
        if seen.is_some() {
            break;
        }
    }
    match seen {
        Some(check) => assert!(matches!(check, Check::Batches | Check::Repeats), "{check:?}"),
        None => assert_eq!(told, 0, "questions that come again cost it nothing"),
    }
    let honest = pass(&["WORK=100000"], &plan(&order), usize::MAX).1;
    assert_eq!(integrity::violated(std::slice::from_ref(&honest)), None, "{honest:?}");
}
