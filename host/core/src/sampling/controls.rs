//! Control questions: drawn from a run's seed, after the plugins were fixed, and mixed into the set's questions.
//!
//! Every set has one truth on most of its questions; a plugin that gives that answer without looking is right. So some
//! configurations of the set come again with B moved along the line that changes the separation, half of them so that the
//! surfaces cross and half so that they are apart. Their answers are judged like all others, and nothing else is made of them.
//!
//! Moving B by less than the distance, straight toward A's nearest point, leaves exactly the rest of the distance: nothing
//! else can come nearer than that. So most controls take one look at the truth.

use nalgebra::{Unit, Vector3};

use super::approach::{ball, bounds};
use super::low_discrepancy::{direction, mix};
use super::window::Window;
use crate::configuration::{Class, Configuration, ConfigurationSet, Placed, Separation, Truth};
use crate::numbers::Numbers;
use crate::oracle::{Pair, U32};
use crate::query::{Query, Semantics};

/// The nearest controls, as a share of S: 4 tau32, so that they are scored in single precision.
const NEAREST: f64 = 128.0 * U32;
/// The furthest, as a share of S. No control is further than wanted because the set's own separation is: this is easy.
const FURTHEST: f64 = 0.1;
/// Where all contacts are listed: deep crossings have thousands.
const FURTHEST_LISTED: f64 = 0.01;
/// A control is this much nearer than the set's questions at most, as long as that is nearer than `EASY`, a share of S.
const HARDER: f64 = 8.0;
const EASY: f64 = 0.01;
/// A crossing holds when every vertex moves by this share of S: 2 tau32.
const ROBUST: f64 = 64.0 * U32;
/// Configurations of the set that are tried for one control, before the other kind is.
const TRIES: u64 = 6;
/// Moves toward one separation.
const MOVES: u32 = 6;
/// Below this share of S the witness points do not tell a direction.
const DIRECTED: f64 = 1e-12;

/// No rank without so many: fewer could be guessed.
pub const LEAST: u32 = 24;
/// No run has more.
const MOST: u64 = 10_000;

/// How many controls go with so many configurations: one to four, so that a fifth of all questions are controls.
pub fn count(configurations: u64) -> u64 {
    configurations.div_ceil(4).clamp(u64::from(LEAST), MOST)
}

/// A question that the run asks beside the set's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// The configuration with its truth; no distance was wanted.
    pub placed: Placed,
    /// The configuration of the set that it departs from.
    pub from: u32,
}

/// Which of the two answers a control has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Apart,
    Crossing,
}

impl Kind {
    fn other(self) -> Self {
        match self {
            Kind::Apart => Kind::Crossing,
            Kind::Crossing => Kind::Apart,
        }
    }
}

/// The controls of one run, each a pure function of its number.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    pair: Pair<'a>,
    placed: &'a [Placed],
    query: Query,
    semantics: Semantics,
    seed: u64,
    /// Centre of the bounding box and largest distance from it, of either object.
    balls: [(nalgebra::Point3<f64>, f64); 2],
    /// What is typical of the set: its window, or the distance of which a tenth of the set's are nearer.
    asked: Asked,
}

#[derive(Clone, Copy, Debug)]
enum Asked {
    Window(Window),
    Distance(f64),
}

impl<'a> Plan<'a> {
    /// The controls for a set, whose `placed` must not be empty.
    pub fn new(pair: Pair<'a>, set: &'a ConfigurationSet, query: Query, semantics: Semantics, seed: u64) -> Self {
        let asked = match set.separation {
            // The ladder's first step is that of a single precision, and nearer than that is no control.
            Some(Separation::Ladder) => Asked::Distance(0.0),
            Some(one) => {
                let (lo, hi) = bounds(pair.a());
                Asked::Window(Window::new(one, (hi - lo).amax()))
            }
            None => {
                let apart = set.placed.iter().filter(|p| !p.truth.hit);
                let mut distances: Vec<f64> = apart.map(|p| p.truth.distance_hi).collect();
                distances.sort_unstable_by(f64::total_cmp);
                Asked::Distance(distances.get(distances.len() / 10).copied().unwrap_or(0.0))
            }
        };
        let balls = [pair.a(), pair.b()].map(ball);
        Self { pair, placed: &set.placed, query, semantics, seed, balls, asked }
    }

    /// Control `number`, which departs from a configuration of the set within `among`; `None` where B can neither be made to
    /// cross A nor to part from it for certain.
    pub fn draw(&self, number: u64, among: std::ops::Range<usize>) -> Option<Control> {
        let wanted = self.kind(number);
        for (kind, attempt) in [wanted, wanted.other()].into_iter().flat_map(|kind| (0..TRIES).map(move |i| (kind, i)))
        {
            let mut numbers = Numbers::new(mix(mix(self.seed, number), (kind as u64) << 32 | attempt));
            let from = among.start + numbers.below(among.len());
            if let Some(placed) = self.depart(&self.placed[from], kind, &mut numbers) {
                return Some(Control { placed, from: from as u32 });
            }
        }
        None
    }

    /// Controls come in pairs, one of each kind in an order that is drawn, so that every prefix has half of each. Of
    /// distances a quarter crosses: there are many other answers.
    fn kind(&self, number: u64) -> Kind {
        let group: u64 = if self.query == Query::Proximity { 4 } else { 2 };
        let crossing = Numbers::new(mix(!self.seed, number / group)).below(group as usize) as u64;
        if number % group == crossing { Kind::Crossing } else { Kind::Apart }
    }

    /// The nearest and the furthest separation of controls, in a scene of this size S.
    pub fn range(&self, size: f64) -> [f64; 2] {
        let asked = match &self.asked {
            Asked::Window(window) => window.aim(size).0.abs(),
            Asked::Distance(distance) => *distance,
        };
        let least = (asked / HARDER).min(EASY * size).max(NEAREST * size);
        let furthest = if self.query == Query::CollisionAll { FURTHEST_LISTED } else { FURTHEST };
        [least, (furthest * size).max(least)]
    }

    /// B moved so that the objects are apart, or cross, by a separation that is drawn.
    fn depart(&self, from: &Placed, kind: Kind, numbers: &mut Numbers) -> Option<Placed> {
        let aim = Aim { plan: self, share: unit(numbers) };
        let sideways = direction(unit(numbers), unit(numbers));
        let [wanted, _] = aim.at(&from.configuration);
        match kind {
            Kind::Apart => self.part(self.apart(from, wanted, &sideways)?, &aim),
            Kind::Crossing if from.truth.hit => {
                // Still crossing, elsewhere.
                let still = self.certain(moved(&from.configuration, sideways * wanted), Kind::Crossing);
                still.or_else(|| self.certain(moved(&from.configuration, sideways * (wanted / 8.0)), Kind::Crossing))
            }
            Kind::Crossing => self.cross(self.apart(from, wanted, &sideways)?, &aim),
        }
    }

    /// The configuration itself, or B pulled out along the line of the centres until the objects are apart.
    fn apart(&self, from: &Placed, wanted: f64, sideways: &Vector3<f64>) -> Option<(Configuration, Truth)> {
        let is_apart = |c: &Configuration, truth: &Truth| !self.pair.asked(c, truth, self.semantics).hit;
        if is_apart(&from.configuration, &from.truth) {
            return Some((from.configuration, from.truth));
        }
        let [(centre_a, radius_a), (centre_b, radius_b)] = &self.balls;
        let between = from.configuration.pose_b.apply(centre_b) - from.configuration.pose_a.apply(centre_a);
        let outward = Unit::try_new(between, 1e-6 * (radius_a + radius_b)).map_or(*sideways, Unit::into_inner);
        let end = 2.0 * (radius_a + radius_b) + wanted;
        let mut way = wanted;
        loop {
            let outside = moved(&from.configuration, outward * way);
            if !self.pair.hit(&outside) {
                let truth = self.pair.truth(&outside);
                if is_apart(&outside, &truth) {
                    return Some((outside, truth));
                }
            }
            if way >= end {
                return None;
            }
            way = (2.0 * way).min(end);
        }
    }

    /// To a wanted distance: toward A's nearest point, or away from it.
    fn part(&self, (mut at, mut truth): (Configuration, Truth), aim: &Aim) -> Option<Placed> {
        let near = |x: f64, y: f64| (x - y).abs() < 0.1 * y;
        for _ in 0..MOVES {
            let [wanted, _] = aim.at(&at);
            let away = self.away(&at, &truth)?;
            at = moved(&at, away * (wanted - truth.distance_hi));
            truth = self.pair.truth(&at);
            if truth.hit {
                return None;
            }
            if near(truth.distance_hi, aim.at(&at)[0]) {
                break;
            }
        }
        // In a hollow nothing is as far as that.
        let [wanted, least] = aim.at(&at);
        (truth.distance_lo > 0.9 * least && truth.distance_hi < 1.1 * wanted)
            .then(|| self.scored(at, truth, Kind::Apart))
            .flatten()
    }

    /// Through A's nearest point and so much further.
    fn cross(&self, (at, truth): (Configuration, Truth), aim: &Aim) -> Option<Placed> {
        let away = self.away(&at, &truth)?;
        // As large as the scene is when they touch.
        let [wanted, least] = aim.at(&moved(&at, -away * truth.distance_hi));
        let mut depth = wanted;
        for _ in 0..MOVES {
            let found = self.certain(moved(&at, -away * (truth.distance_hi + depth)), Kind::Crossing);
            if found.is_some() || depth <= least {
                return found;
            }
            // Through a thin part and out again, or past it.
            depth = (depth / 4.0).max(least);
        }
        None
    }

    /// From A's nearest point to B's.
    fn away(&self, at: &Configuration, truth: &Truth) -> Option<Vector3<f64>> {
        let between = truth.witness.point_b - truth.witness.point_a;
        let [(centre_a, _), (centre_b, _)] = &self.balls;
        let centres = || at.pose_b.apply(centre_b) - at.pose_a.apply(centre_a);
        let least = DIRECTED * self.pair.scene_size(at);
        between.try_normalize(least).or_else(|| centres().try_normalize(least))
    }

    fn certain(&self, configuration: Configuration, kind: Kind) -> Option<Placed> {
        // The cheap look first: all crossing triangles are looked at for the truth.
        (self.pair.hit(&configuration) == (kind == Kind::Crossing))
            .then(|| self.scored(configuration, self.pair.truth(&configuration), kind))
            .flatten()
    }

    /// Is it of this kind for certain, in both precisions?
    fn scored(&self, configuration: Configuration, truth: Truth, kind: Kind) -> Option<Placed> {
        let asked = self.pair.asked(&configuration, &truth, self.semantics);
        let class = match kind {
            Kind::Apart => Class::Clear,
            Kind::Crossing => Class::Colliding,
        };
        let robust = kind == Kind::Apart || asked.margin > ROBUST * self.pair.scene_size(&configuration);
        (robust && [asked.class64, asked.class32] == [class; 2]).then_some(Placed {
            configuration,
            truth,
            rounded: None,
            root_index: 0,
            wanted: None,
        })
    }
}

/// A separation that is drawn: S, and its share with it, changes with the way there.
struct Aim<'p> {
    plan: &'p Plan<'p>,
    /// Where between the nearest and the furthest; all powers of ten are alike.
    share: f64,
}

impl Aim<'_> {
    /// It, and the nearest of all.
    fn at(&self, configuration: &Configuration) -> [f64; 2] {
        let [least, most] = self.plan.range(self.plan.pair.scene_size(configuration));
        [least * libm::pow(most / least, self.share), least]
    }
}

fn moved(configuration: &Configuration, way: Vector3<f64>) -> Configuration {
    let mut moved = *configuration;
    moved.pose_b.translation += way;
    moved
}

/// From [0, 1).
fn unit(numbers: &mut Numbers) -> f64 {
    (numbers.bits() >> 11) as f64 / (1u64 << 53) as f64
}

/// On how many controls the best single answer is right, in the arithmetic that is judged most kindly.
pub fn alike(pair: &Pair, controls: &[Control], query: Query, semantics: Semantics) -> u32 {
    let asked = |c: &Control| pair.asked(&c.placed.configuration, &c.placed.truth, semantics);
    let crossing = controls.iter().filter(|c| asked(c).hit).count();
    let apart = match query {
        Query::CollisionFirst | Query::CollisionAll => controls.len() - crossing,
        Query::Proximity => {
            // The intervals in which a distance is right; as many as overlap begin before one of them ends.
            let ends = |c: &Control| {
                let (truth, tau) = (asked(c), pair.tau(&c.placed.configuration, U32));
                [truth.distance_lo - tau, truth.distance_hi + tau]
            };
            let all: Vec<[f64; 2]> = controls.iter().filter(|c| !asked(c).hit).map(ends).collect();
            let [mut begins, mut finishes] = [0, 1].map(|end| all.iter().map(|ends| ends[end]).collect::<Vec<_>>());
            begins.sort_unstable_by(f64::total_cmp);
            finishes.sort_unstable_by(f64::total_cmp);
            let open = |(i, begin): (usize, &f64)| i + 1 - finishes.partition_point(|finish| finish < begin);
            begins.iter().enumerate().map(open).max().unwrap_or(0)
        }
    };
    crossing.max(apart) as u32
}
