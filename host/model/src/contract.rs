//! What an algorithm had to deliver for its time: only like is compared with like.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// The contract class of a result. Places are given within one class, never across.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
pub struct ContractClass {
    /// What was delivered.
    pub delivered: Delivered,
    /// In which order it was asked.
    pub order: Order,
    /// CPUs that it might use; 1 is the single-threaded track, which the jail enforces.
    pub cpus: u32,
    /// Bits of the arithmetic that it declares, 32 or 64; its answers are judged accordingly.
    pub bits: u8,
}

/// What an algorithm delivered, as its answers show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Delivered {
    /// Whether there is a contact.
    FirstContact,
    /// All pairs of triangles in contact.
    AllContacts,
    /// How far apart.
    Distance,
    /// How far apart, and where.
    DistanceWithWitness,
}

/// In which order configurations come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// Shuffled: nothing of one configuration helps with the next.
    Shuffled,
    /// Along a trajectory: each is near the one before.
    Trajectory,
}

impl ContractClass {
    /// In words, e.g. `distance with witness, shuffled, 1 CPU, f64`.
    pub fn words(&self) -> String {
        let delivered = match self.delivered {
            Delivered::FirstContact => "first contact",
            Delivered::AllContacts => "all contacts",
            Delivered::Distance => "distance",
            Delivered::DistanceWithWitness => "distance with witness",
        };
        let order = match self.order {
            Order::Shuffled => "shuffled",
            Order::Trajectory => "trajectory",
        };
        format!("{delivered}, {order}, {} CPU{}, f{}", self.cpus, if self.cpus == 1 { "" } else { "s" }, self.bits)
    }
}
