//! What is asked of an algorithm and what it may answer.

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

/// The question of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Query {
    /// Collision query, stopping at the first intersecting pair.
    CollisionFirst,
    /// Collision query, all intersecting pairs.
    CollisionAll,
    /// Proximity query: minimum distance, 0 when the surfaces meet.
    Proximity,
}

/// What counts as an object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Semantics {
    /// Its triangles alone: an object wholly inside another one, without touching its surface, is apart from it.
    #[default]
    Surface,
    /// For closed meshes: its triangles and what they enclose. An object inside another one collides with it, and the
    /// distance is 0.
    Solid,
}

/// What an algorithm says; every number in it is unchecked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// To [`Query::CollisionFirst`].
    Collision {
        /// Do they meet?
        hit: bool,
        /// The pair of triangles found (A, B), when `hit` and when the algorithm says.
        pair: Option<[u32; 2]>,
    },
    /// To [`Query::CollisionAll`].
    Contacts {
        /// How many pairs the algorithm found.
        total: u64,
        /// The pairs (A, B), as many as the host's buffer took.
        pairs: Vec<[u32; 2]>,
    },
    /// To [`Query::Proximity`].
    Distance {
        /// Minimum distance.
        distance: f64,
        /// Witness points in the world frame (A, B), when given.
        points: Option<[Point3<f64>; 2]>,
        /// Witness triangles (A, B), when given.
        triangles: Option<[u32; 2]>,
    },
    /// The algorithm says that it could not decide.
    GaveUp,
    /// The algorithm does not answer this kind of query.
    Unsupported,
}

/// Work done for one query, as the algorithm counts it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Counters {
    /// Tests between bounding volumes, if it counts them.
    pub bv_tests: Option<u64>,
    /// Tests between primitives, if it counts them.
    pub primitive_tests: Option<u64>,
}
