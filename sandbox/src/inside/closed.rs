//! What every jailed program of ours begins with: it closes itself off, tells the supervisor, and waits for commands.

use std::os::fd::{AsFd, OwnedFd};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use seccompiler::BpfProgram;

use super::jail::{ANSWER, CONTROL, REQUEST, TRIAL, inherited};
use crate::confine::{ConfineError, close_from, harden, root};
use crate::control::{Control, Report};
use crate::doorbell::{futex_wait, futex_wake};
use crate::protocol::{SLOT_WORDS, answer, request, slot};
use crate::seccomp;
use crate::shared::Segment;

/// The usual [`Shared::watch`].
const WATCH: Duration = Duration::from_millis(2);

/// The shared memory, from the runner's side.
pub struct Shared {
    /// What the process was started for.
    pub trial: Segment,
    /// Commands.
    pub request: Segment,
    /// The slot that answers go to.
    pub answer: Segment,
    /// How long it watches memory after its last answer before it sleeps.
    pub watch: Duration,
}

/// A process that has closed itself off, with the system call filter in force.
pub struct Closed {
    /// The shared memory.
    pub shared: Shared,
    /// The filter's listener, until the supervisor has taken it.
    pub listener: i32,
    /// The tighter filters, compiled before anything foreign is in this process.
    pub tighter: Vec<BpfProgram>,
}

/// The bytes written for one command.
pub type Slot = [u64; SLOT_WORDS];

/// Closes this process off and tells the supervisor. A step that fails ends the process, and the supervisor learns which.
pub fn close_off(mode: &str, plugin: &str, libraries: &[&str]) -> Closed {
    let control = Control::from_fd(inherited(CONTROL));
    let shared = match confined(mode, plugin, libraries) {
        Ok(shared) => shared,
        Err(error) => {
            let _ = control.send(&Report::Fault { step: error.step(), reason: error.to_string() }, &[]);
            std::process::exit(120);
        }
    };
    // Everything but 0, 1, 2 and the listener, which the supervisor's first command closes.
    drop(control);
    let (listener, tighter) = match filters(mode.split(',').any(|part| part == "threads")) {
        Ok(filters) => filters,
        Err(error) => {
            // The socket is gone; the supervisor sees an early end and these words.
            eprintln!("{error}");
            std::process::exit(120);
        }
    };
    let word = shared.answer.u32(answer::LISTENER);
    word.store(listener as u32 + 1, Ordering::Release);
    futex_wake(word);
    Closed { shared, listener, tighter }
}

/// The listener of the filter, which is in force, and the tighter ones for later.
fn filters(threads: bool) -> Result<(i32, Vec<BpfProgram>), ConfineError> {
    let refused = |e: &dyn std::fmt::Display| ConfineError::Seccomp(e.to_string());
    let program = seccomp::compile(std::process::id() as i32, threads).map_err(|e| refused(&e))?;
    let tighter = seccomp::compile_tighter().map_err(|e| refused(&e))?;
    Ok((seccomp::install(&program).map_err(|e| refused(&e))?, tighter))
}

fn confined(mode: &str, plugin: &str, libraries: &[&str]) -> Result<Shared, ConfineError> {
    let has = |flag| mode.split(',').any(|part| part == flag);
    let own_root = has("jail");
    let map = |fd: OwnedFd, writable| Segment::whole(fd.as_fd(), writable).map_err(ConfineError::SharedMemory);
    let shared = Shared {
        trial: map(inherited(TRIAL), false)?,
        request: map(inherited(REQUEST), false)?,
        answer: map(inherited(ANSWER), true)?,
        watch: if has("futex") { Duration::ZERO } else { WATCH },
    };
    close_from(CONTROL as u32 + 1).map_err(ConfineError::Descriptors)?;
    // What the plugin brings is loaded with it, under the filter.
    let (optional, required): (Vec<&str>, Vec<&str>) = libraries
        .iter()
        .filter(|path| root::is_system(path))
        .partition(|path| !["libc.so.6", "libm.so.6", "libgcc_s.so.1"].iter().any(|n| path.ends_with(n)));
    harden::preload(&required, &optional)?;
    harden::reset_signals()?;
    // An ordinary user's supervisor could not look at an undumpable process; root can.
    if has("own") {
        harden::make_undumpable()?;
    }
    let sealed = harden::seal_code();
    let no_new_code = harden::refuse_new_code();
    let plugin = Path::new(plugin);
    let landlock = if own_root {
        harden::landlock(&[plugin, Path::new("/lib")])
    } else {
        let places = libraries.iter().map(Path::new);
        harden::landlock(&places.chain([plugin]).collect::<Vec<_>>())
    };
    let landlock = match landlock {
        Ok(abi) => abi,
        // An own root shows the same files. Whether that is enough for this plugin is the supervisor's to say.
        Err(_) if own_root => 0,
        Err(error) => return Err(error),
    };
    for (i, fact) in [landlock, sealed, u32::from(no_new_code)].into_iter().enumerate() {
        shared.answer.u32(answer::HARDENING + 4 * i).store(fact, Ordering::Relaxed);
    }
    Ok(shared)
}

impl Closed {
    /// Gives up the listener's descriptor, which the supervisor has by now.
    pub fn close_listener(&self) {
        // SAFETY: our own descriptor, which the supervisor's first command closes once.
        unsafe { libc::close(self.listener) };
    }
}

impl Shared {
    /// Waits for the command after `number`, so long by watching memory and then asleep.
    #[inline]
    pub fn next(&self, number: u32, watch: Duration) -> u32 {
        let word = self.request.u32(request::NUMBER);
        let mut watched_since = None;
        loop {
            for _ in 0..256 {
                let new = word.load(Ordering::Acquire);
                if new != number {
                    return new;
                }
                if watch.is_zero() {
                    break;
                }
                std::hint::spin_loop();
            }
            let since = *watched_since.get_or_insert_with(Instant::now);
            if since.elapsed() >= watch {
                // Said before the last look at the number, so that the supervisor cannot miss it.
                self.answer.u32(answer::RUNNER_SLEEPS).store(1, Ordering::SeqCst);
                futex_wait(word, number, None);
                self.answer.u32(answer::RUNNER_SLEEPS).store(0, Ordering::SeqCst);
                watched_since = None;
            }
        }
    }

    /// Publishes the answers to command `number`.
    #[inline]
    pub fn commit(&self, number: u32) {
        let word = self.answer.u32(answer::NUMBER);
        word.swap(number, Ordering::SeqCst);
        if self.request.u32(request::SUPERVISOR_SLEEPS).load(Ordering::SeqCst) != 0 {
            futex_wake(word);
        }
    }

    /// Puts text beside the slot, cut to what fits.
    pub fn say(&self, slot: &mut Slot, text: &[u8]) {
        let text = &text[..text.len().min(answer::TEXT_BYTES)];
        self.answer.store_bytes(answer::TEXT, text);
        slot[slot::TEXT_LEN] = text.len() as u64;
    }

    /// The poses of one question of the current command.
    #[inline]
    pub fn poses(&self, question: usize) -> [f64; 32] {
        let mut words = [0; 32];
        self.request.load(request::POSES + request::POSES_STRIDE * question, &mut words);
        words.map(f64::from_bits)
    }

    /// The numbers of the object that stands first in a question and of the one that stands second.
    #[inline]
    pub fn objects(&self, question: usize) -> [usize; 2] {
        let word = self.request.u64(request::OBJECTS + 8 * question).load(Ordering::Relaxed);
        [word as u32 as usize, (word >> 32) as usize]
    }

    /// Of the object that is to be built: vertices, triangles, and where both begin in the trial file.
    pub fn mesh(&self) -> [u64; 4] {
        let mut words = [0; 4];
        self.request.load(request::MESH, &mut words);
        words
    }

    /// Address of a byte of the trial file.
    pub fn trial_address(&self, offset: usize) -> *const u8 {
        self.trial.address(offset)
    }
}
