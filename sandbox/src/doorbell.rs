//! Waiting for a word in shared memory to change: the primitive under both hand-offs.

use std::sync::atomic::AtomicU32;
use std::time::Duration;

/// Sleeps until the word is woken, differs from `expected`, or the time is over. Returns early at will.
pub fn futex_wait(word: &AtomicU32, expected: u32, at_most: Option<Duration>) {
    let limit = at_most.map(|d| libc::timespec { tv_sec: d.as_secs() as i64, tv_nsec: i64::from(d.subsec_nanos()) });
    let limit = limit.as_ref().map_or(std::ptr::null(), std::ptr::from_ref);
    // SAFETY: the word is live memory (a reference), the time is null or a live timespec. A shared futex, since the
    // other side is another process. The outcome does not matter: callers look at the word again.
    unsafe { libc::syscall(libc::SYS_futex, word.as_ptr(), libc::FUTEX_WAIT, expected, limit) };
}

/// Wakes the one sleeper on the word, if there is one.
pub fn futex_wake(word: &AtomicU32) {
    // SAFETY: the word is live memory; waking changes nothing in it.
    unsafe { libc::syscall(libc::SYS_futex, word.as_ptr(), libc::FUTEX_WAKE, 1) };
}
