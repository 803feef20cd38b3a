//! Where methods fail: questions that are hard on purpose, and what must hold between the answers to them.
//!
//! Pure, as the core is: a family, a value of its parameter and a seed give the same questions on every machine. The lab
//! (`ocb_lab::stability`) asks the algorithms and judges their answers.
#![forbid(unsafe_code)]

pub mod corpus;
pub mod draw;
pub mod families;
pub mod minimise;
pub mod relations;
pub mod search;
pub mod shapes;
pub mod sweep;
pub mod tessellations;

use std::sync::Arc;

use ocb_core::configuration::Configuration;
use ocb_core::mesh::{Mesh, MeshError};
use ocb_core::pose::Pose;

use draw::Draw;

/// Two objects and where they stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Posed {
    /// Object A.
    pub a: Arc<Mesh>,
    /// Object B.
    pub b: Arc<Mesh>,
    /// Where both stand.
    pub configuration: Configuration,
}

impl Posed {
    /// B moves, A does not.
    pub fn new(a: &Arc<Mesh>, b: &Arc<Mesh>, pose_b: Pose) -> Self {
        Self { a: a.clone(), b: b.clone(), configuration: Configuration { pose_a: Pose::identity(), pose_b } }
    }

    /// The same pose on other objects.
    pub fn with(&self, a: Arc<Mesh>, b: Arc<Mesh>) -> Self {
        Self { a, b, configuration: self.configuration }
    }
}

/// What an answer has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// Right, as any answer.
    Judged,
    /// Right for some scene that differs by no more than this length.
    Within(f64),
    /// Anything: it must come in time and end nothing.
    Lasting,
}

/// One question of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// What is asked about.
    pub posed: Posed,
    /// What the answer has to be.
    pub rule: Rule,
    /// An earlier question of the same list that has the same answer, to the last bit.
    pub same_as: Option<usize>,
    /// Of solid bodies.
    pub solid: bool,
}

impl From<Posed> for Question {
    fn from(posed: Posed) -> Self {
        Self { posed, rule: Rule::Judged, same_as: None, solid: false }
    }
}

/// The questions at one value of the parameter for one seed, asked in this order; or why no plugin ever sees them.
pub type Made = Result<Vec<Question>, MeshError>;

/// In which direction of its parameter a family gets harder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Harder {
    /// Toward large values.
    Up,
    /// Toward small values.
    Down,
    /// Away from 0.
    Outward,
}

/// What a family sweeps.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name, with its unit.
    pub name: &'static str,
    /// Its values, ascending.
    pub steps: &'static [f64],
    /// Where it gets harder.
    pub harder: Harder,
    /// Values between two steps make sense; their ratio counts when the steps are decades.
    pub continuous: bool,
}

/// Questions of one kind.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Short name, as on the command line.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// What it tests, one sentence.
    pub sentence: &'static str,
    /// Where such failures were reported.
    pub source: &'static str,
    /// What is swept.
    pub parameter: Parameter,
    /// It asks for more than the plugin interface promises (rotations, finite numbers): shown, and no fault of a method.
    pub beyond: bool,
    /// All contacts are asked for as well.
    pub all_contacts: bool,
    /// The questions.
    make: fn(&mut Draw, f64) -> Made,
}

impl Family {
    /// The questions of one value of the parameter and one seed. Objects that do not depend on the parameter are the same
    /// for all its values, so that one process can answer for all.
    pub fn questions(&self, seed: u32, at: f64) -> Made {
        let name = self.id.bytes().fold(0u64, |sum, byte| sum.wrapping_mul(131).wrapping_add(u64::from(byte)));
        (self.make)(&mut Draw::new(name ^ u64::from(seed)), at)
    }
}
