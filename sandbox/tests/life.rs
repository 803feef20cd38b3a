//! Beginnings and ends, seen from the supervisor.

mod common;

use std::time::{Duration, Instant};

use common::{alive, apart, fixture, launcher, policy, start};
use ocb_core::query::Query;
use ocb_sandbox::{Launcher, Outcome, Phase};

#[test]
fn a_runner_killed_from_outside_is_told_as_a_signal() {
    let mut session = start(&launcher(), &fixture(&["FAULT_SLEEP"])).unwrap();
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
    let mut session = start(&launcher(), &fixture(&["FAULT_LOOP"])).unwrap();
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
