//! Runs an attack in its form.

use ocb_core::query::{Answer, Query};
use ocb_core::record::Verdict;
use ocb_sandbox::integrity::Finding;
use ocb_sandbox::{Ending, Launcher, Outcome, Phase, Policy};

use crate::common::{apart, fixture, judged, launcher_with, policy, start, start_scene};
use crate::{Attack, Expected, Form, pass};

/// What came of it.
pub struct Ran {
    /// The last word on the session.
    pub ending: Ending,
    /// Of the collision queries that were answered.
    pub shortest_ns: f64,
    /// No time of theirs is below the clock's resolution.
    pub bounded: bool,
    /// Of the distances.
    pub verdicts: Vec<Verdict>,
    /// Wrong answers of the passes.
    pub wrong: usize,
    /// Processes with wrong answers.
    pub wrong_in: usize,
    /// The checks that measurements did not meet, one of each that did not.
    pub caught: Vec<Finding>,
    /// How many measurements there were.
    pub measurements: usize,
}

impl Ran {
    /// Nothing came of it yet.
    pub fn new() -> Self {
        let ending = Ending::from(Outcome::Completed);
        let (verdicts, caught) = (vec![], vec![]);
        Ran { ending, shortest_ns: 0.0, bounded: true, verdicts, wrong: 0, wrong_in: 0, caught, measurements: 0 }
    }
}

/// The difference to what was expected.
pub fn check(attack: &Attack, constructor: bool) -> Result<(), String> {
    let mut before: Option<String> = None;
    for _ in 0..if attack.form == Form::Twice { 2 } else { 1 } {
        let ran = run(attack, constructor);
        let said = ran.ending.to_string();
        if matches!(attack.expected, Expected::SaysAlike(_)) && before.as_ref().is_some_and(|b| *b != said) {
            return Err(format!("{}: it sees a difference: {said}, and before: {before:?}", attack.id));
        }
        before = Some(said);
        let phase = match attack.form {
            _ if constructor => Phase::Load,
            Form::ThirdObject => Phase::Build,
            _ => Phase::Query,
        };
        if !attack.expected.met_by(&ran, phase) {
            let form = if constructor { " (constructor)" } else { "" };
            let (ending, expected) = (&ran.ending, attack.expected.text());
            let (what, more) = (attack.defines.join(" "), (ran.shortest_ns, &ran.verdicts, ran.wrong, &ran.caught));
            return Err(format!("{}{form} {what}: {ending} {more:?}, not {expected}", attack.id));
        }
    }
    Ok(())
}

fn run(attack: &Attack, constructor: bool) -> Ran {
    let form = attack.form;
    let mut defines = attack.defines.to_vec();
    defines.extend((constructor && form != Form::Loading).then_some("IN_CONSTRUCTOR"));
    defines.extend((form == Form::ThirdObject).then_some(["IN_BUILD", "AT_OBJECT=2"]).into_iter().flatten());
    defines.extend(matches!(form, Form::Contacts | Form::ThreadsContacts).then_some("IN_CONTACTS"));
    let threads = if matches!(form, Form::Threads | Form::ThreadsContacts) { 2 } else { 1 };
    let launcher = launcher_with(Policy { threads, rough_clock: attack.is_untimed(), ..policy() });
    if form == Form::Pass { pass::ask(&launcher, attack, &defines) } else { ask(&launcher, attack, &defines) }
}

/// Asks what the form wants, and two collision queries, so that a harmless attack has to go on being honest.
fn ask(launcher: &Launcher, attack: &Attack, defines: &[&str]) -> Ran {
    let mut ran = Ran { shortest_ns: f64::MAX, ..Ran::new() };
    let start = if attack.form == Form::ThirdObject { start_scene } else { start };
    let mut session = match start(launcher, &fixture(defines)) {
        Ok(session) => session,
        Err(ending) => return Ran { ending, ..ran },
    };
    let pid = session.pid();
    let mut contacts = None;
    match attack.form {
        Form::Contacts | Form::ThreadsContacts => contacts = session.query(Query::CollisionAll, &apart(0.5)).ok(),
        Form::Distances => {
            for x in [2.0, 3.5] {
                let Ok(sample) = session.query(Query::Proximity, &apart(x)) else { break };
                ran.verdicts.push(judged(Query::Proximity, &apart(x), &sample.answer));
            }
        }
        _ => {}
    }
    for (distance, met) in [(0.5, true), (2.0, false)] {
        let Ok(sample) = session.query(Query::CollisionFirst, &apart(distance)) else { break };
        assert!(matches!(sample.answer, Answer::Collision { hit, .. } if hit == met), "{defines:?}: {sample:?}");
        ran.shortest_ns = ran.shortest_ns.min(sample.raw_ns);
        ran.bounded &= sample.time_ns >= session.clock().resolution_ns();
    }
    ran.ending = session.finish();
    // Not before the rest has been asked: whoever could reach this answer has had the time.
    if let (Some(sample), Form::ThreadsContacts) = (contacts, attack.form) {
        let honest = Answer::Contacts { total: 3, pairs: vec![[0, 10], [1, 11], [2, 12]] };
        assert_eq!(sample.answer, honest, "{defines:?}");
    }
    // Not even a process whose first thread has ended.
    assert!(!std::path::Path::new(&format!("/proc/{pid}")).exists(), "{defines:?} left its process behind");
    ran
}
