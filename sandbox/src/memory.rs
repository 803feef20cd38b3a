//! The memory group: a control group of its own for each jail, where this process may make one. It also limits the number of
//! processes if possible. It never limits CPU time: a scheduling group got no CPU for minutes beside one busy loop (Linux 6.18),
//! and the runner is pinned to its CPUs anyway.

use std::ffi::{CStr, CString};
use std::fs;
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// Groups are named `ocb-jail-<pid of the supervisor>-<count>`, so that a janitor can tell whose they were.
const PREFIX: &str = "ocb-jail-";
/// The group below a delegated one into which its processes are moved.
const HOST: &str = "ocb-host";
/// What a process writes into [`MemoryGroup::entrances`].
pub(crate) const ITSELF: &[u8] = b"0";

/// One control group with a memory limit. Removed on drop; its processes must have ended by then.
#[derive(Debug)]
pub struct MemoryGroup {
    folder: PathBuf,
    version: Version,
    /// Where its processes are counted; with one hierarchy that is `folder`.
    counted: Option<PathBuf>,
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
    /// Makes a group limited to `bytes`, and to `tasks` processes and threads where these can be counted. An error means that this
    /// machine lets us make none.
    pub fn new(bytes: u64, tasks: usize) -> io::Result<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let (parent, version) = parent("memory")?;
        let counting = match version {
            Version::V1 => {
                self::parent("pids").ok().filter(|(_, version)| *version == Version::V1).map(|(folder, _)| folder)
            }
            Version::V2 => None,
        };
        if COUNT.load(Ordering::Relaxed) == 0 {
            [Some(&parent), counting.as_ref()].into_iter().flatten().for_each(|parent| sweep(parent));
        }
        let name = format!("{PREFIX}{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let folder = parent.join(&name);
        fs::create_dir(&folder)?;
        let mut group = MemoryGroup { folder, version, counted: None };
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
        let counted = match version {
            Version::V1 => counting.map(|parent| parent.join(&name)).filter(|folder| fs::create_dir(folder).is_ok()),
            Version::V2 => Some(group.folder.clone()).filter(|_| hands_down(&parent, "pids")),
        };
        group.counted = counted.filter(|folder| fs::write(folder.join("pids.max"), tasks.to_string()).is_ok());
        Ok(group)
    }

    /// The files through which a process with a single thread moves itself in, by writing [`ITSELF`] into each. Moving another
    /// process, or one that may have several threads, waits until the whole kernel has stood still once (some 10 ms).
    pub fn entrances(&self) -> io::Result<Vec<OwnedFd>> {
        let file = match self.version {
            Version::V1 => "tasks",
            Version::V2 => "cgroup.procs",
        };
        let elsewhere = self.counted.iter().filter(|folder| **folder != self.folder);
        let folders = [&self.folder].into_iter().chain(elsewhere);
        folders.map(|folder| fs::OpenOptions::new().write(true).open(folder.join(file)).map(OwnedFd::from)).collect()
    }

    /// Are its processes counted?
    pub fn counts_processes(&self) -> bool {
        self.counted.is_some()
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
        remove(&self.folder);
        if let Some(counted) = &self.counted {
            remove(counted);
        }
    }
}

/// The kernel lets go of a group a moment after its last process has been reaped.
fn remove(folder: &Path) {
    for _ in 0..200 {
        match fs::remove_dir(folder) {
            Err(error) if error.raw_os_error() == Some(libc::EBUSY) => std::thread::sleep(Duration::from_millis(2)),
            _ => return,
        }
    }
}

/// Where groups with this controller can be made.
fn parent(controller: &str) -> io::Result<(PathBuf, Version)> {
    let mounts = fs::read_to_string("/proc/self/mountinfo")?;
    let groups = fs::read_to_string("/proc/self/cgroup")?;
    let places = hierarchies(controller, &mounts, &groups);
    let usable = places.into_iter().find(|(folder, version)| match version {
        Version::V1 => writable(folder),
        Version::V2 => writable(folder) && hands_down(folder, controller),
    });
    usable.ok_or_else(|| io::Error::other(format!("cannot create a control group with a {controller} controller")))
}

fn writable(folder: &Path) -> bool {
    nix::unistd::access(folder, nix::unistd::AccessFlags::W_OK).is_ok()
}

/// Can groups below this one (version 2) have the controller? A group with processes of its own cannot pass it on, so its processes
/// are moved one level down if it is ours.
fn hands_down(folder: &Path, controller: &str) -> bool {
    let names = |file: &str| {
        fs::read_to_string(folder.join(file)).is_ok_and(|text| text.split_whitespace().any(|c| c == controller))
    };
    let has = || names("cgroup.subtree_control");
    let ask = || fs::write(folder.join("cgroup.subtree_control"), format!("+{controller}")).is_ok() && has();
    has() || names("cgroup.controllers") && (ask() || is_ours(folder) && make_room(folder).is_ok() && ask())
}

/// May its processes be rearranged? Yes if systemd has delegated it (`Delegate=`), if it is the root of a container, or if this
/// process is alone in it.
fn is_ours(folder: &Path) -> bool {
    let delegated = || [c"user.delegate", c"trusted.delegate"].iter().any(|name| is_marked(folder, name));
    // The machine's own root has no type, and needs no room.
    let is_group = |folder: &Path| folder.join("cgroup.procs").exists();
    let root_of_namespace = || folder.join("cgroup.type").exists() && !folder.parent().is_some_and(is_group);
    let alone = || processes(folder).is_ok_and(|all| all == [std::process::id().to_string()]);
    delegated() || root_of_namespace() || alone()
}

fn is_marked(folder: &Path, name: &CStr) -> bool {
    let Ok(path) = CString::new(folder.as_os_str().as_bytes()) else { return false };
    let mut value = [0u8; 1];
    // SAFETY: two live C strings, and a buffer of the length that is given.
    let len = unsafe { libc::getxattr(path.as_ptr(), name.as_ptr(), value.as_mut_ptr().cast(), value.len()) };
    len == 1 && value == *b"1"
}

/// Moves the processes of a group into one below it.
fn make_room(folder: &Path) -> io::Result<()> {
    let below = folder.join(HOST);
    match fs::create_dir(&below) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error),
        _ => {}
    }
    for process in processes(folder)? {
        // A failure is harmless for a process that has ended; for any other the next attempt to pass on the controller fails.
        let _ = fs::write(below.join("cgroup.procs"), process);
    }
    Ok(())
}

fn processes(folder: &Path) -> io::Result<Vec<String>> {
    Ok(fs::read_to_string(folder.join("cgroup.procs"))?.split_whitespace().map(str::to_owned).collect())
}

/// Candidate folders: our own group where version 1 has the controller; of version 2 our own group, or the one above it when we
/// have made room there, and the root.
fn hierarchies(controller: &str, mountinfo: &str, own_groups: &str) -> Vec<(PathBuf, Version)> {
    let group = |is: &dyn Fn(&str) -> bool| {
        own_groups.lines().find_map(|line| {
            let (_number, rest) = line.split_once(':')?;
            let (controllers, path) = rest.split_once(':')?;
            is(controllers).then(|| path.trim_start_matches('/').to_string())
        })
    };
    let own = group(&|controllers| controllers.split(',').any(|c| c == controller));
    let unified = group(&str::is_empty);
    let mut places = Vec::new();
    for line in mountinfo.lines() {
        let Some((before, after)) = line.split_once(" - ") else { continue };
        let Some(folder) = before.split_whitespace().nth(4).map(PathBuf::from) else { continue };
        let mut after = after.split_whitespace();
        match (after.next(), after.nth(1)) {
            (Some("cgroup"), Some(options)) if options.split(',').any(|o| o == controller) => {
                // A container may mount a part of the hierarchy: then our own path may not be below it.
                places.extend(own.iter().map(|own| (folder.join(own), Version::V1)).filter(|(f, _)| f.exists()));
                places.push((folder, Version::V1));
            }
            (Some("cgroup2"), _) => {
                if let Some(own) = unified.as_deref().filter(|own| !own.is_empty()) {
                    let own = Path::new(own);
                    let above = if own.ends_with(HOST) { own.parent() } else { Some(own) };
                    places.extend(above.map(|own| (folder.join(own), Version::V2)).filter(|(f, _)| *f != folder));
                }
                places.push((folder, Version::V2));
            }
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
            hierarchies("memory", hybrid, "4:memory:/not-there\n0::/\n"),
            [("/sys/fs/cgroup/memory".into(), Version::V1), ("/sys/fs/cgroup/unified".into(), Version::V2)]
        );
        let unified = "31 29 0:28 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n";
        let above = |own: &str| hierarchies("memory", unified, &format!("0::{own}\n"))[0].0.clone();
        assert_eq!(above("/user.slice/a.scope"), Path::new("/sys/fs/cgroup/user.slice/a.scope"));
        assert_eq!(above("/user.slice/a.scope/ocb-host"), Path::new("/sys/fs/cgroup/user.slice/a.scope"));
        assert_eq!(hierarchies("memory", unified, "0::/\n"), [("/sys/fs/cgroup".into(), Version::V2)]);
        assert_eq!(hierarchies("memory", unified, "0::/ocb-host\n"), [("/sys/fs/cgroup".into(), Version::V2)]);
        assert_eq!(hierarchies("pids", hybrid, "0::/\n"), [("/sys/fs/cgroup/unified".into(), Version::V2)]);
        assert_eq!(hierarchies("memory", "nonsense\n- x\n", ""), []);
    }

    /// With whatever controller version 2 has on this machine; needs root, who may arrange groups.
    #[test]
    #[expect(clippy::disallowed_methods, reason = "a process that sits in a group; it hangs on no thread of this test")]
    fn a_delegated_group_makes_room_and_another_one_is_left_alone() {
        let unified = ["/sys/fs/cgroup/unified", "/sys/fs/cgroup"].map(Path::new);
        let root = unified.into_iter().find(|folder| folder.join("cgroup.controllers").exists() && writable(folder));
        let root = root.expect("not run: needs root and a control group hierarchy of version 2");
        let controllers = fs::read_to_string(root.join("cgroup.controllers")).unwrap();
        let controller = controllers.split_whitespace().next();
        let controller = controller.expect("not run: no controller in the control group hierarchy of version 2");
        assert!(hands_down(root, controller));
        let folder = root.join(format!("ocb-test-{}", std::process::id()));
        fs::create_dir(&folder).unwrap();
        let mut inside = std::process::Command::new("sleep").arg("60").spawn().unwrap();
        fs::write(folder.join("cgroup.procs"), inside.id().to_string()).unwrap();
        assert!(!hands_down(&folder, controller), "it is somebody else's");
        let path = CString::new(folder.as_os_str().as_bytes()).unwrap();
        // SAFETY: two live C strings and a byte.
        let marked = unsafe { libc::setxattr(path.as_ptr(), c"trusted.delegate".as_ptr(), b"1".as_ptr().cast(), 1, 0) };
        let (shown, moved) = (hands_down(&folder, controller), processes(&folder.join(HOST)));
        let below = folder.join("jail");
        let made = fs::create_dir(&below);
        let _ = inside.kill().and_then(|()| inside.wait());
        [&below, &folder.join(HOST), &folder].into_iter().for_each(|folder| remove(folder));
        assert_eq!(marked, 0, "{}", io::Error::last_os_error());
        assert!(shown && made.is_ok());
        assert_eq!(moved.unwrap(), [inside.id().to_string()]);
    }
}
