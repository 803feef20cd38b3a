//! The look at the runner from outside, before the plugin may be loaded.

use std::fs;
use std::path::Path;

/// What must hold for this kind of jail.
#[derive(Clone, Copy, Debug)]
pub struct Expected<'a> {
    /// In namespaces and a root of its own.
    pub namespaces: bool,
    /// With user and group ids of its own.
    pub own_ids: bool,
    /// In the memory group of this name.
    pub group: Option<&'a str>,
}

/// Every namespace the runner must have of its own.
const NAMESPACES: [&str; 7] = ["user", "pid", "net", "mnt", "ipc", "uts", "cgroup"];

/// Looks at the process; the error names the first thing that is not as it must be.
pub fn verify(pid: i32, expected: Expected<'_>) -> Result<(), String> {
    let process = Path::new("/proc").join(pid.to_string());
    let status = fs::read_to_string(process.join("status")).map_err(|e| format!("its status is not readable: {e}"))?;
    check_status(&status, expected)?;
    let mut descriptors: Vec<String> = fs::read_dir(process.join("fd"))
        .map_err(|e| format!("its descriptors are not readable: {e}"))?
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    descriptors.sort();
    if descriptors != ["0", "1", "2"] {
        return Err(format!("it holds the descriptors {} instead of 0, 1, 2", descriptors.join(", ")));
    }
    if let Some(group) = expected.group {
        let groups = fs::read_to_string(process.join("cgroup")).map_err(|e| format!("no list of its groups: {e}"))?;
        if !groups.lines().any(|line| line.rsplit('/').next() == Some(group)) {
            return Err(format!("it is not in the memory group {group}"));
        }
    }
    if expected.namespaces {
        for name in NAMESPACES {
            let namespace = |of: &Path| fs::read_link(of.join("ns").join(name));
            match (namespace(&process), namespace(Path::new("/proc/self"))) {
                (Ok(theirs), Ok(ours)) if theirs != ours => {}
                _ => return Err(format!("it has no {name} namespace of its own")),
            }
        }
        let mounts = fs::read_to_string(process.join("mountinfo")).map_err(|e| format!("no list of mounts: {e}"))?;
        check_mounts(&mounts)?;
    }
    Ok(())
}

fn check_status(status: &str, expected: Expected<'_>) -> Result<(), String> {
    let field = |name: &str| {
        status.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':')).map(str::trim).unwrap_or("missing")
    };
    let mut rules = vec![("Seccomp", "2"), ("NoNewPrivs", "1"), ("Threads", "1")];
    let no_capabilities = "0000000000000000";
    rules.extend(["CapInh", "CapPrm", "CapEff", "CapAmb"].map(|name| (name, no_capabilities)));
    if expected.namespaces {
        rules.push(("CapBnd", no_capabilities));
    }
    if expected.own_ids {
        rules.push(("Groups", ""));
    }
    for (name, wanted) in rules {
        if field(name) != wanted {
            return Err(format!("{name} is '{}' and must be '{wanted}'", field(name)));
        }
    }
    if expected.own_ids {
        let ids: Vec<&str> = field("Uid").split_whitespace().chain(field("Gid").split_whitespace()).collect();
        if ids.iter().any(|id| id.parse::<u32>().map_or(true, |id| id < 0x4000_0000)) {
            return Err(format!("its ids are {}", ids.join(" ")));
        }
    }
    Ok(())
}

fn check_mounts(mountinfo: &str) -> Result<(), String> {
    for line in mountinfo.lines() {
        let mut fields = line.split_whitespace().skip(4);
        let (place, options) = (fields.next().unwrap_or("?"), fields.next().unwrap_or(""));
        if !options.split(',').any(|option| option == "ro") {
            return Err(format!("its mount {place} is writable"));
        }
        if place != "/" && !place.starts_with("/lib") {
            return Err(format!("it has the mount {place}"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "Name:\tocb-runner\nUid:\t1073741825\t1073741825\t1073741825\t1073741825\n\
        Gid:\t1073741825\t1073741825\t1073741825\t1073741825\nGroups:\t \nThreads:\t1\n\
        CapInh:\t0000000000000000\nCapPrm:\t0000000000000000\nCapEff:\t0000000000000000\nCapBnd:\t0000000000000000\n\
        CapAmb:\t0000000000000000\nNoNewPrivs:\t1\nSeccomp:\t2\n";
    const JAIL: Expected<'_> = Expected { namespaces: true, own_ids: true, group: None };

    #[test]
    fn every_line_of_the_status_counts() {
        assert_eq!(check_status(GOOD, JAIL), Ok(()));
        for (good, bad) in [
            ("Seccomp:\t2", "Seccomp:\t0"),
            ("NoNewPrivs:\t1", "NoNewPrivs:\t0"),
            ("CapEff:\t0000000000000000", "CapEff:\t0000000000000001"),
            ("CapBnd:\t0000000000000000", "CapBnd:\t000001ffffffffff"),
            ("Groups:\t ", "Groups:\t0 4 24"),
            ("Uid:\t1073741825", "Uid:\t0"),
            ("Threads:\t1", "Threads:\t2"),
            ("Seccomp:\t2\n", ""),
        ] {
            assert!(check_status(&GOOD.replace(good, bad), JAIL).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_writable_or_foreign_mount_is_refused() {
        let root = "1 0 0:1 / / ro,nosuid,nodev - tmpfs none rw\n";
        assert_eq!(check_mounts(root), Ok(()));
        assert!(check_mounts(&root.replace(" ro,", " rw,")).is_err());
        assert!(check_mounts("1 0 0:1 / /proc ro - proc proc rw\n").is_err());
    }
}
