//! The order in which a process is asked: the set's questions with the controls among them.
//!
//! The two orders stay as they are, and every beginning of what is woven has its share of controls: an algorithm whose budget
//! ends has answered as many of them as all others have who came as far.

use std::ops::Range;

use ocb_core::numbers::Numbers;

/// The first controls of a process stand in blocks of this many questions of the set, however few controls there are, so that
/// a plugin that is honest for its first 40 questions has seen at least eight.
const BLOCK: usize = 4;
const DENSE: usize = 10;

/// A part of both orders.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Piece {
    /// Of the set's questions.
    pub own: Range<usize>,
    /// Of the controls.
    pub controls: Range<usize>,
}

impl Piece {
    /// Nothing of the set is in it.
    pub fn is_empty(&self) -> bool {
        self.own.is_empty()
    }

    /// How many questions it has, controls included.
    pub fn questions(&self) -> usize {
        self.own.len() + self.controls.len()
    }

    /// What of it lies before this end.
    pub fn before(&self, reach: Reach) -> Self {
        let cut = |range: &Range<usize>, end: usize| range.start..end.clamp(range.start, range.end);
        Self { own: cut(&self.own, reach.own), controls: cut(&self.controls, reach.controls) }
    }
}

/// An end in both orders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reach {
    /// Questions of the set before it.
    pub own: usize,
    /// Controls before it.
    pub controls: usize,
}

/// How many of `own` questions go with each of so many controls, one block after the other.
pub fn blocks(own: usize, controls: usize) -> Vec<Range<usize>> {
    let dense = if controls * BLOCK < own { controls.min(DENSE) } else { 0 };
    let (rest, others) = (own - dense * BLOCK, controls - dense);
    let end = |i: usize| if i <= dense { i * BLOCK } else { dense * BLOCK + rest * (i - dense) / others.max(1) };
    (0..controls).map(|i| end(i)..end(i + 1)).collect()
}

/// One control somewhere in each block, drawn by the seed.
pub fn evenly(own: &[u32], controls: &[u32], seed: u64) -> Vec<u32> {
    let mut numbers = Numbers::new(seed);
    let mut order = Vec::with_capacity(own.len() + controls.len());
    let blocks = blocks(own.len(), controls.len());
    let woven = blocks.last().map_or(0, |last| last.end);
    for (block, control) in blocks.into_iter().zip(controls) {
        let (before, behind) = own[block.clone()].split_at(numbers.below(block.len() + 1));
        order.extend(before.iter().chain([control]).chain(behind));
    }
    order.extend(&own[woven..]);
    order
}

/// Each control right behind the question that it departs from; both come in ascending order.
pub fn behind(own: &[u32], controls: &[u32], from: impl Fn(u32) -> u32) -> Vec<u32> {
    let mut order = Vec::with_capacity(own.len() + controls.len());
    let mut left = controls.iter().peekable();
    for &question in own {
        order.push(question);
        while let Some(&control) = left.next_if(|control| from(**control) <= question) {
            order.push(control);
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Controls have numbers from 1,000,000 on.
    fn numbers(own: usize, controls: usize) -> [Vec<u32>; 2] {
        [(0..own as u32).collect(), (1_000_000..1_000_000 + controls as u32).collect()]
    }

    fn is_control(number: &u32) -> bool {
        *number >= 1_000_000
    }

    #[test]
    fn every_beginning_has_its_share_and_forty_questions_have_eight() {
        for (own, controls) in [(1, 24), (10, 24), (96, 24), (500, 125), (5003, 1251), (100_000, 10_000), (50, 9)] {
            let [questions, extra] = numbers(own, controls);
            for seed in 0..5 {
                let order = evenly(&questions, &extra, seed);
                let [mut q, mut c] = [Vec::new(), Vec::new()];
                for (i, &number) in order.iter().enumerate() {
                    if is_control(&number) {
                        c.push(number)
                    } else {
                        q.push(number)
                    }
                    let due = (i + 1) * controls / (own + controls);
                    assert!(c.len() + 1 >= due, "{own} {controls}: {} of {}", c.len(), i + 1);
                }
                assert_eq!((q, c), (questions.clone(), extra.clone()), "both keep their order");
                if order.len() >= 40 {
                    assert!(order[..40].iter().filter(|n| is_control(n)).count() >= 8, "{own} {controls}");
                }
            }
            assert!(controls < 2 || own < 2 || evenly(&questions, &extra, 1) != evenly(&questions, &extra, 2));
        }
    }

    #[test]
    fn a_control_of_a_trajectory_stands_right_behind_its_frame() {
        let [questions, extra] = numbers(6, 3);
        let from = |control: u32| [0, 2, 2][(control - 1_000_000) as usize];
        assert_eq!(behind(&questions, &extra, from), [0, 1_000_000, 1, 2, 1_000_001, 1_000_002, 3, 4, 5]);
    }

    #[test]
    fn what_is_cut_has_a_beginning_of_both() {
        let piece = Piece { own: 10..20, controls: 4..7 };
        let all = |own, controls| piece.before(Reach { own, controls });
        assert_eq!(all(14, 5), Piece { own: 10..14, controls: 4..5 });
        assert_eq!(all(50, 50), piece);
        assert!(all(3, 1).is_empty() && all(3, 1).questions() == 0 && piece.questions() == 13);
    }
}
