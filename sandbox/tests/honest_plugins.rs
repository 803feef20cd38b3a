//! Honest plugins in every language pass through the jail, again and again: a few rounds here, a hundred with
//! `OCB_HONEST=100`, as `make soak` has it.

mod common;

use std::path::Path;

use common::{fixture, honest, judged, launcher, launcher_with, policy, start, upright};
use ocb_core::query::Query;
use ocb_core::record::Verdict;
use ocb_sandbox::{Ending, Launcher, Outcome, Phase, Policy};

fn rounds() -> usize {
    std::env::var("OCB_HONEST").ok().and_then(|n| n.parse().ok()).unwrap_or(8)
}

fn two_threads() -> Launcher {
    launcher_with(Policy { threads: 2, ..policy() })
}

/// Asks about objects that meet and objects apart; every answer must be right.
fn run(launcher: &Launcher, plugin: &Path) -> Ending {
    let mut session = start(launcher, plugin).unwrap_or_else(|ending| panic!("{}: {ending}", plugin.display()));
    for x in [0.2, 2.0, -0.25, 1.5, 8.0] {
        let sample = session.query(Query::CollisionFirst, &upright(x));
        let sample = sample.unwrap_or_else(|outcome| panic!("{}: {outcome}", plugin.display()));
        let verdict = judged(Query::CollisionFirst, &upright(x), &sample.answer);
        assert_eq!(verdict, Verdict::Correct, "{} at {x}: {:?}", plugin.display(), sample.answer);
    }
    session.finish()
}

#[test]
fn every_language_is_right_and_completes() {
    let plugins = [
        (launcher(), fixture(&["NO_PAIR"])),
        (launcher(), honest("exceptions.cpp")),
        (launcher(), honest("panics.rs")),
        (two_threads(), honest("openmp.c")),
        // The other track is no obstacle to those who do not use it.
        (two_threads(), honest("exceptions.cpp")),
        (two_threads(), honest("panics.rs")),
    ];
    for round in 0..rounds() {
        for (launcher, plugin) in &plugins {
            let ending = run(launcher, plugin);
            assert_eq!(ending.outcome, Outcome::Completed, "round {round}, {}", plugin.display());
        }
    }
    println!("{} honest runs, all completed", rounds() * plugins.len());
}

#[test]
fn what_a_plugin_prints_is_kept() {
    let ending = run(&launcher(), &honest("exceptions.cpp"));
    // A question that was disturbed is asked again.
    let mut lines: Vec<&str> = ending.stderr.lines().collect();
    lines.dedup();
    assert_eq!(lines, ["apart by 1", "apart by 0.5", "apart by 7"]);
}

#[test]
fn a_panic_is_an_error_with_its_own_words() {
    let mut session = start(&launcher(), &honest("panics.rs")).unwrap();
    let outcome = session.query(Query::CollisionFirst, &upright(20.0)).unwrap_err();
    let reason = "collide returned OCB_ERROR: the plugin panicked: nobody goes as far as 20".to_string();
    assert_eq!(outcome, Outcome::Failed { phase: Phase::Query, reason });
}
