//! The limits of a runner and where it runs.

use crate::layers::Profile;

/// The limits of one runner. What happens inside when each is reached stands in `sandbox/README.md`.
#[derive(Clone, Debug, PartialEq)]
pub struct Policy {
    /// Memory of the jail, bytes.
    pub memory_bytes: u64,
    /// Time to load the file and describe what is in it, seconds.
    pub load_seconds: f64,
    /// Time to build the structure of one object, seconds.
    pub build_seconds: f64,
    /// Time to answer one query, seconds.
    pub query_seconds: f64,
    /// Time of the whole trial, seconds; the limit of processor time follows it.
    pub trial_seconds: f64,
    /// Bytes that the plugin may write to its standard output and error.
    pub output_bytes: u64,
    /// CPUs that the plugin may use at once, with threads of its own when there are several. 1 is the single-threaded
    /// track, where it can start none.
    pub threads: usize,
    /// CPU that the runner is kept on, with others beside it when it has threads; the scheduler's choice when absent.
    pub runner_cpu: Option<usize>,
    /// CPU that the supervising thread is kept on while a session lasts; the scheduler's choice when absent.
    pub supervisor_cpu: Option<usize>,
    /// Which hand-off times the queries.
    pub clock: ClockChoice,
    /// Times are compared by orders of magnitude only, or nobody reads them: a session begins with few null round trips, and a
    /// watching supervisor soon sleeps, which leaves its CPU to others and adds the time of being woken.
    pub rough_clock: bool,
    /// The plugin was built from our own sources: it may run even where this machine forbids namespaces, under the
    /// layers that remain ([`crate::Session::layers`] lists them). Never set it for a file that somebody brought.
    pub trusted: bool,
    /// SHA-256 (hex) that the plugin file must have when it is opened; any when absent.
    pub plugin_sha256: Option<String>,
    /// How much a foreign plugin needs of this machine.
    pub profile: Profile,
}

/// Which hand-off times the queries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClockChoice {
    /// `Spin` where two CPUs can be had, else `Futex`.
    #[default]
    Auto,
    /// Both sides watch shared memory, each on a CPU of its own: about 0.3 us per round trip.
    Spin,
    /// Both sides sleep in turn on one CPU: about 3 us per round trip.
    Futex,
}

/// A plugin with several CPUs may start so many threads in any case: libraries have some beside those that work.
const LEAST_THREADS: usize = 16;

impl Policy {
    /// How many threads the plugin may start beside the one that calls it.
    pub fn startable_threads(&self) -> usize {
        if self.threads > 1 { self.threads.max(LEAST_THREADS) } else { 0 }
    }
}

impl Default for Policy {
    fn default() -> Self {
        Policy {
            memory_bytes: 2 << 30,
            load_seconds: 10.0,
            build_seconds: 120.0,
            query_seconds: 10.0,
            trial_seconds: 3600.0,
            output_bytes: 64 << 10,
            threads: 1,
            runner_cpu: None,
            supervisor_cpu: None,
            clock: ClockChoice::Auto,
            rough_clock: false,
            trusted: false,
            plugin_sha256: None,
            profile: Profile::Production,
        }
    }
}
