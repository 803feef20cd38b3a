//! Taking out a machine whose times drift: once an hour each machine measures the sentinel, and what that takes is compared with what
//! it took on the machines of its hardware class in the last week.

use std::time::Duration;

use ocb_core::statistics::select_quantile;

use super::orders::ordered;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{MachineFacts, OrderedAlgorithm, Sentinel};
use crate::plugins::registry::Registry;
use crate::store::{Store, now_us};
use crate::{EngineError, Result};

/// The sentinel asks this algorithm; without it there is none. (Brute force would take minutes.)
const ALGORITHM: &str = "box-tree";
/// A machine measures the sentinel so often.
const EVERY: Duration = Duration::from_secs(3600);
/// So many readings in a row that are off take a machine out: one may be chance.
const IN_A_ROW: usize = 3;
/// Fewer others say nothing about a machine.
const LEAST: usize = 3;
/// Readings are kept for so long.
const KEPT: Duration = Duration::from_secs(7 * 24 * 3600);

/// A reading of the sentinel.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Its machine.
    pub machine: String,
    /// When.
    pub at_us: i64,
    /// Nanoseconds of the median query.
    pub median_ns: f64,
    /// It was off when it came: a machine that is measured more often because it is off does not become the usual one.
    pub off: bool,
}

/// What the sentinel usually takes on the class of a machine, its own last readings left out; nothing while there are few.
fn usual(readings: &[Reading], machine: &str) -> Option<f64> {
    let own: Vec<&Reading> = last(readings, machine).collect();
    let others = readings.iter().filter(|it| !it.off && !own.contains(it));
    let mut others: Vec<f64> = others.map(|it| it.median_ns).collect();
    (others.len() >= LEAST).then(|| select_quantile(&mut others, 0.5))
}

fn last<'r>(readings: &'r [Reading], machine: &str) -> impl Iterator<Item = &'r Reading> {
    readings.iter().filter(move |it| it.machine == machine).take(IN_A_ROW)
}

/// The last readings of a machine divided by what is usual, the newest first, as far back as they are off by more than `most`.
fn off(readings: &[Reading], machine: &str, most: f64) -> Vec<f64> {
    let Some(usual) = usual(readings, machine) else { return Vec::new() };
    last(readings, machine).map(|it| it.median_ns / usual).take_while(|ratio| (ratio - 1.0).abs() > most).collect()
}

impl Engine {
    /// Takes what the sentinel took on a machine.
    ///
    /// # Errors
    /// `Invalid` for a time that is none.
    #[boxed]
    pub async fn sentinel_of(&self, machine: &str, sentinel: Sentinel) -> Result<()> {
        let store = &self.inner.store;
        let trouble = match sentinel {
            Sentinel::Failed { message } => Some(format!("The sentinel could not be measured. {message}")),
            Sentinel::Measured { median_ns } if !(median_ns.is_finite() && median_ns > 0.0) => {
                return Err(EngineError::Invalid("A sentinel takes a positive number of nanoseconds.".into()));
            }
            Sentinel::Measured { median_ns } => {
                let machines = store.machines().await?;
                let facts = machines.iter().find(|it| it.name == machine).and_then(|it| it.facts.as_ref());
                let class = facts.map_or_else(|| self.inner.classes.usual(), |facts| facts.hardware_class.clone());
                let reading = Reading { machine: machine.to_owned(), at_us: now_us(), median_ns, off: false };
                let mut readings = store.readings(&class).await?;
                readings.insert(0, reading.clone());
                let off = off(&readings, machine, self.inner.config.most_drift);
                store.keep_reading(&class, &Reading { off: !off.is_empty(), ..reading }).await?;
                off.get(IN_A_ROW - 1).map(|_| drifted(off[0]))
            }
        };
        if let Some(why) = trouble {
            tracing::error!("the machine {machine} gets no run: {why}");
            store.machine_failed(machine, &why).await?;
        }
        Ok(())
    }
}

fn drifted(ratio: f64) -> String {
    format!(
        "Its times have drifted: the sentinel takes {:+.1} % of what it takes on machines of its class, {IN_A_ROW} times in a row.",
        100.0 * (ratio - 1.0)
    )
}

/// The algorithm with which a machine has to measure the sentinel before it gets a run; nothing when it has done so lately and is off
/// by no more than `most`.
pub async fn sentinel_due(
    store: &Store,
    registry: &Registry,
    most: f64,
    machine: &str,
    facts: &MachineFacts,
) -> Result<Option<OrderedAlgorithm>> {
    let readings = store.readings(&facts.hardware_class).await?;
    let last = readings.iter().find(|it| it.machine == machine);
    let lately = last.is_some_and(|it| now_us() - it.at_us < EVERY.as_micros() as i64);
    if lately && off(&readings, machine, most).is_empty() {
        return Ok(None);
    }
    Ok(registry.algorithm(ALGORITHM).filter(|it| it.trusted).map(|it| ordered(&it)))
}

/// The last reading of a machine divided by what is usual on its class; nothing while there are few.
pub fn drift(readings: &[Reading], machine: &str) -> Option<f64> {
    Some(last(readings, machine).next()?.median_ns / usual(readings, machine)?)
}

impl Store {
    /// The readings of a hardware class, the newest first.
    pub(super) async fn readings(&self, class: &str) -> Result<Vec<Reading>> {
        let text = "SELECT machine, at_us, median_ns, off FROM sentinels WHERE hardware_class = $1 ORDER BY at_us DESC";
        let rows: Vec<(String, i64, f64, i64)> = sqlx::query_as(text).bind(class).fetch_all(&self.pool).await?;
        let reading = |(machine, at_us, median_ns, off)| Reading { machine, at_us, median_ns, off: off != 0 };
        Ok(rows.into_iter().map(reading).collect())
    }

    /// Keeps a reading, and drops the old ones.
    async fn keep_reading(&self, class: &str, reading: &Reading) -> Result<()> {
        let text = "INSERT INTO sentinels (machine, hardware_class, at_us, median_ns, off) VALUES ($1, $2, $3, $4, $5)";
        let query = sqlx::query(text).bind(&reading.machine).bind(class).bind(reading.at_us).bind(reading.median_ns);
        query.bind(i64::from(reading.off)).execute(&self.pool).await?;
        let oldest = reading.at_us - KEPT.as_micros() as i64;
        sqlx::query("DELETE FROM sentinels WHERE at_us < $1").bind(oldest).execute(&self.pool).await?;
        Ok(())
    }

    /// Forgets the readings of a machine, which may be another one now.
    pub(super) async fn forget_readings(&self, machine: &str) -> Result<()> {
        sqlx::query("DELETE FROM sentinels WHERE machine = $1").bind(machine).execute(&self.pool).await?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings of machines, the newest first.
    fn readings(all: &[(&str, f64)]) -> Vec<Reading> {
        let of = |(place, (machine, median_ns)): (usize, &(&str, f64))| Reading {
            machine: (*machine).to_owned(),
            at_us: 1000 - place as i64,
            median_ns: *median_ns,
            off: false,
        };
        all.iter().enumerate().map(of).collect()
    }

    #[test]
    fn a_machine_is_off_when_its_last_readings_are() {
        let slow = [("a", 104.0), ("b", 100.0), ("a", 105.0), ("b", 101.0), ("a", 106.0), ("b", 99.0), ("a", 100.0)];
        let found = off(&readings(&slow), "a", 0.03);
        assert_eq!(found.iter().map(|ratio| (100.0 * ratio).round()).collect::<Vec<_>>(), [104.0, 105.0, 106.0]);
        let longer = [&slow[..], &[("a", 100.0); 5]].concat();
        assert!(off(&readings(&longer), "b", 0.03).is_empty(), "the other one is off");
        assert!(off(&readings(&slow), "a", 0.07).is_empty(), "within the bound");
        let twice = [("a", 104.0), ("b", 100.0), ("a", 105.0), ("b", 101.0), ("a", 101.0), ("b", 99.0)];
        assert_eq!(off(&readings(&twice), "a", 0.03).len(), 2, "not yet three in a row");
        let fast = [("a", 96.0), ("b", 100.0), ("a", 96.0), ("b", 100.0), ("a", 96.0), ("b", 100.0)];
        assert_eq!(off(&readings(&fast), "a", 0.03).len(), 3, "faster is another machine, too");
        let better = [("a", 100.0), ("a", 105.0), ("a", 105.0), ("b", 100.0), ("b", 100.0), ("b", 100.0)];
        assert!(off(&readings(&better), "a", 0.03).is_empty(), "the newest one is as it should be");
    }

    #[test]
    fn few_readings_of_others_say_nothing() {
        let few = [("a", 200.0), ("a", 200.0), ("a", 200.0), ("b", 100.0), ("b", 100.0)];
        assert!(off(&readings(&few), "a", 0.03).is_empty());
        // Alone it is compared with what it was.
        let alone = [("a", 110.0), ("a", 110.0), ("a", 110.0), ("a", 100.0), ("a", 100.0), ("a", 100.0)];
        assert_eq!(off(&readings(&alone), "a", 0.03).len(), 3);
        assert_eq!((drift(&readings(&alone), "a"), drift(&readings(&alone[..2]), "a")), (Some(1.1), None));
    }

    #[test]
    fn a_machine_that_is_off_for_long_does_not_become_the_usual_one() {
        let mut all = readings(&[[("a", 120.0); 40].as_slice(), &[("b", 100.0); 8]].concat());
        assert!(!off(&all, "b", 0.03).is_empty(), "were they counted");
        all.iter_mut().filter(|it| it.machine == "a").for_each(|it| it.off = true);
        assert!(off(&all, "b", 0.03).is_empty());
        assert_eq!(off(&all, "a", 0.03), [1.2; IN_A_ROW]);
    }
}
