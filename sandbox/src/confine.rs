//! The child side of the jail: one step per function, one error each. `runner/jail.rs` calls them in order.
//!
//! [`root`] builds the file system, this file takes rights away, [`harden`] closes the runner's own process.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::{AsRawFd, BorrowedFd, OwnedFd, RawFd};

use crate::memory::ITSELF;

pub mod harden;
pub mod root;

/// A step that failed. The variant's name is the step's name in the outcome.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each variant is named for its step, and the text tells the rest")]
pub enum ConfineError {
    #[error("the parent-death signal cannot be set: {0}")]
    ParentDeath(io::Error),
    #[error("the memory group cannot be entered: {0}")]
    MemoryGroup(io::Error),
    #[error("{0}")]
    Namespaces(io::Error),
    #[error("user and group ids cannot be mapped: {0}")]
    IdMaps(io::Error),
    #[error("supplementary groups cannot be dropped: {0}")]
    Groups(io::Error),
    #[error("the ids inside the jail cannot be taken: {0}")]
    Ids(io::Error),
    #[error("mounts cannot be made private: {0}")]
    PrivateMounts(io::Error),
    #[error("the empty root cannot be built: {0}")]
    EmptyRoot(io::Error),
    #[error("system library {0} cannot be put into the jail: {1}")]
    Library(String, io::Error),
    #[error("the plugin file cannot be copied into the jail: {0}")]
    PluginCopy(io::Error),
    #[error("the new root cannot be entered: {0}")]
    EnterRoot(io::Error),
    #[error("the new root cannot be made read-only: {0}")]
    ReadOnlyRoot(io::Error),
    #[error("the host name cannot be set: {0}")]
    HostName(io::Error),
    #[error("limit {0} cannot be set: {1}")]
    Limit(&'static str, io::Error),
    #[error("the CPU cannot be chosen: {0}")]
    Cpu(io::Error),
    #[error("the standard descriptors cannot be set: {0}")]
    Descriptors(io::Error),
    #[error("capabilities cannot be dropped: {0}")]
    Capabilities(io::Error),
    #[error("no_new_privs cannot be set: {0}")]
    NoNewPrivileges(io::Error),
    #[error("the shared memory cannot be mapped: {0}")]
    SharedMemory(io::Error),
    #[error("system library {0} cannot be loaded before the plugin: {1}")]
    Preload(String, String),
    #[error("signals cannot be reset: {0}")]
    Signals(io::Error),
    #[error("the process cannot be made undumpable: {0}")]
    Undumpable(io::Error),
    #[error("{0}")]
    Landlock(String),
    #[error("the system call filter cannot be put in force: {0}")]
    Seccomp(String),
}

impl ConfineError {
    /// Name of the step.
    pub fn step(&self) -> String {
        let debug = format!("{self:?}");
        debug.split('(').next().unwrap_or_default().to_string()
    }
}

/// What the kernel said about the last call.
pub(crate) fn checked(result: libc::c_int) -> io::Result<()> {
    if result < 0 { Err(io::Error::last_os_error()) } else { Ok(()) }
}

/// Dies when the parent does. The kernel clears this on a change of ids, so it is set again after each.
pub fn die_with_parent() -> Result<(), ConfineError> {
    // SAFETY: takes integers only.
    checked(unsafe { libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL, 0, 0, 0) }).map_err(ConfineError::ParentDeath)
}

/// Moves this process, which has one thread, into the memory group whose entrance this is.
pub fn enter_group(entrance: OwnedFd) -> Result<(), ConfineError> {
    File::from(entrance).write_all(ITSELF).map_err(ConfineError::MemoryGroup)
}

/// Supplementary groups survive the entry into a user namespace until they are dropped.
pub fn drop_groups() -> Result<(), ConfineError> {
    // SAFETY: an empty list needs no pointer.
    checked(unsafe { libc::setgroups(0, std::ptr::null()) }).map_err(ConfineError::Groups)
}

/// Takes a user and group id inside the namespace. Raw calls: glibc's wrappers are for threads, of which there are none.
pub fn take_ids(id: u32) -> Result<(), ConfineError> {
    // SAFETY: take integers only.
    checked(unsafe { libc::syscall(libc::SYS_setresgid, id, id, id) } as i32).map_err(ConfineError::Ids)?;
    // SAFETY: as above.
    checked(unsafe { libc::syscall(libc::SYS_setresuid, id, id, id) } as i32).map_err(ConfineError::Ids)
}

/// A name that says nothing.
pub fn hide_host_name() -> Result<(), ConfineError> {
    nix::unistd::sethostname("sandbox").map_err(|e| ConfineError::HostName(e.into()))
}

/// An empty session keyring. Kernels without keyrings have nothing to hide.
pub fn forget_keys() {
    const JOIN_SESSION_KEYRING: i32 = 1;
    // SAFETY: a null name asks for a new anonymous keyring.
    unsafe { libc::syscall(libc::SYS_keyctl, JOIN_SESSION_KEYRING, 0) };
}

/// Resource limits, soft and hard alike. `address_space` in bytes, `cpu` in seconds, `tasks` all processes and threads
/// of this user in this user namespace; absent where there is no such namespace, and they would be the user's own.
pub fn set_limits(address_space: u64, cpu: u64, tasks: Option<u64>) -> Result<(), ConfineError> {
    let tasks = tasks.map(|tasks| ("processes and threads", libc::RLIMIT_NPROC, tasks));
    let limits = [
        ("core", libc::RLIMIT_CORE, 0),
        ("address space", libc::RLIMIT_AS, address_space),
        ("processor time", libc::RLIMIT_CPU, cpu),
        ("open files", libc::RLIMIT_NOFILE, 32),
        ("file size", libc::RLIMIT_FSIZE, 0),
        ("stack", libc::RLIMIT_STACK, 8 << 20),
        ("locked memory", libc::RLIMIT_MEMLOCK, 0),
        ("message queues", libc::RLIMIT_MSGQUEUE, 0),
        ("pending signals", libc::RLIMIT_SIGPENDING, 64),
    ];
    for (name, resource, value) in limits.into_iter().chain(tasks) {
        let limit = libc::rlimit { rlim_cur: value, rlim_max: value };
        // SAFETY: a live struct that the call reads.
        checked(unsafe { libc::setrlimit(resource, &raw const limit) }).map_err(|e| ConfineError::Limit(name, e))?;
    }
    Ok(())
}

/// Stays on these CPUs; the filter forbids the plugin to change that.
pub fn stay_on_cpus(cpus: &[usize]) -> Result<(), ConfineError> {
    pin(cpus).map(drop).map_err(ConfineError::Cpu)
}

/// Keeps the calling thread on the given CPUs; returns where it might run before.
pub(crate) fn pin(cpus: &[usize]) -> io::Result<Vec<usize>> {
    use nix::sched::{CpuSet, sched_setaffinity};
    let before = own_cpus()?;
    let mut set = CpuSet::new();
    for cpu in cpus {
        set.set(*cpu)?;
    }
    sched_setaffinity(nix::unistd::Pid::from_raw(0), &set)?;
    Ok(before)
}

/// Keeps every thread of a process on the given CPUs. One that ends meanwhile is no loss, so nothing here can fail.
pub(crate) fn pin_process(pid: i32, cpus: &[usize]) {
    use nix::sched::{CpuSet, sched_setaffinity};
    let mut set = CpuSet::new();
    for cpu in cpus {
        let _ = set.set(*cpu);
    }
    let tasks = std::fs::read_dir(format!("/proc/{pid}/task")).into_iter().flatten().flatten();
    for task in tasks.filter_map(|task| task.file_name().to_str()?.parse().ok()) {
        let _ = sched_setaffinity(nix::unistd::Pid::from_raw(task), &set);
    }
}

/// Where the calling thread may run.
pub(crate) fn own_cpus() -> io::Result<Vec<usize>> {
    use nix::sched::{CpuSet, sched_getaffinity};
    let all = sched_getaffinity(nix::unistd::Pid::from_raw(0))?;
    Ok((0..CpuSet::count()).filter(|cpu| all.is_set(*cpu).unwrap_or(false)).collect())
}

/// Makes standard input an empty pipe and standard output the same pipe as standard error, puts `kept` at 3, 4, ... and
/// closes everything else.
pub fn arrange_descriptors(kept: &[BorrowedFd<'_>]) -> Result<(), ConfineError> {
    let arrange = || -> io::Result<()> {
        const SAFE: RawFd = 100;
        let (empty, writer) = nix::unistd::pipe()?;
        drop(writer);
        // First out of the way of the low numbers, then down to their places.
        let lifted = |fd: BorrowedFd<'_>| -> io::Result<RawFd> {
            // SAFETY: duplicates a borrowed descriptor; the copies are closed with everything else below.
            let fd = unsafe { libc::fcntl(fd.as_raw_fd(), libc::F_DUPFD, SAFE) };
            checked(fd).map(|()| fd)
        };
        use std::os::fd::AsFd;
        let sources =
            std::iter::once(empty.as_fd()).chain(kept.iter().copied()).map(lifted).collect::<io::Result<Vec<_>>>()?;
        let places = std::iter::once(0).chain(3..);
        for (from, to) in sources.iter().zip(places) {
            // SAFETY: descriptors of this single-threaded process, whose owners are about to lose them by design.
            checked(unsafe { libc::dup2(*from, to) })?;
        }
        // SAFETY: as above.
        checked(unsafe { libc::dup2(2, 1) })?;
        // Whoever owned the rest never runs again: the process is about to exec or to wait.
        std::mem::forget(empty);
        close_from(3 + kept.len() as u32)
    };
    arrange().map_err(ConfineError::Descriptors)
}

/// Closes every descriptor from `first` on.
pub fn close_from(first: u32) -> io::Result<()> {
    // SAFETY: integers only; single-threaded callers that use none of these descriptors afterwards.
    checked(unsafe { libc::syscall(libc::SYS_close_range, first, u32::MAX, 0) } as i32)
}

/// Empties the bounding set, so that no exec can bring a capability back. Without the right to do so there is none to
/// lose, which the supervisor verifies.
pub fn drop_capabilities() -> Result<(), ConfineError> {
    for capability in 0..64 {
        // SAFETY: integers only.
        if unsafe { libc::prctl(libc::PR_CAPBSET_DROP, capability, 0, 0, 0) } < 0 {
            let error = io::Error::last_os_error();
            match error.raw_os_error() {
                // Past the kernel's last capability.
                Some(libc::EINVAL) => break,
                Some(libc::EPERM) => return Ok(()),
                _ => return Err(ConfineError::Capabilities(error)),
            }
        }
    }
    // SAFETY: integers only.
    checked(unsafe { libc::prctl(libc::PR_CAP_AMBIENT, libc::PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0) })
        .map_err(ConfineError::Capabilities)
}

/// Gives up every capability held now; for processes that stay and do not exec.
pub fn clear_capabilities() -> Result<(), ConfineError> {
    const VERSION_3: u32 = 0x2008_0522;
    let header = [VERSION_3, 0];
    let nothing = [0u32; 6];
    // SAFETY: both arrays have the kernel's layout for version 3 and outlive the call.
    checked(unsafe { libc::syscall(libc::SYS_capset, header.as_ptr(), nothing.as_ptr()) } as i32)
        .map_err(ConfineError::Capabilities)
}

/// No exec gives rights any more; also what an unprivileged seccomp filter requires.
pub fn no_new_privileges() -> Result<(), ConfineError> {
    // SAFETY: integers only.
    checked(unsafe { libc::prctl(libc::PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) }).map_err(ConfineError::NoNewPrivileges)
}

/// A descriptor of a process.
pub fn process_descriptor(pid: i32) -> io::Result<OwnedFd> {
    use std::os::fd::FromRawFd;
    // SAFETY: integers only; the result is checked.
    let fd = unsafe { libc::syscall(libc::SYS_pidfd_open, pid, 0) } as i32;
    checked(fd)?;
    // SAFETY: just made, owned by nobody else.
    Ok(unsafe { OwnedFd::from_raw_fd(fd) })
}
