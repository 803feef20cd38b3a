//! Other work on the machine, and fewer CPUs for what is started.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
use nix::unistd::Pid;

/// The CPUs of this thread, and of what it starts.
pub fn cpus() -> Vec<usize> {
    let set = sched_getaffinity(Pid::from_raw(0)).expect("the kernel tells");
    (0..CpuSet::count()).filter(|cpu| set.is_set(*cpu).unwrap_or(false)).collect()
}

/// Keeps this thread, and what it starts from now on, on one of its CPUs.
pub fn stay_on(cpu: usize) {
    let mut set = CpuSet::new();
    set.set(cpu).expect("a CPU's number");
    sched_setaffinity(Pid::from_raw(0), &set).expect("one of this thread's own CPUs");
}

/// A loop on every CPU, until it is dropped.
pub struct Busy {
    enough: Arc<AtomicBool>,
    loops: Vec<JoinHandle<()>>,
}

impl Busy {
    /// Begins.
    pub fn begin() -> Self {
        let enough = Arc::new(AtomicBool::new(false));
        let one = |cpu| {
            let enough = enough.clone();
            std::thread::spawn(move || {
                stay_on(cpu);
                while !enough.load(Ordering::Relaxed) {
                    std::hint::spin_loop();
                }
            })
        };
        Self { loops: cpus().into_iter().map(one).collect(), enough }
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        self.enough.store(true, Ordering::Relaxed);
        for one in self.loops.drain(..) {
            one.join().expect("a loop ends");
        }
    }
}
