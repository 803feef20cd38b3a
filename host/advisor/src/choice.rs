//! Which levels of detail are enough for a question on some configurations.

use ocb_advice::{Levels, Question, Watch};
use ocb_core::configuration::{Configuration, Placed};
use ocb_core::lod::{Answer, LodPair};
use ocb_core::oracle::Pair;
use rayon::prelude::*;

use crate::ladder::Level;
use crate::question::Hybrid;
use crate::timing::{Way, times, way};

/// Configurations on which the steps of a choice are timed; the result is measured on all of them afterwards.
const TRIED: usize = 200;

/// The ladders of a scene's objects.
#[derive(Clone, Copy)]
pub(crate) struct Ladders<'a> {
    pub(crate) a: &'a [Level],
    pub(crate) b: &'a [Level],
}

impl<'a> Ladders<'a> {
    pub(crate) fn pair(&self, [a, b]: Levels) -> LodPair<'a> {
        LodPair::new(&self.a[a].lod, &self.b[b].lod)
    }

    pub(crate) fn hybrid(&self, stages: &[Levels]) -> Hybrid<'a> {
        // The objects themselves come last anyway.
        let stages = stages.iter().filter(|&&levels| levels != [0, 0]).map(|&levels| self.pair(levels)).collect();
        Hybrid { stages, whole: self.pair([0, 0]), oracle: Pair::new(self.a[0].lod.shape(), self.b[0].lod.shape()) }
    }

    /// Both objects step by step, until both are at their coarsest; the objects themselves first.
    pub(crate) fn diagonal(&self) -> Vec<Levels> {
        let last = [self.a.len() - 1, self.b.len() - 1];
        (0..=last[0].max(last[1])).map(|k| [k.min(last[0]), k.min(last[1])]).collect()
    }

    /// Do these levels answer by themselves?
    pub(crate) fn suffice(&self, levels: Levels, question: Question, placed: &Placed) -> bool {
        let pair = self.pair(levels);
        match question {
            Question::Distance { tolerance } => {
                pair.distance(&placed.configuration, 2.0 * tolerance).width() <= 2.0 * tolerance
            }
            Question::Clearance { clearance } => pair.clearance(&placed.configuration, clearance) != Answer::Undecided,
        }
    }

    fn finer_or_coarser(&self, [a, b]: Levels) -> impl Iterator<Item = Levels> {
        let (a, b) = (a as isize, b as isize);
        let near = [[a + 1, b], [a, b + 1], [a - 1, b], [a, b - 1]];
        let lens = [self.a.len() as isize, self.b.len() as isize];
        near.into_iter()
            .filter(move |at| (0..2).all(|i| (0..lens[i]).contains(&at[i])))
            .map(|at| at.map(|x| x as usize))
    }
}

/// The levels with the fewest triangles whose intervals fit on every configuration: along the diagonal as far as it
/// goes, then the one object or the other, whichever saves more.
pub(crate) fn smallest(ladders: &Ladders, question: Question, sample: &[Placed], watch: &dyn Watch) -> Option<Levels> {
    let all = |levels: Levels| sample.par_iter().all(|placed| ladders.suffice(levels, question, placed));
    let mut best = [0, 0];
    for levels in ladders.diagonal().into_iter().rev() {
        if watch.stopped() {
            return None;
        }
        if all(levels) {
            best = levels;
            break;
        }
    }
    loop {
        let fewer = |levels: &Levels| ladders.pair(*levels).triangles() < ladders.pair(best).triangles();
        let mut next: Vec<Levels> = ladders.finer_or_coarser(best).filter(fewer).collect();
        next.sort_by_key(|levels| ladders.pair(*levels).triangles());
        match next.into_iter().find(|&levels| all(levels)) {
            Some(levels) if !watch.stopped() => best = levels,
            Some(_) => return None,
            None => return Some(best),
        }
    }
}

/// The stages that answer fastest, found by trying: one pair of levels of the diagonal before the whole objects, then a
/// coarser pair before it, as long as that pays. No stage at all may be the best.
pub(crate) fn fastest(
    ladders: &Ladders,
    question: Question,
    sample: &[Placed],
    watch: &dyn Watch,
) -> Option<Vec<Levels>> {
    // Evenly out of all, so that every distance is among them.
    let apart = sample.len().div_ceil(TRIED);
    let tried: Vec<Configuration> = sample.iter().step_by(apart).map(|placed| placed.configuration).collect();
    let mut best: Vec<Levels> = Vec::new();
    let mut least = f64::INFINITY;
    loop {
        let coarser = |levels: &Levels| best.first().is_none_or(|first| levels.iter().zip(first).all(|(x, y)| x >= y));
        let fresh = ladders.diagonal().into_iter().skip(1).filter(|l| coarser(l) && !best.contains(l));
        let mut candidates: Vec<Vec<Levels>> = fresh.map(|l| [vec![l], best.clone()].concat()).collect();
        candidates.push(best.clone());
        let hybrids: Vec<Hybrid> = candidates.iter().map(|stages| ladders.hybrid(stages)).collect();
        let ways: Vec<Way> = hybrids.iter().map(|hybrid| way(move |c| hybrid.answer(question, c))).collect();
        let sums: Vec<f64> = times(&ways, &tried, 3, watch)?.iter().map(|t| t.iter().flatten().sum()).collect();
        let (winner, sum) =
            sums.iter().enumerate().min_by(|x, y| x.1.total_cmp(y.1)).map(|(i, sum)| (i, *sum)).expect("one at least");
        // What was measured together is compared; a little less is nothing.
        if winner + 1 == candidates.len() || sum > 0.97 * sums[candidates.len() - 1] || sum >= least {
            return Some(best);
        }
        least = sum;
        best = candidates.swap_remove(winner);
    }
}
