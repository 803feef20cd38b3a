//! Plugins with one fault each, and the outcome that each must have.

mod common;

use common::{fixture, launcher, launcher_with, one_question, outcome, policy, start};
use ocb_core::query::Query;
use ocb_sandbox::{Ending, Outcome, Phase, Policy};

fn check_signal(defines: &[&str], phase: Phase, signal: i32) {
    assert_eq!(outcome(defines), Outcome::Signaled { phase, signal }, "{defines:?}");
}

fn check_denied(defines: &[&str], phase: Phase, nr: i64, name: &str) {
    match outcome(defines) {
        Outcome::SyscallDenied { phase: p, call } => {
            assert_eq!((p, call.nr, call.name.as_str()), (phase, nr, name), "{defines:?}");
        }
        other => panic!("{defines:?}: {other}"),
    }
}

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
fn crashes_are_signals() {
    check_signal(&["FAULT_CRASH"], Phase::Query, libc::SIGSEGV);
    check_signal(&["FAULT_CRASH", "IN_BUILD"], Phase::Build, libc::SIGSEGV);
    check_signal(&["FAULT_CRASH", "IN_CONSTRUCTOR"], Phase::Load, libc::SIGSEGV);
    check_signal(&["FAULT_ILLEGAL"], Phase::Query, libc::SIGILL);
    check_signal(&["FAULT_ABORT"], Phase::Query, libc::SIGABRT);
    check_signal(&["FAULT_ABORT", "IN_CONSTRUCTOR"], Phase::Load, libc::SIGABRT);
    // Not a time limit: a handler that loops was one of the traps.
    check_signal(&["FAULT_RECURSION"], Phase::Query, libc::SIGSEGV);
    check_signal(&["FAULT_SURVIVE"], Phase::Query, libc::SIGSEGV);
}

#[test]
fn time_limits_hold_in_every_phase() {
    let timed_out = |phase, limit_seconds| Outcome::TimedOut { phase, limit_seconds, cpu: false };
    assert_eq!(outcome(&["FAULT_LOOP"]), timed_out(Phase::Query, 2.0));
    assert_eq!(outcome(&["FAULT_SLEEP"]), timed_out(Phase::Query, 2.0));
    assert_eq!(outcome(&["FAULT_LOOP", "IN_BUILD"]), timed_out(Phase::Build, 3.0));
    assert_eq!(outcome(&["FAULT_LOOP", "IN_CONSTRUCTOR"]), timed_out(Phase::Load, 3.0));
}

#[test]
fn a_trial_has_an_end() {
    let launcher = launcher_with(Policy { trial_seconds: 1.0, ..policy() });
    let mut session = start(&launcher, &fixture(&["FAULT_SLEEP"])).unwrap();
    let outcome = session.query(Query::CollisionFirst, &common::apart(0.5)).unwrap_err();
    assert_eq!(outcome, Outcome::TimedOut { phase: Phase::Query, limit_seconds: 1.0, cpu: false });
}

#[test]
fn leaving_early_is_a_failure() {
    let left = |phase, status: i32| Outcome::Failed {
        phase,
        reason: format!("it ended its process with exit status {status}"),
    };
    assert_eq!(outcome(&["FAULT_EXIT"]), left(Phase::Query, 0));
    assert_eq!(outcome(&["FAULT_EXIT", "IN_CONSTRUCTOR"]), left(Phase::Load, 0));
    assert_eq!(outcome(&["FAULT_QUICK_EXIT"]), left(Phase::Query, 7));
}

#[test]
fn forbidden_calls_are_named() {
    for (fault, nr, name) in [
        ("FAULT_SOCKET", libc::SYS_socket, "socket"),
        ("FAULT_EXEC", libc::SYS_execve, "execve"),
        ("FAULT_CREATE", libc::SYS_openat, "openat"),
        ("FAULT_KILL", libc::SYS_kill, "kill"),
        ("FAULT_PTRACE", libc::SYS_ptrace, "ptrace"),
        ("FAULT_IO_URING", libc::SYS_io_uring_setup, "io_uring_setup"),
        ("FAULT_SECCOMP", libc::SYS_seccomp, "seccomp"),
        ("FAULT_EXECUTABLE_MEMORY", libc::SYS_mmap, "mmap"),
        ("FAULT_HIGH_BITS", libc::SYS_write, "write"),
        ("FAULT_NO_SUCH_CALL", 9999, "?"),
        ("FAULT_X32", 0x4000_0027, "?"),
    ] {
        check_denied(&[fault], Phase::Query, nr, name);
    }
    check_denied(&["FAULT_SOCKET", "IN_CONSTRUCTOR"], Phase::Load, libc::SYS_socket, "socket");
    check_denied(&["FAULT_EXEC", "IN_CONSTRUCTOR"], Phase::Load, libc::SYS_execve, "execve");
    // glibc's fork is a clone, or a vfork on its way to one.
    check_denied(&["FAULT_FORK"], Phase::Query, libc::SYS_clone, "clone");
    check_denied(&["FAULT_FORK", "IN_BUILD"], Phase::Build, libc::SYS_clone, "clone");
}

#[test]
fn a_denied_call_tells_whose_code_made_it() {
    let Outcome::SyscallDenied { call, .. } = outcome(&["FAULT_SOCKET"]) else { panic!("not denied") };
    assert_eq!(call.mapping, "/lib/libc.so.6");
    assert_eq!(call.args[..2], [libc::AF_INET as u64, libc::SOCK_STREAM as u64]);
}

#[test]
fn the_other_system_call_gate_is_shut() {
    check_signal(&["FAULT_INT80"], Phase::Query, libc::SIGSYS);
}

#[test]
fn there_is_nothing_to_open() {
    check_words(&["FAULT_OPEN"], "open: No such file or directory");
    check_words(&["FAULT_OPEN", "IN_CONSTRUCTOR"], "open: No such file or directory");
}

#[test]
fn no_descriptor_is_inherited() {
    // pwrite is not on the list at all; the very first try ends the plugin.
    check_denied(&["FAULT_WRITE_DESCRIPTOR"], Phase::Query, libc::SYS_pwrite64, "pwrite64");
}

#[test]
fn memory_is_bounded() {
    let ending = one_question(&["FAULT_MEMORY"], Query::CollisionFirst);
    // Where this process can make no memory group, the address space is the limit and malloc fails instead.
    if in_a_memory_group() {
        assert_eq!(ending.outcome, Outcome::OutOfMemory { phase: Phase::Query, limit_bytes: 128 << 20 });
        assert!(ending.memory_peak_bytes.unwrap() > 64 << 20);
    } else {
        assert_eq!(ending.outcome, Outcome::Signaled { phase: Phase::Query, signal: libc::SIGABRT });
    }
    check_words(&["FAULT_RESERVE"], "reserve: Cannot allocate memory");
}

fn in_a_memory_group() -> bool {
    let session = start(&launcher(), &fixture(&[])).unwrap();
    session.layers().iter().any(|layer| layer.starts_with("memory group"))
}

#[test]
fn output_is_bounded() {
    let ending = one_question(&["FAULT_STDERR"], Query::CollisionFirst);
    assert_eq!(ending.outcome, Outcome::OutputLimit { limit_bytes: 64 << 10 });
    assert_eq!(ending.stderr.len(), 64 << 10);
}

#[test]
fn the_input_is_read_only() {
    check_signal(&["FAULT_WRITE_INPUT"], Phase::Build, libc::SIGSEGV);
    check_words(&["FAULT_UNPROTECT_INPUT"], "unprotect: Permission denied");
}

#[test]
fn writing_past_the_contact_buffer_is_a_crash() {
    let ending = one_question(&["FAULT_OVERRUN"], Query::CollisionAll);
    assert_eq!(ending.outcome, Outcome::Signaled { phase: Phase::Query, signal: libc::SIGSEGV });
}

#[test]
fn the_code_of_the_runner_cannot_be_replaced() {
    let session = start(&launcher(), &fixture(&[])).unwrap();
    if session.layers().iter().any(|layer| layer.contains("mseal")) {
        check_words(&["FAULT_OVERLAY_RUNNER"], "overlay: Operation not permitted");
    }
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
    assert_eq!(outcome(&["FAULT_STATUS"]), violation("77 is no status"));
    assert_eq!(outcome(&["FAULT_HIT"]), violation("hit must be 0 or 1 and is 2"));
}

#[test]
fn what_is_no_plugin_is_a_load_error() {
    check_load_error(&["FAULT_NO_ENTRY"], "does not export the function ocb_plugin_v1");
    check_load_error(&["FAULT_VERSION"], "built for version 2.0");
    check_load_error(&["FAULT_REFUSES_HOST"], "another major version");
    check_load_error(&["FAULT_SHORT_STRUCT"], "ocb_algorithm says a size of");
    check_load_error(&["FAULT_ID=\"Not an id\""], "breaks the rules of plugin.h");
    let folder = tempfile::tempdir().unwrap();
    let check_file = |bytes: &[u8], words: &str| {
        let file = folder.path().join("x.so");
        std::fs::write(&file, bytes).unwrap();
        let Ending { outcome, .. } = launcher().describe(&file).unwrap_err();
        let Outcome::LoadError { reason } = &outcome else { panic!("{outcome}") };
        assert!(reason.contains(words), "{reason}");
        // The jail's own paths and the host's mean nothing to the author.
        assert!(!reason.contains("/plugin.so"), "{reason}");
    };
    check_file(b"", "file too short");
    check_file(
        b"#!/bin/sh\necho I am no library, but I am long enough to hold an ELF header, or so I hope.\n",
        "invalid ELF header",
    );
    let missing = launcher().describe(&folder.path().join("missing.so")).unwrap_err();
    assert!(matches!(missing.outcome, Outcome::LoadError { .. }), "{missing}");
    let a_folder = launcher().describe(folder.path()).unwrap_err();
    assert!(matches!(a_folder.outcome, Outcome::LoadError { .. }), "{a_folder}");
}

#[test]
fn half_a_file_is_never_a_plugin() {
    // glibc maps what the headers promise and stumbles over the missing end.
    let whole = std::fs::read(fixture(&[])).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("x.so");
    // The last third holds symbols for debuggers, which no loader reads.
    for share in 1..6 {
        std::fs::write(&file, &whole[..whole.len() * share / 10]).unwrap();
        let Ending { outcome, .. } = launcher().describe(&file).unwrap_err();
        assert!(
            matches!(outcome, Outcome::LoadError { .. } | Outcome::Signaled { phase: Phase::Load, .. }),
            "{outcome}"
        );
    }
}

#[test]
fn every_ending_is_one_sentence() {
    for defines in [&["FAULT_SOCKET"][..], &["FAULT_CRASH"], &["FAULT_EXIT"], &["FAULT_VERSION"]] {
        let text = outcome(defines).to_string();
        assert!(text.ends_with('.') && !text.contains('\n') && !text.contains(".."), "{text}");
    }
}
