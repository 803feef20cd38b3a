//! Charts as data: series of points, each with its n and its 95 % intervals, on axes that say their unit.
//!
//! The engine makes them, the API gives them as JSON, the pages draw them, and [`svg`] writes the same data as a file for
//! whoever has no page. Nothing here knows what was measured.
#![forbid(unsafe_code)]

mod label;
mod paper;
mod place;
mod scale;
mod style;
pub mod svg;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

pub use scale::Placing;
pub use style::{STYLES, Style};

/// A picture of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Chart {
    /// Which one, as requests name it.
    pub kind: String,
    /// What is shown.
    pub title: String,
    /// What is to be seen, in one sentence; empty when there is nothing to say.
    pub finding: String,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// What is drawn, in the order of the key.
    pub series: Vec<Series>,
    /// How to read it, one sentence each.
    pub notes: Vec<String>,
    /// What it shows is still being measured, and will change.
    #[serde(default)]
    #[schema(required = true)]
    pub preliminary: bool,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Axis {
    /// What it measures.
    pub label: String,
    /// `ns`, `1/s`, `share`, `u S`, or a plain word.
    pub unit: String,
    /// How numbers become places.
    pub scale: Scale,
    /// Name of the lane before the axis, for points without a value.
    pub lane: Option<String>,
}

/// How numbers become places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Evenly, from 0.
    Linear,
    /// By logarithm.
    Log,
    /// By logarithm in both directions from the smallest value: below 0 to the left, above to the right.
    Signed,
    /// A row for each series, by its number from 0, the first on top.
    Rows,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Series {
    /// Name in the key.
    pub name: String,
    /// Which of the eight styles; absent: plain grey.
    pub style: Option<u8>,
    /// How it is drawn.
    pub form: Form,
    /// In the order in which they are joined.
    pub points: Vec<Point>,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Marks joined by a line.
    Line,
    /// A staircase without marks.
    Steps,
    /// A thin line without marks.
    Rule,
}

/// One value, with what is known of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Point {
    /// Name beside the mark.
    pub name: Option<String>,
    /// Along the first axis; absent: in the lane.
    pub x: Option<f64>,
    /// Lower end of its 95 % interval.
    pub x_lo: Option<f64>,
    /// Upper end; of a point in the lane: the bound at 95 %.
    pub x_hi: Option<f64>,
    /// Along the second axis.
    pub y: f64,
    /// Lower end of its 95 % interval.
    pub y_lo: Option<f64>,
    /// Upper end.
    pub y_hi: Option<f64>,
    /// How many measured values are behind it.
    pub n: u64,
    /// Drawn filled; hollow otherwise.
    pub filled: bool,
    /// `x` may well be more.
    pub at_least: bool,
    /// Collisions missed among them; said in red.
    pub missed: u64,
    /// False alarms among them; said in amber.
    pub false_alarms: u64,
    /// Everything in one sentence; empty where name and numbers say it.
    pub words: String,
}

impl Point {
    /// A filled point without intervals.
    pub fn at(x: f64, y: f64, n: u64) -> Self {
        Self { x: Some(x), y, n, filled: true, ..Self::default() }
    }

    /// With the 95 % interval of `y`.
    #[must_use]
    pub fn within(mut self, lo: f64, hi: f64) -> Self {
        (self.y_lo, self.y_hi) = (Some(lo), Some(hi));
        self
    }
}

impl Axis {
    /// An axis without a lane.
    pub fn new(label: &str, unit: &str, scale: Scale) -> Self {
        Self { label: label.to_owned(), unit: unit.to_owned(), scale, lane: None }
    }
}

impl Chart {
    /// Every number along the first axis, ends of intervals included.
    pub fn xs(&self) -> impl Iterator<Item = f64> {
        self.points().flat_map(|p| [p.x, p.x.and(p.x_lo), p.x.and(p.x_hi)]).flatten()
    }

    /// Every number along the second axis.
    pub fn ys(&self) -> impl Iterator<Item = f64> {
        self.points().flat_map(|p| [Some(p.y), p.y_lo, p.y_hi]).flatten()
    }

    fn points(&self) -> impl Iterator<Item = &Point> {
        self.series.iter().flat_map(|series| &series.points)
    }
}
