//! `ocb-runner run`: closes the process off, then answers commands until it is killed.

use std::sync::atomic::Ordering;
use std::time::Duration;

use ocb_sandbox::inside::{Closed, Shared, Slot, close_off};
use ocb_sandbox::protocol::{Command, MAX_BATCH, SLOT_WORDS, answer, request, slot};
use ocb_sandbox::trial::TrialHead;

use crate::library::Failure;
use crate::measure::Measured;

/// Never returns: the process ends by being killed.
pub fn run(mode: &str, plugin: &str, libraries: &[&str]) -> ! {
    let closed = close_off(mode, plugin, libraries);
    let libraries = libraries.iter().map(ToString::to_string).collect();
    let state = Measured::new(plugin.to_string(), libraries, closed.tighter.clone());
    serve(&closed, state)
}

fn serve(closed: &Closed, mut state: Measured) -> ! {
    let shared = &closed.shared;
    let (mut number, mut watch) = (0, shared.watch);
    loop {
        number = shared.next(number, watch);
        let command = Command::from_word(shared.request.u64(request::COMMAND).load(Ordering::Relaxed));
        if command == Some(Command::CloseListener) {
            closed.close_listener();
        }
        let questions = shared.request.u64(request::QUESTIONS).load(Ordering::Relaxed) as usize;
        for question in 0..questions.clamp(1, MAX_BATCH) {
            let mut slot = [0; SLOT_WORDS];
            let done = match command {
                Some(command) => state.obey(command, shared, question, &mut slot),
                None => Err(Failure::error("the runner does not know this command")),
            };
            let failed = done.is_err();
            if let Err(failure) = done {
                fail(shared, &mut slot, failure);
            }
            shared.answer.store(answer::SLOT + answer::SLOT_STRIDE * question, &slot);
            // There is one text, so the first failure ends a batch.
            if failed {
                break;
            }
        }
        shared.commit(number);
        watch = if command == Some(Command::Rest) { Duration::ZERO } else { shared.watch };
    }
}

fn fail(shared: &Shared, slot: &mut Slot, failure: Failure) {
    *slot = [0; SLOT_WORDS];
    slot[slot::STATUS] = failure.status;
    shared.say(slot, failure.reason.as_bytes());
}

/// The head of the trial.
pub fn head(shared: &Shared) -> Result<TrialHead, Failure> {
    let len = shared.trial.u64(0).load(Ordering::Relaxed) as usize;
    serde_json::from_slice(&shared.trial.load_bytes(8, len))
        .map_err(|e| Failure::error(format!("the trial's head is not readable ({e})")))
}
