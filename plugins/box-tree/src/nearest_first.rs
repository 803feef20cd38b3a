//! A queue that gives the nearest pair of boxes first, nearly.

/// Sorted into classes of about a tenth of the distance; within a class, the latest first.
///
/// A heap gives the very nearest, but at tens of thousands of open pairs it costs more than the box tests, and exact order
/// within a class saves none of them.
#[derive(Debug)]
pub struct NearestFirst {
    classes: Vec<Vec<(f64, [u32; 2])>>,
    /// No class before this one has a pair.
    nearest: usize,
    /// What `raw_class` says of the farthest class that is kept apart.
    farthest: usize,
}

/// Eight classes to a factor of two, over a factor of two to the 24th; all that is nearer is in the first class.
const CLASSES: usize = 192;

impl Default for NearestFirst {
    fn default() -> Self {
        Self { classes: vec![Vec::new(); CLASSES], nearest: CLASSES, farthest: 0 }
    }
}

impl NearestFirst {
    /// Empties the queue for bounds up to `limit`.
    pub fn restart(&mut self, limit: f64) {
        self.classes.iter_mut().for_each(Vec::clear);
        self.nearest = CLASSES;
        self.farthest = raw_class(limit);
    }

    /// Puts in a pair with a lower bound of its distance.
    #[inline(always)]
    pub fn push(&mut self, bound: f64, pair: [u32; 2]) {
        let class = (raw_class(bound) + CLASSES - 1).saturating_sub(self.farthest).min(CLASSES - 1);
        self.nearest = self.nearest.min(class);
        self.classes[class].push((bound, pair));
    }

    /// Takes a pair of the nearest class that has one.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<(f64, [u32; 2])> {
        while let Some(class) = self.classes.get_mut(self.nearest) {
            if let Some(next) = class.pop() {
                return Some(next);
            }
            self.nearest += 1;
        }
        None
    }
}

/// Exponent and three bits of the fraction: grows with the number, for numbers that are not negative.
#[inline(always)]
fn raw_class(bound: f64) -> usize {
    (bound.to_bits() >> 49) as usize
}
