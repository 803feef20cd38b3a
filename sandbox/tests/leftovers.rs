//! Fifty trials leave nothing behind.

mod common;

use std::path::{Path, PathBuf};

use common::{apart, fixture, launcher, start};
use ocb_core::query::Query;

#[test]
fn fifty_trials_leave_nothing_behind() {
    // The clock's calibration and the first compilation open things of their own.
    drop(start(&launcher(), &fixture(&[])).unwrap());
    let before = leftovers();
    for i in 0..50 {
        let defines: &[&str] =
            [&[][..], &["FAULT_CRASH"], &["FAULT_SOCKET"], &["FAULT_EXIT", "IN_CONSTRUCTOR"], &["FAULT_NO_ENTRY"]]
                [i % 5];
        if let Ok(mut session) = start(&launcher(), &fixture(defines)) {
            let _ = session.query(Query::CollisionFirst, &apart(0.5));
            session.finish();
        }
    }
    let after = leftovers();
    assert_eq!(before, after);
}

/// Descriptors and mounts of this process, its children, its memory groups. This program has no other test, so nothing else comes and goes.
fn leftovers() -> (usize, usize, Vec<PathBuf>) {
    let count = |folder: &str| std::fs::read_dir(folder).unwrap().count();
    let mounts = std::fs::read_to_string("/proc/self/mountinfo").unwrap().lines().count();
    let mut groups = Vec::new();
    let prefix = format!("ocb-jail-{}-", std::process::id());
    find(Path::new("/sys/fs/cgroup"), &prefix, 6, &mut groups);
    (count("/proc/self/fd"), mounts, groups)
}

fn find(folder: &Path, prefix: &str, depth: u32, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if !entry.file_type().is_ok_and(|t| t.is_dir()) {
            continue;
        }
        if entry.file_name().to_string_lossy().starts_with(prefix) {
            found.push(entry.path());
        } else if depth > 0 {
            find(&entry.path(), prefix, depth - 1, found);
        }
    }
}
