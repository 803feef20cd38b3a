//! The hostile catalogue: every attack has exactly its expected outcome, and the table in `sandbox/README.md` says so.

#[path = "../common/mod.rs"]
mod common;
mod crashes;
mod memory;
mod resources;
mod system;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::{apart, fixture, launcher, start};
use ocb_core::query::Query;
use ocb_sandbox::{Ending, Outcome, Phase};

/// One attack.
pub struct Attack {
    /// Its name in the catalogue.
    pub id: &'static str,
    /// What it tries.
    pub title: &'static str,
    /// The function in `fixtures/attacks/`, and what else the compiler is told.
    pub defines: &'static [&'static str],
    /// When it strikes.
    pub form: Form,
    /// What must come of it.
    pub expected: Expected,
}

/// When an attack strikes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// While a collision query is answered.
    Query,
    /// The same, and once more in a constructor, while the file is loaded.
    QueryAndConstructor,
    /// While the file is loaded, whatever the attack's function does later.
    Loading,
    /// While contacts are listed: then the plugin knows where the answer's memory lies.
    Contacts,
}

/// What must come of an attack.
#[derive(Clone, Copy)]
pub enum Expected {
    /// `SyscallDenied` with this call.
    Denied(&'static str),
    /// It got nothing and says so: its words begin like this.
    Says(&'static str),
    /// `Signaled`.
    Signal(i32),
    /// It ended its process with this status.
    Left(i32),
    /// `TimedOut`, by the supervisor's clock.
    TimedOut,
    /// `OutOfMemory`; SIGABRT of its own where there is no memory group.
    OutOfMemory,
    /// `OutputLimit`.
    OutputLimit,
    /// `ProtocolViolation`.
    Violation,
    /// It did what it liked to itself, and the answers are those of an honest plugin.
    Harmless,
}

impl Expected {
    fn text(self) -> String {
        match self {
            Expected::Denied(call) => format!("`SyscallDenied` ({call})"),
            Expected::Says(words) => format!("gets nothing: {words}"),
            Expected::Signal(signal) => {
                let named = nix::sys::signal::Signal::try_from(signal).unwrap();
                format!("`Signaled` ({named})")
            }
            Expected::Left(status) => format!("`Failed` (ended its process with status {status})"),
            Expected::TimedOut => "`TimedOut`".into(),
            Expected::OutOfMemory => "`OutOfMemory`".into(),
            Expected::OutputLimit => "`OutputLimit`".into(),
            Expected::Violation => "`ProtocolViolation`".into(),
            Expected::Harmless => "harmless: answers as an honest plugin".into(),
        }
    }

    fn met_by(self, ending: &Ending, phase: Phase) -> bool {
        match (self, &ending.outcome) {
            (Expected::Denied(name), Outcome::SyscallDenied { phase: p, call }) => *p == phase && call.name == name,
            (Expected::Says(words), Outcome::Failed { reason, .. }) => {
                reason.starts_with(&format!("collide returned OCB_ERROR: {words}"))
            }
            (Expected::Signal(signal), Outcome::Signaled { phase: p, signal: s }) => (*p, *s) == (phase, signal),
            (Expected::Left(status), Outcome::Failed { phase: p, reason }) => {
                *p == phase && *reason == format!("it ended its process with exit status {status}")
            }
            (Expected::TimedOut, Outcome::TimedOut { phase: p, cpu, .. }) => *p == phase && !cpu,
            (Expected::OutOfMemory, Outcome::OutOfMemory { phase: p, .. }) => *p == phase,
            // Without a memory group the address space ends, malloc fails, and the attack gives up.
            (Expected::OutOfMemory, Outcome::Signaled { signal, .. }) => *signal == libc::SIGABRT && !common::grouped(),
            (Expected::OutputLimit, Outcome::OutputLimit { .. }) => true,
            (Expected::Violation, Outcome::ProtocolViolation { phase: p, .. }) => *p == phase,
            (Expected::Harmless, Outcome::Completed) => true,
            _ => false,
        }
    }
}

fn catalogue() -> Vec<&'static Attack> {
    [system::FILES, system::PROCESSES, system::KERNEL, resources::ALL, crashes::ALL, memory::ALL]
        .into_iter()
        .flatten()
        .collect()
}

/// Runs one form of an attack: two questions, so that a harmless one has to go on being honest.
fn run(attack: &Attack, constructor: bool) -> Ending {
    let mut defines = attack.defines.to_vec();
    defines.extend((constructor && attack.form != Form::Loading).then_some("IN_CONSTRUCTOR"));
    defines.extend((attack.form == Form::Contacts).then_some("IN_CONTACTS"));
    let mut session = match start(&launcher(), &fixture(&defines)) {
        Ok(session) => session,
        Err(ending) => return ending,
    };
    if attack.form == Form::Contacts {
        let _ = session.query(Query::CollisionAll, &apart(0.5));
    }
    for (distance, hit) in [(0.5, true), (2.0, false)] {
        match session.query(Query::CollisionFirst, &apart(distance)) {
            Ok(sample) => {
                assert!(matches!(sample.answer, ocb_core::query::Answer::Collision { hit: h, .. } if h == hit))
            }
            Err(_) => break,
        }
    }
    session.finish()
}

fn check(attack: &Attack, constructor: bool) -> Result<(), String> {
    let ending = run(attack, constructor);
    let phase = if constructor { Phase::Load } else { Phase::Query };
    if attack.expected.met_by(&ending, phase) {
        return Ok(());
    }
    let form = if constructor { " (constructor)" } else { "" };
    Err(format!("{}{form} {}: {ending}, not {}", attack.id, attack.defines.join(" "), attack.expected.text()))
}

#[test]
fn every_attack_has_its_outcome() {
    let forms = |attack: &'static Attack| {
        let loading = (attack.form == Form::QueryAndConstructor).then_some((attack, true));
        [(attack, attack.form == Form::Loading)].into_iter().chain(loading)
    };
    let all: Vec<(&Attack, bool)> = catalogue().into_iter().flat_map(forms).collect();
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    // Several at a time: some only wait for their limit. A jail stays with the thread that started it.
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                while let Some((attack, constructor)) = all.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if let Err(reason) = check(attack, *constructor) {
                        wrong.lock().unwrap().push(reason);
                    }
                }
            });
        }
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(wrong.is_empty(), "{} of {} went otherwise:\n{}", wrong.len(), all.len(), wrong.join("\n"));
}

/// The part of the README between its two marks.
const MARKS: [&str; 2] = ["<!-- catalogue: written by its test -->\n", "<!-- end of the catalogue -->\n"];

#[test]
fn the_readme_has_this_table() {
    let mut table = String::from("\n| id | attack | strikes in | outcome |\n| --- | --- | --- | --- |\n");
    for attack in catalogue() {
        let form = match attack.form {
            Form::Query => "query",
            Form::QueryAndConstructor => "query, constructor",
            Form::Loading => "loading",
            Form::Contacts => "contacts",
        };
        let row = format!("| {} | {} | {form} | {} |\n", attack.id, attack.title, attack.expected.text());
        table.push_str(&row);
    }
    table.push('\n');
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/README.md");
    let readme = std::fs::read_to_string(path).unwrap();
    let (before, rest) = readme.split_once(MARKS[0]).expect("the README has a place for the catalogue");
    let (now, after) = rest.split_once(MARKS[1]).expect("and its end");
    if std::env::var_os("UPDATE_CATALOGUE").is_some() {
        let [begin, end] = MARKS;
        std::fs::write(path, format!("{before}{begin}{table}{end}{after}")).unwrap();
        return;
    }
    assert!(now == table, "the README's catalogue is out of date; UPDATE_CATALOGUE=1 writes it");
}
