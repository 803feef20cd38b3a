//! Advice: how much of the models a question needs, what that saves, and what is known of its errors.

use serde::{Deserialize, Serialize};

use crate::point::Point;
use crate::question::Question;
use crate::share::Share;

/// Numbers of levels, of A and of B; `[0, 0]` are the objects themselves.
pub type Levels = [usize; 2];

/// What is advised for a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Advice {
    /// What was asked.
    pub question: Question,
    /// Relative distances at which configurations were looked for.
    pub distances: Vec<f64>,
    /// Configurations from which the advice was made.
    pub configurations: u32,
    /// L, the longest side of A's bounding box.
    pub longest_side: f64,
    /// The levels of A, finest first; the first is the object.
    pub levels_a: Vec<LevelFacts>,
    /// The levels of B.
    pub levels_b: Vec<LevelFacts>,
    /// Levels to ask one after the other before the whole objects; none when those are the fastest.
    #[schema(value_type = Vec<Vec<u32>>)]
    pub stages: Vec<Levels>,
    /// Triangles of both objects.
    pub triangles_before: u32,
    /// Triangles of the first stage.
    pub triangles_after: u32,
    /// Time of the whole objects, asked for the distance, over that of the advice.
    pub faster: Measured,
    /// The same, the whole objects being asked the same question: a yes or no, or a distance only within the tolerance.
    pub faster_than_same_question: Measured,
    /// Half the widest interval on the configurations, for a distance: no answer was or could have been further off.
    pub guaranteed_error: Option<f64>,
    /// The same for any configuration whatever, if the whole objects were never asked.
    pub guaranteed_anywhere: Option<f64>,
    /// What advice says of configurations it was not made from.
    pub held_out: HeldOut,
    /// Ways to answer, measured on the same configurations.
    pub points: Vec<Point>,
    /// Ways that are missing among them.
    #[serde(default)]
    #[schema(required = true)]
    pub left_out: Vec<LeftOut>,
    /// Where on the objects detail is needed.
    pub detail: [Detail; 2],
    /// What the work took, seconds.
    pub seconds: f64,
}

/// One level of one object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct LevelFacts {
    /// Its triangles.
    pub triangles: u32,
    /// The largest thickness; 0 of the object.
    pub thickness: f64,
    /// The largest deviation.
    pub deviation: f64,
}

/// Fresh configurations, compared with the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct HeldOut {
    /// Intervals or answers of the levels themselves that contradict the oracle.
    pub violations: Share,
    /// Wrong answers of the advice as a whole.
    pub wrong: Share,
    /// Configurations for which the whole objects had to be asked.
    pub falls_back: Share,
    /// The largest difference to the oracle's distance, where a distance was asked.
    pub observed_error: Option<f64>,
}

/// One object's vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[schema(as = AdviceDetail)]
pub struct Detail {
    /// Triangles of the coarsest level of the object that was enough for every configuration whose witness point is at
    /// the vertex; absent where there is none.
    pub triangles: Vec<Option<f64>>,
    /// Configurations at the vertex.
    pub counts: Vec<u32>,
}

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// What is not on the plot, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[schema(as = AdviceLeftOut)]
pub struct LeftOut {
    /// As `ocb bench` calls them, or a word for what is no algorithm.
    pub what: Vec<String>,
    /// In one sentence.
    pub reason: String,
}
