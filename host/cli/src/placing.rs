//! How configurations are found, as said on the command line: the same words for every command that needs them.

use clap::{Args, ValueEnum};
use ocb_core::configuration::{Method, Sampling, Separation};
use ocb_core::sampling;

use crate::failure::{Failure, Result};

/// Degrees of a step when nothing is said.
const DEFAULT_STEP: f64 = 20.0;
/// Zachmann's run.
const DEFAULT_FRAMES: i64 = 5000;
/// Distance of the centres in a trajectory: bounding cubes that touch.
const DEFAULT_CENTER_DISTANCE: f64 = 1.0;
/// Random poses when no number is said.
const DEFAULT_POSES: i64 = 10_000;
/// Share of random poses that collide.
const DEFAULT_HIT_SHARE: f64 = 0.5;

/// Arguments of the search for configurations.
#[derive(Clone, Debug, Args)]
pub struct PlacingArgs {
    /// How configurations are found.
    #[arg(long, value_enum, default_value_t = MethodName::Sphere)]
    pub method: MethodName,
    /// Use the 2020 paper's own pattern of directions and rotations.
    #[arg(long, conflicts_with = "count")]
    pub paper_compat: bool,
    /// Rotation step (rotate-by) in degrees [default: 20].
    #[arg(long, allow_negative_numbers = true, value_name = "DEGREES", conflicts_with = "count")]
    pub rotate: Option<f64>,
    /// Direction step (move-by) in degrees; for a grid, the arc of its spacing [default: 20].
    #[arg(long = "move", allow_negative_numbers = true, value_name = "DEGREES", conflicts_with = "count")]
    pub move_by: Option<f64>,
    /// Number of configurations, instead of steps.
    #[arg(long, allow_negative_numbers = true, value_name = "N")]
    pub count: Option<i64>,
    /// Seed of the low-discrepancy sequences [default: 0].
    #[arg(long)]
    pub seed: Option<u64>,
    /// Relative distance: surface distance over the longest side of A's bounding box; 0 means touching [default: 0].
    #[arg(long, allow_negative_numbers = true, conflicts_with_all = ["step", "ladder"])]
    pub distance: Option<f64>,
    /// Step: a share of the scene's size instead, apart (above 0) or crossing (below 0); 7e-15 to 0.1.
    #[arg(long, allow_negative_numbers = true, value_name = "X", conflicts_with = "ladder")]
    pub step: Option<f64>,
    /// The ten steps +-1e-2, 1e-4, 1e-6, 1e-8 and 7.1e-15 in turn.
    #[arg(long)]
    pub ladder: bool,
    /// For a trajectory: distance of the bounding boxes' centres over the longest side of A's [default: 1].
    #[arg(long, allow_negative_numbers = true, value_name = "D")]
    pub center_distance: Option<f64>,
    /// For random placement: share of poses that collide [default: 0.5].
    #[arg(long, allow_negative_numbers = true, value_name = "SHARE")]
    pub hit_share: Option<f64>,
}

/// How configurations are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// B approaches from a sphere around A until the distance is met.
    Sphere,
    /// B starts at every free node of a grid around A; this reaches concavities.
    Grid,
    /// B tumbles about z and x at a fixed distance between the centres; the order is kept.
    Trajectory,
    /// B anywhere in a cube around A; a given share of the poses collides.
    Random,
}

impl PlacingArgs {
    /// The method, checked.
    pub fn method(&self) -> Result<Method> {
        self.fits()?;
        let seed = self.seed.unwrap_or_default();
        let method = match self.method {
            MethodName::Sphere => Method::Sphere { sampling: self.sampling()?, seed },
            MethodName::Grid => Method::Grid { sampling: self.sampling()?, seed },
            MethodName::Trajectory => Method::Trajectory {
                center_distance: self.center_distance.unwrap_or(DEFAULT_CENTER_DISTANCE),
                count: small_count(self.count.unwrap_or(DEFAULT_FRAMES))?,
            },
            MethodName::Random => Method::Random {
                count: small_count(self.count.unwrap_or(DEFAULT_POSES))?,
                hit_share: self.hit_share.unwrap_or(DEFAULT_HIT_SHARE),
                seed,
            },
        };
        let wrong = |e: sampling::SamplingError| Failure::Input(format!("These configurations are not possible: {e}."));
        sampling::check_separation(self.separation()).map_err(wrong)?;
        sampling::count(&method).map_err(wrong)?;
        Ok(method)
    }

    /// How far apart or how deep in each other.
    pub fn separation(&self) -> Separation {
        match self.step {
            _ if self.ladder => Separation::Ladder,
            Some(of_size) => Separation::Step { of_size },
            None => Separation::Relative { distance: self.distance.unwrap_or_default() },
        }
    }

    /// Names of the arguments that were given.
    fn given(&self) -> Vec<&'static str> {
        [
            ("--paper-compat", self.paper_compat),
            ("--rotate", self.rotate.is_some()),
            ("--move", self.move_by.is_some()),
            ("--count", self.count.is_some()),
            ("--seed", self.seed.is_some()),
            ("--distance", self.distance.is_some()),
            ("--step", self.step.is_some()),
            ("--ladder", self.ladder),
            ("--center-distance", self.center_distance.is_some()),
            ("--hit-share", self.hit_share.is_some()),
        ]
        .into_iter()
        .filter_map(|(name, given)| given.then_some(name))
        .collect()
    }

    /// No argument is silently without effect.
    fn fits(&self) -> Result<()> {
        let (name, known): (&str, &[&str]) = match self.method {
            MethodName::Sphere | MethodName::Grid => (
                "sphere or grid",
                &["--paper-compat", "--rotate", "--move", "--count", "--seed", "--distance", "--step", "--ladder"],
            ),
            MethodName::Trajectory => ("trajectory", &["--count", "--center-distance"]),
            MethodName::Random => ("random", &["--count", "--seed", "--hit-share"]),
        };
        match self.given().into_iter().find(|given| !known.contains(given)) {
            Some(other) => Err(Failure::Input(format!(
                "{other} does not belong to --method {name}, which takes {}.",
                known.join(", ")
            ))),
            None => Ok(()),
        }
    }

    fn sampling(&self) -> Result<Sampling> {
        let (rotate, move_by) = (self.rotate.unwrap_or(DEFAULT_STEP), self.move_by.unwrap_or(DEFAULT_STEP));
        Ok(match self.count {
            Some(count) => Sampling::Count { count: small_count(count)? },
            None if self.paper_compat => Sampling::PaperCompat { rotate, move_by },
            None => Sampling::Steps { rotate, move_by },
        })
    }
}

fn small_count(count: i64) -> Result<u32> {
    let most = sampling::MAX_CONFIGURATIONS;
    let fits = u32::try_from(count).ok().filter(|count| (1..=most).contains(&u64::from(*count)));
    fits.ok_or_else(|| Failure::Input(format!("The number of configurations must be 1 to {most}, not {count}.")))
}
