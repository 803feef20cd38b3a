//! Whole passes over equivalent instances, as the engine asks them.

use std::ops::ControlFlow;
use std::time::Duration;

use ocb_core::configuration::Configuration;
use ocb_core::instance::Instance;
use ocb_core::query::{Answer, Query};
use ocb_sandbox::integrity::{self, Check, Finding};
use ocb_sandbox::{Ending, Launcher, Outcome, PassFacts, PassPlan};

use crate::common::{apart, first_contact, fixture, start};
use crate::run::Ran;
use crate::{Attack, Expected};

const QUESTIONS: u32 = 1000;
/// Processes of a measurement, as many as the engine usually starts.
pub const PROCESSES: usize = 5;
/// An attack that is found by statistics is found in so many of so many measurements.
pub const FOUND: usize = 9;
pub const MEASUREMENTS: usize = 10;

/// How often it is measured: all of them in the campaign.
fn measurements() -> usize {
    std::env::var("OCB_MEASUREMENTS").map_or(3, |number| number.parse().expect("OCB_MEASUREMENTS is a number"))
}

/// Passes in fresh processes: one measurement, or several where statistics find the attack.
pub fn ask(launcher: &Launcher, attack: &Attack, defines: &[&str]) -> Ran {
    let mut ran = Ran::new();
    let measurements = if let Expected::Caught(_) = attack.expected { measurements() } else { 1 };
    for measurement in 0..measurements {
        let mut passes: Vec<PassFacts> = Vec::new();
        for process in 0..PROCESSES {
            let (seed, before) = ((measurement * PROCESSES + process) as u64, ran.wrong);
            ran.ending = one(launcher, defines, seed, &mut passes, &mut ran.wrong);
            ran.wrong_in += usize::from(ran.wrong > before);
            if ran.ending.outcome != Outcome::Completed {
                return ran;
            }
        }
        ran.caught.extend(integrity::violated(&passes));
        ran.measurements += 1;
    }
    if let Expected::Caught(checks) = attack.expected {
        println!("{}: found in {} of {measurements} measurements", attack.title, found(&ran.caught, checks));
    }
    ran
}

/// How many of these findings are of one of the checks.
pub fn found(findings: &[Finding], checks: &[Check]) -> usize {
    findings.iter().filter(|finding| checks.contains(&finding.check)).count()
}

fn one(launcher: &Launcher, defines: &[&str], seed: u64, passes: &mut Vec<PassFacts>, wrong: &mut usize) -> Ending {
    let mut session = match start(launcher, &fixture(defines)) {
        Ok(session) => session,
        Err(ending) => return ending,
    };
    // Who lists contacts learns where the answers lie.
    if session.query(Query::CollisionAll, &apart(0.5)).is_ok() {
        let order: Vec<u32> = (0..QUESTIONS).map(|i| i * 379 % QUESTIONS).collect();
        let plan = PassPlan { order: &order, coherent: false, seed, allowance: Duration::from_secs(50) };
        let present = |configuration, instance| first_contact(moved(configuration, instance));
        let mut each = |seen: ocb_sandbox::Observation| {
            let truth = 0.004 * f64::from(seen.configuration) < 1.0;
            *wrong += usize::from(!matches!(seen.answer, Answer::Collision { hit, .. } if hit == truth));
            ControlFlow::Continue(())
        };
        passes.push(session.pass(&plan, &present, &mut each).0);
    }
    session.finish()
}

/// The same question in another place: a motion of both objects that rounds nothing.
fn moved(configuration: u32, instance: Instance) -> Configuration {
    let mut question = apart(0.004 * f64::from(configuration));
    for pose in [&mut question.pose_a, &mut question.pose_b] {
        pose.translation.y += f64::from(instance.number);
    }
    question
}
