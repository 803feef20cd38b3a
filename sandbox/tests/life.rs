//! Beginnings and ends, seen from the supervisor.

mod common;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use common::{alive, apart, fixture, groups_of, launcher, launcher_with, mesh, policy, start};
use ocb_core::query::Query;
use ocb_sandbox::{Killer, Launcher, Outcome, Phase, Policy, Trial};

#[test]
fn a_runner_killed_from_outside_is_told_as_a_signal() {
    let mut session = start(&launcher(), &fixture(&["ATTACK=sleep_forever"])).unwrap();
    let pid = session.pid();
    let assassin = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(200));
        // SAFETY: the runner of this test.
        unsafe { libc::kill(pid, libc::SIGKILL) };
    });
    let outcome = session.query(Query::CollisionFirst, &apart(0.5)).unwrap_err();
    assassin.join().unwrap();
    assert_eq!(outcome, Outcome::Signaled { phase: Phase::Query, signal: libc::SIGKILL });
    // Dead is dead: later questions get the same answer.
    assert_eq!(session.query(Query::Proximity, &apart(0.5)).unwrap_err(), outcome);
    assert_eq!(session.finish().outcome, outcome);
}

#[test]
fn a_session_can_be_cancelled_from_another_thread() {
    let mut session = start(&launcher(), &fixture(&["ATTACK=loop"])).unwrap();
    let (killer, pid) = (session.killer(), session.pid());
    let other = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(200));
        killer.kill();
    });
    assert_eq!(session.query(Query::CollisionFirst, &apart(0.5)).unwrap_err(), Outcome::Cancelled);
    other.join().unwrap();
    assert_eq!(session.finish().outcome, Outcome::Cancelled);
    assert!(!alive(pid));
}

#[test]
fn a_build_can_be_cancelled() {
    let (killer, before) = (Killer::default(), Instant::now());
    let other = {
        let killer = killer.clone();
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_millis(300));
            killer.kill();
        })
    };
    let (mesh, plugin) = (mesh(), fixture(&["ATTACK=loop", "IN_BUILD"]));
    let trial = Trial::new(&plugin, "fixture", &mesh, None);
    let launcher = launcher_with(Policy { build_seconds: 60.0, ..policy() });
    let ending = launcher.start_with(&trial, &killer).err().unwrap();
    assert_eq!(ending.outcome, Outcome::Cancelled);
    assert!(before.elapsed() < Duration::from_secs(10), "{:?}", before.elapsed());
    other.join().unwrap();
    // And one that was cancelled before it began never runs at all.
    assert_eq!(launcher.start_with(&trial, &killer).err().unwrap().outcome, Outcome::Cancelled);
}

#[test]
fn a_dropped_session_is_dead() {
    let session = start(&launcher(), &fixture(&[])).unwrap();
    let pid = session.pid();
    assert!(alive(pid));
    drop(session);
    assert!(!alive(pid));
}

#[test]
fn a_missing_runner_is_our_fault() {
    let launcher = Launcher::new("/nowhere/ocb-runner".into(), policy());
    let ending = launcher.describe(&fixture(&[])).unwrap_err();
    assert!(ending.outcome.ours(), "{ending}");
    assert!(ending.to_string().contains("/nowhere/ocb-runner"), "{ending}");
}

#[test]
fn a_file_that_was_replaced_is_told_from_faults() {
    use sha2::{Digest, Sha256};
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plugin.so");
    std::fs::copy(fixture(&[]), &file).unwrap();
    let hash: String = Sha256::digest(std::fs::read(&file).unwrap()).iter().map(|b| format!("{b:02x}")).collect();
    let launcher = launcher_with(Policy { plugin_sha256: Some(hash), ..policy() });
    assert_eq!(start(&launcher, &file).unwrap().finish().outcome, Outcome::Completed);
    std::fs::copy(fixture(&["ATTACK=loop"]), &file).unwrap();
    let replaced = start(&launcher, &file).err().unwrap().outcome;
    std::fs::remove_file(&file).unwrap();
    let removed = start(&launcher, &file).err().unwrap().outcome;
    for (outcome, words) in [(replaced, "its SHA-256 is"), (removed, "cannot be read")] {
        assert!(matches!(&outcome, Outcome::FileReplaced { reason } if reason.contains(words)), "{outcome:?}");
        assert!(!outcome.ours() && outcome.name() == "FileReplaced", "{outcome}");
    }
}

#[test]
fn starting_is_cheap() {
    let plugin = fixture(&[]);
    let mut times: Vec<Duration> = (0..10)
        .map(|_| {
            let before = Instant::now();
            start(&launcher(), &plugin).unwrap().finish();
            before.elapsed()
        })
        .collect();
    times.sort();
    println!("a trial without questions: median {:?}, from {:?} to {:?}", times[5], times[0], times[9]);
    // A sanity bound for a busy machine; the aim is 20 ms on an idle one.
    assert!(times[5] < Duration::from_secs(2), "{times:?}");
}

#[test]
fn a_jail_is_counted_where_groups_allow() {
    let session = start(&launcher(), &fixture(&[])).unwrap();
    let counted = session.layers().iter().any(|layer| layer.contains("processes counted"));
    let own = std::fs::read_to_string(format!("/proc/{}/cgroup", session.pid())).unwrap();
    let mut groups = groups_of(std::process::id());
    groups.retain(|group| own.lines().any(|line| Path::new(line).file_name() == group.file_name()));
    let number = |group: &PathBuf, file: &str| -> Option<u64> {
        std::fs::read_to_string(group.join(file)).ok()?.trim().parse().ok()
    };
    let limits: Vec<[u64; 2]> =
        groups.iter().filter_map(|group| Some([number(group, "pids.max")?, number(group, "pids.current")?])).collect();
    let expected = if counted { vec![[3, 3]] } else { Vec::new() };
    assert_eq!(limits, expected, "launcher, init and runner in {groups:?}");
    // SAFETY: takes no arguments.
    let root = unsafe { libc::geteuid() } == 0;
    assert!(counted || !root, "root's jails are counted");
    session.finish();
    assert!(groups.iter().all(|group| !group.exists()), "{groups:?}");
}
