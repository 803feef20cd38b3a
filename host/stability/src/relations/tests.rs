use std::sync::Arc;

use ocb_core::oracle::{Pair, Shape, U64};
use proptest::prelude::*;

use super::*;
use crate::families;

/// What a method without a fault says.
fn honest(posed: &Posed) -> Said {
    let (a, b) = (Shape::new(posed.a.clone()), Shape::new(posed.b.clone()));
    let pair = Pair::new(&a, &b);
    let truth = pair.tightest_truth(&posed.configuration);
    let middle = (truth.distance_lo + truth.distance_hi) / 2.0;
    Said {
        hit: Some(truth.hit),
        contacts: Some(pair.contacts(&posed.configuration).len() as u64),
        distance: Some(middle),
        points: Some([truth.witness.point_a, truth.witness.point_b]),
    }
}

fn tau(posed: &[&Posed]) -> f64 {
    let of = |posed: &&Posed| {
        let (a, b) = (Shape::new(posed.a.clone()), Shape::new(posed.b.clone()));
        Pair::new(&a, &b).tau(&posed.configuration, U64)
    };
    posed.iter().map(of).fold(0.0, f64::max)
}

/// The first relation that `method` breaks on a base.
fn broken(relation: Relation, base: &Posed, seed: u64, method: impl Fn(&Posed) -> Said) -> Option<Breach> {
    let said = method(base);
    relation.steps().iter().find_map(|&at| {
        let derived = relation.derive(base, &said, at, &mut Draw::new(seed));
        let answers: Vec<Said> = derived.iter().map(&method).collect();
        let scenes: Vec<&Posed> = std::iter::once(base).chain(&derived).collect();
        relation.breach(base, &said, at, &derived, &answers, tau(&scenes))
    })
}

fn base(seed: u32) -> Posed {
    let of = [("vertex-face", 1e-3), ("edge-edge", 1e-2), ("deep", 1.0), ("broken-mesh", 0.3), ("stacked-boxes", 1e-3)];
    let (family, at) = of[seed as usize % of.len()];
    let questions = families::by_id(family).expect("a family").questions(seed, at).expect("meshes");
    questions[seed as usize / of.len() % questions.len()].posed.clone()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_truth_keeps_every_relation(seed in 0u32..1000) {
        for relation in Relation::ALL {
            prop_assert_eq!(broken(relation, &base(seed), u64::from(seed), honest), None, "{:?} {}", relation, seed);
        }
    }
}

#[test]
fn a_length_that_does_not_scale_breaks_the_unit() {
    let absolute = |posed: &Posed| {
        let said = honest(posed);
        Said { hit: said.distance.map(|d| d < 1e-6), ..said }
    };
    let base = families::by_id("vertex-face").unwrap().questions(1, 1e-2).unwrap()[0].posed.clone();
    assert_eq!(broken(Relation::Unit, &base, 1, absolute), Some(Breach::Decision));
}

#[test]
fn a_method_that_knows_one_order_breaks_the_swap() {
    let base = base(0);
    let ordered = |posed: &Posed| Said { hit: Some(Arc::ptr_eq(&posed.a, &base.a)), ..Said::default() };
    assert_eq!(broken(Relation::Swap, &base, 1, ordered), Some(Breach::Decision));
}

#[test]
fn every_relation_says_what_it_asks() {
    let ids: std::collections::HashSet<&str> = Relation::ALL.iter().map(|r| r.words()[0]).collect();
    assert_eq!(ids.len(), 17);
}
