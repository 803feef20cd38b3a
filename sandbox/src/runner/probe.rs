//! `ocb-runner probe`: asks the kernel for each facility that a jail wants, in a process of its own that may lose what it
//! tries out. One line of JSON each; `ocb_sandbox::doctor` makes sense of them.

use std::io;

use ocb_sandbox::doctor::Probe;

/// Prints what was found.
pub fn probe() {
    let answers: Vec<Probe> = QUESTIONS.iter().map(|(name, ask)| Probe::of(name, ask())).collect();
    println!("{}", serde_json::to_string(&answers).expect("plain data is always JSON"));
}

/// Number or error of the kernel.
type Answer = io::Result<i64>;
/// A name, and how it is asked.
type Question = (&'static str, fn() -> Answer);

/// The last one takes the process into new namespaces, so it comes last.
const QUESTIONS: [Question; 7] = [
    ("notify", || {
        let mut sizes = [0u16; 3];
        // SAFETY: asks for sizes, which are written into a live array.
        call(unsafe { libc::syscall(libc::SYS_seccomp, SECCOMP_GET_NOTIF_SIZES, 0, sizes.as_mut_ptr()) })
    }),
    ("landlock", || {
        const VERSION: u32 = 1;
        // SAFETY: with this flag the call takes no attributes and returns its ABI.
        call(unsafe { libc::syscall(libc::SYS_landlock_create_ruleset, std::ptr::null::<u8>(), 0, VERSION) })
    }),
    ("process descriptors", || {
        // SAFETY: integers only; the descriptor closes with the process.
        let own = call(unsafe { libc::syscall(libc::SYS_pidfd_open, libc::getpid(), 0) })?;
        // SAFETY: as above.
        call(unsafe { libc::syscall(libc::SYS_pidfd_getfd, own, 2, 0) })
    }),
    ("sealed memory", || {
        let file = ocb_sandbox::shared::memory_file(c"probe", 4096)?;
        let seals = libc::F_SEAL_SHRINK | libc::F_SEAL_GROW | libc::F_SEAL_SEAL | libc::F_SEAL_FUTURE_WRITE;
        ocb_sandbox::shared::seal(std::os::fd::AsFd::as_fd(&file), seals).map(|()| 0)
    }),
    ("mseal", || {
        // SAFETY: an empty range.
        call(unsafe { libc::syscall(libc::SYS_mseal, 0, 0, 0) })
    }),
    ("mdwe", || {
        const PR_GET_MDWE: i32 = 66;
        // SAFETY: integers only.
        call(i64::from(unsafe { libc::prctl(PR_GET_MDWE, 0, 0, 0, 0) }))
    }),
    ("namespaces", || {
        let flags = libc::CLONE_NEWUSER
            | libc::CLONE_NEWPID
            | libc::CLONE_NEWNET
            | libc::CLONE_NEWNS
            | libc::CLONE_NEWIPC
            | libc::CLONE_NEWUTS
            | libc::CLONE_NEWCGROUP;
        // SAFETY: integers only; this process does nothing after it but print.
        call(i64::from(unsafe { libc::unshare(flags) }))?;
        // AppArmor may allow the namespace and forbid everything in it.
        ocb_sandbox::confine::root::private_mounts().map(|()| 0).map_err(io::Error::other)
    }),
];

const SECCOMP_GET_NOTIF_SIZES: u32 = 3;

fn call(result: i64) -> Answer {
    if result < 0 { Err(io::Error::last_os_error()) } else { Ok(result) }
}
