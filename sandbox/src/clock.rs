//! The supervisor's clock, and what a session's null round trips say about it.

use std::sync::OnceLock;
use std::time::Duration;

use ocb_core::statistics::quantile;

use crate::protocol::MAX_BATCH;

/// A clock for the time between two moments of one thread's or two CPUs' work: the time stamp counter where the kernel
/// itself trusts it, otherwise `CLOCK_MONOTONIC_RAW`.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    nanoseconds_per_tick: f64,
    /// When it was compared with the kernel's clock, if it is the counter.
    compared: Option<Moment>,
}

/// One moment by both clocks.
#[derive(Clone, Copy, Debug)]
struct Moment {
    kernel_ns: u64,
    ticks: u64,
}

/// Readings of both clocks for one moment. Preemption between the two clocks spoils some of them, hardly ever all.
const READINGS: usize = 32;

impl Moment {
    /// Now, by the quickest reading; the kernel's clock is taken to be in its middle.
    fn now() -> Moment {
        let readings = (0..READINGS).map(|_| {
            let (before, kernel_ns, after) = (counter(), raw_ns(), counter());
            (after.wrapping_sub(before), Moment { kernel_ns, ticks: before + after.wrapping_sub(before) / 2 })
        });
        readings.min_by_key(|(took, _)| *took).expect("some readings").1
    }

    /// Nanoseconds of the kernel for each tick from one moment to a later one.
    fn scale_to(self, later: Moment) -> f64 {
        (later.kernel_ns - self.kernel_ns) as f64 / (later.ticks - self.ticks) as f64
    }
}

/// Where the kernel says which counter it keeps time by.
const CLOCKSOURCE: &str = "/sys/devices/system/clocksource/clocksource0/current_clocksource";

impl Clock {
    /// The clock of this machine; the first call takes 20 ms to compare the counter with the kernel's clock.
    pub fn get() -> Clock {
        static CLOCK: OnceLock<Clock> = OnceLock::new();
        *CLOCK.get_or_init(|| {
            let trusted = std::fs::read_to_string(CLOCKSOURCE).is_ok_and(|source| source.trim() == "tsc");
            if !trusted {
                return Clock { nanoseconds_per_tick: 1.0, compared: None };
            }
            let compared = Moment::now();
            std::thread::sleep(Duration::from_millis(20));
            Clock { nanoseconds_per_tick: compared.scale_to(Moment::now()), compared: Some(compared) }
        })
    }

    /// It reads the time stamp counter.
    pub fn is_counter(&self) -> bool {
        self.compared.is_some()
    }

    /// Relative change of its rate against the kernel's clock since it was calibrated; a few millionths are measurement error.
    pub fn drift(&self) -> f64 {
        self.compared.map_or(0.0, |then| then.scale_to(Moment::now()) / self.nanoseconds_per_tick - 1.0)
    }

    /// Now. Later memory accesses are not begun before it, earlier ones are done.
    #[inline(always)]
    pub fn ticks(&self) -> u64 {
        if self.compared.is_some() { counter() } else { raw_ns() }
    }

    /// Nanoseconds from one moment to a later one; 0 when the order is wrong.
    pub fn nanoseconds(&self, from: u64, to: u64) -> f64 {
        to.saturating_sub(from) as f64 * self.nanoseconds_per_tick
    }

    /// As many ticks as this many nanoseconds.
    pub fn in_ticks(&self, nanoseconds: f64) -> u64 {
        (nanoseconds / self.nanoseconds_per_tick) as u64
    }
}

#[inline(always)]
fn counter() -> u64 {
    let mut cpu = 0;
    // SAFETY: every x86-64 whose kernel keeps time by the counter has RDTSCP; the fences only order.
    unsafe {
        let ticks = core::arch::x86_64::__rdtscp(&raw mut cpu);
        core::arch::x86_64::_mm_lfence();
        ticks
    }
}

fn raw_ns() -> u64 {
    let mut now = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: a valid clock and a live timespec.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC_RAW, &raw mut now) };
    now.tv_sec as u64 * 1_000_000_000 + now.tv_nsec as u64
}

/// How the clock of one session behaved, before foreign code was loaded into its runner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockFacts {
    /// Which hand-off.
    pub kind: ClockKind,
    /// Median round trip of a question to the null plugin, nanoseconds; 0 where the machine was too busy to find it, so that
    /// times are longer than they should be rather than shorter.
    pub null_median_ns: f64,
    /// Its 5th percentile.
    pub null_p05_ns: f64,
    /// Its 95th percentile.
    pub null_p95_ns: f64,
    /// What each further question of a batch to the null plugin adds, nanoseconds.
    pub null_each_ns: f64,
    /// How long the calibration loop took on the runner's CPU before the plugin was loaded, nanoseconds.
    pub calibration_ns: f64,
}

/// Which hand-off a session uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClockKind {
    /// Two CPUs, each side watching shared memory.
    Spin,
    /// One CPU, each side sleeping in turn.
    Futex,
}

impl ClockKind {
    /// `spin` or `futex`.
    pub fn as_str(self) -> &'static str {
        match self {
            ClockKind::Spin => "spin",
            ClockKind::Futex => "futex",
        }
    }
}

/// Round trips of one session that say how its clock behaves.
#[derive(Debug, Default)]
pub(crate) struct Trips {
    /// Of one question to the null plugin.
    pub null: Vec<f64>,
    /// Of a batch of [`MAX_BATCH`].
    pub null_batch: Vec<f64>,
    /// Time of the calibration loop.
    pub calibration_ns: f64,
    /// Enough of the first, and of the second, to say what a question costs in which nothing is computed.
    pub known: [bool; 2],
}

/// A trip that took so many times the shortest one met something else than the clock, while nothing foreign is in the runner.
pub(crate) const STRAYED: f64 = 3.0;

impl ClockFacts {
    /// From at least one round trip of each kind.
    pub(crate) fn of(kind: ClockKind, mut trips: Trips) -> Self {
        let [null, batch] = [&mut trips.null, &mut trips.null_batch].map(|all| {
            all.sort_by(f64::total_cmp);
            &all[..]
        });
        let [null_median_ns, null_p05_ns, null_p95_ns] = match trips.known[0] {
            true => [0.5, 0.05, 0.95].map(|p| quantile(null, p)),
            false => [0.0, 0.0, STRAYED * null[0]],
        };
        let null_each_ns = match trips.known {
            [true, true] => ((quantile(batch, 0.5) - null_median_ns) / (MAX_BATCH - 1) as f64).max(0.0),
            _ => 0.0,
        };
        let calibration_ns = trips.calibration_ns;
        ClockFacts { kind, null_median_ns, null_p05_ns, null_p95_ns, null_each_ns, calibration_ns }
    }

    /// The shortest time that can be told from nothing: the spread of the null round trip, nanoseconds, at least 1.
    pub fn resolution_ns(&self) -> f64 {
        (self.null_p95_ns - self.null_p05_ns).max(1.0)
    }

    /// The plugin's part of a round trip of so many questions, and whether it is only an upper bound.
    pub(crate) fn subtract(&self, raw_ns: f64, questions: usize) -> (f64, bool) {
        let time_ns = raw_ns - self.null_median_ns - self.null_each_ns * (questions - 1) as f64;
        let resolution = self.resolution_ns();
        if time_ns < resolution { (resolution, true) } else { (time_ns, false) }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    #[test]
    fn times_below_the_spread_are_bounds_and_never_zero() {
        let trips = Trips {
            null: (200..=300).map(f64::from).collect(),
            null_batch: vec![250.0 + 63.0 * 20.0],
            calibration_ns: 10_250.0,
            known: [true; 2],
        };
        let facts = ClockFacts::of(ClockKind::Spin, trips);
        assert_eq!((facts.null_p05_ns, facts.null_median_ns, facts.null_p95_ns), (205.0, 250.0, 295.0));
        assert_eq!((facts.null_each_ns, facts.calibration_ns), (20.0, 10_250.0));
        assert_eq!(facts.subtract(260.0, 1), (90.0, true));
        assert_eq!(facts.subtract(100.0, 1), (90.0, true));
        assert_eq!(facts.subtract(1250.0, 1), (1000.0, false));
        assert_eq!(facts.subtract(1250.0, 11), (800.0, false));
    }

    #[test]
    fn where_too_little_is_known_nothing_is_subtracted() {
        let trips = Trips { null: vec![50_000.0], null_batch: vec![9e6], calibration_ns: 7e3, known: [false; 2] };
        let facts = ClockFacts::of(ClockKind::Spin, trips);
        // A question of 24 us, in which nothing but the clock took 0.4 us.
        assert_eq!(facts.subtract(24_400.0, 1), (150_000.0, true));
        assert_eq!(facts.subtract(151_000.0, 1), (151_000.0, false));
        assert_eq!(facts.subtract(1_600_000.0, 64), (1_600_000.0, false));
        // A few batches that met something say nothing against what is known of single questions.
        let trips = Trips { null: vec![400.0; 20], null_batch: vec![9e6], calibration_ns: 7e3, known: [true, false] };
        assert_eq!(ClockFacts::of(ClockKind::Spin, trips).subtract(24_400.0, 64), (24_000.0, false));
    }

    /// How many nanoseconds of the clock pass in one of the standard library's: the median of many readings, of which
    /// preemption between the two clocks spoils few.
    fn rate(clock: Clock) -> f64 {
        let readings = || (0..99).map(|_| (Instant::now(), clock.ticks())).collect::<Vec<_>>();
        let then = readings();
        std::thread::sleep(Duration::from_millis(50));
        let ratio = |((a, from), (b, to)): (&(Instant, u64), &(Instant, u64))| {
            clock.nanoseconds(*from, *to) / (*b - *a).as_nanos() as f64
        };
        let mut ratios: Vec<f64> = then.iter().zip(&readings()).map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        ratios[49]
    }

    #[test]
    fn a_second_of_the_clock_is_a_second_and_another_scale_is_seen() {
        let clock = Clock::get();
        assert!((rate(clock) - 1.0).abs() < 2e-3, "{}", rate(clock));
        assert!(clock.drift().abs() < 1e-3, "{}", clock.drift());
        for wrong in [0.5, 1.02, 2.0] {
            let other = Clock { nanoseconds_per_tick: clock.nanoseconds_per_tick * wrong, ..clock };
            assert!((rate(other) / wrong - 1.0).abs() < 2e-3, "{wrong} gives {}", rate(other));
        }
    }

    #[test]
    fn ticks_are_nanoseconds_turned_round() {
        let clock = Clock::get();
        let ticks = clock.in_ticks(1e9);
        assert!((clock.nanoseconds(7, 7 + ticks) - 1e9).abs() < 10.0, "{ticks} ticks a second");
        assert_eq!(clock.nanoseconds(8, 7), 0.0);
    }

    #[test]
    fn a_scale_that_is_wrong_is_seen() {
        let right = Clock::get();
        assert!(right.is_counter(), "not run: the kernel does not keep time by the counter");
        let wrong = Clock { nanoseconds_per_tick: right.nanoseconds_per_tick * 1.02, ..right };
        std::thread::sleep(Duration::from_millis(20));
        // 1 / 1.02 is 0.98.
        assert!((wrong.drift() + 0.02).abs() < 1e-3, "{}", wrong.drift());
    }
}
