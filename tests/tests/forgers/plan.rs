//! Which runs are made: classes, question, and the machine's condition.

use crate::kit::{self, Class, HONEST};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Question {
    /// Do they collide? In every configuration of these sets they do not.
    Collision,
    /// How far apart are they?
    Distance,
}

/// On what kind of machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Condition {
    /// One CPU: supervisor and runner sleep in turn (the futex clock).
    pub one_cpu: bool,
    /// A loop runs on every CPU.
    pub busy: bool,
}

/// One `ocb bench`.
#[derive(Clone, Debug)]
pub struct Run {
    /// The classes whose libraries take part.
    pub classes: Vec<Class>,
    /// The algorithms of each class, without its name.
    pub algorithms: Vec<&'static str>,
    /// What is asked.
    pub question: Question,
    /// Where.
    pub condition: Condition,
    /// How many configurations.
    pub configurations: u32,
    /// Another set for another seed.
    pub seed: usize,
    /// A slow algorithm with the id of the reference takes part, its library named before ours.
    pub twin_of_the_reference: bool,
}

const QUIET: Condition = Condition { one_cpu: false, busy: false };

/// The grossest of each kind, in less than a minute.
pub fn slice() -> Vec<Run> {
    let one_cpu = Condition { one_cpu: true, ..QUIET };
    let all = |extra: &[&'static str]| HONEST.iter().chain(extra).copied().collect::<Vec<_>>();
    let run = |class, question, condition, extra| Run {
        classes: vec![class],
        algorithms: all(extra),
        question,
        condition,
        configurations: 150,
        seed: 0,
        twin_of_the_reference: condition == one_cpu,
    };
    let movers = ["mover_warm_up", "mover_constructor", "mover_create", "mover_gaps"];
    let guesses = ["disturb_all", "disturb_sleep", "truth_last", "adapt_time", "adapt_count", "early_guess"];
    let distances = ["disturb_all", "memo_relative", "memo_lengths", "truth_single"];
    vec![
        run(Class::Us20, Question::Collision, QUIET, &[&guesses[..], &movers[..]].concat()),
        run(Class::Us100, Question::Collision, QUIET, &guesses[..4]),
        run(Class::Us100, Question::Distance, QUIET, &distances),
        run(
            Class::Us20,
            Question::Collision,
            one_cpu,
            &["disturb_all", "disturb_yield", "truth_sample", "early_awake", "mover_warm_up", "mover_gaps"],
        ),
    ]
}

/// After so many runs every algorithm was measured under all conditions.
pub const CYCLE: usize = 64;

/// `CLASS:CONDITION` of those runs of a campaign that are made, as `300ns:one-busy-cpu`.
#[derive(Clone, Copy, Debug)]
pub struct At<'a>(pub &'a str);

impl At<'_> {
    fn takes(self, run: &Run) -> bool {
        let condition = match (run.condition.one_cpu, run.condition.busy) {
            (false, false) => "quiet",
            (false, true) => "busy",
            (true, false) => "one-cpu",
            (true, true) => "one-busy-cpu",
        };
        run.classes.iter().any(|class| self.0 == format!("{}:{condition}", class.name()))
    }
}

/// So many runs, every algorithm in turn under all conditions. The honest ones and those that disturb others are in every run, of
/// the rest half: a campaign is there to see the honest ones often, and takes half of the time so. Of `only` these forgers all are
/// in every run, so that their medians are known sooner; `at` leaves out all other runs, for the same reason.
pub fn campaign(runs: usize, only: Option<&str>, at: Option<At>) -> Vec<Run> {
    let parts = [
        (Class::Us20, Question::Collision),
        (Class::Ns300, Question::Collision),
        (Class::Us1, Question::Collision),
        (Class::Us3, Question::Collision),
        (Class::Us20, Question::Distance),
        (Class::Us100, Question::Collision),
        (Class::Us100, Question::Distance),
        (Class::Ms7, Question::Collision),
    ];
    let one = |i: usize| {
        let (part, turn) = (i % parts.len(), i / parts.len());
        let (class, question) = parts[part];
        let condition = Condition { one_cpu: turn % 2 == 1, busy: turn / 2 % 2 == 1 };
        let algorithms = match only {
            Some(names) => chosen(names),
            None if class == Class::Ms7 => slow_ones(),
            None => half(turn / 4 % 2),
        };
        Run {
            classes: vec![class],
            algorithms,
            question,
            condition,
            configurations: if class == Class::Ms7 { 24 } else { 100 },
            seed: i,
            twin_of_the_reference: i % 7 == 6,
        }
    };
    assert!(at.is_none_or(|at| (0..CYCLE).map(one).any(|run| at.takes(&run))), "OCB_FORGERS_AT names no runs: {at:?}");
    (0..).map(one).filter(|run| at.is_none_or(|at| at.takes(run))).take(runs).collect()
}

/// One half of the kit or the other, in the order of the library, with those that belong into every run.
fn half(which: usize) -> Vec<&'static str> {
    let always = |name: &str| kit::is_honest(name) || name.starts_with("noise_") || name == "courier";
    let chosen = kit::all().into_iter().enumerate().filter(|(n, name)| n % 2 == which || always(name));
    chosen.map(|(_, name)| name).collect()
}

/// The honest ones and the forgers of a list with commas.
fn chosen(names: &str) -> Vec<&'static str> {
    let names: Vec<&str> = names.split(',').collect();
    let unknown: Vec<_> = names.iter().filter(|name| !kit::all().contains(name)).collect();
    assert!(unknown.is_empty(), "OCB_FORGERS_ONLY names no forgers: {unknown:?}");
    kit::all().into_iter().filter(|name| kit::is_honest(name) || names.contains(name)).collect()
}

/// Enough of each kind where every question takes milliseconds.
fn slow_ones() -> Vec<&'static str> {
    let some =
        ["memo_axes", "disturb_all", "disturb_sleep", "disturb_hard", "truth_last", "truth_coin", "truth_learned"];
    let others =
        ["mover_warm_up", "mover_gaps", "early_commit", "early_guess", "adapt_time", "adapt_controls", "friend"];
    HONEST.into_iter().chain(some).chain(others).collect()
}

#[test]
fn a_soak_reaches_every_algorithm_under_all_conditions() {
    let runs = campaign(CYCLE, None, None);
    for name in kit::all() {
        for (one_cpu, busy) in [(false, false), (false, true), (true, false), (true, true)] {
            let condition = Condition { one_cpu, busy };
            let reached = |run: &&Run| run.condition == condition && run.algorithms.contains(&name);
            assert!(runs.iter().any(|run| reached(&run)), "{name} {condition:?}");
        }
    }
}
