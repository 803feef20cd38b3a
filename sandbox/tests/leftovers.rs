//! Trials leave nothing behind: fifty here, a thousand with `OCB_TRIALS=1000`, as `make soak` has it.

mod common;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use common::{apart, fixture, groups_of, launcher, mesh, start};
use ocb_core::query::Query;
use ocb_sandbox::{Killer, Outcome, Trial};

fn trials() -> usize {
    std::env::var("OCB_TRIALS").ok().and_then(|n| n.parse().ok()).unwrap_or(50)
}

/// One test, because it counts what this whole process has.
#[test]
fn trials_leave_nothing_behind() {
    let faults: [&[&str]; 5] = [
        &[],
        &["ATTACK=store_to_null"],
        &["ATTACK=raw_call", "RAW=41"],
        &["ATTACK=leave", "IN_CONSTRUCTOR"],
        &["FAULT_NO_ENTRY"],
    ];
    // The clock's calibration and the first compilation open things of their own.
    let plugins = faults.map(fixture);
    drop(start(&launcher(), &plugins[0]).unwrap());
    let before = leftovers();
    for i in 0..trials() {
        if let Ok(mut session) = start(&launcher(), &plugins[i % 5]) {
            let _ = session.query(Query::CollisionFirst, &apart(0.5));
            session.finish();
        }
    }
    assert_eq!(leftovers(), before);
    for i in 0..trials() {
        end_at_any_step(&plugins[0], i);
    }
    assert_eq!(leftovers(), before);
}

/// The jail's processes are killed, or the session is cancelled, after so many steps of half a millisecond.
fn end_at_any_step(plugin: &std::path::Path, step: usize) {
    let (mesh, killer) = (mesh(), Killer::default());
    let after = Duration::from_micros(500) * (step % 80) as u32;
    let other = {
        let (killer, cancel) = (killer.clone(), step.is_multiple_of(2));
        std::thread::spawn(move || {
            std::thread::sleep(after);
            if cancel {
                killer.kill();
            } else {
                for pid in children() {
                    // SAFETY: children of this process, which are the launchers of this test.
                    unsafe { libc::kill(pid, libc::SIGKILL) };
                }
            }
        })
    };
    let begun = Instant::now();
    let trial = Trial::new(plugin, "fixture", &mesh, None);
    let outcome = match launcher().start_with(&trial, &killer) {
        Ok(mut session) => {
            let asked = (0..50).find_map(|_| session.query(Query::CollisionFirst, &apart(0.5)).err());
            asked.unwrap_or_else(|| session.finish().outcome)
        }
        Err(ending) => ending.outcome,
    };
    other.join().unwrap();
    // Whoever kills our own processes is no plugin; whoever cancels is nobody.
    let plausible = matches!(outcome, Outcome::Completed | Outcome::Cancelled | Outcome::SandboxFault { .. })
        || matches!(outcome, Outcome::Signaled { signal: libc::SIGKILL, .. });
    assert!(plausible, "step {step}: {outcome}");
    assert!(begun.elapsed() < Duration::from_secs(20), "step {step}: {:?}", begun.elapsed());
}

/// Processes whose parent is this one, dead ones that nobody has reaped included.
fn children() -> Vec<i32> {
    let own = std::process::id().to_string();
    let all = std::fs::read_dir("/proc").unwrap().flatten().filter_map(|e| e.file_name().to_str()?.parse::<i32>().ok());
    all.filter(|pid| {
        let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        stat.rsplit(") ").next().and_then(|rest| rest.split(' ').nth(1)) == Some(&own)
    })
    .collect()
}

/// Descriptors and mounts of this process, its children, its memory groups.
fn leftovers() -> (usize, usize, Vec<i32>, Vec<PathBuf>) {
    let count = |folder: &str| std::fs::read_dir(folder).unwrap().count();
    let mounts = std::fs::read_to_string("/proc/self/mountinfo").unwrap().lines().count();
    (count("/proc/self/fd"), mounts, children(), groups_of(std::process::id()))
}
