//! Selections: predicates over the configurations of a run, in one small language for the command line, the API and the pages.
//!
//! Only this module reads the language: a page sends the text and receives which configurations it selects.
//!
//! ```text
//! selection = all { "|" all }
//! all       = one { "&" one }
//! one       = "!" one | "(" selection ")" | test
//! test      = column [ "of" algorithm ] "in" "[" number "," number "]"
//!           | flag [ "of" algorithm ]
//!           | "near" "(" [ "a" | "b" ] "vertex" integer "," number ")"
//! column    = the name of a `Column` with a range
//! flag      = the name of a `Column` that is a flag
//! ```
//!
//! Times are nanoseconds unless a unit follows (`ns`, `us`, `ms`, `s`), errors are in u S, distances in the objects'
//! lengths. Both ends of a range belong to it. `near` takes the configurations whose witness point on that object is no
//! further from the vertex than so many times the longest side of the object's bounding box. Without `of`, a column is
//! that of the algorithm that is looked at. A configuration without a value fulfils no test on it.

mod parse;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use nalgebra::Point3;

/// Which object of the scene, as tests name it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Body {
    /// The fixed object.
    #[default]
    A,
    /// The moving object.
    B,
}

/// How a column is tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// By a range of values.
    Range {
        /// What the values are, as a chart names its axis.
        axis: &'static str,
        /// Their unit; of nanoseconds (`ns`), the language also takes multiples.
        unit: &'static str,
    },
    /// By its name alone.
    Flag,
}

const fn range(axis: &'static str, unit: &'static str) -> Kind {
    Kind::Range { axis, unit }
}

/// Defines the columns: each with its name in the language and how it is tested.
macro_rules! columns {
    ($($(#[$doc:meta])* $column:ident = $name:literal, $kind:expr;)*) => {
        /// A number that every measured configuration has.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Column {
            $($(#[$doc])* $column,)*
        }

        impl Column {
            /// Every column.
            pub const ALL: &[Self] = &[$(Self::$column),*];

            /// Its name in the language.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$column => $name,)*
                }
            }

            /// How it is tested.
            pub const fn kind(self) -> Kind {
                match self {
                    $(Self::$column => $kind,)*
                }
            }
        }
    };
}

columns! {
    /// Time of the query.
    Time = "time", range("time per query", "ns");
    /// BV tests of the query.
    BvTests = "bv", range("BV tests", "tests");
    /// Primitive tests of the query.
    PrimitiveTests = "primitives", range("primitive tests", "tests");
    /// How far the answered distance lies outside the certified interval.
    Error = "error", range("distance error", "u S");
    /// Certified distance (upper end); the same for every algorithm.
    Distance = "distance", range("true distance", "lengths");
    /// 1 where the answer is wrong.
    Wrong = "wrong", Kind::Flag;
    /// 1 where a collision was missed.
    Missed = "missed", Kind::Flag;
    /// 1 where a collision was reported that is none.
    FalseAlarm = "false_alarm", Kind::Flag;
    /// 1 where equivalent instances got answers that contradict each other.
    Flipped = "flipped", Kind::Flag;
    /// Share of the other algorithms whose answer contradicts this one's.
    Disputed = "disputed", Kind::Flag;
}

/// The tests of the language, one a line.
pub fn help() -> String {
    let (mut ranges, mut flags) = (Vec::new(), Vec::new());
    for column in Column::ALL {
        match column.kind() {
            Kind::Range { unit: "ns", .. } => ranges.push(format!("{} (ns, us, ms, s)", column.name())),
            Kind::Range { unit, .. } => ranges.push(format!("{} ({unit})", column.name())),
            Kind::Flag => flags.push(column.name()),
        }
    }
    let (ranges, flags) = (ranges.join(", "), flags.join(", "));
    format!(
        "  COLUMN [of ALGORITHM] in [LOW, HIGH]   {ranges}
  FLAG [of ALGORITHM]                    {flags}
  near([a|b] vertex N, R)                witness point within R times the object's longest side of vertex N"
    )
}

/// A predicate over configurations.
#[derive(Clone, Debug, PartialEq)]
pub enum Selection {
    /// The column's value lies between the two ends, or on one of them.
    Range {
        /// What is tested.
        column: Column,
        /// Whose column; the algorithm that is looked at when absent.
        of: Option<String>,
        /// Smallest value that belongs to it.
        lo: f64,
        /// Largest value that belongs to it.
        hi: f64,
    },
    /// The flag is raised.
    Flag {
        /// What is tested.
        column: Column,
        /// Whose flag.
        of: Option<String>,
    },
    /// The witness point lies in a ball around a vertex.
    Near {
        /// On which object.
        body: Body,
        /// Middle of the ball: a vertex, counted from 0.
        vertex: u32,
        /// Radius as a share of the longest side of the object's bounding box.
        radius: f64,
    },
    /// Not that.
    Not(Box<Selection>),
    /// All of these.
    All(Vec<Selection>),
    /// At least one of these.
    Any(Vec<Selection>),
}

/// Why a text is no selection.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("The selection cannot be read at character {at}: {what}.")]
pub struct SelectionError {
    /// Where, counted from 1.
    pub at: usize,
    /// What was expected or is not possible there.
    pub what: String,
}

/// Where the values come from. All have one value per configuration, NaN where there is none.
pub trait Columns {
    /// Why a column is not to be had.
    type Error;

    /// One column of an algorithm, of the one that is looked at when `of` is absent.
    fn column(&self, column: Column, of: Option<&str>) -> Result<Cow<'_, [f64]>, Self::Error>;

    /// Distance of each witness point on the object from a vertex, as a share of the longest side of the object's box.
    fn distance_from(&self, body: Body, vertex: u32) -> Result<Vec<f64>, Self::Error>;
}

impl Selection {
    /// Which configurations belong to it.
    pub fn apply<C: Columns>(&self, columns: &C) -> Result<Vec<bool>, C::Error> {
        let many = |all: &[Self], join: fn(bool, bool) -> bool| {
            let mut parts = all.iter().map(|one| one.apply(columns));
            let first = parts.next().unwrap_or(Ok(Vec::new()))?;
            parts.try_fold(first, |so_far, next| Ok(so_far.into_iter().zip(next?).map(|(x, y)| join(x, y)).collect()))
        };
        Ok(match self {
            Self::Range { column, of, lo, hi } => {
                columns.column(*column, of.as_deref())?.iter().map(|x| lo <= x && x <= hi).collect()
            }
            Self::Flag { column, of } => columns.column(*column, of.as_deref())?.iter().map(|x| *x > 0.0).collect(),
            Self::Near { body, vertex, radius } => {
                columns.distance_from(*body, *vertex)?.iter().map(|x| x <= radius).collect()
            }
            Self::Not(one) => one.apply(columns)?.into_iter().map(|x| !x).collect(),
            Self::All(all) => many(all, |x, y| x && y)?,
            Self::Any(all) => many(all, |x, y| x || y)?,
        })
    }

    /// The algorithms that it names.
    pub fn algorithms(&self) -> Vec<&str> {
        let mut named: Vec<&str> = match self {
            Self::Range { of, .. } | Self::Flag { of, .. } => of.iter().map(String::as_str).collect(),
            Self::Near { .. } => Vec::new(),
            Self::Not(one) => one.algorithms(),
            Self::All(all) | Self::Any(all) => all.iter().flat_map(Self::algorithms).collect(),
        };
        named.sort_unstable();
        named.dedup();
        named
    }

    /// Does it ask for this column anywhere?
    pub fn uses(&self, wanted: Column) -> bool {
        match self {
            Self::Range { column, .. } | Self::Flag { column, .. } => *column == wanted,
            Self::Near { .. } => false,
            Self::Not(one) => one.uses(wanted),
            Self::All(all) | Self::Any(all) => all.iter().any(|one| one.uses(wanted)),
        }
    }
}

/// Distance of each point from `middle`, in units of `length`.
pub fn distances(points: &[Point3<f64>], middle: &Point3<f64>, length: f64) -> Vec<f64> {
    points.iter().map(|p| (p - middle).norm() / length).collect()
}

impl FromStr for Selection {
    type Err = SelectionError;

    fn from_str(text: &str) -> Result<Self, SelectionError> {
        parse::selection(text)
    }
}

/// The shortest text that reads as the same selection.
impl fmt::Display for Selection {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let joined = |f: &mut fmt::Formatter, all: &[Self], sign: &str, inner: fn(&Self) -> bool| {
            for (i, one) in all.iter().enumerate() {
                let sign = if i == 0 { "" } else { sign };
                if inner(one) { write!(f, "{sign}({one})")? } else { write!(f, "{sign}{one}")? }
            }
            Ok(())
        };
        let whose = |of: &Option<String>| of.as_ref().map_or_else(String::new, |of| format!(" of {of}"));
        match self {
            Self::Range { column, of, lo, hi } => write!(f, "{}{} in [{lo}, {hi}]", column.name(), whose(of)),
            Self::Flag { column, of } => write!(f, "{}{}", column.name(), whose(of)),
            Self::Near { body: Body::A, vertex, radius } => write!(f, "near(vertex {vertex}, {radius})"),
            Self::Near { body: Body::B, vertex, radius } => write!(f, "near(b vertex {vertex}, {radius})"),
            Self::Not(one) if matches!(**one, Self::All(_) | Self::Any(_)) => write!(f, "!({one})"),
            Self::Not(one) => write!(f, "!{one}"),
            Self::All(all) => joined(f, all, " & ", |one| matches!(one, Self::Any(_) | Self::All(_))),
            Self::Any(all) => joined(f, all, " | ", |one| matches!(one, Self::Any(_))),
        }
    }
}
