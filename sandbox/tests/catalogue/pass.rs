//! Whole passes over equivalent instances, as the engine asks them.

use std::ops::ControlFlow;
use std::time::Duration;

use ocb_core::configuration::Configuration;
use ocb_core::instance::{Instance, Presented};
use ocb_core::query::{Answer, Query};
use ocb_sandbox::integrity;
use ocb_sandbox::{Ending, Launcher, Outcome, PassFacts, PassPlan};

use crate::common::{apart, fixture, start};
use crate::run::Ran;
use crate::{Attack, Expected};

const QUESTIONS: u32 = 1000;
/// Processes at most: on a busy machine many blocks are disturbed and show nothing.
const PROCESSES: u64 = 20;
/// As many as the engine usually starts.
const USUAL: u64 = 5;

/// Passes in fresh processes, until what is expected of them has been seen.
pub fn ask(launcher: &Launcher, attack: &Attack, defines: &[&str]) -> Ran {
    let mut ran = Ran {
        ending: Ending::from(Outcome::Completed),
        shortest_ns: 0.0,
        bounded: true,
        verdicts: vec![],
        wrong: 0,
        caught: None,
    };
    let mut passes: Vec<PassFacts> = Vec::new();
    for round in 0..PROCESSES {
        ran.ending = one(launcher, defines, round, &mut passes, &mut ran.wrong);
        ran.caught = integrity::violated(&passes);
        let seen = match attack.expected {
            Expected::Caught(_) => ran.caught.is_some(),
            Expected::Wrong => ran.wrong > 0,
            _ => round + 1 == USUAL,
        };
        if seen || ran.ending.outcome != Outcome::Completed {
            break;
        }
    }
    ran
}

fn one(launcher: &Launcher, defines: &[&str], seed: u64, passes: &mut Vec<PassFacts>, wrong: &mut usize) -> Ending {
    let mut session = match start(launcher, &fixture(defines)) {
        Ok(session) => session,
        Err(ending) => return ending,
    };
    // Who lists contacts learns where the answers lie.
    if session.query(Query::CollisionAll, &apart(0.5)).is_ok() {
        let order: Vec<u32> = (0..QUESTIONS).map(|i| i * 379 % QUESTIONS).collect();
        let plan = PassPlan {
            query: Query::CollisionFirst,
            order: &order,
            coherent: false,
            seed,
            allowance: Duration::from_secs(50),
        };
        let present =
            |configuration, instance| Presented { configuration: moved(configuration, instance), swapped: false };
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
