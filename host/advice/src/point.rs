//! A way to answer a question, as a point in a plot of time and error against the size of its model.

use serde::{Deserialize, Serialize};

use crate::advice::{Levels, Measured};
use crate::share::Share;

/// What kind of model a way asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = AdviceKind)]
pub enum Kind {
    /// The objects themselves, for their distance.
    Whole,
    /// The objects themselves, for no more than is asked.
    SameQuestion,
    /// The objects themselves: further apart than the tolerance, yes or no, instead of a distance.
    YesNo,
    /// Levels of detail; for a yes or no with the whole objects behind them.
    Levels,
    /// The advice, with the whole objects behind it.
    Advised,
    /// Convex hulls.
    Hulls,
    /// Boxes along the axes of the objects' files.
    Boxes,
    /// Hulls of parts that are nearly convex.
    ConvexParts,
    /// Spheres that fill the objects.
    InnerSpheres,
    /// One object as voxels, the other as points; to a distance, whether it is more than the tolerance.
    Voxels,
    /// The objects themselves, by parry in f64.
    DoublePrecision,
    /// The same in f32, where vertices and poses are rounded.
    SinglePrecision,
}

/// What a model consists of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = AdviceUnit)]
pub enum Unit {
    /// Triangles, also of hulls.
    #[default]
    Triangles,
    /// Spheres.
    Spheres,
    /// Voxels that a surface passes through; of the object whose points are looked up, these.
    Voxels,
}

impl Kind {
    /// What its models consist of.
    fn unit(self) -> Unit {
        match self {
            Self::InnerSpheres => Unit::Spheres,
            Self::Voxels => Unit::Voxels,
            _ => Unit::Triangles,
        }
    }

    /// Does it answer from what is certified, or from the objects in exact enough arithmetic?
    fn is_certified(self) -> bool {
        matches!(self, Self::Whole | Self::SameQuestion | Self::YesNo | Self::Levels | Self::Advised)
    }
}

/// A way to answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[schema(as = AdvicePoint)]
pub struct Point {
    /// What is asked.
    pub kind: Kind,
    /// Numbers of the levels, coarsest stage first; none for what is no level.
    #[schema(value_type = Vec<Vec<u32>>)]
    pub stages: Vec<Levels>,
    /// How large the first model asked is, of both objects together.
    #[serde(alias = "triangles")]
    pub elements: u32,
    /// In what that is counted.
    #[serde(default)]
    #[schema(required = true)]
    pub unit: Unit,
    /// What another method is called where it can be measured by itself (`ocb bench`), with its setting.
    pub algorithm: Option<String>,
    /// How many of the configurations it was asked about, drawn at random, where all of them would take too long.
    pub asked: Option<u32>,
    /// Time of a query, microseconds.
    pub micros: Measured,
    /// How many times faster than the whole objects asked for their distance, about the same configurations.
    pub faster: Measured,
    /// No answer was or could have been further off (half the widest interval); absent where nothing is certified.
    pub guaranteed_error: Option<f64>,
    /// The largest error seen.
    pub observed_error: Option<f64>,
    /// How often the whole objects had to be asked, or would have to be.
    pub falls_back: Option<Share>,
    /// "Not clear" of configurations that are clear, of these.
    pub false_alarms: Option<Share>,
    /// "Clear" of configurations that are not, of these.
    pub missed: Option<Share>,
    /// Can it not be wrong by more than it says?
    pub certified: bool,
    /// Is it the advice?
    pub advised: bool,
}

impl Point {
    /// A way that is not measured yet.
    pub fn new(kind: Kind, stages: &[Levels], elements: u32) -> Self {
        let none = Measured { value: 0.0, lo: 0.0, hi: 0.0 };
        Self {
            kind,
            stages: stages.to_vec(),
            elements,
            unit: kind.unit(),
            algorithm: None,
            asked: None,
            micros: none,
            faster: none,
            guaranteed_error: None,
            observed_error: None,
            falls_back: None,
            false_alarms: None,
            missed: None,
            certified: kind.is_certified(),
            advised: false,
        }
    }
}
