//! Pairs of boxes, the one with the smallest bound first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::Slot;

/// A queue of pairs of boxes. Among equal bounds the latest comes first, so that deeply overlapping objects, whose
/// bounds are all 0, are searched depth-first.
#[derive(Debug, Default)]
pub(crate) struct BestFirst {
    heap: BinaryHeap<Entry>,
    pushed: u32,
}

impl BestFirst {
    /// `bound` must not be negative.
    pub(crate) fn push(&mut self, bound: f32, a: Slot, b: Slot) {
        self.pushed = self.pushed.wrapping_add(1);
        // The bits of floats that are not negative are ordered as the floats are; -0 becomes 0.
        let key = u64::from((bound + 0.0).to_bits()) << 32 | u64::from(!self.pushed);
        self.heap.push(Entry { key, a, b });
    }

    pub(crate) fn pop(&mut self) -> Option<(f32, Slot, Slot)> {
        self.heap.pop().map(|e| (f32::from_bits((e.key >> 32) as u32), e.a, e.b))
    }
}

#[derive(Debug)]
struct Entry {
    key: u64,
    a: Slot,
    b: Slot,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.key.cmp(&self.key) // the heap gives the greatest, we want the smallest
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl Eq for Entry {}
