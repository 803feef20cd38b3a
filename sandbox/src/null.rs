//! What the clock itself costs: round trips to the null plugin, before foreign code is in the runner. So nobody can make
//! them slow and have more subtracted than is right.

use std::time::{Duration, Instant};

use ocb_core::configuration::Configuration;
use ocb_core::pose::Pose;
use ocb_core::query::Query;

use crate::clock::{ClockFacts, STRAYED, Trips};
use crate::exchange::{Exchange, Poses};
use crate::outcome::Outcome;
use crate::policy::Policy;
use crate::protocol::{Command, MAX_BATCH};
use crate::question::Question;
use crate::speed;

/// Null round trips and null batches of a session; a tenth more before them does not count.
const THOROUGH: [usize; 2] = [1000, 50];
/// The same where orders of magnitude are enough.
const ROUGH: [usize; 2] = [20, 2];
/// On a busy machine so many that did not will do after so long.
const ENOUGH: (Duration, usize) = (Duration::from_millis(50), 100);
/// Then it is left at what there is. Fewer than so many are nothing to go by: a trip or two that met something would be
/// subtracted from everything, with no spread to tell.
const LONGEST: Duration = Duration::from_millis(500);
const FEWEST: usize = 20;

/// Asks the null plugin so often that the round trip and its spread are known.
pub(crate) fn measure(
    exchange: &mut Exchange,
    policy: &Policy,
    runner_cpu: Option<usize>,
) -> Result<ClockFacts, Outcome> {
    let nowhere = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
    let question = Question { query: Query::CollisionFirst, objects: [0, 1], configuration: nowhere };
    let mut ask = |questions, times: usize| {
        let questions: Vec<Poses> = (0..questions).map(|_| Poses::from(&question)).collect();
        let mut trip = || exchange.asked(Command::Null, &questions, policy.query_seconds);
        for _ in 0..times / 10 {
            trip()?;
        }
        let begun = Instant::now();
        straight(times, || Ok((trip()?.raw_ns, begun.elapsed())))
    };
    let [samples, batches] = if policy.rough_clock { ROUGH } else { THOROUGH };
    let null = ask(1, samples)?;
    let null_batch = ask(MAX_BATCH, batches)?;
    exchange.rest(policy.query_seconds)?;
    let calibration_ns = speed::measure(runner_cpu)?;
    let known = [enough(&null, samples), enough(&null_batch, batches)];
    Ok(ClockFacts::of(exchange.kind(), Trips { null, null_batch, calibration_ns, known }))
}

fn enough(kept: &[f64], asked: usize) -> bool {
    kept.len() >= FEWEST.min(asked)
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
        let will_do = passed > ENOUGH.0 && kept.len() >= ENOUGH.1;
        if kept.len() >= times || will_do || passed > LONGEST {
            return Ok(kept);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is kept of trips that take so long, one after the other.
    fn kept(times: usize, mut next: impl FnMut() -> f64) -> Vec<f64> {
        let mut passed = Duration::ZERO;
        let trip = || {
            let raw_ns = next();
            passed += Duration::from_nanos(raw_ns as u64);
            Ok((raw_ns, passed))
        };
        straight(times, trip).unwrap()
    }

    #[test]
    fn a_quiet_machine_gives_all_and_a_busy_one_what_it_has_time_for() {
        assert_eq!(kept(1000, || 400.0), [400.0; 1000]);
        // Every second trip meets a time slice of something else.
        let mut turn = 0;
        let busy = kept(1000, || {
            turn += 1;
            [400.0, 4e6][turn % 2]
        });
        assert!(enough(&busy, 1000) && busy.len() < 130 && busy.iter().all(|trip| *trip == 400.0), "{busy:?}");
    }

    #[test]
    fn slow_trips_are_no_clock_only_because_they_came_first() {
        let mut turn = 0;
        let one = kept(20, || {
            turn += 1;
            if turn < 20 { 5e4 } else { 400.0 }
        });
        assert_eq!(one, [400.0; 20]);
        // Something is always in the way, now and then for less long: that is nothing to subtract.
        let mut turn = 0;
        let few = kept(1000, || {
            turn += 1;
            if turn % 20 == 0 { 5e4 } else { 4e6 }
        });
        assert!(few == [5e4; 6] && !enough(&few, 1000) && !enough(&few, 20), "{few:?}");
    }
}
