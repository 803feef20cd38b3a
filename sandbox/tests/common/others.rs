//! Other work on the CPUs, which keeps a claim about times from being shown.

use std::time::{Duration, Instant};

use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
use nix::unistd::Pid;

/// How long each CPU is looked at.
const LOOK: Duration = Duration::from_millis(50);
/// A thread that waits for its CPU for more than this share of the time has company there.
const ALONE: f64 = 0.05;

/// The CPUs of this process, looked at before a claim is tested.
pub struct Others {
    before: bool,
}

impl Others {
    /// Looks for other work now.
    pub fn look() -> Self {
        Others { before: at_work() }
    }

    /// Asserts a claim that holds on quiet CPUs. Where it does not hold, the test ends: as not run if there is other work now or
    /// was before, otherwise as a failure.
    pub fn hold(&self, claim: bool, told: impl FnOnce() -> String) {
        if claim {
            return;
        }
        let told = told();
        if self.before || at_work() {
            eprintln!("{told}");
            panic!("not run: the machine is too busy to show it");
        }
        panic!("{told}");
    }
}

/// Has another process a part of one of the CPUs?
fn at_work() -> bool {
    let all = sched_getaffinity(Pid::from_raw(0)).unwrap();
    let cpus = (0..CpuSet::count()).filter(|cpu| all.is_set(*cpu).unwrap_or(false));
    let looks: Vec<_> = cpus.map(|cpu| std::thread::spawn(move || waited_on(cpu))).collect();
    looks.into_iter().any(|look| look.join().unwrap() > ALONE)
}

/// The share of the time for which a thread waits that could use all of a CPU.
fn waited_on(cpu: usize) -> f64 {
    let mut set = CpuSet::new();
    set.set(cpu).unwrap();
    sched_setaffinity(Pid::from_raw(0), &set).unwrap();
    let (begun, before) = (Instant::now(), waited());
    while begun.elapsed() < LOOK {
        std::hint::spin_loop();
    }
    (waited() - before).as_secs_f64() / begun.elapsed().as_secs_f64()
}

/// How long this thread could have computed but something else had its CPU, as the kernel counts it.
fn waited() -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    Duration::from_nanos(text.split_whitespace().nth(1).unwrap().parse().unwrap())
}
