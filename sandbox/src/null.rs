//! What the clock itself costs: round trips to the null plugin, before foreign code is in the runner. So nobody can make
//! them slow and have more subtracted than is right.

use std::time::{Duration, Instant};

use ocb_core::configuration::Configuration;
use ocb_core::instance::Presented;
use ocb_core::pose::Pose;

use crate::clock::{ClockFacts, Trips};
use crate::exchange::Exchange;
use crate::outcome::{Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::{Command, MAX_BATCH};

/// Null round trips, null batches and calibration loops of a session; a tenth more before them does not count.
const THOROUGH: [usize; 3] = [1000, 50, 50];
/// The same where orders of magnitude are enough.
const ROUGH: [usize; 3] = [20, 2, 2];
/// A trip that took so many times the shortest one met something else than the clock: nothing foreign is in the runner.
const STRAYED: f64 = 3.0;
/// So many that did not will do on a busy machine after so long, later fewer. With fewer still nothing is known: a trip or
/// two that met something would be subtracted from everything, with no spread to tell.
const ENOUGH: [(Duration, usize); 2] = [(Duration::from_millis(50), 100), (Duration::from_millis(500), 20)];
/// A machine that has not given as many by then cannot be measured on.
const HOPELESS: Duration = Duration::from_secs(10);

/// Asks the null plugin so often that the round trip and its spread are known.
pub(crate) fn measure(exchange: &mut Exchange, policy: &Policy) -> Result<ClockFacts, Outcome> {
    let nowhere = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
    let question = Presented { configuration: nowhere, swapped: false };
    let mut ask = |command, questions, times: usize| {
        let questions = vec![question; questions];
        let mut trip = || {
            // As before any question: the runner has to fetch the new poses from the supervisor's CPU.
            exchange.place(&questions);
            exchange.obeyed(command, Phase::Query, policy.query_seconds)
        };
        for _ in 0..times / 10 {
            trip()?;
        }
        let begun = Instant::now();
        straight(times, || Ok((trip()?.raw_ns, begun.elapsed())))
    };
    let [samples, batches, calibrations] = if policy.rough_clock { ROUGH } else { THOROUGH };
    let trips = Trips {
        null: ask(Command::Null, 1, samples)?,
        null_batch: ask(Command::Null, MAX_BATCH, batches)?,
        calibration: ask(Command::Calibrate, 1, calibrations)?,
    };
    exchange.ask_for(1);
    Ok(ClockFacts::of(exchange.kind(), trips))
}

/// So many round trips that met nothing, or as many as a busy machine has time for. What it does to the others is left out,
/// for it would hide every short time of the session behind the spread. A trip gives its nanoseconds and the time since the
/// first one began.
fn straight(times: usize, mut trip: impl FnMut() -> Result<(f64, Duration), Outcome>) -> Result<Vec<f64>, Outcome> {
    let (mut kept, mut shortest) = (Vec::new(), f64::INFINITY);
    loop {
        let (raw_ns, passed) = trip()?;
        if raw_ns < shortest {
            shortest = raw_ns;
            kept.retain(|known| *known <= STRAYED * shortest);
        }
        if raw_ns <= STRAYED * shortest {
            kept.push(raw_ns);
        }
        let will_do = |(after, least): &(Duration, usize)| passed > *after && kept.len() >= *least.min(&times);
        if kept.len() >= times || ENOUGH.iter().any(will_do) {
            return Ok(kept);
        }
        if passed > HOPELESS {
            return Err(Outcome::fault(
                "Clock",
                "this machine is too busy to measure: in ten seconds no twenty questions in which nothing is computed took \
                 about as long as the shortest; end what else is at work",
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is kept of trips that take so long, one after the other.
    fn kept(times: usize, mut next: impl FnMut(Duration) -> f64) -> Result<Vec<f64>, Outcome> {
        let mut passed = Duration::ZERO;
        straight(times, || {
            let raw_ns = next(passed);
            passed += Duration::from_nanos(raw_ns as u64);
            Ok((raw_ns, passed))
        })
    }

    #[test]
    fn a_quiet_machine_gives_all_and_a_busy_one_what_it_has_time_for() {
        assert_eq!(kept(1000, |_| 400.0).unwrap(), [400.0; 1000]);
        // Every second trip meets a time slice of something else.
        let mut turn = 0;
        let busy = kept(1000, |_| {
            turn += 1;
            [400.0, 4e6][turn % 2]
        });
        let busy = busy.unwrap();
        assert!(busy.len() >= 20 && busy.len() < 130 && busy.iter().all(|trip| *trip == 400.0), "{busy:?}");
    }

    #[test]
    fn slow_trips_are_no_clock_only_because_they_came_first() {
        // For a second something is always in the way, now and then for less long.
        let mut turn = 0;
        let late = kept(20, |passed| {
            turn += 1;
            if passed > Duration::from_secs(1) {
                400.0
            } else if turn % 20 == 0 {
                5e4
            } else {
                4e6
            }
        });
        assert_eq!(late.unwrap(), [400.0; 20]);
        // Nineteen of them, then one that met nothing.
        let mut turn = 0;
        let one = kept(20, |_| {
            turn += 1;
            if turn < 20 { 5e4 } else { 400.0 }
        });
        assert_eq!(one.unwrap(), [400.0; 20]);
    }

    #[test]
    fn a_machine_without_twenty_straight_trips_is_a_fault() {
        let mut turn = 0;
        let hopeless = kept(1000, |_| {
            turn += 1;
            if turn == 7 { 400.0 } else { 4e6 }
        });
        let Err(Outcome::SandboxFault { step, reason }) = hopeless else { panic!("{hopeless:?}") };
        assert!(step == "Clock" && reason.contains("too busy"), "{step}: {reason}");
    }
}
