//! How far an algorithm will come in the time that it may take, for whoever follows the run.

use std::time::Duration;

use ocb_core::instance::OTHER_UNITS;
use ocb_core::sampling::controls;

use super::asked_in_another_unit;

/// Less of a pass says little of the rest.
const EARLIEST: Duration = Duration::from_millis(100);

/// What an algorithm costs in a whole run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Seconds, starts included.
    pub seconds: f64,
    /// The budget ends its measuring.
    pub budget_limited: bool,
}

/// What an algorithm costs that takes `query` seconds to answer and `start` seconds to begin, in a run of so many passes over so
/// many configurations.
pub fn cost(configurations: u64, passes: u32, budget: f64, counted: bool, query: f64, start: f64) -> Cost {
    let asked = configurations + controls::count(configurations);
    let timed = asked as f64 * f64::from(passes) * query;
    let budget_limited = timed > budget;
    let timed = timed.min(budget);
    let in_other_units = OTHER_UNITS.len() / 2 * asked_in_another_unit(configurations as usize);
    let further = in_other_units as f64 / configurations.max(1) as f64 + f64::from(u8::from(counted));
    let starts = passes + OTHER_UNITS.len() as u32 + u32::from(counted);
    Cost { seconds: timed + timed / f64::from(passes) * further + start * f64::from(starts), budget_limited }
}

/// One algorithm's pass so far.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// Questions answered.
    pub answered: u64,
    /// Time they took.
    pub worked: Duration,
    /// Time of the whole pass at most.
    pub allowance: Duration,
}

impl Pace {
    /// How many of so many questions will be answered in the pass; nothing while it is too early to tell.
    pub fn reach(&self, questions: u64) -> Option<u64> {
        if self.answered == 0 || self.worked < EARLIEST {
            return None;
        }
        let most = self.answered as f64 * self.allowance.as_secs_f64() / self.worked.as_secs_f64();
        Some(questions.min(self.answered.max(most.round() as u64)))
    }

    /// Questions of one whole round, while the first one is at a part of them behind `before` others. An algorithm that does
    /// not come through the part is asked no further ones.
    pub fn round(&self, before: u64, part: u64, all: u64) -> Option<u64> {
        let reach = self.reach(part)?;
        Some(if reach < part { before + reach } else { all })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A thousand questions a second, six seconds at most.
    fn after(milliseconds: u64) -> Pace {
        let (worked, allowance) = (Duration::from_millis(milliseconds), Duration::from_secs(6));
        Pace { answered: milliseconds, worked, allowance }
    }

    #[test]
    fn a_budget_that_ends_early_shows_from_the_first_report() {
        for milliseconds in (200..=6000).step_by(200) {
            assert_eq!(after(milliseconds).round(0, 200_000, 200_000), Some(6000), "after {milliseconds} ms");
        }
    }

    #[test]
    fn whoever_comes_through_a_part_is_asked_the_rest_too() {
        assert_eq!(after(200).round(500, 5000, 200_000), Some(200_000));
        assert_eq!(after(200).round(500, 7000, 200_000), Some(6500));
    }

    #[test]
    fn nothing_is_known_too_early_and_what_is_answered_stays_answered() {
        assert_eq!(after(50).reach(10), None);
        assert_eq!(Pace { answered: 0, ..after(5000) }.reach(10), None);
        assert_eq!(after(7000).reach(200_000), Some(7000));
    }
}
