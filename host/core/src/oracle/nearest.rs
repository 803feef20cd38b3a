//! The certified distance: best-first search with a feasible bound above and separating directions below.

use super::closest::{Closest, closest};
use super::filter;
use super::scene::Scene;
use crate::bvh::BestFirst;

/// Distances in the scene's unit; the true one is in `[lo, hi]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    /// Realises `hi`; meets when `hit`.
    pub(crate) pair: [u32; 2],
    pub(crate) hit: bool,
    pub(crate) exact_used: bool,
}

/// How narrow the interval shall be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// As f64 gives it (some ten `u S`); exact arithmetic only where f64 says too little.
    Enough,
    /// Neighbouring f64 numbers, always by exact arithmetic.
    Tightest,
}

/// Interval widths up to this many `u S` are left to f64.
const WIDTH: f64 = 512.0;

/// The nearest pair of triangles; `start` is a pair believed to be near.
pub(crate) fn nearest(scene: &Scene, start: Option<[u32; 2]>, effort: Effort) -> Nearest {
    let mut search = Search { scene, hi: f64::INFINITY, best: [0, 0], candidates: Vec::new(), exact_used: false };
    match search.run(start) {
        Some(pair) => Nearest { lo: 0.0, hi: 0.0, pair, hit: true, exact_used: search.exact_used },
        None => search.settle(effort),
    }
}

/// The nearest of some pairs, when all others are known to be at least `beyond` apart.
pub(crate) fn nearest_among(scene: &Scene, pairs: &[[u32; 2]], beyond: f64) -> Nearest {
    let mut search = Search { scene, hi: f64::INFINITY, best: [0, 0], candidates: Vec::new(), exact_used: false };
    match pairs.iter().find(|&&pair| search.look(pair)) {
        Some(&pair) => Nearest { lo: 0.0, hi: 0.0, pair, hit: true, exact_used: search.exact_used },
        None => {
            let found = search.settle(Effort::Enough);
            Nearest { lo: found.lo.min(beyond), ..found }
        }
    }
}

struct Candidate {
    pair: [u32; 2],
    near: Closest,
}

struct Search<'s, 'p> {
    scene: &'s Scene<'p>,
    hi: f64,
    best: [u32; 2],
    /// Pairs whose lower bound was below `hi` when they were seen.
    candidates: Vec<Candidate>,
    exact_used: bool,
}

impl Search<'_, '_> {
    /// Visits all pairs that may be nearest; returns the first that meets.
    fn run(&mut self, start: Option<[u32; 2]>) -> Option<[u32; 2]> {
        let scene = self.scene;
        let Some(frame) = &scene.frame else {
            return scene.all_pairs().find(|&pair| self.look(pair));
        };
        if let Some(pair) = start
            && self.look(pair)
        {
            return Some(pair);
        }
        let (root_a, root_b) = frame.roots();
        if let Some(pair) = frame.nearby()
            && self.look(pair)
        {
            return Some(pair);
        }
        let mut queue = BestFirst::default();
        queue.push(0.0, root_a, root_b);
        while let Some((bound, a, b)) = queue.pop() {
            if f64::from(bound) >= self.hi {
                break;
            }
            if let Some(pair) = frame.triangles(a, b) {
                if Some(pair) != start && self.look(pair) {
                    return Some(pair);
                }
                continue;
            }
            frame.expand(a, b, |a, b, child_bound| {
                if f64::from(child_bound) < self.hi {
                    queue.push(child_bound.max(bound), a, b);
                }
            });
        }
        None
    }

    /// Compares two triangles; true when they meet.
    fn look(&mut self, pair: [u32; 2]) -> bool {
        let (a, b) = self.scene.triangles(pair);
        let near = closest(&a, &b);
        // Also where numbers are out of range: the lower bound is never NaN.
        if near.lo <= 0.0 {
            let meets = filter::hit(&a, &b).unwrap_or_else(|| {
                self.exact_used = true;
                self.scene.exact(pair).hit()
            });
            if meets {
                return true;
            }
        }
        if near.hi < self.hi {
            self.hi = near.hi;
            self.best = pair;
        }
        if near.lo < self.hi {
            self.candidates.push(Candidate { pair, near });
        }
        false
    }

    /// The interval over all candidates; none of them meets.
    fn settle(mut self, effort: Effort) -> Nearest {
        let scene = self.scene;
        // Below this, intervals of f64 say too little about the distance.
        let width = WIDTH * scene.epsilon;
        let all = effort == Effort::Tightest || self.hi <= 2.0 * width;
        let (mut lo, mut hi, mut best) = (f64::INFINITY, f64::INFINITY, self.best);
        for Candidate { pair, near } in &self.candidates {
            if near.lo >= self.hi {
                continue;
            }
            let (l, h) = if all || near.lo < self.hi - width {
                self.exact_used = true;
                let (l, h) = scene.exact(*pair).distance();
                (l / scene.unit, h / scene.unit)
            } else {
                (near.lo, near.hi)
            };
            lo = lo.min(l);
            if h < hi {
                (hi, best) = (h, *pair);
            }
        }
        Nearest { lo, hi, pair: best, hit: false, exact_used: self.exact_used }
    }
}
