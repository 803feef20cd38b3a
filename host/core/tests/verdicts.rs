//! Every verdict, on two triangles whose truth is plain.

mod common;

use nalgebra::{Point3, Vector3};
use ocb_core::configuration::{Class, Placed};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::{ContactScore, Verdict};
use ocb_core::validation::{Judged, Precision, Terms, judge};

/// A horizontal triangle and a vertical one whose lowest corner stands `height` above its middle.
struct Stage {
    a: Shape,
    b: Shape,
    placed: Placed,
}

impl Stage {
    fn new(height: f64) -> Self {
        let floor = [Point3::new(-1.0, -1.0, 0.0), Point3::new(1.0, -1.0, 0.0), Point3::new(0.0, 1.0, 0.0)];
        // The second triangle of A lies far away.
        let far = floor.map(|p| p + Vector3::new(0.0, 0.0, -8.0));
        let blade = [Point3::new(0.0, 0.0, 0.0), Point3::new(0.5, 0.0, 1.0), Point3::new(-0.5, 0.0, 1.0)];
        let (a, b) = (Shape::from_triangles(&[floor, far]), Shape::from_triangles(&[blade]));
        let mut pose = Pose::identity();
        pose.translation.z = height;
        let configuration = common::placed(pose);
        let truth = Pair::new(&a, &b).truth(&configuration);
        Self { a, b, placed: Placed { configuration, truth, rounded: None, root_index: 0, wanted: None } }
    }

    fn judge(&self, query: Query, answer: Answer) -> Verdict {
        self.judge_as(query, answer, Precision::Double)
    }

    fn judge_as(&self, query: Query, answer: Answer, precision: Precision) -> Verdict {
        self.judged(Terms { query, semantics: Semantics::Surface, precision }, &answer).verdict
    }

    fn judged(&self, terms: Terms, answer: &Answer) -> Judged {
        judge(&Pair::new(&self.a, &self.b), &self.placed, terms, answer)
    }

    fn says(&self, hit: bool, pair: Option<[u32; 2]>) -> Verdict {
        self.judge(Query::CollisionFirst, Answer::Collision { hit, pair })
    }

    fn lists(&self, total: u64, pairs: &[[u32; 2]]) -> Verdict {
        self.judge(Query::CollisionAll, Answer::Contacts { total, pairs: pairs.to_vec() })
    }

    fn measures(&self, distance: f64, points: Option<[[f64; 3]; 2]>, triangles: Option<[u32; 2]>) -> Verdict {
        let points = points.map(|p| p.map(Point3::from));
        self.judge(Query::Proximity, Answer::Distance { distance, points, triangles })
    }
}

#[test]
fn apart() {
    let stage = Stage::new(0.25);
    assert_eq!(stage.says(false, None), Verdict::Correct);
    assert_eq!(stage.says(true, None), Verdict::FalsePositive);
    assert_eq!(stage.says(true, Some([0, 0])), Verdict::FalsePositive);
    assert_eq!(stage.lists(0, &[]), Verdict::Correct);
    assert_eq!(stage.lists(1, &[[0, 0]]), Verdict::FalsePositive);
}

#[test]
fn crossing() {
    let stage = Stage::new(-0.25);
    assert_eq!(stage.says(true, None), Verdict::Correct);
    assert_eq!(stage.says(true, Some([0, 0])), Verdict::Correct);
    assert_eq!(stage.says(false, None), Verdict::FalseNegative);
    assert_eq!(stage.says(true, Some([1, 0])), Verdict::WrongWitness);
    assert_eq!(stage.says(true, Some([2, 0])), Verdict::Invalid);
    assert_eq!(stage.says(true, Some([0, 1])), Verdict::Invalid);
    assert_eq!(stage.lists(1, &[[0, 0]]), Verdict::Correct);
    assert_eq!(stage.lists(2, &[[0, 0], [1, 0]]), Verdict::WrongWitness);
    assert_eq!(stage.lists(2, &[[0, 0], [0, 0]]), Verdict::Invalid);
    assert_eq!(stage.lists(0, &[[0, 0]]), Verdict::Invalid);
    assert_eq!(stage.lists(0, &[]), Verdict::FalseNegative);
    // Cut short by the buffer.
    assert_eq!(stage.lists(1, &[]), Verdict::Correct);
    assert_eq!(stage.measures(0.0, None, None), Verdict::Correct);
    assert_eq!(stage.measures(0.1, None, None), Verdict::FalseNegative);
}

#[test]
fn touching_is_reported_not_scored() {
    let stage = Stage::new(0.0);
    assert!(stage.placed.truth.hit);
    assert_eq!(stage.placed.truth.class64, Class::Grazing);
    assert_eq!(stage.says(true, None), Verdict::Undecidable);
    assert_eq!(stage.says(false, None), Verdict::Undecidable);
    assert_eq!(stage.says(true, Some([1, 0])), Verdict::WrongWitness);
    assert_eq!(stage.says(false, Some([0, 0])), Verdict::Invalid);
    assert_eq!(stage.measures(0.1, None, None), Verdict::DistanceOver);
}

#[test]
fn the_band_depends_on_the_precision() {
    let stage = Stage::new(1e-7);
    assert_eq!((stage.placed.truth.class64, stage.placed.truth.class32), (Class::Clear, Class::Grazing));
    let answer = Answer::Collision { hit: true, pair: None };
    assert_eq!(stage.judge_as(Query::CollisionFirst, answer.clone(), Precision::Double), Verdict::FalsePositive);
    assert_eq!(stage.judge_as(Query::CollisionFirst, answer, Precision::Single), Verdict::Undecidable);
}

#[test]
fn lists_of_contacts_are_scored_by_precision_and_recall() {
    let terms = Terms { query: Query::CollisionAll, semantics: Semantics::Surface, precision: Precision::Double };
    let score = |stage: &Stage, total: u64, pairs: &[[u32; 2]]| {
        stage.judged(terms, &Answer::Contacts { total, pairs: pairs.to_vec() }).contacts
    };
    let crossing = Stage::new(-0.25);
    let of = |listed, genuine, robust, found| Some(ContactScore { listed, genuine, robust, found });
    assert_eq!(score(&crossing, 1, &[[0, 0]]), of(1, 1, 1, Some(1)));
    assert_eq!(score(&crossing, 2, &[[0, 0], [1, 0]]), of(2, 1, 1, Some(1)));
    assert_eq!(score(&crossing, 1, &[[1, 0]]), of(1, 0, 1, Some(0)));
    assert_eq!(score(&crossing, 0, &[]), of(0, 0, 1, Some(0)));
    // Cut short by the buffer: what was found beyond it nobody knows.
    assert_eq!(score(&crossing, 3, &[[0, 0]]), of(1, 1, 1, None));
    // No list at all.
    assert_eq!(score(&crossing, 2, &[[0, 0], [0, 0]]), None);
    // A pair that only touches is free: neither needed nor wrong.
    let touching = Stage::new(0.0);
    assert_eq!(score(&touching, 0, &[]), of(0, 0, 0, Some(0)));
    assert_eq!(score(&touching, 1, &[[0, 0]]), of(1, 1, 0, Some(0)));
    let apart = Stage::new(0.25);
    assert_eq!(score(&apart, 1, &[[0, 0]]), of(1, 0, 0, Some(0)));

    let half = ContactScore { listed: 4, genuine: 2, robust: 8, found: Some(2) };
    assert_eq!((half.precision(), half.recall()), (Some(0.5), Some(0.25)));
    let nothing = ContactScore { listed: 0, genuine: 0, robust: 0, found: Some(0) };
    assert_eq!((nothing.precision(), nothing.recall()), (None, None));
    assert_eq!(ContactScore { found: None, ..half }.recall(), None);
}

#[test]
fn a_count_beyond_the_list_is_certified() {
    let crossing = Stage::new(-0.25);
    assert_eq!(crossing.lists(1, &[]), Verdict::Correct);
    for invented in [2, u64::MAX] {
        assert_eq!(crossing.lists(invented, &[[0, 0]]), Verdict::WrongWitness);
        assert_eq!(crossing.lists(invented, &[]), Verdict::WrongWitness);
    }
    // One that only touches may be counted or not.
    let touching = Stage::new(0.0);
    assert_ne!(touching.lists(1, &[]), Verdict::WrongWitness);
    assert_eq!(touching.lists(2, &[]), Verdict::WrongWitness);
}

#[test]
fn distances_and_witnesses() {
    let stage = Stage::new(0.25);
    let points = Some([[0.0, 0.0, 0.0], [0.0, 0.0, 0.25]]);
    assert_eq!(stage.measures(0.25, None, None), Verdict::Correct);
    assert_eq!(stage.measures(0.25, points, Some([0, 0])), Verdict::Correct);
    assert_eq!(stage.measures(0.25, points, None), Verdict::Correct);
    assert_eq!(stage.measures(0.25, None, Some([0, 0])), Verdict::Correct);
    assert_eq!(stage.measures(0.25 + 1e-9, None, None), Verdict::DistanceOver);
    assert_eq!(stage.measures(0.25 - 1e-9, None, None), Verdict::DistanceUnder);
    assert_eq!(stage.measures(0.0, None, None), Verdict::DistanceUnder);
    // Right number, wrong place.
    assert_eq!(stage.measures(0.25, Some([[0.0, 0.0, 0.0], [0.0, 0.0, 0.26]]), None), Verdict::WrongWitness);
    assert_eq!(stage.measures(0.25, points, Some([1, 0])), Verdict::WrongWitness);
    assert_eq!(stage.measures(0.25, None, Some([1, 0])), Verdict::WrongWitness);
    let beside = Some([[3.0, 0.0, 0.0], [3.0, 0.0, 0.25]]);
    assert_eq!(stage.measures(0.25, beside, Some([0, 0])), Verdict::WrongWitness);
    let exchanged = Some([[0.0, 0.0, 0.25], [0.0, 0.0, 0.0]]);
    assert_eq!(stage.measures(0.25, exchanged, Some([0, 0])), Verdict::WrongWitness);
}

#[test]
fn no_number_is_a_wildcard() {
    let stage = Stage::new(0.25);
    let points = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.25]];
    for distance in [f64::NAN, f64::INFINITY, -0.25, -f64::MIN_POSITIVE] {
        assert_eq!(stage.measures(distance, Some(points), Some([0, 0])), Verdict::Invalid);
    }
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(stage.measures(0.25, Some([[bad, 0.0, 0.0], points[1]]), Some([0, 0])), Verdict::Invalid);
        assert_eq!(stage.measures(0.25, Some([points[0], [0.0, 0.0, bad]]), None), Verdict::Invalid);
    }
    assert_eq!(stage.measures(0.25, Some(points), Some([0, u32::MAX])), Verdict::Invalid);
}

#[test]
fn what_is_no_answer_is_no_error_and_no_answer_to_another_question_counts() {
    let stage = Stage::new(-0.25);
    for query in [Query::CollisionFirst, Query::CollisionAll, Query::Proximity] {
        assert_eq!(stage.judge(query, Answer::GaveUp), Verdict::GaveUp);
        assert_eq!(stage.judge(query, Answer::Unsupported), Verdict::Unsupported);
    }
    let hit = Answer::Collision { hit: true, pair: None };
    assert_eq!(stage.judge(Query::Proximity, hit.clone()), Verdict::Invalid);
    assert_eq!(stage.judge(Query::CollisionAll, hit), Verdict::Invalid);
}
