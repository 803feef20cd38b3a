//! The memory group: a control group of its own for each jail, where this process may make one.

use std::fs;
use std::io;
use std::os::fd::OwnedFd;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// Groups are named `ocb-jail-<pid of the supervisor>-<count>`, so that a janitor can tell whose they were.
const PREFIX: &str = "ocb-jail-";
/// What a process writes into [`MemoryGroup::entrance`].
pub(crate) const ITSELF: &[u8] = b"0";

/// One control group with a memory limit. Removed on drop; its processes must have ended by then.
#[derive(Debug)]
pub struct MemoryGroup {
    folder: PathBuf,
    version: Version,
}

/// Which generation of control groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// A hierarchy per controller.
    V1,
    /// One hierarchy.
    V2,
}

impl MemoryGroup {
    /// Makes a group limited to `bytes`. An error means that this machine lets us make none.
    pub fn new(bytes: u64) -> io::Result<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let (parent, version) = parent()?;
        if COUNT.load(Ordering::Relaxed) == 0 {
            sweep(&parent);
        }
        let name = format!("{PREFIX}{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let folder = parent.join(name);
        fs::create_dir(&folder)?;
        let group = MemoryGroup { folder, version };
        let limit = bytes.to_string();
        match version {
            Version::V1 => {
                group.write("memory.limit_in_bytes", &limit)?;
                // With swap accounting off the file is not there, and then there is nothing to limit.
                let _ = group.write("memory.memsw.limit_in_bytes", &limit);
            }
            Version::V2 => {
                group.write("memory.max", &limit)?;
                let _ = group.write("memory.swap.max", "0");
            }
        }
        Ok(group)
    }

    /// The file through which a process with a single thread moves itself in, by writing [`ITSELF`]. Moving another
    /// process, or one that may have several threads, waits until the whole kernel has stood still once (some 10 ms).
    pub fn entrance(&self) -> io::Result<OwnedFd> {
        let file = match self.version {
            Version::V1 => "tasks",
            Version::V2 => "cgroup.procs",
        };
        fs::OpenOptions::new().write(true).open(self.folder.join(file)).map(OwnedFd::from)
    }

    /// How many of its processes the kernel has killed for want of memory.
    pub fn kills(&self) -> u64 {
        let file = match self.version {
            Version::V1 => "memory.oom_control",
            Version::V2 => "memory.events",
        };
        let text = fs::read_to_string(self.folder.join(file)).unwrap_or_default();
        text.lines().find_map(|line| line.strip_prefix("oom_kill ")?.trim().parse().ok()).unwrap_or(0)
    }

    /// Bytes in use.
    pub fn usage(&self) -> Option<u64> {
        self.number(match self.version {
            Version::V1 => "memory.usage_in_bytes",
            Version::V2 => "memory.current",
        })
    }

    /// Most bytes ever in use.
    pub fn peak(&self) -> Option<u64> {
        self.number(match self.version {
            Version::V1 => "memory.max_usage_in_bytes",
            Version::V2 => "memory.peak",
        })
    }

    /// Its own name, without the folders above.
    pub fn name(&self) -> Option<&str> {
        self.folder.file_name()?.to_str()
    }

    /// `v1` or `v2`.
    pub fn version(&self) -> &'static str {
        match self.version {
            Version::V1 => "v1",
            Version::V2 => "v2",
        }
    }

    fn number(&self, file: &str) -> Option<u64> {
        fs::read_to_string(self.folder.join(file)).ok()?.trim().parse().ok()
    }

    fn write(&self, file: &str, text: &str) -> io::Result<()> {
        fs::write(self.folder.join(file), text)
    }
}

impl Drop for MemoryGroup {
    fn drop(&mut self) {
        // The kernel lets go of a group a moment after its last process has been reaped.
        for _ in 0..200 {
            match fs::remove_dir(&self.folder) {
                Err(error) if error.raw_os_error() == Some(libc::EBUSY) => std::thread::sleep(Duration::from_millis(2)),
                _ => return,
            }
        }
    }
}

/// Where groups with a memory controller can be made.
fn parent() -> io::Result<(PathBuf, Version)> {
    let mounts = fs::read_to_string("/proc/self/mountinfo")?;
    let groups = fs::read_to_string("/proc/self/cgroup")?;
    let places = memory_hierarchies(&mounts, &groups);
    let usable = places.into_iter().find(|(folder, version)| match version {
        Version::V1 => writable(folder),
        Version::V2 => writable(folder) && hands_memory_down(folder),
    });
    usable.ok_or_else(|| io::Error::other("no control group with a memory controller can be made here"))
}

fn writable(folder: &Path) -> bool {
    nix::unistd::access(folder, nix::unistd::AccessFlags::W_OK).is_ok()
}

fn hands_memory_down(folder: &Path) -> bool {
    let file = folder.join("cgroup.subtree_control");
    let has = || fs::read_to_string(&file).is_ok_and(|text| text.split_whitespace().any(|c| c == "memory"));
    has() || (fs::write(&file, "+memory").is_ok() && has())
}

/// Candidate folders: our own group where version 1 limits memory, the root of version 2 (a group with processes of its
/// own cannot hand controllers down).
fn memory_hierarchies(mountinfo: &str, own_groups: &str) -> Vec<(PathBuf, Version)> {
    let own = own_groups.lines().find_map(|line| {
        let mut parts = line.splitn(3, ':').skip(1);
        let controllers = parts.next()?;
        let path = parts.next()?;
        controllers.split(',').any(|c| c == "memory").then(|| path.trim_start_matches('/').to_string())
    });
    let mut places = Vec::new();
    for line in mountinfo.lines() {
        let Some((before, after)) = line.split_once(" - ") else { continue };
        let Some(folder) = before.split_whitespace().nth(4).map(PathBuf::from) else { continue };
        let mut after = after.split_whitespace();
        match (after.next(), after.nth(1)) {
            (Some("cgroup"), Some(options)) if options.split(',').any(|o| o == "memory") => {
                // A container may mount a part of the hierarchy: then our own path may not be below it.
                places.extend(own.iter().map(|own| (folder.join(own), Version::V1)).filter(|(f, _)| f.exists()));
                places.push((folder, Version::V1));
            }
            (Some("cgroup2"), _) => places.push((folder, Version::V2)),
            _ => {}
        }
    }
    places
}

/// Removes groups whose supervisor is gone. A group that still has processes cannot be removed and stays.
fn sweep(parent: &Path) {
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let owner = name.to_str().and_then(|n| n.strip_prefix(PREFIX)).and_then(|n| n.split('-').next());
        if owner.is_some_and(|pid| !Path::new("/proc").join(pid).exists()) {
            let _ = fs::remove_dir(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hierarchies_are_found_on_hybrid_and_on_unified_machines() {
        let hybrid = "30 29 0:27 / /sys/fs/cgroup/memory rw,relatime - cgroup cgroup rw,memory\n\
                      31 29 0:28 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n";
        assert_eq!(
            memory_hierarchies(hybrid, "4:memory:/not-there\n0::/\n"),
            [("/sys/fs/cgroup/memory".into(), Version::V1), ("/sys/fs/cgroup/unified".into(), Version::V2)]
        );
        let unified = "31 29 0:28 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n";
        assert_eq!(memory_hierarchies(unified, "0::/user.slice\n"), [("/sys/fs/cgroup".into(), Version::V2)]);
        assert_eq!(memory_hierarchies("nonsense\n- x\n", ""), []);
    }
}
