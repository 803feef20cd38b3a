//! Pairs of nodes that are still to be opened, the latest first.

use ocb_lanes::{Bits, Lanes};

use super::tree::Link;

/// A stack that takes sixteen at once. A and B apart, as the lanes bring them.
#[derive(Debug, Default)]
pub struct Stack {
    /// Longer than what is used, so that there is always room for sixteen.
    of_a: Vec<u32>,
    of_b: Vec<u32>,
    used: usize,
}

const LANES: usize = 16;

impl Stack {
    /// Empties the stack.
    pub fn clear(&mut self) {
        self.used = 0;
    }

    #[inline(always)]
    pub fn len(&self) -> usize {
        self.used
    }

    /// Puts in the pairs of places in these lanes; that of one of them, if it is among them, as the latest.
    #[inline(always)]
    pub fn push<L: Lanes>(&mut self, lanes: Bits, last: usize, a: &[u32; 4], b: &[u32; 4]) {
        let end = self.used + LANES;
        if end > self.of_a.len() {
            self.grow();
        }
        let to_a = self.of_a[self.used..].first_chunk_mut::<LANES>();
        let to_b = self.of_b[self.used..].first_chunk_mut::<LANES>();
        if let (Some(to_a), Some(to_b)) = (to_a, to_b) {
            let others = lanes & !(1 << last);
            let count = others.count_ones() as usize % LANES;
            L::pairs(others, b, a, [to_b, to_a]);
            // Written in any case, kept when it is one of the lanes: no branch waits for the lanes.
            (to_a[count], to_b[count]) = (a[last % 4], b[last / 4 % 4]);
            self.used += lanes.count_ones() as usize;
        }
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self) {
        let more = 2 * self.of_a.len() + 16 * LANES;
        self.of_a.resize(more, 0);
        self.of_b.resize(more, 0);
    }

    /// Takes the latest pair.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<[Link; 2]> {
        self.used = self.used.checked_sub(1)?;
        Some([Link(self.of_a[self.used]), Link(self.of_b[self.used])])
    }

    /// A pair by the order of coming.
    #[inline(always)]
    pub fn get(&self, place: usize) -> [Link; 2] {
        [Link(self.of_a[place]), Link(self.of_b[place])]
    }
}
