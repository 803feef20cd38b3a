//! How long the runner has computed and how long it has waited for its CPU, as the kernel counts it.

use std::fs::File;
use std::os::unix::fs::FileExt;

use crate::clock::Clock;

/// The counters of one process with a single thread; with more threads, of all that live now.
pub(crate) struct Meter {
    pid: i32,
    first: Option<File>,
    state: Option<File>,
    threads: bool,
}

/// Both since the process began, nanoseconds. They lag up to a tick of the kernel behind while the process computes and
/// are exact while it sleeps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Usage {
    /// It computed.
    pub run_ns: f64,
    /// It could have computed, but something else had its CPU.
    pub delay_ns: f64,
}

impl Usage {
    /// From then to now.
    pub fn since(self, then: Usage) -> Usage {
        Usage { run_ns: self.run_ns - then.run_ns, delay_ns: self.delay_ns - then.delay_ns }
    }
}

impl Meter {
    pub fn of(pid: i32, threads: bool) -> Self {
        let [first, state] = ["schedstat", "stat"].map(|name| File::open(format!("/proc/{pid}/{name}")).ok());
        Meter { pid, first, state, threads }
    }

    /// Does it sleep in the kernel? Nothing where the kernel does not say.
    pub fn is_asleep(&self) -> Option<bool> {
        self.state().map(|state| state == b'S')
    }

    /// Does it compute, or would it if it had its CPU?
    pub fn is_ready(&self) -> bool {
        self.state() == Some(b'R')
    }

    fn state(&self) -> Option<u8> {
        let mut text = [0; 128];
        let len = self.state.as_ref()?.read_at(&mut text, 0).ok()?;
        // Its name is in brackets, and it chose that itself.
        let behind = text[..len].iter().rposition(|c| *c == b')')?;
        text.get(behind + 2).copied()
    }

    /// Nothing where the kernel does not count.
    pub fn read(&self) -> Option<Usage> {
        if !self.threads {
            return parse(self.first.as_ref()?);
        }
        let tasks = std::fs::read_dir(format!("/proc/{}/task", self.pid)).ok()?;
        let each = tasks.flatten().filter_map(|task| parse(&File::open(task.path().join("schedstat")).ok()?));
        Some(each.fold(Usage::default(), |all, one| Usage {
            run_ns: all.run_ns + one.run_ns,
            delay_ns: all.delay_ns + one.delay_ns,
        }))
    }
}

/// "ran waited slices", in nanoseconds and a number.
fn parse(file: &File) -> Option<Usage> {
    let mut text = [0; 64];
    let len = file.read_at(&mut text, 0).ok()?;
    let mut numbers = std::str::from_utf8(&text[..len]).ok()?.split_ascii_whitespace();
    let mut next = || numbers.next()?.parse::<u64>().ok().map(|n| n as f64);
    Some(Usage { run_ns: next()?, delay_ns: next()? })
}

/// Time that the machine under this one took from a CPU, as a share of the time since [`Steal::begin`].
pub(crate) struct Steal {
    cpu: Option<usize>,
    begun: u64,
    stolen_before: Option<u64>,
}

/// The kernel counts stolen time in hundredths of a second.
const TICK_NS: f64 = 1e7;

impl Steal {
    pub fn begin(cpu: Option<usize>) -> Self {
        Steal { cpu, begun: Clock::get().ticks(), stolen_before: stolen(cpu) }
    }

    /// Nothing where the kernel does not count.
    pub fn share(&self) -> Option<f64> {
        let clock = Clock::get();
        let passed = clock.nanoseconds(self.begun, clock.ticks());
        let stolen = stolen(self.cpu)?.saturating_sub(self.stolen_before?);
        Some(stolen as f64 * TICK_NS / passed.max(TICK_NS))
    }
}

/// The eighth number of the CPU's line; of all CPUs together when none is named.
fn stolen(cpu: Option<usize>) -> Option<u64> {
    let name = cpu.map_or_else(|| "cpu".to_owned(), |cpu| format!("cpu{cpu}"));
    let text = std::fs::read_to_string("/proc/stat").ok()?;
    let mut words = text.lines().map(str::split_ascii_whitespace).find_map(|mut line| {
        let found = line.next() == Some(&name);
        found.then_some(line)
    })?;
    words.nth(7)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_counted_and_sleep_is_not() {
        // SAFETY: asks for a number.
        let meter = Meter::of(unsafe { libc::gettid() }, false);
        let before = meter.read().unwrap();
        let begun = std::time::Instant::now();
        while begun.elapsed().as_millis() < 60 {
            std::hint::spin_loop();
        }
        let worked = meter.read().unwrap().since(before);
        // Others may have the CPU meanwhile, and then it says so; the counters lag behind by a tick at most.
        assert!(worked.run_ns + worked.delay_ns > 40e6, "{worked:?}");
        assert!(Steal::begin(None).share().is_some_and(|share| (0.0..=1e3).contains(&share)));
        assert!(Meter::of(i32::MAX, false).read().is_none());
    }
}
