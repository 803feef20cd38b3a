//! Honest plugins in every language pass through the jail, again and again: a few rounds here, a hundred with
//! `OCB_HONEST=100`, as `make soak` has it.

mod common;

use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

use common::{first_contact, fixture, honest, judged, launcher, launcher_with, policy, start, upright};
use ocb_core::instance::Instance;
use ocb_core::query::Query;
use ocb_core::record::Verdict;
use ocb_sandbox::{Ending, Launcher, Outcome, PassFacts, PassPlan, Phase, Policy, integrity};

/// Of a pass; fewer where each of them makes the plugin print something.
const QUESTIONS: u32 = 1000;
const FEW: u32 = 200;

fn rounds() -> usize {
    std::env::var("OCB_HONEST").ok().and_then(|n| n.parse().ok()).unwrap_or(8)
}

fn two_threads() -> Launcher {
    launcher_with(Policy { threads: 2, ..policy() })
}

/// Asks about objects that meet and objects apart, then many of them in a pass; every answer must be right.
fn run(launcher: &Launcher, plugin: &Path, questions: u32) -> (Ending, PassFacts) {
    let mut session = start(launcher, plugin).unwrap_or_else(|ending| panic!("{}: {ending}", plugin.display()));
    for x in [0.2, 2.0, -0.25, 1.5, 8.0] {
        let sample = session.query(Query::CollisionFirst, &upright(x));
        let sample = sample.unwrap_or_else(|outcome| panic!("{}: {outcome}", plugin.display()));
        let verdict = judged(Query::CollisionFirst, &upright(x), &sample.answer);
        assert_eq!(verdict, Verdict::Correct, "{} at {x}: {:?}", plugin.display(), sample.answer);
    }
    let order: Vec<u32> = (0..questions).map(|i| i * 379 % questions).collect();
    let allowance = Duration::from_secs(50);
    let plan = PassPlan { order: &order, coherent: false, seed: 7, allowance };
    // Up to 0.5 they meet, from 1.5 on they do not.
    let asked = |i: u32| {
        let share = f64::from(i) / f64::from(questions);
        upright(if share < 0.5 { 0.2 + 0.6 * share } else { 3.0 * share })
    };
    let present = |i: u32, _: Instance| first_contact(asked(i));
    let mut wrong = 0;
    let (facts, ended) = session.pass(&plan, &present, &mut |seen| {
        wrong +=
            usize::from(judged(Query::CollisionFirst, &asked(seen.configuration), &seen.answer) != Verdict::Correct);
        ControlFlow::Continue(())
    });
    assert_eq!((wrong, ended), (0, Ok(())), "{}", plugin.display());
    (session.finish(), facts)
}

#[test]
fn every_language_is_right_and_completes() {
    let plugins = [
        (launcher(), fixture(&["NO_PAIR"]), QUESTIONS),
        (launcher(), fixture(&["NO_PAIR", "WORK=20000", "UNEVEN"]), QUESTIONS),
        (launcher(), honest("exceptions.cpp"), FEW),
        (launcher(), honest("panics.rs"), FEW),
        (two_threads(), honest("openmp.c"), FEW),
        // The other track is no obstacle to those who do not use it.
        (two_threads(), honest("exceptions.cpp"), FEW),
        (two_threads(), honest("panics.rs"), FEW),
    ];
    let mut passes = vec![Vec::new(); plugins.len()];
    for round in 0..rounds() {
        for ((launcher, plugin, questions), passes) in plugins.iter().zip(&mut passes) {
            let (ending, facts) = run(launcher, plugin, *questions);
            assert_eq!(ending.outcome, Outcome::Completed, "round {round}, {}", plugin.display());
            // As many as a run of the engine usually has.
            passes.push(facts);
            if passes.len() == 5 {
                assert_eq!(integrity::violated(passes), None, "round {round}, {}: {passes:#?}", plugin.display());
                passes.clear();
            }
        }
    }
    println!("{} honest runs, all completed, nobody accused", rounds() * plugins.len());
}

#[test]
fn what_a_plugin_prints_is_kept() {
    let (ending, _) = run(&launcher(), &honest("exceptions.cpp"), FEW);
    // A question that was disturbed is asked again.
    let mut lines: Vec<&str> = ending.stderr.lines().collect();
    lines.dedup();
    assert_eq!(lines[..3], ["apart by 1", "apart by 0.5", "apart by 7"]);
}

#[test]
fn a_panic_is_an_error_with_its_own_words() {
    let mut session = start(&launcher(), &honest("panics.rs")).unwrap();
    let outcome = session.query(Query::CollisionFirst, &upright(20.0)).unwrap_err();
    let reason = "collide returned OCB_ERROR: the plugin panicked: nobody goes as far as 20".to_string();
    assert_eq!(outcome, Outcome::Failed { phase: Phase::Query, reason });
}
