//! The main function of a program of ours whose work calls libraries of others: bytes in, progress, bytes out. The supervisor's
//! side: [`crate::work`].

use std::sync::atomic::Ordering;

use super::closed::{Closed, Shared, close_off};
use crate::doorbell::futex_wait;
use crate::protocol::{Command, SLOT_WORDS, answer, request, work};
use crate::seccomp;

/// What the work may say before it ends.
pub struct Desk<'a>(&'a Shared);

/// Does the work in a jail, or refuses to be started by hand. `work` gets the supervisor's bytes, and whether it may start
/// threads.
pub fn main(work: impl FnOnce(&[u8], bool, &Desk<'_>) -> Vec<u8>) -> ! {
    let arguments: Vec<String> = std::env::args().collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        [_, "launch"] => super::launch(),
        [_, "run", mode, nothing, libraries @ ..] => {
            let closed = close_off(mode, nothing, libraries);
            begin(&closed);
            let shared = &closed.shared;
            let len = shared.trial.u64(0).load(Ordering::Relaxed) as usize;
            let threads = mode.split(',').any(|part| part == "threads");
            finish(shared, &work(&shared.trial.load_bytes(8, len), threads, &Desk(shared)))
        }
        _ => {
            eprintln!("OpenCollBench starts {} in a jail; it cannot be used by hand.", super::program());
            std::process::exit(2);
        }
    }
}

/// Obeys until the tighter filters are in force: from then on foreign code may run.
fn begin(closed: &Closed) {
    let shared = &closed.shared;
    let mut number = 0;
    loop {
        number = shared.next(number, shared.watch);
        let command = Command::from_word(shared.request.u64(request::COMMAND).load(Ordering::Relaxed));
        match command {
            Some(Command::CloseListener) => closed.close_listener(),
            Some(Command::Tighten) => seccomp::tighten(&closed.tighter).expect("the tighter filter is accepted"),
            _ => {}
        }
        shared.answer.store(answer::SLOT, &[0; SLOT_WORDS]);
        shared.commit(number);
        if command == Some(Command::Tighten) {
            return;
        }
    }
}

/// Hands the result over and waits to be killed.
fn finish(shared: &Shared, result: &[u8]) -> ! {
    assert!(result.len() <= shared.answer.len() - work::RESULT, "the result has {} bytes, too many", result.len());
    shared.answer.store_bytes(work::RESULT, result);
    shared.answer.u64(work::DONE).store(result.len() as u64 + 1, Ordering::Release);
    loop {
        let word = shared.request.u32(request::NUMBER);
        futex_wait(word, word.load(Ordering::Relaxed), None);
    }
}

impl Desk<'_> {
    /// `done` of `total` parts of a step are done. It costs next to nothing.
    pub fn progress(&self, step: u8, done: u64, total: u64) {
        self.0.answer.u64(work::PROGRESS).store(work::progress(step, done, total), Ordering::Relaxed);
    }

    /// Waits until the supervisor lets times be taken.
    pub fn ask_to_measure(&self) {
        let (granted, asks) = (self.0.request.u32(work::GRANTED), self.0.answer.u32(work::ASKS));
        asks.store(1, Ordering::Release);
        while granted.load(Ordering::Acquire) == 0 {
            futex_wait(granted, 0, None);
        }
    }
}
