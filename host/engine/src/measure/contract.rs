//! The contract class of what was measured, read off the answers where they show it.

use ocb_core::query::{Answer, Query};
use ocb_core::record::Record;

use super::Measured;
use crate::model::{ContractClass, Delivered, Order};

/// The class of one algorithm's measurements.
pub fn contract(measured: &Measured, query: Query, coherent: bool) -> ContractClass {
    ContractClass {
        delivered: match query {
            Query::CollisionFirst => Delivered::FirstContact,
            Query::CollisionAll => Delivered::AllContacts,
            Query::Proximity if witnessed(&measured.records) => Delivered::DistanceWithWitness,
            Query::Proximity => Delivered::Distance,
        },
        order: if coherent { Order::Trajectory } else { Order::Shuffled },
        cpus: measured.contestant.threads as u32,
        bits: if measured.contestant.info.single_precision { 32 } else { 64 },
    }
}

/// Every distance came with its witness points.
fn witnessed(records: &[Record]) -> bool {
    let mut distances = records.iter().filter_map(|record| match record.answer {
        Answer::Distance { points, .. } => Some(points.is_some()),
        _ => None,
    });
    distances.next() == Some(true) && distances.all(|with| with)
}
