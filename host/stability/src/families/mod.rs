//! The families: each a construction that some library has failed at.
//!
//! They stand in the order of what is hard about them: how close (`near`), flat sides on flat sides (`flat`), thin and
//! empty triangles (`thin`), numbers (`units`), whole objects (`whole`), what holds an object together (`soup`),
//! what is not a rotation (`matrices`), and the order of the questions (`order`).

mod flat;
mod matrices;
mod near;
mod order;
mod soup;
mod thin;
mod units;
mod whole;

use crate::Family;

/// All of them, in the order of the tables.
pub fn all() -> impl Iterator<Item = &'static Family> {
    [
        &near::FAMILIES[..],
        &flat::FAMILIES,
        &thin::FAMILIES,
        &units::FAMILIES,
        &whole::FAMILIES,
        &soup::FAMILIES,
        &matrices::FAMILIES,
        &order::FAMILIES,
    ]
    .into_iter()
    .flatten()
}

/// The one with this short name.
pub fn by_id(id: &str) -> Option<&'static Family> {
    all().find(|family| family.id == id)
}

/// Powers of ten from 1e-12 to 0.1: how close.
const DECADES: &[f64] = &[1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];

#[cfg(test)]
mod tests;
