//! What a run is called in the filters of the board.

use ocb_core::configuration::{Method, Separation};
use ocb_core::query::{Query, Semantics};

use super::Named;
use crate::model::{ContractClass, Delivered, Order, RunSpec};

/// The question, with what counts as an object.
pub fn question(spec: &RunSpec) -> Named {
    let (value, words) = match spec.query {
        Query::CollisionFirst => ("collision_first", "collision, first contact"),
        Query::CollisionAll => ("collision_all", "collision, all contacts"),
        Query::Proximity => ("proximity", "distance"),
    };
    match spec.semantics {
        Semantics::Surface => Named { value: value.into(), words: words.into() },
        Semantics::Solid => Named { value: format!("{value}+solid"), words: format!("{words}, solid bodies") },
    }
}

/// The pair of objects: stock objects with their triangle counts, others by id.
pub fn scene(spec: &RunSpec, names: [&str; 2]) -> Named {
    let a = &spec.object_a;
    let ids = [a, spec.object_b.as_ref().unwrap_or(a)].map(|id| id.trim_start_matches("stock:"));
    let words: Vec<&str> = ids.iter().zip(names).map(|(id, name)| if id.contains('@') { id } else { name }).collect();
    Named { value: ids.join("~"), words: words.join(" x ") }
}

/// How far apart, and how the positions were found.
pub fn distance(spec: &RunSpec) -> Named {
    let (method, prefix) = match &spec.method {
        Method::Sphere { .. } => ("sphere", ""),
        Method::Grid { .. } => ("grid", "grid:"),
        Method::Trajectory { center_distance, .. } => {
            return named(format!("trajectory:{center_distance}"), format!("trajectory at {center_distance} L"));
        }
        Method::Random { hit_share, .. } => {
            return named(format!("random:{hit_share}"), format!("random, {hit_share} colliding"));
        }
        Method::File { sha256 } => {
            let short: String = sha256.chars().take(12).collect();
            return named(format!("given:{short}"), format!("given poses {short}"));
        }
    };
    match spec.separation {
        Separation::Ladder => named(format!("{prefix}ladder"), format!("ladder of steps ({method})")),
        Separation::Step { of_size } => {
            named(format!("{prefix}step:{of_size:e}"), format!("step {of_size:e} of S ({method})"))
        }
        Separation::Relative { distance } => {
            named(format!("{prefix}{distance}"), format!("relative distance {distance} ({method})"))
        }
    }
}

/// The contract class.
pub fn class(class: &ContractClass) -> Named {
    let delivered = match class.delivered {
        Delivered::FirstContact => "first_contact",
        Delivered::AllContacts => "all_contacts",
        Delivered::Distance => "distance",
        Delivered::DistanceWithWitness => "distance_with_witness",
    };
    let order = match class.order {
        Order::Shuffled => "shuffled",
        Order::Trajectory => "trajectory",
    };
    named(format!("{delivered}-{order}-{}-f{}", class.cpus, class.bits), class.words())
}

fn named(value: String, words: String) -> Named {
    Named { value, words }
}
