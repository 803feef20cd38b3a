//! How configurations are found.

mod approach;
mod closer;
pub mod controls;
mod grid;
mod low_discrepancy;
mod nearby;
mod number;
mod paper_pattern;
mod penetration;
mod placer;
mod random;
mod sphere;
mod trajectory;
mod window;

use crate::configuration::{Method, Placed, Separation};
use crate::oracle::Shape;

pub use number::count;
pub use placer::check as check_separation;

/// Changes whenever the same request gives other configurations.
pub const VERSION: u32 = 4;

/// No set has more configurations than this.
pub const MAX_CONFIGURATIONS: u64 = 10_000_000;

/// Why no set can be sampled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SamplingError {
    /// A set of none.
    #[error("the number of configurations must be at least 1")]
    NoConfigurations,
    /// More than [`MAX_CONFIGURATIONS`].
    #[error(
        "{0} configurations are too many; at most {MAX_CONFIGURATIONS} are possible: choose larger steps or a smaller number"
    )]
    TooMany(u64),
    /// Steps outside (0, 180].
    #[error("{name} must be more than 0 and at most 180 degrees, not {value}")]
    Degrees {
        /// Which step.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// Negative, infinite or not a number.
    #[error("the relative distance must be a number from 0 to 1000, not {0}")]
    RelativeDistance(f64),
    /// Too small to be told apart in f64, too large for a step, or not a number.
    #[error("a step must be from {least:e} to {most} of the scene's size, apart (+) or crossing (-), not {0}", least = placer::LEAST_STEP, most = Separation::LARGEST_STEP)]
    Step(f64),
    /// The grid has too many nodes for one rotation.
    #[error("the grid would have {0} positions for each rotation; at most {most} are possible: choose a larger move-by or a smaller number", most = grid::MAX_NODES)]
    TooFine(u64),
    /// Negative, infinite or not a number.
    #[error("the distance of the centres must be a number from 0 to 1000 times L, not {0}")]
    CenterDistance(f64),
    /// Not a probability between 0 and 1.
    #[error("the share of colliding poses must be more than 0 and less than 1, not {0}")]
    HitShare(f64),
    /// No size of the box gives the wanted share.
    #[error("no box gives a share of {wanted} colliding random poses; the nearest possible share is {found}")]
    NoBox {
        /// What was asked for.
        wanted: f64,
        /// What the last box gave.
        found: f64,
    },
    /// Nobody wants the rest.
    #[error("it was stopped")]
    Stopped,
    /// A file of poses needs no search.
    #[error("the poses of a file are given, not found")]
    Given,
}

/// What to sample, in units of work that are pure functions of their number, so that many threads may share them.
#[derive(Clone, Debug)]
pub enum Plan<'a> {
    /// One ray per unit.
    Sphere(sphere::Plan<'a>),
    /// One rotation per unit.
    Grid(Box<grid::Plan<'a>>),
    /// One frame per unit.
    Trajectory(trajectory::Plan<'a>),
    /// One pose per unit.
    Random(random::Plan<'a>),
}

/// What one unit of work gave, in the unit's own order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Configurations with their truth.
    pub placed: Vec<Placed>,
    /// Rays on which nothing was found.
    pub missed: u32,
}

impl From<Option<Placed>> for Found {
    fn from(placed: Option<Placed>) -> Self {
        Self { missed: u32::from(placed.is_none()), placed: placed.into_iter().collect() }
    }
}

impl<'a> Plan<'a> {
    /// Plans the work; a grid and a random placement look at some poses to find their measures.
    ///
    /// `separation` is what [`Method::Sphere`] and [`Method::Grid`] look for; the others do not need it.
    pub fn new(a: &'a Shape, b: &'a Shape, method: &Method, separation: Separation) -> Result<Self, SamplingError> {
        Self::unless_stopped(a, b, method, separation, &|| false)
    }

    /// The same, but ends with [`SamplingError::Stopped`] soon after `stopped` says so; it is asked again and again.
    pub fn unless_stopped(
        a: &'a Shape,
        b: &'a Shape,
        method: &Method,
        separation: Separation,
        stopped: &dyn Fn() -> bool,
    ) -> Result<Self, SamplingError> {
        let expected = count(method)?;
        Ok(match *method {
            Method::Sphere { sampling, seed } => {
                Self::Sphere(sphere::Plan::new(a, b, &sampling, expected, separation, seed)?)
            }
            Method::Grid { sampling, seed } => {
                Self::Grid(Box::new(grid::Plan::new(a, b, &sampling, separation, seed, stopped)?))
            }
            Method::Trajectory { center_distance, count } => {
                Self::Trajectory(trajectory::Plan::new(a, b, center_distance, count))
            }
            Method::Random { count, hit_share, seed } => {
                Self::Random(random::Plan::new(a, b, count, hit_share, seed, stopped)?)
            }
            Method::File { .. } => return Err(SamplingError::Given),
        })
    }

    /// Number of units of work.
    pub fn units(&self) -> u64 {
        match self {
            Self::Sphere(plan) => plan.len(),
            Self::Grid(plan) => plan.rotations(),
            Self::Trajectory(plan) => plan.len(),
            Self::Random(plan) => plan.len(),
        }
    }

    /// What unit `unit` gives, a pure function of it.
    pub fn place(&self, unit: u64) -> Found {
        assert!(unit < self.units(), "unit {unit} of {}", self.units());
        match self {
            Self::Sphere(plan) => plan.place(unit).into(),
            Self::Grid(plan) => plan.place(unit),
            Self::Trajectory(plan) => Some(plan.place(unit)).into(),
            Self::Random(plan) => Some(plan.place(unit)).into(),
        }
    }

    /// All units' results as one, in their order; of a grid with a wanted number, evenly thinned to it.
    pub fn gather(&self, found: Vec<Found>) -> Found {
        let mut all = Found::default();
        for unit in found {
            all.placed.extend(unit.placed);
            all.missed += unit.missed;
        }
        if let Self::Grid(plan) = self {
            plan.thin(&mut all.placed);
        }
        all
    }

    /// Side of the cube in which random poses are, in the objects' lengths.
    pub fn box_side(&self) -> Option<f64> {
        match self {
            Self::Random(plan) => Some(plan.side()),
            Self::Sphere(_) | Self::Grid(_) | Self::Trajectory(_) => None,
        }
    }

    /// Distance between the grid's nodes, in the objects' lengths.
    pub fn spacing(&self) -> Option<f64> {
        match self {
            Self::Grid(plan) => Some(plan.spacing()),
            Self::Sphere(_) | Self::Trajectory(_) | Self::Random(_) => None,
        }
    }
}
