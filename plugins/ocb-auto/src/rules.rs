//! Which method, and why.

use crate::features::{Feature, Features};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Query {
    /// Do they meet?
    Collision,
    /// Where do they meet?
    Contacts,
    /// How far apart are they?
    Distance,
}

/// How a query is answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// The features have answered it: apart.
    Nothing,
    /// By `ocb-fast`.
    Fast,
    /// By `simdop`.
    SimDop,
    /// By `ocb-fast`; a distance is asked for after a collision query has found none.
    CollisionFirst,
}

/// A feature on one side of a bound.
#[derive(Clone, Copy, Debug)]
pub enum Condition {
    /// Above it.
    Above(Feature, f64),
    /// Below it.
    Below(Feature, f64),
}

impl Condition {
    fn holds(&self, features: &Features) -> bool {
        match *self {
            Self::Above(feature, bound) => features.get(feature) > bound,
            Self::Below(feature, bound) => features.get(feature) < bound,
        }
    }
}

/// A method for these queries, when all conditions hold.
#[derive(Clone, Debug)]
pub struct Rule<'a> {
    /// The queries.
    pub queries: &'a [Query],
    /// The conditions.
    pub when: &'a [Condition],
    /// The method.
    pub choice: Choice,
    /// Why.
    pub reason: &'a str,
}

/// The first one that fits is taken; where none does, `ocb-fast`. The bounds are those that `benches/regret` found best.
pub const RULES: [Rule<'static>; 3] = [
    Rule {
        queries: &[Query::Collision, Query::Contacts],
        when: &[Condition::Above(Feature::Clearance, 0.0)],
        choice: Choice::Nothing,
        reason: "balls around the objects do not meet, so that nothing in them does",
    },
    Rule {
        queries: &[Query::Collision],
        when: &[Condition::Above(Feature::SizeRatio, 15.0), Condition::Below(Feature::CountRatio, 64.0)],
        choice: Choice::SimDop,
        reason: "ocb-fast opens both nodes at once, and all children of a small one meet what one of them meets; simdop asks \
                 for a node as a whole first, if the trees are of like height",
    },
    Rule {
        queries: &[Query::Distance],
        when: &[Condition::Below(Feature::Clearance, -0.3)],
        choice: Choice::CollisionFirst,
        reason: "objects so deep in each other's balls mostly meet, and depth first finds a contact sooner than nearest first",
    },
];

/// The method for a query.
#[inline]
pub fn choose(rules: &[Rule<'_>], query: Query, features: &Features) -> Choice {
    let fits =
        |rule: &&Rule<'_>| rule.queries.contains(&query) && rule.when.iter().all(|condition| condition.holds(features));
    rules.iter().find(fits).map_or(Choice::Fast, |rule| rule.choice)
}
