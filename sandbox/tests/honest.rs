//! An honest plugin passes through the jail unharmed.

mod common;

use common::{apart, fixture, launcher, launcher_with, mesh, one_question, policy, start};
use nalgebra::Point3;
use ocb_core::query::{Answer, Counters, Query};
use ocb_sandbox::{ClockChoice, ClockKind, Outcome, Policy, Trial};

#[test]
fn describes_itself() {
    let descriptors = launcher().describe(&fixture(&[])).unwrap();
    assert_eq!(descriptors.len(), 1);
    let one = &descriptors[0];
    assert_eq!((one.id.as_str(), one.name.as_str()), ("fixture", "Fixture[31m of the tests"));
    assert_eq!(one.queries, [Query::CollisionFirst, Query::CollisionAll, Query::Proximity]);
    assert!(one.counters && one.witness_points && !one.single_precision && !one.coherent);
    assert_eq!(one.parameters.len(), 1);
    assert_eq!((one.parameters[0].maximum, one.parameters[0].integer), (100.0, true));
}

#[test]
fn answers_every_kind_of_question() {
    let mut session = start(&launcher(), &fixture(&[])).unwrap();
    assert!(session.set_up().build_ns > 0.0);
    let hit = session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
    assert_eq!(hit.answer, Answer::Collision { hit: true, pair: Some([0, 1]) });
    assert!(hit.time_ns > 0.0 && hit.raw_ns >= 0.0);
    let miss = session.query(Query::CollisionFirst, &apart(2.0)).unwrap();
    assert_eq!(miss.answer, Answer::Collision { hit: false, pair: None });
    let contacts = session.query(Query::CollisionAll, &apart(0.5)).unwrap();
    assert_eq!(contacts.answer, Answer::Contacts { total: 3, pairs: vec![[0, 10], [1, 11], [2, 12]] });
    let distance = session.query(Query::Proximity, &apart(2.5)).unwrap();
    let points = Some([Point3::origin(), Point3::new(2.5, 0.0, 0.0)]);
    assert_eq!(distance.answer, Answer::Distance { distance: 2.5, points, triangles: Some([0, 1]) });
    let ending = session.finish();
    assert_eq!((ending.outcome, ending.stderr.as_str()), (Outcome::Completed, ""));
    assert!(ending.cpu_seconds.is_some());
}

#[test]
fn counts_in_a_pass_of_its_own_and_takes_parameters() {
    let (mesh, plugin) = (mesh(), fixture(&[]));
    let parameters = [("knob".to_string(), 42.0)];
    let trial = Trial { parameters: &parameters, ..Trial::new(&plugin, "fixture", &mesh, Some(&mesh)) };
    let mut session = launcher().start(&trial).unwrap();
    let (answer, counters) = session.count(Query::CollisionFirst, &apart(0.5)).unwrap();
    assert_eq!(answer, Answer::Collision { hit: true, pair: Some([0, 1]) });
    assert_eq!(counters, Some(Counters { bv_tests: Some(11), primitive_tests: Some(42) }));
    session.count(Query::CollisionFirst, &apart(2.0)).unwrap();
    // A timed query adds nothing.
    session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
    assert_eq!(session.triangle_tests(), Some([vec![84, 0], vec![0, 84]]));
    // A query that counts nothing is answered all the same, and then the sums are not those of all queries.
    assert!(matches!(session.count(Query::Proximity, &apart(0.5)), Ok((Answer::Distance { .. }, None))));
    assert_eq!(session.triangle_tests(), None);
}

#[test]
fn tests_per_triangle_that_do_not_add_up_are_not_taken() {
    let mut session = start(&launcher(), &fixture(&["FAULT_MISCOUNT"])).unwrap();
    let (_, counters) = session.count(Query::CollisionFirst, &apart(0.5)).unwrap();
    assert_eq!(counters, Some(Counters { bv_tests: Some(11), primitive_tests: Some(1) }));
    assert_eq!(session.triangle_tests(), None);
}

/// Zeros of somebody who did not count are no map of zeros.
#[test]
fn tests_per_triangle_that_were_not_counted_are_not_taken() {
    let (mesh, plugin) = (mesh(), fixture(&["TOTALS_ALONE"]));
    let parameters = [("knob".to_string(), 0.0)];
    let trial = Trial { parameters: &parameters, ..Trial::new(&plugin, "fixture", &mesh, None) };
    let mut session = launcher().start(&trial).unwrap();
    let (_, counters) = session.count(Query::CollisionFirst, &apart(0.5)).unwrap();
    assert_eq!(counters, Some(Counters { bv_tests: Some(11), primitive_tests: Some(0) }));
    assert_eq!(session.triangle_tests(), None);
}

#[test]
fn what_it_answers_depends_on_its_parameters() {
    let (launcher, plugin) = (launcher(), fixture(&[]));
    let queries = |knob: f64| launcher.queries(&plugin, "fixture", &[("knob".to_string(), knob)]).unwrap();
    assert_eq!(queries(1.0), [Query::CollisionFirst, Query::CollisionAll, Query::Proximity]);
    assert_eq!(queries(0.0), [Query::CollisionFirst, Query::CollisionAll]);
    let refused = launcher.queries(&plugin, "fixture", &[("knob".to_string(), 101.0)]);
    assert!(matches!(refused.unwrap_err().outcome, Outcome::Failed { .. } | Outcome::LoadError { .. }));
}

#[test]
fn gave_up_is_an_answer() {
    let mut session = start(&launcher(), &fixture(&["FAULT_GAVE_UP"])).unwrap();
    assert_eq!(session.query(Query::CollisionFirst, &apart(0.5)).unwrap().answer, Answer::GaveUp);
    assert_eq!(session.finish().outcome, Outcome::Completed);
}

#[test]
fn numbers_are_passed_on_as_they_are() {
    let mut session = start(&launcher(), &fixture(&["FAULT_NAN"])).unwrap();
    let Answer::Distance { distance, points, triangles } = session.query(Query::Proximity, &apart(0.5)).unwrap().answer
    else {
        panic!("no distance");
    };
    assert!(distance.is_nan() && points.unwrap()[0].x.is_infinite());
    assert_eq!(triangles, Some([4_000_000_000, 1]));
    assert_eq!(session.finish().outcome, Outcome::Completed);
}

#[test]
fn an_absurd_number_of_contacts_is_cut_to_the_buffer() {
    let mut session = start(&launcher(), &fixture(&["FAULT_TOTAL"])).unwrap();
    let Answer::Contacts { total, pairs } = session.query(Query::CollisionAll, &apart(0.5)).unwrap().answer else {
        panic!("no contacts");
    };
    assert_eq!((total, pairs.len()), (u64::MAX, 1 << 16));
}

#[test]
fn both_clocks_see_work() {
    for (choice, kind) in [(ClockChoice::Spin, ClockKind::Spin), (ClockChoice::Futex, ClockKind::Futex)] {
        let policy = Policy { clock: choice, ..policy() };
        let mut session = start(&launcher_with(policy), &fixture(&["WORK=3000000"])).unwrap();
        assert_eq!(session.clock().kind, kind);
        let facts = *session.clock();
        assert!(facts.null_p05_ns <= facts.null_median_ns && facts.null_median_ns <= facts.null_p95_ns);
        let sample = session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
        // Three million rounds through memory take no less than half a millisecond on any machine.
        assert!(sample.raw_ns - sample.waited_ns > 500_000.0, "{sample:?}");
        // On a machine too busy to measure it is a bound, otherwise the difference; never 0.
        let asked_ns = sample.raw_ns - sample.waited_ns;
        let expected = (asked_ns - facts.null_median_ns).max(facts.resolution_ns());
        assert_eq!(sample.time_ns, expected);
        assert_eq!(sample.below_resolution, expected == facts.resolution_ns());
        // The jail's processor time reaches us through all its processes.
        assert!(session.finish().cpu_seconds.unwrap() * 1e9 > 500_000.0);
    }
}

#[test]
fn where_times_are_rough_the_supervisor_soon_sleeps() {
    let policy = Policy { clock: ClockChoice::Spin, rough_clock: true, ..policy() };
    let mut session = start(&launcher_with(policy), &fixture(&["WORK=3000000"])).unwrap();
    let own = || {
        let mut used = libc::timespec { tv_sec: 0, tv_nsec: 0 };
        // SAFETY: it writes this one structure.
        assert_eq!(unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &raw mut used) }, 0);
        used.tv_sec as f64 * 1e9 + used.tv_nsec as f64
    };
    let mut shares = [0; 5].map(|_| {
        let before = own();
        let sample = session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
        (own() - before) / sample.raw_ns
    });
    shares.sort_by(f64::total_cmp);
    assert!(shares[2] < 0.5, "it watches for this share of each answer's time: {shares:?}");
}

#[test]
fn one_cpu_is_enough() {
    let policy = Policy { runner_cpu: Some(0), supervisor_cpu: Some(0), ..policy() };
    let mut session = start(&launcher_with(policy), &fixture(&[])).unwrap();
    assert_eq!(session.clock().kind, ClockKind::Futex);
    session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
    assert_eq!(session.finish().outcome, Outcome::Completed);
}

#[test]
fn the_floating_point_state_is_put_back() {
    let mut session = start(&launcher(), &fixture(&["ATTACK=spoil_floating_point"])).unwrap();
    for _ in 0..3 {
        // The fixture leaves flush-to-zero, round-down and a backward direction behind; distances are whole again.
        session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
        // Its square is a denormal number.
        let tiny = session.query(Query::Proximity, &apart(1e-160)).unwrap();
        assert!(matches!(tiny.answer, Answer::Distance { distance, .. } if distance > 0.0), "{tiny:?}");
    }
}

#[test]
fn unknown_names_are_load_errors_that_name_what_there_is() {
    let (mesh, plugin) = (mesh(), fixture(&[]));
    let start = |algorithm: &str, parameters: &[(String, f64)]| {
        let trial = Trial { parameters, ..Trial::new(&plugin, algorithm, &mesh, None) };
        launcher().start(&trial).err().unwrap()
    };
    let ending = start("other", &[]);
    assert_eq!(ending.outcome, Outcome::LoadError { reason: "it has no algorithm 'other'; it has fixture".into() });
    for (name, value) in [("other", 1.0), ("knob", 101.0), ("knob", 0.5), ("knob", f64::INFINITY)] {
        let ending = start("fixture", &[(name.to_string(), value)]);
        assert!(!matches!(ending.outcome, Outcome::Completed | Outcome::SandboxFault { .. }), "{ending}");
    }
}

#[test]
fn what_it_says_is_kept_without_control_characters() {
    let ending = one_question(&["ATTACK=abort_self"], Query::CollisionFirst);
    assert!(!ending.stderr.contains('\u{1b}'));
}
