//! The part of a segment that lies in a Voronoi region.

use crate::polyhedron::Feature;

/// The rest of a segment after cutting it by planes.
pub struct Clip {
    /// Parameters: 0 at the tail, 1 at the head.
    pub span: [f64; 2],
    /// The features behind the planes that cut its ends; none at an end of the segment itself.
    pub by: [Option<Feature>; 2],
}

impl Clip {
    /// The whole segment.
    pub fn new() -> Self {
        Self { span: [0.0, 1.0], by: [None; 2] }
    }

    /// Cuts by a plane before `feature`, given how far tail and head lie inside. False if the whole segment lies outside.
    #[inline]
    pub fn cut(&mut self, tail: f64, head: f64, feature: Feature) -> bool {
        let end = match (tail < 0.0, head < 0.0) {
            (true, true) => return false,
            (false, false) => return true,
            (true, false) => 0,
            (false, true) => 1,
        };
        let at = tail / (tail - head);
        if (end == 0 && at > self.span[0]) || (end == 1 && at < self.span[1]) {
            self.span[end] = at;
            self.by[end] = Some(feature);
        }
        true
    }

    /// Whether planes that each leave a part of the segment leave nothing together.
    pub fn is_empty(&self) -> bool {
        self.span[0] > self.span[1]
    }

    /// The feature behind an end from which the distance decreases outwards. `slope` is the derivative of the distance from
    /// a feature at a parameter.
    #[inline]
    pub fn nearer(&self, slope: impl Fn(Feature, f64) -> f64) -> Option<Feature> {
        let low = self.by[0].filter(|&feature| slope(feature, self.span[0]) > 0.0);
        low.or_else(|| self.by[1].filter(|&feature| slope(feature, self.span[1]) < 0.0))
    }
}
