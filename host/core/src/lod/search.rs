//! Questions to a pair of levels of detail: one traversal, the smallest bound first.

use super::Lod;
use crate::bvh::{BestFirst, Frame, Slot};
use crate::configuration::Configuration;
use crate::oracle::scene::{LARGEST, reach};
use crate::oracle::triangle::Triangle;
use crate::oracle::{U64, closest, filter};

/// What frames may stretch lengths, with what the sums below may lose.
const STRETCH: f64 = 1.0 + 2e-6;
/// Pairs of triangles about which nothing can be said before the whole question is given up.
const MOST_UNDECIDED: u32 = 8;

/// A distance certainly not below `lo` and not above `hi`, in the objects' lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower bound.
    pub lo: f64,
    /// Upper bound.
    pub hi: f64,
}

impl Interval {
    /// How much it leaves open.
    pub fn width(&self) -> f64 {
        self.hi - self.lo
    }

    /// The best single number: wrong by at most half the width.
    pub fn middle(&self) -> f64 {
        self.lo / 2.0 + self.hi / 2.0
    }
}

/// Is the distance more than a clearance?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Certainly more.
    Clear,
    /// Certainly not more.
    Closer,
    /// These levels cannot tell.
    Undecided,
}

/// Levels of detail of the two objects of a scene.
#[derive(Clone, Copy, Debug)]
pub struct LodPair<'a> {
    a: &'a Lod,
    b: &'a Lod,
}

impl<'a> LodPair<'a> {
    /// `a` stands for object A, `b` for object B.
    pub fn new(a: &'a Lod, b: &'a Lod) -> Self {
        Self { a, b }
    }

    /// How many triangles both have.
    pub fn triangles(&self) -> usize {
        self.a.shape.triangles().len() + self.b.shape.triangles().len()
    }

    /// What the interval of any configuration is wide at most.
    pub fn most_width(&self) -> f64 {
        self.a.width() + self.b.width()
    }

    /// The distance of the objects; the search ends as soon as the interval is not wider than `width`.
    pub fn distance(&self, configuration: &Configuration, width: f64) -> Interval {
        let Some(search) = Search::new(self, configuration) else {
            return Interval { lo: 0.0, hi: f64::INFINITY };
        };
        let found = search.distance(width / search.frame.unit);
        Interval { lo: found.lo * search.frame.unit, hi: found.hi * search.frame.unit }
    }

    /// Is the distance of the objects more than `clearance`?
    pub fn clearance(&self, configuration: &Configuration, clearance: f64) -> Answer {
        match Search::new(self, configuration) {
            Some(search) => search.clearance(clearance / search.frame.unit),
            None => Answer::Undecided,
        }
    }
}

/// One configuration; lengths are in the frame's unit, a power of two, so that changing units rounds nothing.
struct Search<'s> {
    pair: &'s LodPair<'s>,
    configuration: &'s Configuration,
    frame: Frame<'s>,
    /// The levels' thickness by slot, where they have any.
    reach: Option<[&'s [f32]; 2]>,
}

impl<'s> Search<'s> {
    fn new(pair: &'s LodPair, configuration: &'s Configuration) -> Option<Self> {
        let (a, b) = (&pair.a.shape, &pair.b.shape);
        let size = reach(&configuration.pose_a, a).max(reach(&configuration.pose_b, b));
        if size.is_nan() || size > LARGEST {
            return None;
        }
        let frame = Frame::new(a.tree(), &configuration.pose_a, b.tree(), &configuration.pose_b, size)?;
        let slots = |lod: &'s Lod| lod.leeway.as_ref().map_or(&[] as &[f32], |l| &l.reach);
        let reach = (pair.a.leeway.is_some() || pair.b.leeway.is_some()).then(|| [slots(pair.a), slots(pair.b)]);
        Some(Self { pair, configuration, frame, reach })
    }

    fn distance(&self, width: f64) -> Interval {
        let mut seen = Interval { lo: f64::INFINITY, hi: f64::INFINITY };
        let look = |seen: &mut Interval, pair: [u32; 2]| {
            let found = self.leaves(pair);
            seen.lo = seen.lo.min(found.lo);
            seen.hi = seen.hi.min(found.hi);
        };
        if let Some(pair) = self.frame.nearby() {
            look(&mut seen, pair);
        }
        let mut queue = BestFirst::default();
        let (a, b) = self.frame.roots();
        queue.push(0.0, a, b);
        while let Some((bound, a, b)) = queue.pop() {
            let least = f64::from(bound).min(seen.lo);
            // Nothing that waits is nearer than `least`.
            if f64::from(bound) >= seen.lo || seen.hi - least <= width {
                seen.lo = least;
                break;
            }
            match self.frame.triangles(a, b) {
                Some(pair) => look(&mut seen, pair),
                None => self.expand(a, b, |a, b, child| {
                    if f64::from(child) < seen.lo {
                        queue.push(child.max(bound), a, b);
                    }
                }),
            }
        }
        seen
    }

    fn clearance(&self, clearance: f64) -> Answer {
        let mut undecided = 0;
        let mut queue = BestFirst::default();
        let (a, b) = self.frame.roots();
        queue.push(0.0, a, b);
        while let Some((bound, a, b)) = queue.pop() {
            let Some(pair) = self.frame.triangles(a, b) else {
                self.expand(a, b, |a, b, child| {
                    if f64::from(child) <= clearance {
                        queue.push(child.max(bound), a, b);
                    }
                });
                continue;
            };
            let found = self.leaves(pair);
            if found.hi <= clearance {
                return Answer::Closer;
            }
            if found.lo <= clearance {
                undecided += 1;
                if undecided == MOST_UNDECIDED {
                    break;
                }
            }
        }
        if undecided == 0 { Answer::Clear } else { Answer::Undecided }
    }

    /// The interval that two triangles alone would give.
    fn leaves(&self, [i, j]: [u32; 2]) -> Interval {
        let unit = self.frame.unit;
        let Configuration { pose_a, pose_b } = self.configuration;
        let a = Triangle::mapped(pose_a, &self.pair.a.shape.corners(i), 1.0 / unit);
        let b = Triangle::mapped(pose_b, &self.pair.b.shape.corners(j), 1.0 / unit);
        let mut near = closest(&a, &b);
        // Of triangles that cross it finds two points that are not one.
        if near.lo <= 0.0 && filter::hit(&a, &b) == Some(true) {
            near.hi = 0.0;
        }
        if self.reach.is_none() {
            return Interval { lo: near.lo, hi: near.hi };
        }
        let ([e_a, g_a], [e_b, g_b]) = (self.pair.a.lengths(i), self.pair.b.lengths(j));
        // Numbers below the normal range would round in the scaling.
        let both = |x: f64, y: f64| (x + y) / unit * STRETCH + f64::MIN_POSITIVE;
        Interval {
            lo: ((near.lo - both(e_a, e_b)) * (1.0 - 4.0 * U64)).max(0.0),
            hi: (near.hi + both(g_a, g_b)) * (1.0 + 4.0 * U64),
        }
    }

    /// The children of the larger box with bounds of what the objects are apart there.
    fn expand(&self, a: Slot, b: Slot, mut visit: impl FnMut(Slot, Slot, f32)) {
        self.frame.expand(a, b, |a, b, bound| {
            let bound = match self.reach {
                Some(of) => self.frame.less(bound, [a.of(of[0]), b.of(of[1])]),
                None => bound,
            };
            visit(a, b, bound);
        });
    }
}
