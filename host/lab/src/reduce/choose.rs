//! The choice for all objects together.

use std::sync::atomic::{AtomicU64, Ordering};

use ocb_advice::{Share, Watch};
use ocb_core::configuration::Configuration;
use ocb_core::lod::Interval;
use rayon::prelude::*;

use super::between::{between, keep, of_balls};
use super::stand_in::StandIn;
use crate::model::{ChangedAnswer, LaterQueries, ReduceTerms};

/// ChangedAnswer answers that are listed.
const LISTED: usize = 20;
/// This share of the recording is left out, at its end.
const LATER: usize = 5;
/// With fewer groups, queries are left out instead.
const FEWEST_GROUPS: usize = 10;

/// A query about two objects.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// By their places in the scene.
    pub objects: [u32; 2],
    /// Their poses.
    pub configuration: Configuration,
    /// Up to which distance the answer is yes; absent where the distance is asked.
    pub limit: Option<f64>,
    /// To which group it belongs.
    pub group: u64,
    /// Its place in the recording.
    pub row: u32,
    /// The distance of the objects themselves.
    pub truth: Interval,
}

/// What is asked, and what may stand for each object: the simplest first, the object itself last.
pub struct Problem {
    /// In the order of the recording.
    pub asked: Vec<Asked>,
    /// By object.
    pub stand_ins: Vec<Vec<StandIn>>,
    terms: ReduceTerms,
}

/// Of each object, by its place in the scene: which of its stand-ins.
pub type Chosen = Vec<usize>;

impl Problem {
    /// Finds the truth of each query; nothing when it was stopped.
    pub fn certify(
        asked: Vec<Asked>,
        stand_ins: Vec<Vec<StandIn>>,
        terms: ReduceTerms,
        watch: &dyn Watch,
    ) -> Option<Self> {
        let own: Chosen = stand_ins.iter().map(|all| all.len() - 1).collect();
        let mut problem = Self { asked, stand_ins, terms };
        let all: Vec<&Asked> = problem.asked.iter().collect();
        let truth = |asked: &Asked| between(problem.bodies(asked, &own), &asked.configuration);
        let truths = problem.each(&all, watch, truth)?;
        for (asked, truth) in problem.asked.iter_mut().zip(truths) {
            asked.truth = truth;
        }
        Some(problem)
    }

    /// Something of each of these queries, on all CPUs; nothing when it was stopped.
    pub fn each<T: Send>(
        &self,
        asked: &[&Asked],
        watch: &dyn Watch,
        find: impl Fn(&Asked) -> T + Sync,
    ) -> Option<Vec<T>> {
        let (done, total) = (AtomicU64::new(0), asked.len() as u64);
        let one = |asked: &&Asked| {
            watch.step("queries", done.fetch_add(1, Ordering::Relaxed), total);
            (!watch.stopped()).then(|| find(asked))
        };
        asked.par_iter().map(one).collect()
    }

    /// All queries.
    pub fn all(&self) -> Vec<u32> {
        (0..self.asked.len() as u32).collect()
    }

    /// The queries to choose by, and the later ones to check by: the last groups, or the last queries where there are few groups.
    pub fn split(&self) -> (Vec<u32>, Vec<u32>) {
        let mut groups: Vec<u64> = Vec::new();
        for asked in &self.asked {
            if groups.last() != Some(&asked.group) {
                groups.push(asked.group);
            }
        }
        let at = if groups.len() >= FEWEST_GROUPS {
            let first = groups.len() - groups.len() / LATER;
            let mut number = 0;
            let starts = |at: &usize| {
                number += usize::from(*at > 0 && self.asked[*at].group != self.asked[*at - 1].group);
                number == first
            };
            (0..self.asked.len()).find(starts).unwrap_or(self.asked.len())
        } else {
            self.asked.len() - self.asked.len() / LATER
        };
        let mut seen = self.all();
        let later = seen.split_off(at);
        (seen, later)
    }

    /// The simplest bodies that keep the answers of these queries on these terms; nothing when it was stopped.
    ///
    /// Objects that are asked about most often, and have most triangles, come first. At first each pair may use half of the
    /// tolerance, so that no object takes all of it from the others.
    pub fn choose(&self, rows: &[u32], terms: ReduceTerms, watch: &dyn Watch) -> Option<Chosen> {
        let mut of_object: Vec<Vec<&Asked>> = vec![Vec::new(); self.stand_ins.len()];
        for row in rows {
            let asked = &self.asked[*row as usize];
            let [a, b] = asked.objects;
            of_object[a as usize].push(asked);
            if a != b {
                of_object[b as usize].push(asked);
            }
        }
        // What is close decides most often.
        for asked in &mut of_object {
            asked.sort_by(|x, y| x.truth.hi.total_cmp(&y.truth.hi));
        }
        let mut chosen: Chosen = self.stand_ins.iter().map(|all| all.len() - 1).collect();
        let mut order: Vec<usize> = (0..chosen.len()).collect();
        let weight = |object: usize| self.stand_ins[object][chosen[object]].elements * of_object[object].len() as u64;
        order.sort_by_key(|object| std::cmp::Reverse(weight(*object)));
        let total = 2 * order.len() as u64;
        let mut done = 0;
        for share in [0.5, 1.0] {
            let terms = terms.times(share);
            for &object in &order {
                watch.step("choosing", done, total);
                done += 1;
                for simpler in 0..chosen[object] {
                    let mut tried = chosen.clone();
                    tried[object] = simpler;
                    let keeps = |asked: &&Asked| !watch.stopped() && self.keeps(asked, &tried, &terms);
                    let kept = of_object[object].par_iter().all(keeps);
                    if watch.stopped() {
                        return None;
                    }
                    if kept {
                        chosen = tried;
                        break;
                    }
                }
            }
        }
        Some(chosen)
    }

    /// What became of later queries; nothing when it was stopped.
    pub fn hold(&self, chosen: &Chosen, rows: &[u32], watch: &dyn Watch) -> Option<LaterQueries> {
        let judge = |asked: &Asked| (!self.keeps(asked, chosen, &self.terms)).then(|| self.changed(asked, chosen));
        let asked: Vec<&Asked> = rows.iter().map(|row| &self.asked[*row as usize]).collect();
        let mut changed: Vec<ChangedAnswer> = self.each(&asked, watch, judge)?.into_iter().flatten().collect();
        let missed = changed.iter().filter(|changed| changed.missed).count() as u64;
        let share = Share::of(changed.len() as u32, rows.len() as u32);
        changed.sort_by(|x, y| y.missed.cmp(&x.missed).then(y.off().total_cmp(&x.off())));
        changed.truncate(LISTED);
        Some(LaterQueries { queries: rows.len() as u64, changed: share, missed, examples: changed })
    }

    /// Both intervals of a query whose answer changed.
    fn changed(&self, asked: &Asked, chosen: &Chosen) -> ChangedAnswer {
        let reduced = self.reduced(asked, chosen);
        ChangedAnswer {
            row: asked.row,
            objects: asked.objects,
            distance: [asked.truth.lo, asked.truth.hi],
            reduced: [reduced.lo, reduced.hi],
            missed: self.misses(asked, reduced),
        }
    }

    /// The objects certainly meet, and what stands for them certainly does not.
    pub fn misses(&self, asked: &Asked, reduced: Interval) -> bool {
        !self.terms.outside_only && asked.truth.hi == 0.0 && reduced.lo > 0.0
    }

    /// The distance of what stands for the objects.
    pub fn reduced(&self, asked: &Asked, chosen: &Chosen) -> Interval {
        if self.is_unchanged(asked, chosen) {
            return asked.truth;
        }
        between(self.bodies(asked, chosen), &asked.configuration)
    }

    fn keeps(&self, asked: &Asked, chosen: &Chosen, terms: &ReduceTerms) -> bool {
        if self.is_unchanged(asked, chosen) {
            return true;
        }
        let bodies = self.bodies(asked, chosen);
        let balls = Interval { lo: of_balls(bodies, &asked.configuration), hi: f64::INFINITY };
        // Most pairs of a scene are far apart.
        asked.limit.is_some() && keep(terms, asked.limit, asked.truth, balls)
            || keep(terms, asked.limit, asked.truth, between(bodies, &asked.configuration))
    }

    /// Are both objects themselves?
    pub fn is_unchanged(&self, asked: &Asked, chosen: &Chosen) -> bool {
        asked.objects.iter().all(|object| chosen[*object as usize] + 1 == self.stand_ins[*object as usize].len())
    }

    /// What was asked for.
    pub fn terms(&self) -> ReduceTerms {
        self.terms
    }

    fn bodies(&self, asked: &Asked, chosen: &Chosen) -> [&super::body::Body; 2] {
        asked.objects.map(|object| &*self.stand_ins[object as usize][chosen[object as usize]].body)
    }
}
