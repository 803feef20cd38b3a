//! The multi-threaded track: threads work on the CPUs that they are given, are counted, and end with their trial. What
//! hostile threads get stands in the catalogue.

mod common;

use common::{apart, fixture, honest, launcher, launcher_with, policy, start};
use ocb_core::query::Query;
use ocb_sandbox::{ClockKind, Launcher, Outcome, Policy};

/// The track for two threads, which needs two CPUs.
fn two_threads() -> Launcher {
    let cpus = std::thread::available_parallelism().map_or(1, usize::from);
    assert!(cpus >= 2, "the tests of the multi-threaded track need two CPUs; this process may use one");
    launcher_with(Policy { threads: 2, ..policy() })
}

#[test]
fn a_plugin_says_that_it_can_use_threads() {
    assert!(two_threads().describe(&honest("openmp.c")).unwrap()[0].threads);
    assert!(!launcher().describe(&fixture(&[])).unwrap()[0].threads);
}

#[test]
fn openmp_is_for_the_multi_threaded_track_alone() {
    let refused = launcher().describe(&honest("openmp.c")).unwrap_err();
    let Outcome::LoadError { reason } = &refused.outcome else { panic!("{refused}") };
    assert!(reason.contains("libgomp.so.1") && reason.contains("OCB_CAPABILITY_THREADS"), "{reason}");
    let rules = launcher().inspect(&honest("openmp.c")).unwrap().rejections;
    assert_eq!(rules.iter().map(|r| r.rule.as_str()).collect::<Vec<_>>(), ["threads"]);
    assert_eq!(two_threads().inspect(&honest("openmp.c")).unwrap().rejections, []);
}

#[test]
fn the_track_is_told_and_limited() {
    let limit = |launcher: &Launcher| {
        let session = start(launcher, &fixture(&[])).unwrap();
        let limits = std::fs::read_to_string(format!("/proc/{}/limits", session.pid())).unwrap();
        let line = limits.lines().find(|line| line.starts_with("Max processes")).unwrap().to_string();
        let words: Vec<u64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let told = session.layers().iter().any(|layer| layer.contains("multi-threaded track"));
        (words, told)
    };
    // As root the runner has an id of its own; otherwise it shares one with the jail's init.
    // SAFETY: reads a number.
    let init = u64::from(unsafe { libc::geteuid() } != 0);
    assert_eq!(limit(&launcher()), (vec![1 + init; 2], false));
    assert_eq!(limit(&two_threads()), (vec![17 + init; 2], true));
}

/// Both threads' work is processor time, however long it took by the wall clock.
#[test]
fn processor_time_of_all_threads_is_reported() {
    let mut session = start(&two_threads(), &fixture(&["ATTACK=work_on_two_threads"])).unwrap();
    let sample = session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
    // Each works for 0.1 s of its own processor time; on two idle CPUs that is little more than 0.1 s of wall time.
    assert!(sample.raw_ns > 1e8, "{sample:?}");
    assert!(session.finish().cpu_seconds.unwrap() >= 0.2);
}

#[test]
fn the_clock_sleeps_where_the_threads_need_all_cpus() {
    let cpus = std::thread::available_parallelism().map_or(1, usize::from);
    let kind = |threads| {
        let launcher = launcher_with(Policy { threads, ..policy() });
        start(&launcher, &fixture(&[])).unwrap().clock().kind
    };
    assert_eq!(kind(cpus.max(2)), ClockKind::Futex);
    if cpus > 2 {
        assert_eq!(kind(2), ClockKind::Spin);
    }
    let launcher = launcher_with(Policy { threads: cpus + 1, ..policy() });
    let Err(ending) = start(&launcher, &fixture(&[])) else { panic!("more threads than CPUs") };
    assert!(ending.outcome.ours() && ending.to_string().contains("ask for fewer threads"), "{ending}");
}
