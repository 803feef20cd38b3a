//! The filter against the kernel: every system call number is tried by a process under it, and the kernel asks about
//! exactly those that the list does not have.
//!
//! No test harness: the process under the filter is forked, which needs a single thread.

#[path = "common/list.rs"]
mod list;

use std::collections::BTreeSet;
use std::os::fd::{AsRawFd, FromRawFd, OwnedFd};
use std::sync::atomic::{AtomicI64, Ordering};

use list::{List, Verdict};
use ocb_sandbox::seccomp;

/// What the supervisor answers to every question, so that the sweep can go on: an error that no call here gives itself.
const ANSWER: i32 = libc::EXDEV;
/// uretprobe and uprobe pass every filter on current kernels, and end a process that uses them by hand.
const PASS_THROUGH: [i64; 2] = [335, 336];
/// Calls that do not come back.
const NO_RETURN: [i64; 3] = [libc::SYS_rt_sigreturn, libc::SYS_exit, libc::SYS_exit_group];

/// Words that both processes see.
struct Board {
    listener: AtomicI64,
    go: AtomicI64,
    done: AtomicI64,
    results: [AtomicI64; PLACES],
}

const PLACES: usize = 8192;

fn main() {
    // SAFETY: a fresh shared mapping of zeros, which is a valid board, never unmapped.
    let board: &'static Board = unsafe {
        let flags = libc::MAP_SHARED | libc::MAP_ANONYMOUS;
        let memory =
            libc::mmap(std::ptr::null_mut(), size_of::<Board>(), libc::PROT_READ | libc::PROT_WRITE, flags, -1, 0);
        assert_ne!(memory, libc::MAP_FAILED);
        &*memory.cast::<Board>()
    };
    // SAFETY: this process has one thread.
    let child = unsafe { libc::fork() };
    if child == 0 {
        swept(board);
    }
    let list = List::read(child, false);
    let listener = listener_of(child, board);
    let mut notified = BTreeSet::new();
    board.go.store(1, Ordering::SeqCst);
    while board.done.load(Ordering::SeqCst) == 0 {
        if let Some(place) = answer_one(&listener) {
            notified.insert(place);
        }
        let mut status = 0;
        // SAFETY: looks at our own child.
        let ended = unsafe { libc::waitpid(child, &raw mut status, libc::WNOHANG) };
        assert!(ended == 0 || board.done.load(Ordering::SeqCst) != 0, "the swept process died ({status:#x})");
    }
    // SAFETY: our own child, which waits for this.
    unsafe { libc::kill(child, libc::SIGKILL) };
    let mut asked = 0;
    for (place, (nr, arguments)) in calls(child).into_iter().enumerate() {
        let result = board.results[place].load(Ordering::SeqCst);
        let expected = list.verdict(nr, &arguments);
        assert_eq!(notified.contains(&(place as u64)), expected == Verdict::Ask, "call {nr} {arguments:x?}: {result}");
        match expected {
            Verdict::Ask => assert_eq!(result, -i64::from(ANSWER), "call {nr}"),
            Verdict::Quiet(errno) => assert_eq!(result, -i64::from(errno), "call {nr}"),
            Verdict::Allow => assert_ne!(result, -i64::from(ANSWER), "call {nr}"),
        }
        asked += u32::from(expected == Verdict::Ask);
    }
    assert!(asked > 2500, "{asked}");
    println!("test every_number_is_swept ... ok ({asked} of {} calls were asked about)", calls(child).len());
}

/// Number and arguments: all zeros for everybody, and all ones for what is never made.
fn calls(own_pid: i32) -> Vec<(i64, [u64; 6])> {
    let list = List::read(own_pid, false);
    let numbers: Vec<i64> = (0..1100).chain((0x4000_0000..).take(600)).chain([9999, 0x7fff_ffff]).collect();
    let swept = |nr: &&i64| !PASS_THROUGH.contains(nr) && !NO_RETURN.contains(nr);
    let zeros = numbers.iter().filter(swept).map(|nr| (*nr, [0; 6]));
    let ones = numbers.iter().filter(swept).map(|nr| (*nr, [u64::MAX; 6]));

    let all: Vec<_> = zeros.chain(ones.filter(|(nr, args)| list.verdict(*nr, args) == Verdict::Ask)).collect();
    assert!(all.len() < PLACES);
    all
}

/// The process under the filter.
fn swept(board: &Board) -> ! {
    let own = std::process::id() as i32;
    let calls = calls(own);
    // SAFETY: integers only; required of a process without privileges.
    unsafe { libc::prctl(libc::PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) };
    let listener = seccomp::install(&seccomp::compile(own, false).unwrap()).unwrap();
    board.listener.store(i64::from(listener) + 1, Ordering::SeqCst);
    while board.go.load(Ordering::SeqCst) == 0 {
        std::hint::spin_loop();
    }
    for (place, (nr, a)) in calls.iter().enumerate() {
        // Which call the supervisor is about to be asked about.
        board.listener.store(place as i64, Ordering::SeqCst);
        // SAFETY: with zeros a call that is made finds no memory to change; with ones none is made.
        let result = unsafe { raw(*nr, a) };
        board.results[place].store(result, Ordering::SeqCst);
    }
    board.done.store(1, Ordering::SeqCst);
    loop {
        std::hint::spin_loop();
    }
}

/// The system call as the kernel answers it. libc's own wrapper would truncate the number's upper half.
///
/// # Safety
/// The call must not touch memory of this process.
unsafe fn raw(nr: i64, a: &[u64; 6]) -> i64 {
    let result;
    // SAFETY: by the caller's word.
    unsafe {
        core::arch::asm!(
            "syscall", inlateout("rax") nr => result, in("rdi") a[0], in("rsi") a[1], in("rdx") a[2], in("r10") a[3],
            in("r8") a[4], in("r9") a[5], lateout("rcx") _, lateout("r11") _, options(nostack)
        );
    }
    result
}

fn listener_of(child: i32, board: &Board) -> (OwnedFd, &'static AtomicI64) {
    let number = loop {
        match board.listener.load(Ordering::SeqCst) {
            0 => std::thread::yield_now(),
            number => break number - 1,
        }
    };
    // SAFETY: integers only; the results are checked.
    let (process, listener) = unsafe {
        let process = libc::syscall(libc::SYS_pidfd_open, child, 0);
        (process, libc::syscall(libc::SYS_pidfd_getfd, process, number, 0) as i32)
    };
    assert!(process >= 0 && listener >= 0, "{}", std::io::Error::last_os_error());
    // SAFETY: just made; the board lives for ever.
    unsafe { (OwnedFd::from_raw_fd(listener), &*std::ptr::from_ref(&board.listener)) }
}

/// Answers one question with an error and says which call it was about.
fn answer_one((listener, place): &(OwnedFd, &AtomicI64)) -> Option<u64> {
    let mut wait = libc::pollfd { fd: listener.as_raw_fd(), events: libc::POLLIN, revents: 0 };
    // SAFETY: one live record.
    if unsafe { libc::poll(&raw mut wait, 1, 10) } != 1 {
        return None;
    }
    // SAFETY: all zeros is a valid value, and the one the kernel wants.
    let mut call: libc::seccomp_notif = unsafe { std::mem::zeroed() };
    // SAFETY: a live struct of the request's type.
    if unsafe { libc::ioctl(listener.as_raw_fd(), libc::SECCOMP_IOCTL_NOTIF_RECV as _, &raw mut call) } < 0 {
        return None;
    }
    // Before the answer: after it the process is already at the next one.
    let asked = place.load(Ordering::SeqCst) as u64;
    let answer = libc::seccomp_notif_resp { id: call.id, val: 0, error: -ANSWER, flags: 0 };
    // SAFETY: as above.
    unsafe { libc::ioctl(listener.as_raw_fd(), libc::SECCOMP_IOCTL_NOTIF_SEND as _, &raw const answer) };
    Some(asked)
}
