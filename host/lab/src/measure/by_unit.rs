//! Time and answers by unit of length, and whether they depend on it.

use ocb_core::comparison::{Interval, compare};
use ocb_core::instance::exponent;
use ocb_core::units::{Pace, Tally, Usual};

use super::Measured;
use crate::model::{Estimated, InUnit, TimeSummary, UnitDependence};

/// Units that a run asks in.
pub const UNITS: usize = 3;
/// Their exponents: the unit of the files first.
const EXPONENTS: [i32; UNITS] = [0, -3, 3];

/// A smaller difference than this is within the spread of an empty round trip, nanoseconds.
const LEAST_NS: f64 = 500.0;

/// Of many configurations an eighth is asked in each other unit, so that a run of five rounds becomes a twentieth longer.
const SHARE: usize = 8;
/// At least so many, where there are: enough to compare two processes.
const LEAST_ASKED: usize = 60;

/// Configurations asked in each other unit where the rounds asked so many in the unit of the files.
pub fn asked_in_another_unit(own: usize) -> usize {
    own.min((own / SHARE).max(LEAST_ASKED))
}

/// Number of the unit that this process sees.
pub fn unit(process: Option<u32>) -> usize {
    EXPONENTS.iter().position(|known| *known == exponent(process)).unwrap_or(0)
}

/// What was found in one unit.
pub struct Found {
    exponent: i32,
    processes: usize,
    n: usize,
    mean_ns: Option<Estimated>,
    /// Beside the reference algorithm.
    pace: Pace,
    /// By itself.
    alone: Pace,
    /// All answers.
    tally: Tally,
    /// Those to configurations that were asked in the unit of the files as well, and the answers to these there.
    common: [Tally; 2],
}

impl Found {
    /// Slower or faster than in the unit of the files, beside the reference algorithm and by itself: another program may have
    /// slowed down one of the two, in one unit and not in the other.
    fn is_apart(&self, file: &Self) -> bool {
        let differs = self.pace.differs_from(&file.pace);
        let paces = self.alone.spread().zip(file.alone.spread());
        let differ = |(usual, (here, there)): (Estimated, (Interval, Interval))| {
            (here.value - there.value).abs() * usual.value >= LEAST_NS
        };
        differs.is_some()
            && differs == self.alone.differs_from(&file.alone)
            && file.mean_ns.zip(paces).is_some_and(differ)
    }

    /// For tables and pages.
    pub fn info(&self) -> InUnit {
        let Tally { answers, wrong, missed } = self.tally;
        InUnit {
            exponent: self.exponent,
            processes: self.processes as u32,
            n: self.n as u32,
            mean_ns: self.mean_ns,
            pace: self.pace.spread().map(Estimated::from),
            answers,
            wrong,
            missed,
        }
    }
}

/// What was found in each unit that was asked in; the official time is that of the unit of the files.
pub fn of(measured: &Measured, reference: Option<&Measured>, official: Option<&TimeSummary>) -> Vec<Found> {
    // Divided by itself every pace would be 1.
    let reference = reference.filter(|reference| reference.algorithm.info.id != measured.algorithm.info.id);
    let usual = Usual::of(&measured.times);
    let usual_of_reference = reference.map(|reference| Usual::of(&reference.times));
    let found = (0..UNITS).map(|index| {
        let times = in_unit(measured, index);
        let of_reference = reference.map(|reference| in_unit(reference, index));
        let beside = of_reference.as_ref().zip(usual_of_reference.as_ref()).map(|(times, usual)| (&times[..], usual));
        let tallies = |unit: usize| measured.tallies.iter().map(move |cell| cell[unit]);
        let common = |unit: usize| {
            let asked = tallies(index).zip(tallies(0)).zip(tallies(unit));
            asked.filter(|((here, file), _)| here.answers > 0 && file.answers > 0).map(|(_, tally)| tally)
        };
        let sum = |all: &mut dyn Iterator<Item = Tally>| all.fold(Tally::default(), Tally::plus);
        let processes: std::collections::BTreeSet<u32> = times.iter().flatten().map(|(process, _)| *process).collect();
        Found {
            exponent: EXPONENTS[index],
            processes: if index == 0 { measured.passes.len() } else { processes.len() },
            n: times.iter().filter(|times| !times.is_empty()).count(),
            mean_ns: if index == 0 { official.map(|time| time.mean_ns) } else { mean(&times) },
            pace: Pace::of(&times, &usual, beside),
            alone: Pace::of(&times, &usual, None),
            tally: sum(&mut tallies(index)),
            common: [sum(&mut common(index)), sum(&mut common(0))],
        }
    });
    found.filter(|unit| unit.tally.answers > 0).collect()
}

/// The times in one unit, by configuration.
fn in_unit(measured: &Measured, index: usize) -> Vec<Vec<(u32, f64)>> {
    if index == 0 {
        return measured.times.clone();
    }
    let here = |times: &Vec<(u32, f64)>| times.iter().filter(|(p, _)| unit(Some(*p)) == index).copied().collect();
    measured.elsewhere.iter().map(here).collect()
}

/// Every configuration was timed once, so the interval is over the configurations.
fn mean(times: &[Vec<(u32, f64)>]) -> Option<Estimated> {
    let once: Vec<Vec<(u32, f64)>> = times.iter().map(|t| t.iter().map(|(_, ns)| (0, *ns)).collect()).collect();
    compare(&once, None, 1, times.len() as u64).map(|found| found.mean_ns.into())
}

/// Present when time or answers in another unit differ from those in the unit of the files.
pub fn dependence(units: &[Found]) -> Option<UnitDependence> {
    let (file, others) = units.split_first().filter(|(file, _)| file.exponent == 0)?;
    let (mut time, mut answers, mut parts) = (Vec::new(), Vec::new(), Vec::new());
    for other in others {
        let mut said = Vec::new();
        if let Some(Interval { value, lo, hi }) = other.pace.spread().filter(|_| other.is_apart(file)) {
            time.push(other.exponent);
            said.push(format!("a query takes {} times as long ({} to {})", times(value), times(lo), times(hi)));
        }
        let [here, there] = other.common;
        if here.differs(there) {
            answers.push(other.exponent);
            let of = |Tally { answers, wrong, .. }: Tally| format!("{wrong} of {answers}");
            said.push(format!("{} answers are wrong ({} in the file's unit)", of(here), of(there)));
        }
        if !said.is_empty() {
            parts.push(format!("with all coordinates times {}, {}", factor(other.exponent), said.join(", and ")));
        }
    }
    (!parts.is_empty()).then(|| {
        let message = format!("Depends on the unit of length: {}.", parts.join("; "));
        UnitDependence { time, answers, message }
    })
}

/// A power of two as people write it.
fn factor(exponent: i32) -> String {
    let size = 2f64.powi(exponent.abs());
    if exponent < 0 { format!("1/{size}") } else { format!("{size}") }
}

fn times(x: f64) -> String {
    if x < 9.95 { format!("{x:.2}") } else { format!("{x:.0}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fifty configurations of 1 us in five processes; elsewhere so many times as long.
    fn found(exponent: i32, processes: &[(u32, f64)], tally: Tally, file: Tally) -> Found {
        let of = |all: &[(u32, f64)]| vec![all.iter().map(|(p, factor)| (*p, 1000.0 * factor)).collect(); 50];
        let usual = Usual::of(&of(&[(0, 1.0), (1, 1.0)]));
        let times: Vec<Vec<(u32, f64)>> = of(processes);
        let pace = Pace::of(&times, &usual, None);
        Found {
            exponent,
            processes: processes.len(),
            n: times.len(),
            mean_ns: mean(&times),
            alone: pace.clone(),
            pace,
            tally,
            common: [tally, file],
        }
    }

    fn tally(answers: u32, wrong: u32) -> Tally {
        Tally { answers, wrong, missed: 0 }
    }

    const SAME: [(u32, f64); 2] = [(0, 1.0), (2, 1.02)];

    fn three(small: [(u32, f64); 2], small_wrong: u32) -> Vec<Found> {
        let file = tally(250, 0);
        vec![
            found(0, &[(0, 0.99), (1, 1.0), (2, 1.01)], file, file),
            found(-3, &small, tally(50, small_wrong), file),
            found(3, &SAME, tally(50, 0), file),
        ]
    }

    #[test]
    fn a_steady_algorithm_has_no_finding() {
        assert_eq!(dependence(&three(SAME, 0)), None);
        assert_eq!(dependence(&three([(0, 2.5), (2, 1.0)], 0)), None, "one slow moment");
        assert_eq!(dependence(&three([(0, 0.6), (2, 0.6)], 0)), None, "within the spread of the clock");
        assert_eq!(dependence(&three(SAME, 1)), None, "one wrong answer may be chance");
        assert_eq!(dependence(&[]), None);
        // Four times as quick beside the reference algorithm: it was the reference's bad moment where it is as quick as ever by
        // itself, or even slower on the mean, for which one interruption is enough.
        let mut beside = three([(0, 0.25), (2, 0.25)], 0);
        for unit in &mut beside {
            unit.mean_ns = Some(Estimated { value: 28_000.0, lo: 28_000.0, hi: 28_000.0 });
        }
        assert!(dependence(&beside).is_some());
        for of_it in [[(0, 0.9), (2, 1.0)], [(0, 4.0), (2, 4.0)]] {
            beside[1].alone = three(of_it, 0).remove(1).alone;
            assert_eq!(dependence(&beside), None);
        }
        // What was asked in another unit alone has nothing to be compared with.
        assert_eq!(dependence(&three([(0, 9.0), (2, 9.0)], 9)[1..]), None);
    }

    #[test]
    fn the_finding_names_the_unit_and_what_differs_there() {
        let slow = dependence(&three([(0, 3.0), (2, 12.0)], 0)).unwrap();
        assert_eq!((slow.time, slow.answers), (vec![-3], vec![]));
        assert_eq!(
            slow.message,
            "Depends on the unit of length: with all coordinates times 1/8, a query takes 6.00 times as long (3.00 to 12)."
        );
        let both = dependence(&three([(0, 0.4), (2, 0.4)], 40)).unwrap();
        assert_eq!((both.time, both.answers), (vec![-3], vec![-3]));
        assert!(both.message.ends_with(
            "times 1/8, a query takes 0.40 times as long (0.40 to 0.40), and 40 of 50 answers are wrong (0 of 250 in \
             the file's unit)."
        ), "{}", both.message);
    }

    #[test]
    fn what_is_shown_of_a_unit() {
        let all = three([(0, 2.0), (2, 2.0)], 7);
        let InUnit { exponent, processes, n, mean_ns, pace, answers, wrong, missed } = all[1].info();
        assert_eq!((exponent, processes, n, answers, wrong, missed), (-3, 2, 50, 50, 7, 0));
        // The fixture gives a configuration both times; a run gives it one.
        assert!(mean_ns.is_some_and(|mean| (mean.value - 2000.0).abs() < 1e-6));
        assert!(pace.is_some_and(|pace| (pace.value - 2.0).abs() < 1e-9));
        assert_eq!([None, Some(0), Some(1), Some(2), Some(3), Some(4)].map(unit), [0, 1, 2, 1, 2, 0]);
    }
}
