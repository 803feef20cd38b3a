//! The oracle for whoever asks it alone: certified answers on all CPUs, and the files they go to. No store, no plugin.

use std::sync::atomic::Ordering;

use ocb_core::configuration::Configuration;
use ocb_core::oracle::{Pair, Shape};
use rayon::prelude::*;

pub use crate::columns::{contacts_parquet, csv, truths_parquet};
pub use crate::configurations::{Gauge, read_matrices};
pub use crate::machine::{Machine, MakingWay};
use crate::model::{ContactRow, TruthRow};

/// How much is asked about a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Do they collide, how robustly, and which class is that? Cheap for objects far apart.
    Collision,
    /// Also the distance.
    Distance,
    /// Whether they collide, and all pairs of triangles that meet.
    Contacts,
}

/// Certifies all configurations; `None` when it was stopped.
pub fn certify(
    a: &Shape,
    b: &Shape,
    configurations: &[Configuration],
    depth: Depth,
    gauge: &Gauge,
) -> Option<Vec<TruthRow>> {
    let pair = Pair::new(a, b);
    on_all_cpus(configurations.len(), gauge, |i| row(&pair, i as u64, &configurations[i], depth))
}

fn row(pair: &Pair, index: u64, configuration: &Configuration, depth: Depth) -> TruthRow {
    if depth == Depth::Distance {
        return TruthRow::of(index, &pair.truth(configuration));
    }
    let known = pair.truth_unless_clear(configuration);
    let mut row = match &known {
        Some(truth) => TruthRow { distance_lo: None, distance_hi: None, ..TruthRow::of(index, truth) },
        None => TruthRow::clear(index, pair.containment(configuration)),
    };
    if depth == Depth::Contacts {
        let contacts = if row.hit { pair.contact_margins(configuration) } else { Vec::new() };
        row.contacts = Some(contacts.iter().map(ContactRow::from).collect());
    }
    row
}

/// The values for 0 to `len` - 1 in order, computed on all CPUs; `None` when it was stopped.
pub fn on_all_cpus<T: Send>(len: usize, gauge: &Gauge, value: impl Fn(usize) -> T + Sync) -> Option<Vec<T>> {
    (0..len)
        .into_par_iter()
        .map(|i| {
            if gauge.stop.load(Ordering::Relaxed) {
                return None;
            }
            let found = value(i);
            gauge.done.fetch_add(1, Ordering::Relaxed);
            Some(found)
        })
        .collect()
}
