//! eps* from records whose answers are made up.

mod common;

use nalgebra::Point3;
use ocb_core::configuration::Placed;
use ocb_core::instance::AskedAs;
use ocb_core::oracle::{Pair, Shape, U64};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::{Record, Verdict};
use ocb_core::resolution::{DistanceError, Resolution, Threshold};
use ocb_core::validation::{Precision, Terms};

/// Heights of the blade's tip above the floor; below 0 it crosses by half as much.
const HEIGHTS: [f64; 6] = [0.25, 1e-3, 1e-6, 0.0, -1e-6, -1e-3];

struct Ladder {
    a: Shape,
    b: Shape,
    placed: Vec<Placed>,
}

impl Ladder {
    fn new() -> Self {
        let floor = [Point3::new(-1.0, -1.0, 0.0), Point3::new(1.0, -1.0, 0.0), Point3::new(0.0, 1.0, 0.0)];
        let blade = [Point3::new(0.0, 0.0, 0.0), Point3::new(0.5, 0.0, 1.0), Point3::new(-0.5, 0.0, 1.0)];
        let (a, b) = (Shape::from_triangles(&[floor]), Shape::from_triangles(&[blade]));
        let place = |height: f64| {
            let mut pose = Pose::identity();
            pose.translation.z = height;
            let configuration = common::placed(pose);
            Placed {
                configuration,
                truth: Pair::new(&a, &b).tightest_truth(&configuration),
                rounded: None,
                root_index: 0,
                wanted: None,
            }
        };
        let placed = HEIGHTS.map(place).to_vec();
        Self { a, b, placed }
    }

    fn size(&self, i: usize) -> f64 {
        Pair::new(&self.a, &self.b).scene_size(&self.placed[i].configuration)
    }

    fn resolution(&self, query: Query, answer: impl Fn(usize) -> Answer) -> Resolution {
        let record = |i: usize| Record {
            configuration: i as u32,
            time_ns: 1.0,
            below_resolution: false,
            passes: 1,
            counters: None,
            answer: answer(i),
            asked: AskedAs::default(),
            verdict: Verdict::Correct,
            contacts: None,
            flips: 0,
        };
        let records: Vec<Record> = (0..HEIGHTS.len()).map(record).collect();
        let terms = Terms { query, semantics: Semantics::Surface, precision: Precision::Double };
        Resolution::of(&Pair::new(&self.a, &self.b), &self.placed, &records, terms)
    }

    fn says(&self, hit: impl Fn(f64) -> bool) -> Resolution {
        self.resolution(Query::CollisionFirst, |i| Answer::Collision { hit: hit(HEIGHTS[i]), pair: None })
    }

    fn measures(&self, distance: impl Fn(f64) -> f64) -> Resolution {
        let of = |i: usize| Answer::Distance { distance: distance(HEIGHTS[i].max(0.0)), points: None, triangles: None };
        self.resolution(Query::Proximity, of)
    }
}

/// Configurations, those answered wrongly, and where.
fn told(side: &Threshold) -> (u32, u32, Option<f64>) {
    (side.n, side.wrong, side.at)
}

#[test]
fn without_errors_the_narrowest_decision_bounds_it() {
    let ladder = Ladder::new();
    let all = ladder.says(|height| height <= 0.0);
    assert_eq!(told(&all.false_hits), (3, 0, Some(1e-6 / ladder.size(2))));
    // Touching has no margin and is on neither side.
    assert_eq!(told(&all.misses), (2, 0, Some(ladder.placed[4].truth.margin / ladder.size(4))));
    assert!(ladder.placed[4].truth.margin > 0.0);
    assert_eq!(all.distance, None);
    assert_eq!((all.eps, all.seen), (all.false_hits.at, false));
}

#[test]
fn with_errors_the_widest_one_counts() {
    let ladder = Ladder::new();
    let eager = ladder.says(|height| height < 0.01);
    assert_eq!(told(&eager.false_hits), (3, 2, Some(1e-3 / ladder.size(1))));
    assert_eq!(eager.misses.wrong, 0);
    assert_eq!((eager.eps, eager.seen), (Some(1e-3 / ladder.size(1)), true));
    let both = ladder.says(|height| height > 0.0);
    assert_eq!((both.eps, both.seen), (Some(0.25 / ladder.size(0)), true));
    let shy = ladder.says(|height| height < -1e-5);
    assert_eq!(shy.false_hits.wrong, 0);
    assert_eq!((shy.eps, shy.seen), (shy.misses.at, true));
    assert_eq!(told(&shy.misses), (2, 1, Some(ladder.placed[4].truth.margin / ladder.size(4))));
}

#[test]
fn no_answer_is_no_error_and_no_evidence() {
    let ladder = Ladder::new();
    assert_eq!(ladder.resolution(Query::CollisionFirst, |_| Answer::GaveUp), Resolution::default());
    assert_eq!(ladder.measures(|_| f64::NAN), Resolution::default());
}

#[test]
fn distances_err_over_and_under_in_roundings() {
    let ladder = Ladder::new();
    let right = ladder.measures(|d| d);
    assert_eq!(right.distance, Some(DistanceError { n: 6, over: None, under: None }));
    assert_eq!((right.false_hits.wrong, right.misses.wrong), (0, 0));
    let unit = U64 * ladder.size(0);
    let off = ladder.measures(|d| if d > 0.1 { d + 64.0 * unit } else { d * 0.5 }).distance.expect("distances");
    assert_eq!((off.n, off.over), (6, Some(64.0)));
    let under = off.under.expect("halves are below");
    assert!((under - 0.5e-3 / (U64 * ladder.size(1))).abs() <= 1.0, "{under}");
    // A distance where the objects cross is a miss, a zero where they do not a false hit.
    assert_eq!(ladder.measures(|_| 0.5).misses.wrong, 2);
    assert_eq!(ladder.measures(|_| 0.0).false_hits.wrong, 3);
}
