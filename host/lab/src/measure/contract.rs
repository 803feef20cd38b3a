//! The contract class of what was measured, read off the answers where they show it.

use ocb_core::query::{Answer, Query};

use crate::algorithm::Algorithm;
use crate::model::{ContractClass, Delivered, Order};

/// The class of one algorithm that gave these answers.
pub fn contract<'a>(
    algorithm: &Algorithm,
    answers: impl Iterator<Item = &'a Answer>,
    query: Query,
    coherent: bool,
) -> ContractClass {
    ContractClass {
        delivered: match query {
            Query::CollisionFirst => Delivered::FirstContact,
            Query::CollisionAll => Delivered::AllContacts,
            Query::Proximity if witnessed(answers) => Delivered::DistanceWithWitness,
            Query::Proximity => Delivered::Distance,
        },
        order: if coherent { Order::Trajectory } else { Order::Shuffled },
        cpus: algorithm.threads as u32,
        bits: if algorithm.info.single_precision { 32 } else { 64 },
    }
}

/// Every distance came with its witness points.
fn witnessed<'a>(answers: impl Iterator<Item = &'a Answer>) -> bool {
    let mut distances = answers.filter_map(|answer| match answer {
        Answer::Distance { points, .. } => Some(points.is_some()),
        _ => None,
    });
    distances.next() == Some(true) && distances.all(|with| with)
}
