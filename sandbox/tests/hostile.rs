//! Plugins with one fault each, and the outcome that each must have.

mod common;

use common::{fixture, grouped, launcher, launcher_with, one_question, outcome, policy, start};
use ocb_core::query::Query;
use ocb_sandbox::{Outcome, Phase, Policy, Session};

/// The fault was survived, and the plugin tells what it got.
fn check_words(defines: &[&str], words: &str) {
    match outcome(defines) {
        Outcome::Failed { reason, .. } => assert!(reason.contains(words), "{defines:?}: {reason}"),
        other => panic!("{defines:?}: {other}"),
    }
}

fn check_load_error(defines: &[&str], words: &str) {
    match outcome(defines) {
        Outcome::LoadError { reason } => assert!(reason.contains(words), "{defines:?}: {reason}"),
        other => panic!("{defines:?}: {other}"),
    }
}

#[test]
fn time_limits_hold_in_every_phase() {
    let timed_out = |phase, limit_seconds| Outcome::TimedOut { phase, limit_seconds, cpu: false };
    assert_eq!(outcome(&["ATTACK=loop"]), timed_out(Phase::Query, 2.0));
    assert_eq!(outcome(&["ATTACK=sleep_forever"]), timed_out(Phase::Query, 2.0));
    assert_eq!(outcome(&["ATTACK=loop", "IN_BUILD"]), timed_out(Phase::Build, 3.0));
    assert_eq!(outcome(&["ATTACK=loop", "IN_CONSTRUCTOR"]), timed_out(Phase::Load, 3.0));
}

#[test]
fn a_trial_has_an_end() {
    // No other limit is near, so only the trial's can end it: in the query, or before it where the start is slow.
    let far = 600.0;
    let limits = Policy { load_seconds: far, build_seconds: far, query_seconds: far, ..policy() };
    let launcher = launcher_with(Policy { trial_seconds: 1.0, ..limits });
    let asked = |mut session: Session| session.query(Query::CollisionFirst, &common::apart(0.5)).unwrap_err();
    let outcome = start(&launcher, &fixture(&["ATTACK=sleep_forever"])).map_or_else(|ending| ending.outcome, asked);
    assert!(matches!(outcome, Outcome::TimedOut { limit_seconds: 1.0, cpu: false, .. }), "{outcome:?}");
}

#[test]
fn a_denied_call_tells_whose_code_made_it() {
    let Outcome::SyscallDenied { call, .. } = outcome(&["ATTACK=high_bits"]) else { panic!("not denied") };
    assert_eq!(call.mapping, "/lib/libc.so.6");
    assert_eq!((call.name.as_str(), call.args[0]), ("write", 0x1_0000_0002));
}

#[test]
fn memory_is_bounded() {
    let ending = one_question(&["ATTACK=touch_forever"], Query::CollisionFirst);
    // Where this process can make no memory group, the address space is the limit and malloc fails instead.
    if grouped() {
        assert_eq!(ending.outcome, Outcome::OutOfMemory { phase: Phase::Query, limit_bytes: 128 << 20 });
        assert!(ending.memory_peak_bytes.unwrap() > 64 << 20);
    } else {
        assert_eq!(ending.outcome, Outcome::Signaled { phase: Phase::Query, signal: libc::SIGABRT });
    }
}

#[test]
fn output_is_bounded() {
    let ending = one_question(&["ATTACK=flood"], Query::CollisionFirst);
    assert_eq!(ending.outcome, Outcome::OutputLimit { limit_bytes: 64 << 10 });
    assert_eq!(ending.stderr.len(), 64 << 10);
}

#[test]
fn writing_past_the_contact_buffer_is_a_crash() {
    let ending = one_question(&["FAULT_OVERRUN"], Query::CollisionAll);
    assert_eq!(ending.outcome, Outcome::Signaled { phase: Phase::Query, signal: libc::SIGSEGV });
}

#[test]
fn an_error_of_the_plugin_is_told_in_its_words() {
    let failed = outcome(&["FAULT_BUILD_ERROR"]);
    let reason = "load_mesh returned OCB_ERROR: no room for 2 triangles [31m".to_string();
    assert_eq!(failed, Outcome::Failed { phase: Phase::Build, reason });
    check_words(&["FAULT_ERROR"], "collide returned OCB_ERROR");
    check_words(&["FAULT_NO_OBJECT"], "load_mesh returned OCB_OK and no object");
}

#[test]
fn answers_outside_the_rules_are_violations() {
    let violation = |rule: &str| Outcome::ProtocolViolation { phase: Phase::Query, rule: rule.into() };
    assert_eq!(outcome(&["FAULT_STATUS"]), violation("77 is not a status"));
    assert_eq!(outcome(&["FAULT_HIT"]), violation("hit must be 0 or 1 and is 2"));
}

#[test]
fn what_is_no_plugin_is_a_load_error() {
    check_load_error(&["FAULT_NO_ENTRY"], "does not export the function ocb_entry_v1");
    check_load_error(&["FAULT_VERSION"], "built for version 2.");
    check_load_error(&["FAULT_REFUSES_HOST"], "another major version");
    check_load_error(&["FAULT_SHORT_STRUCT"], "ocb_algorithm declares a size of");
    check_load_error(&["FAULT_ID=\"Not an id\""], "breaks the rules of plugin.h");
    let folder = tempfile::tempdir().unwrap();
    let missing = launcher().describe(&folder.path().join("missing.so")).unwrap_err();
    assert!(matches!(missing.outcome, Outcome::LoadError { .. }), "{missing}");
    let a_folder = launcher().describe(folder.path()).unwrap_err();
    assert!(matches!(a_folder.outcome, Outcome::LoadError { .. }), "{a_folder}");
}

#[test]
fn every_ending_is_one_sentence() {
    for defines in
        [&["ATTACK=raw_call", "RAW=41"][..], &["ATTACK=store_to_null"], &["ATTACK=leave"], &["FAULT_VERSION"]]
    {
        let text = outcome(defines).to_string();
        assert!(text.ends_with('.') && !text.contains('\n') && !text.contains(".."), "{text}");
    }
}
