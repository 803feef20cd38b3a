//! How likely a plugin that guesses keeps its rank.
//!
//! It keeps it when every control question that it guesses at happens to be answered rightly. Which questions are controls it
//! cannot tell: they come in the same order, from the same objects, and were drawn after it was fixed.

/// The control questions of a run, as far as guessing is concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Guessing {
    /// Controls.
    pub controls: u32,
    /// Those that the best single answer is right on.
    pub alike: u32,
}

impl Guessing {
    /// The probability that one answer is right on all of so many controls, whichever these are.
    pub fn right_on(self, guessed: u32) -> f64 {
        let Self { controls, alike } = self;
        let left = |of: u32, i: u32| f64::from(of.saturating_sub(i));
        (0..guessed.min(controls)).map(|i| left(alike, i) / left(controls, i)).product()
    }

    /// An upper bound for a plugin that looks at its first `honest` of `asked` questions and gives one answer to all others.
    /// The controls stand evenly among the questions: in every `asked / controls` in a row there is one.
    pub fn keeps_rank_after(self, honest: u64, asked: u64) -> f64 {
        let seen = (u128::from(honest) * u128::from(self.controls)).div_ceil(u128::from(asked.max(1)));
        self.right_on(self.controls - seen.min(u128::from(self.controls)) as u32)
    }

    /// An upper bound for a plugin that guesses at this share of its questions, the same for every control: by one answer, or
    /// by any that is no better.
    pub fn keeps_rank(self, share: f64) -> f64 {
        let Self { controls, alike } = self;
        if controls == 0 {
            return 1.0;
        }
        let caught = share * f64::from(controls - alike.min(controls)) / f64::from(controls);
        libm::pow(1.0 - caught, f64::from(controls))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Numbers;

    /// How often, of so many drawn orders, nothing is answered wrongly: one control in every block of questions, of which so
    /// many have the guessed answer.
    fn simulated(of: Guessing, block: u64, guesses: impl Fn(u64, &mut Numbers) -> Option<bool>) -> f64 {
        const RUNS: u32 = 200_000;
        let mut numbers = Numbers::new(7);
        let mut kinds: Vec<bool> = (0..of.controls).map(|i| i < of.alike).collect();
        let kept = (0..RUNS).filter(|_| {
            numbers.shuffle(&mut kinds);
            (0..).zip(&kinds).all(|(i, kind)| {
                let position = i * block + numbers.below(block as usize) as u64;
                guesses(position, &mut numbers).is_none_or(|guess| guess == *kind)
            })
        });
        kept.count() as f64 / f64::from(RUNS)
    }

    #[test]
    fn plugins_that_guess_are_kept_no_more_often_than_that() {
        let of = Guessing { controls: 6, alike: 3 };
        for honest in [0, 7, 15, 18, 23, 30] {
            let kept = simulated(of, 5, |position, _| (position >= honest).then_some(true));
            let bound = of.keeps_rank_after(honest, 30);
            assert!(kept <= bound + 0.004, "{honest}: {kept} of {bound}");
            // Where the honest part ends with a block, it is what happens.
            assert!(honest % 5 > 0 || (kept - bound).abs() < 0.004, "{honest}: {kept} instead of {bound}");
        }
        for share in [0.1, 0.5, 1.0] {
            let chance = |numbers: &mut Numbers| (numbers.bits() >> 11) as f64 / (1u64 << 53) as f64;
            let constant = simulated(of, 5, |_, numbers| (chance(numbers) < share).then_some(true));
            let coin = simulated(of, 5, |_, numbers| (chance(numbers) < share).then(|| numbers.below(2) == 0));
            let bound = of.keeps_rank(share);
            assert!(constant <= bound + 0.004, "{share}: {constant} of {bound}");
            assert!((coin - bound).abs() < 0.004, "{share}: {coin} instead of {bound}");
        }
    }

    #[test]
    fn without_controls_every_guess_passes_and_with_one_truth_as_well() {
        for of in [Guessing { controls: 0, alike: 0 }, Guessing { controls: 40, alike: 40 }] {
            assert_eq!([of.keeps_rank(1.0), of.keeps_rank_after(0, 200), of.right_on(9)], [1.0; 3]);
        }
        let of = Guessing { controls: 24, alike: 12 };
        assert!(of.keeps_rank(0.5) < 1.01e-3 && of.keeps_rank_after(40, 120) < 1e-5);
        // More than can be right by one answer.
        assert_eq!([of.right_on(13), of.keeps_rank_after(0, 120), of.right_on(0)], [0.0, 0.0, 1.0]);
    }
}
