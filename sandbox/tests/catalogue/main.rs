//! The hostile catalogue: every attack has exactly its expected outcome, and the table in `sandbox/README.md` says so.

/// One attack: the name of its function in `fixtures/attacks/`, and what else the compiler is told.
macro_rules! attack {
    ($id:expr, $title:expr, $name:literal $([$($more:expr),*])?, $form:expr, $expected:expr) => {
        Attack {
            id: $id,
            title: $title,
            defines: &[concat!("ATTACK=", $name) $($(, $more)*)?],
            form: $form,
            expected: $expected,
        }
    };
}

mod answers;
mod clock;
#[path = "../common/mod.rs"]
mod common;
mod crashes;
mod expected;
mod memory;
mod pass;
mod resources;
mod run;
mod system;
mod threads;
mod traces;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use common::Others;
use expected::Expected;
use run::check;

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

impl Attack {
    /// Is it after files, the network, the kernel, processes or resources, or does it crash? None of that depends on times, so the
    /// clock is rough, which leaves a CPU to the other programs.
    fn is_untimed(&self) -> bool {
        self.form != Form::Pass && self.id.starts_with(['F', 'N', 'K', 'P', 'R', 'C'])
    }
}

/// When an attack strikes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// While a collision query is answered.
    Query,
    /// The same, and once more in a constructor, while the file is loaded.
    QueryAndConstructor,
    /// While the file is loaded, whatever the attack's function does later.
    Loading,
    /// While contacts are listed: then the plugin knows where the answer's memory lies.
    Contacts,
    /// While a collision query is answered, in the multi-threaded track.
    Threads,
    /// While contacts are listed, in the multi-threaded track.
    ThreadsContacts,
    /// While distances are answered, which are judged.
    Distances,
    /// While a collision query is answered, in two trials, one after the other.
    Twice,
    /// In a thousand questions of a pass, in several processes.
    Pass,
    /// While the third object of a scene of four is built.
    ThirdObject,
}

impl Form {
    fn text(self) -> &'static str {
        match self {
            Form::Query => "query",
            Form::QueryAndConstructor => "query, constructor",
            Form::Loading => "loading",
            Form::Contacts => "contacts",
            Form::Threads => "query, several threads",
            Form::ThreadsContacts => "contacts, several threads",
            Form::Distances => "distances",
            Form::Twice => "query, two trials",
            Form::Pass => "passes",
            Form::ThirdObject => "build, third object of a scene",
        }
    }
}

fn catalogue() -> Vec<&'static Attack> {
    let system = [system::FILES, system::PROCESSES, system::KERNEL];
    let rest = [threads::ALL, resources::ALL, crashes::ALL, memory::ALL, answers::ALL, clock::ALL, traces::ALL];
    system.into_iter().chain(rest).flatten().collect()
}

/// One at a time: other work disturbs the clock, and a disturbed clock finds nothing.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

#[test]
fn every_attack_has_its_outcome() {
    let _alone = alone();
    let forms = |attack: &'static Attack| {
        let loading = (attack.form == Form::QueryAndConstructor).then_some((attack, true));
        [(attack, attack.form == Form::Loading)].into_iter().chain(loading)
    };
    let once = catalogue().into_iter().filter(|attack| attack.form != Form::Pass);
    let all: Vec<(&Attack, bool)> = once.flat_map(forms).collect();
    // What the host knows and no plugin may find; `search_memory` looks for it.
    let reference = std::hint::black_box(vec![memory::CANARY; 4096]);
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
    assert!(reference.iter().all(|word| *word == memory::CANARY));
    let wrong = wrong.into_inner().unwrap();
    assert!(wrong.is_empty(), "{} of {} went otherwise:\n{}", wrong.len(), all.len(), wrong.join("\n"));
}

/// An attack that statistics find is found in at least nine of ten measurements on quiet CPUs, of which the campaign makes all and
/// others three; the test prints in how many.
#[test]
fn attacks_on_many_questions_have_their_outcome() {
    let _alone = alone();
    let others = Others::look();
    let passes = catalogue().into_iter().filter(|attack| attack.form == Form::Pass);
    let (by_statistics, always): (Vec<&Attack>, Vec<&Attack>) =
        passes.partition(|attack| matches!(attack.expected, Expected::Caught(_)));
    let wrong = |attacks: &[&Attack]| -> Vec<String> {
        attacks.iter().filter_map(|attack| check(attack, false).err()).collect()
    };
    let [always, by_statistics] = [wrong(&always), wrong(&by_statistics)];
    assert!(always.is_empty(), "{}", always.join("\n"));
    others.hold(by_statistics.is_empty(), || by_statistics.join("\n"));
}

/// The part of the README between its two marks.
const MARKS: [&str; 2] = ["<!-- catalogue: written by its test -->\n", "<!-- end of the catalogue -->\n"];

#[test]
fn the_readme_has_this_table() {
    let mut table = String::from("\n| id | attack | strikes in | outcome |\n| --- | --- | --- | --- |\n");
    for attack in catalogue() {
        let (form, outcome) = (attack.form.text(), attack.expected.text());
        let row = format!("| {} | {} | {form} | {outcome} |\n", attack.id, attack.title);
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
