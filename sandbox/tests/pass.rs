//! A pass asks every question once for the time that counts, and some of them again to see whether that was honest.

mod common;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use common::{Others, apart, fixture, launcher, launcher_with, start};
use ocb_core::instance::Instance;
use ocb_core::query::{Answer, Query};
use ocb_sandbox::integrity::{self, Check};
use ocb_sandbox::{Observation, Outcome, PassFacts, PassPlan, Policy, Sample};

const QUESTIONS: u32 = 500;
/// As many as the engine usually starts.
const PROCESSES: usize = 5;

/// One of these tests keeps a CPU busy, so they run one after the other.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn plan(order: &[u32]) -> PassPlan<'_> {
    PassPlan { order, coherent: false, seed: 7, allowance: Duration::from_secs(50) }
}

/// One pass of the fixture over so many distances: what was seen, and the facts.
fn pass(defines: &[&str], plan: &PassPlan<'_>, stop_after: usize) -> (Vec<Observation>, PassFacts, Outcome) {
    let mut session = start(&launcher(), &fixture(defines)).unwrap();
    let mut seen = Vec::new();
    let present = |configuration: u32, _: Instance| common::first_contact(apart(0.004 * f64::from(configuration)));
    let (facts, ended) = session.pass(plan, &present, &mut |observation| {
        seen.push(observation);
        if seen.len() < stop_after { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let ending = session.finish();
    assert_eq!(ended.err().unwrap_or(Outcome::Completed), ending.outcome);
    (seen, facts, ending.outcome)
}

#[test]
fn every_question_comes_once_before_any_comes_again() {
    let _alone = alone();
    let order: Vec<u32> = (0..QUESTIONS).rev().collect();
    let (seen, facts, outcome) = pass(&["WORK=2000"], &plan(&order), usize::MAX);
    assert_eq!((outcome, facts.reached), (Outcome::Completed, order.len()));
    for observation in &seen {
        let hit = observation.configuration < 250;
        assert!(matches!(observation.answer, Answer::Collision { hit: said, .. } if said == hit), "{observation:?}");
    }
    // Each has its one official time, and what comes again comes behind all of them, has none and is another instance.
    let (counted, again) = seen.split_at(order.len());
    assert_eq!(counted.iter().map(|o| o.configuration).collect::<Vec<_>>(), order);
    assert!(counted.iter().all(|o| o.time.is_some_and(|time| time.ns > 0.0) && o.instance == Instance::default()));
    assert!(!again.is_empty() && again.iter().all(|o| o.time.is_none() && o.instance != Instance::default()));
    let disturbed = counted.iter().filter(|o| o.time.is_some_and(|time| time.disturbed)).count();
    assert_eq!(facts.disturbed as usize, disturbed);
    assert!(facts.blocks[0] >= 2 && facts.blocks[1] <= facts.blocks[0] && facts.asked_ns[0] > facts.asked_ns[1]);
    assert!(facts.calibration_ns[0] > 0.0 && facts.calibration_ns[0] <= facts.calibration_ns[2]);
}

#[test]
fn the_order_of_a_coherent_set_is_kept() {
    let _alone = alone();
    let order: Vec<u32> = (0..QUESTIONS).collect();
    let (seen, ..) = pass(&[], &PassPlan { coherent: true, ..plan(&order) }, usize::MAX);
    let (counted, again) = seen.split_at(order.len());
    assert_eq!(counted.iter().map(|o| o.configuration).collect::<Vec<_>>(), order);
    // What comes again does so from the first on in the order's own sequence.
    let batch = again.iter().take_while(|o| o.instance == again[0].instance).map(|o| o.configuration);
    let batch: Vec<u32> = batch.collect();
    assert!(batch.windows(2).all(|pair| pair[0] + 1 == pair[1]), "{batch:?}");
}

#[test]
fn a_pass_ends_when_it_shall() {
    let _alone = alone();
    let order: Vec<u32> = (0..QUESTIONS).collect();
    let (seen, facts, outcome) = pass(&[], &plan(&order), 200);
    assert_eq!((seen.len(), outcome), (200, Outcome::Completed));
    assert!(facts.reached < 300);
    let (seen, facts, _) = pass(&[], &PassPlan { allowance: Duration::ZERO, ..plan(&order) }, usize::MAX);
    assert_eq!((facts.reached, seen.iter().filter(|o| o.time.is_some()).count()), (0, 0));
    // A crash in the middle keeps what was answered before.
    let (seen, facts, outcome) = pass(&["CRASH_AFTER=300"], &plan(&order), usize::MAX);
    assert!(matches!(outcome, Outcome::Signaled { .. }), "{outcome:?}");
    assert!(facts.reached < 400 && seen.len() <= 300 && seen.len() > 100, "{} {}", facts.reached, seen.len());
}

#[test]
fn remembering_gains_nothing_and_is_seen_where_questions_come_again() {
    let _alone = alone();
    let order: Vec<u32> = (0..2 * QUESTIONS).collect();
    let times = |seen: &[Observation]| {
        let mut times: Vec<f64> = seen.iter().filter_map(|o| o.time).map(|time| time.ns).collect();
        times.sort_by(f64::total_cmp);
        times
    };
    let others = Others::look();
    let (mut memoiser, mut twin) = ((Vec::new(), Vec::new()), (Vec::new(), Vec::new()));
    for _ in 0..PROCESSES {
        for (defines, (seen, facts)) in
            [(&["WORK=100000", "MEMOISES"][..], &mut memoiser), (&["WORK=100000"], &mut twin)]
        {
            let (observations, found, _) = pass(defines, &plan(&order), usize::MAX);
            seen.extend(observations);
            facts.push(found);
        }
    }
    // An answer that is only looked up takes less than a hundredth of one that is computed, and other work on the machine has
    // made the same code take twice as long. So a tenth tells them apart, and hardly a time may lie below it.
    let (mine, computed) = (times(&memoiser.0), times(&twin.0));
    let usual_ns = computed[computed.len() / 2];
    let looked_up = mine.iter().filter(|ns| **ns < 0.1 * usual_ns).count();
    assert!(100 * looked_up < mine.len(), "{looked_up} of {} below a tenth of {usual_ns} ns", mine.len());
    assert_eq!(integrity::violated(&twin.1), None, "{:?}", twin.1);
    // Batches that other work disturbed say nothing, and three are needed.
    let seen = integrity::violated(&memoiser.1).map(|finding| finding.check);
    others.hold(seen == Some(Check::Batches), || format!("{seen:?} in {:?}", memoiser.1));
}

#[test]
fn a_wait_for_the_cpu_is_taken_off_the_question_that_it_fell_into() {
    let _alone = alone();
    // Another thread of this test computes on the runner's CPU all the while.
    let cpu = 0;
    let policy = Policy { runner_cpu: Some(cpu), supervisor_cpu: Some(1), ..common::policy() };
    let busy = Busy::on(cpu);
    let mut session = start(&launcher_with(policy), &fixture(&["WORK=250000"])).unwrap();
    let mut samples = Vec::new();
    // The time of a question that waited for nothing. Some kernels let most questions wait, so the median does not show it.
    let mut alone_ns = f64::INFINITY;
    // A question of half a millisecond meets a slice of some milliseconds now and then.
    let waited = |samples: &[Sample], alone_ns: f64| -> Vec<Sample> {
        samples.iter().filter(|s| !s.disturbed && s.raw_ns > 4.0 * alone_ns).cloned().collect()
    };
    while samples.len() < 100 || waited(&samples, alone_ns).len() < 10 && samples.len() < 20_000 {
        samples.push(session.query(Query::CollisionFirst, &apart(0.5)).unwrap());
        let mut raw: Vec<f64> = samples.iter().map(|s| s.raw_ns).collect();
        raw.sort_by(f64::total_cmp);
        alone_ns = raw[raw.len() / 20];
    }
    drop(busy);
    let waited = waited(&samples, alone_ns);
    let mended = waited.iter().filter(|sample| sample.time_ns < 0.5 * sample.raw_ns).count();
    assert!(waited.len() >= 10, "nothing else had its CPU in {} questions", samples.len());
    assert!(2 * mended > waited.len(), "{mended} of {}: {waited:?}", waited.len());
}

#[test]
fn a_limit_does_not_count_waits_for_the_cpu() {
    let _alone = alone();
    let on = |cpu, query_seconds| Policy { runner_cpu: Some(cpu), query_seconds, ..common::policy() };
    let asked = |query_seconds, fault: &str| {
        let mut session = start(&launcher_with(on(0, query_seconds)), &fixture(&[fault])).unwrap();
        session.query(Query::CollisionFirst, &apart(0.5)).map(|sample| sample.raw_ns / 1e9)
    };
    let work = "WORK=600000000";
    let seconds = asked(30.0, work).unwrap();
    let busy = Busy::on(0);
    // It takes twice as long beside the other thread, and computes no longer than before.
    let beside = asked(1.6 * seconds, work).unwrap();
    println!("{seconds} s alone, {beside} s beside a loop");
    let endless = asked(1.6 * seconds, "ATTACK=loop").unwrap_err();
    assert!(matches!(endless, Outcome::TimedOut { .. }), "{endless:?}");
    drop(busy);
}

#[test]
fn work_during_the_wake_up_is_not_lost_time() {
    let _alone = alone();
    let others = Others::look();
    let policy = Policy { runner_cpu: Some(0), supervisor_cpu: Some(0), ..common::policy() };
    let mut session = start(&launcher_with(policy), &fixture(&["WORK=1000000"])).unwrap();
    let samples: Vec<Sample> = (0..40).map(|_| session.query(Query::CollisionFirst, &apart(0.5)).unwrap()).collect();
    let disturbed = samples.iter().filter(|sample| sample.disturbed).count();
    others.hold(disturbed < 10, || format!("{disturbed} of 40 on a shared CPU"));
}

#[test]
fn times_that_the_clock_cannot_tell_accuse_nobody() {
    let _alone = alone();
    let policy = Policy { runner_cpu: Some(0), supervisor_cpu: Some(0), ..common::policy() };
    let launcher = launcher_with(policy);
    let order: Vec<u32> = (0..2 * QUESTIONS).collect();
    let present = |configuration: u32, _: Instance| common::first_contact(apart(0.004 * f64::from(configuration)));
    let others = Others::look();
    // A batch that meets something is left out, and a process has but three.
    let passes = (0..20).map(|_| {
        let mut session = start(&launcher, &fixture(&["WORK=300"])).unwrap();
        let (facts, ended) = session.pass(&plan(&order), &present, &mut |_| ControlFlow::Continue(()));
        ended.unwrap();
        facts
    });
    let facts = passes.into_iter().find(|facts| !facts.batches.is_empty());
    others.hold(facts.is_some(), || "every batch of twenty processes met something".into());
    let facts = facts.unwrap();
    // The sleeping clock cannot tell so short a time.
    assert!(facts.batches.iter().all(|batch| batch.alone_ns == 0.0), "{facts:?}");
    assert_eq!(integrity::violated(std::slice::from_ref(&facts)), None, "{facts:?}");
}

/// A thread that computes on one CPU until dropped.
struct Busy(Arc<AtomicBool>, Option<JoinHandle<()>>);

impl Busy {
    fn on(cpu: usize) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let seen = stop.clone();
        let thread = std::thread::spawn(move || {
            let mut set = nix::sched::CpuSet::new();
            set.set(cpu).unwrap();
            nix::sched::sched_setaffinity(nix::unistd::Pid::from_raw(0), &set).unwrap();
            while !seen.load(Ordering::Relaxed) {
                std::hint::spin_loop();
            }
        });
        Busy(stop, Some(thread))
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
        self.1.take().map(JoinHandle::join);
    }
}
