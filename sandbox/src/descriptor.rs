//! What a plugin says of one of its algorithms.

use ocb_core::query::Query;
use serde::{Deserialize, Serialize};

/// What a plugin says of one of its algorithms. Text is bounded and free of control characters, and unverified.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Descriptor {
    /// Unique id, e.g. `box-tree`.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Version as the plugin says it.
    pub version: String,
    /// Authors.
    pub authors: String,
    /// SPDX licence expression.
    pub license: String,
    /// Home page or source.
    pub url: String,
    /// The paper the method comes from.
    pub paper: String,
    /// The questions it answers.
    pub queries: Vec<Query>,
    /// It reports BV and primitive tests.
    pub counters: bool,
    /// It has distances with witness points; whether an answer carries them, the answer says.
    pub witness_points: bool,
    /// Computes in f32: its answers are judged in the wider band.
    pub single_precision: bool,
    /// It also answers for solid bodies.
    pub solid: bool,
    /// Earlier queries speed up later ones: the order of queries matters.
    pub coherent: bool,
    /// Can use several CPUs: it may enter the multi-threaded track.
    pub threads: bool,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
}

/// A knob of an algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// What it does.
    pub description: String,
    /// Smallest value.
    pub minimum: f64,
    /// Largest value.
    pub maximum: f64,
    /// Value when nothing is said.
    pub default: f64,
    /// Only whole numbers.
    pub integer: bool,
}

/// Longest text in a descriptor, bytes.
const TEXT_BYTES: usize = 4096;
/// Most parameters of one algorithm.
const PARAMETERS: usize = 64;

impl Descriptor {
    /// Cuts the text, strips control characters, refuses what breaks the interface's rules.
    pub(crate) fn bounded(mut self) -> Result<Self, String> {
        for text in
            [&mut self.name, &mut self.version, &mut self.authors, &mut self.license, &mut self.url, &mut self.paper]
        {
            *text = one_line(text);
        }
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || matches!(c, '-' | '.' | '_');
        let first = self.id.chars().next();
        if !first.is_some_and(|c| c.is_ascii_lowercase()) || self.id.len() > 64 || !self.id.chars().all(plain) {
            return Err(format!("the algorithm id '{}' breaks the rules of plugin.h", one_line(&self.id)));
        }
        if self.parameters.len() > PARAMETERS {
            return Err(format!("'{}' has {} parameters, at most 64 may be", self.id, self.parameters.len()));
        }
        for parameter in &mut self.parameters {
            parameter.name = one_line(&parameter.name);
            parameter.description = one_line(&parameter.description);
            let Parameter { minimum, maximum, default, .. } = *parameter;
            let ordered = minimum <= default && default <= maximum;
            if !ordered || !minimum.is_finite() || !maximum.is_finite() {
                return Err(format!("parameter '{}' of '{}' has no sensible range", parameter.name, self.id));
            }
        }
        Ok(self)
    }
}

fn one_line(text: &str) -> String {
    let mut cut = TEXT_BYTES.min(text.len());
    while !text.is_char_boundary(cut) {
        cut -= 1;
    }
    text[..cut].chars().filter(|c| !c.is_control()).collect()
}
