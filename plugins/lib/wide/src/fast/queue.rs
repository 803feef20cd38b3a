//! A queue that gives the nearest pair of nodes first, nearly.

use super::tree::Link;

/// Sorted into classes of a sixteenth of a factor of two; within a class, the latest first.
///
/// Entries of a class are a chain through one array, so that nothing moves when one is put in or taken out.
#[derive(Debug, Default)]
pub struct NearestFirst {
    entries: Vec<Entry>,
    /// The latest entry of each class, plus one.
    latest: Vec<u32>,
    /// No class before this one has an entry.
    nearest: usize,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    squared: f32,
    pair: [Link; 2],
    before: u32,
}

const CLASSES: usize = 512;
/// Squares from 2^-56 to 2^8 are told apart.
const FIRST: u32 = (127 - 56) << 3;

impl NearestFirst {
    /// Empties the queue.
    pub fn clear(&mut self) {
        self.entries.clear();
        self.latest.clear();
        self.latest.resize(CLASSES, 0);
        self.nearest = CLASSES;
    }

    /// Puts in a pair with a lower bound of its squared distance, which is not negative.
    #[inline(always)]
    pub fn push(&mut self, squared: f32, pair: [Link; 2]) {
        let class = class(squared);
        self.nearest = self.nearest.min(class);
        let before = self.latest[class];
        self.entries.push(Entry { squared, pair, before });
        self.latest[class] = self.entries.len() as u32;
    }

    /// Takes a pair of the nearest class that has one; none when that class lies beyond a limit.
    #[inline(always)]
    pub fn pop(&mut self, limit: f32) -> Option<(f32, [Link; 2])> {
        let farthest = class(limit);
        while self.nearest <= farthest {
            let latest = self.latest.get_mut(self.nearest)?;
            if let Some(entry) = self.entries.get((*latest as usize).wrapping_sub(1)) {
                *latest = entry.before;
                return Some((entry.squared, entry.pair));
            }
            self.nearest += 1;
        }
        None
    }
}

/// Exponent and three bits of the fraction: grows with the number, for numbers that are not negative.
#[inline(always)]
fn class(squared: f32) -> usize {
    ((squared.to_bits() >> 20).saturating_sub(FIRST) as usize).min(CLASSES - 1)
}
