//! The sphere method: B stands on a sphere around A in some rotation and is moved toward A until the surfaces are as far
//! apart, or as deep in each other, as wanted [OpenCollBench 2020, 3.1; Trenkel 2007].

use super::SamplingError;
use super::low_discrepancy::{self, Sample, share};
use super::paper_pattern::Pattern;
use super::placer::{Placer, Target};
use crate::configuration::{Placed, Sampling, Separation};
use crate::oracle::Shape;

/// The rays of the sphere method.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    placer: Placer<'a>,
    pattern: Option<Pattern>,
    len: u64,
    seed: u64,
}

impl<'a> Plan<'a> {
    pub(super) fn new(
        a: &'a Shape,
        b: &'a Shape,
        sampling: &Sampling,
        len: u64,
        separation: Separation,
        seed: u64,
    ) -> Result<Self, SamplingError> {
        let pattern = match *sampling {
            Sampling::PaperCompat { rotate, move_by } => Some(Pattern::new(rotate, move_by)),
            Sampling::Steps { .. } | Sampling::Count { .. } => None,
        };
        Ok(Self { placer: Placer::new(a, b, separation)?, pattern, len, seed })
    }

    pub(super) fn len(&self) -> u64 {
        self.len
    }

    /// `None` when B never comes that close on its ray.
    ///
    /// A stands where its file puts it; B is rotated about the centre of its bounding box, which moves along a ray through
    /// the centre of A's.
    pub(super) fn place(&self, index: u64) -> Option<Placed> {
        // The paper's pattern has no seed.
        let (seed, (direction, rotation)): (u64, Sample) = match &self.pattern {
            Some(pattern) => (0, pattern.sample(index)),
            None => (self.seed, low_discrepancy::sample(index, self.seed)),
        };
        let target = Target { index, place: share(seed, index) };
        self.placer.place(target, &direction, &rotation)
    }
}
