use std::collections::HashSet;

use ocb_core::configuration::Class;
use ocb_core::mesh::MeshError;
use ocb_core::oracle::{Pair, Shape};

use super::*;
use crate::Rule;

/// Every question of the first seeds, with its family and the value of its parameter.
fn each(mut look: impl FnMut(&'static Family, f64, &crate::Made)) {
    for family in all() {
        for &at in family.parameter.steps {
            for seed in 0..2 {
                look(family, at, &family.questions(seed, at));
            }
        }
    }
}

#[test]
fn there_are_28_with_names_of_their_own() {
    let ids: HashSet<&str> = all().map(|family| family.id).collect();
    assert_eq!((all().count(), ids.len()), (28, 28));
    // Relations are asked for in the same words.
    assert!(crate::relations::Relation::ALL.iter().all(|relation| !ids.contains(relation.words()[0])));
    for family in all() {
        let steps = family.parameter.steps;
        assert!(steps.windows(2).all(|w| w[0] < w[1]), "{}: steps ascend", family.id);
        assert_eq!(by_id(family.id).map(|f| f.name), Some(family.name));
    }
}

#[test]
fn a_seed_gives_the_same_questions_again_and_another_seed_others() {
    for family in all() {
        let at = family.parameter.steps[family.parameter.steps.len() / 2];
        let [one, again, other] = [3, 3, 4].map(|seed| family.questions(seed, at));
        // NaN is no number that equals itself.
        let text = |made: &crate::Made| format!("{made:?}");
        assert_eq!(text(&one), text(&again), "{}", family.id);
        let drawn = !matches!(family.id, "index" | "many-contacts");
        assert!(!drawn || text(&one) != text(&other), "{}", family.id);
    }
}

#[test]
fn only_what_is_no_mesh_is_refused() {
    each(|family, at, made| {
        let expected = match (family.id, at) {
            ("smallest", 0.0) => Some(MeshError::NoTriangles),
            ("exponents", 300.0) => Some(MeshError::TooFar { vertex: 0 }),
            ("not-a-number", 3.0) => Some(MeshError::NotFinite { vertex: 0 }),
            ("index", _) => Some(MeshError::IndexOutOfRange { triangle: 0, index: 0, vertices: 0 }),
            _ => None,
        };
        let kind = |e: &MeshError| std::mem::discriminant(e);
        assert_eq!(made.as_ref().err().map(kind), expected.as_ref().map(kind), "{} at {at}: {made:?}", family.id);
    });
}

#[test]
fn both_answers_are_asked_for_with_certainty() {
    for family in all().filter(|family| !matches!(family.id, "index" | "exact-touch" | "identical" | "not-a-number")) {
        let (mut clear, mut colliding) = (0, 0);
        for seed in 0..3 {
            for &at in family.parameter.steps {
                let asked = family.questions(seed, at).unwrap_or_default();
                for question in asked.iter().filter(|q| q.rule != Rule::Lasting) {
                    let posed = &question.posed;
                    let (a, b) = (Shape::new(posed.a.clone()), Shape::new(posed.b.clone()));
                    let truth = Pair::new(&a, &b).truth(&posed.configuration);
                    clear += u32::from(truth.class64 == Class::Clear);
                    colliding += u32::from(truth.class64 == Class::Colliding);
                }
            }
        }
        let one_sided = match family.id {
            "near-parallel" | "ties" | "containment" => clear > 0,
            "many-contacts" | "deep" => colliding > 0,
            _ => clear > 0 && colliding > 0,
        };
        assert!(one_sided, "{}: {clear} certainly apart, {colliding} certainly in each other", family.id);
    }
}

#[test]
fn questions_with_one_answer_are_the_same_question() {
    each(|family, _, made| {
        let Ok(questions) = made else { return };
        for question in questions {
            let Some(earlier) = question.same_as else { continue };
            assert_eq!(questions[earlier].posed, question.posed, "{}", family.id);
        }
    });
}
