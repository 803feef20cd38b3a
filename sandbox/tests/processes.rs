//! What happens around a supervisor: it dies, or it belongs to an ordinary user.
//!
//! This program has no test harness, since it starts copies of itself that play those supervisors.

mod common;

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::{alive, apart, fixture, groups_of, launcher_with, policy, runner, start};
use ocb_core::query::Query;
use ocb_sandbox::doctor::{Diagnosis, State, examine};
use ocb_sandbox::inside;
use ocb_sandbox::work::{Seen, Work};
use ocb_sandbox::{Launcher, Outcome, Policy, Profile};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [_, "hang", plugin] => hang(Path::new(plugin)),
        [_, "ordinary", folder] => ordinary(Path::new(folder)),
        [_, "launch" | "run", ..] => {
            inside::task::main(|input, threads, _| format!("{} bytes, {threads}", input.len()).into_bytes())
        }
        [_, "refused", folder] => where_namespaces_are_refused(Path::new(folder)),
        _ => {
            the_death_of_the_supervisor_ends_the_jail();
            here();
            another_user("ordinary");
            another_user("refused");
        }
    }
}

#[expect(clippy::disallowed_methods, reason = "the test plays supervisors, which are processes")]
fn command(program: &Path) -> Command {
    Command::new(program)
}

/// A supervisor whose plugin never answers.
fn hang(plugin: &Path) {
    let mut session = start(&launcher_with(Policy { query_seconds: 60.0, ..policy() }), plugin).unwrap();
    println!("runner {}", session.pid());
    let _ = session.query(Query::CollisionFirst, &apart(0.5));
}

fn the_death_of_the_supervisor_ends_the_jail() {
    let mut supervisor = command(&std::env::current_exe().unwrap());
    supervisor.arg("hang").arg(fixture(&["ATTACK=sleep_forever"])).stdout(Stdio::piped());
    let mut supervisor = supervisor.spawn().unwrap();
    let mut lines = BufReader::new(supervisor.stdout.take().unwrap()).lines().map_while(Result::ok);
    let runner = lines.find_map(|line| line.strip_prefix("runner ")?.parse().ok()).expect("it tells its runner");
    assert!(alive(runner));
    supervisor.kill().unwrap();
    supervisor.wait().unwrap();
    // Within a second, and later where other work keeps the CPUs from the three processes of the jail.
    assert!(gone_within(runner, Duration::from_secs(10)), "the runner outlived its supervisor");
    // What a process cannot take away after its death, the next supervisor does when it starts its first jail.
    let left = groups_of(supervisor.id());
    drop(start(&launcher_with(policy()), &fixture(&[])).unwrap());
    assert_eq!(groups_of(supervisor.id()), Vec::<PathBuf>::new(), "of {left:?}");
    // SAFETY: reads a number.
    assert!(!left.is_empty() || unsafe { libc::geteuid() } != 0, "root's jails have a memory group");
    println!("test the_death_of_the_supervisor_ends_the_jail ... ok");
}

fn gone_within(pid: i32, time: Duration) -> bool {
    let start = Instant::now();
    while alive(pid) {
        if start.elapsed() > time {
            return false;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    true
}

/// As whoever runs the tests.
fn here() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(runner(), folder.path().join("ocb-runner")).unwrap();
    std::fs::copy(fixture(&[]), folder.path().join("honest.so")).unwrap();
    std::fs::set_permissions(folder.path(), std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
    let diagnosis = production_is_what_the_doctor_says(folder.path());
    assert!(diagnosis.own_plugins && diagnosis.facilities.len() >= 12, "{diagnosis:#?}");
    println!("test the_doctor_is_right ... ok (production: {})", diagnosis.production);
}

/// Plays a part as an ordinary user, from a folder that everybody may enter with everything in it that is needed.
fn another_user(part: &str) {
    let folder = tempfile::Builder::new().prefix("ocb-ordinary").tempdir_in("/tmp").unwrap();
    let open = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    std::fs::set_permissions(folder.path(), open).unwrap();
    let place = |from: &Path, name: &str| std::fs::copy(from, folder.path().join(name)).unwrap();
    place(&std::env::current_exe().unwrap(), "test");
    place(&runner(), "ocb-runner");
    place(&fixture(&[]), "honest.so");
    place(&fixture(&["ATTACK=raw_call", "RAW=41"]), "socket.so");
    // While it is loaded: later nothing is opened, whatever the files allow.
    place(&fixture(&["ATTACK=open_passwd", "IN_CONSTRUCTOR"]), "open.so");
    place(&fixture(&["ATTACK=many_threads"]), "threads.so");
    // In a user namespace of its own a process may forbid further ones to itself and its children.
    let refuse = "echo 0 > /proc/sys/user/max_user_namespaces && exec \"$@\"";
    // SAFETY: reads a number.
    let root = unsafe { libc::geteuid() } == 0;
    let mut words: Vec<&str> = if root { vec!["runuser", "-u", "nobody", "--"] } else { Vec::new() };
    if part == "refused" {
        words.extend(["unshare", "-Ur", "sh", "-c", refuse, "sh"]);
    }
    let program = folder.path().join("test");
    words.extend([program.to_str().unwrap(), part, folder.path().to_str().unwrap()]);
    let output = command(Path::new(words[0])).args(&words[1..]).current_dir("/").output().unwrap();
    assert!(output.status.success(), "{part}: {}", String::from_utf8_lossy(&output.stderr));
    println!("test plugins run for an ordinary user ({part}) ... ok");
}

/// A program of ours does its work in the jail, with threads where these are counted.
fn work_is_done(program: &Path, threads: bool) {
    let mut work = Work::start(program, &Policy { threads: 2, ..policy() }, &[0; 5], 64).unwrap();
    while work.look().unwrap() != Seen::Done {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!(String::from_utf8(work.finish().unwrap()).unwrap(), format!("5 bytes, {threads}"));
}

fn ordinary(folder: &Path) {
    work_is_done(&folder.join("test"), true);
    let diagnosis = production_is_what_the_doctor_says(folder);
    assert!(diagnosis.dev && diagnosis.own_plugins, "{diagnosis:#?}");
    let launcher = Launcher::new(folder.join("ocb-runner"), policy());
    let mut session = start(&launcher, &folder.join("honest.so")).unwrap();
    let layers = session.layers().join("; ");
    assert!(layers.contains("pid, net, mount") && layers.contains("ids of this user"), "{layers}");
    session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
    assert_eq!(session.finish().outcome, Outcome::Completed);
    let mut session = start(&launcher, &folder.join("socket.so")).unwrap();
    let outcome = session.query(Query::CollisionFirst, &apart(0.5)).unwrap_err();
    assert!(matches!(&outcome, Outcome::SyscallDenied { call, .. } if call.nr == libc::SYS_socket), "{outcome}");
    // Threads are counted in the jail's user namespace: those of this user's other programs do not matter.
    let threads = Launcher::new(folder.join("ocb-runner"), Policy { threads: 2, ..policy() });
    let mut session = start(&threads, &folder.join("threads.so")).unwrap();
    let outcome = session.query(Query::CollisionFirst, &apart(0.5)).unwrap_err();
    assert!(outcome.to_string().contains("16 threads, then EAGAIN"), "{outcome}");
}

/// What `ocb doctor` tells is what happens, and what is missing is told with the way to get it.
fn production_is_what_the_doctor_says(folder: &Path) -> Diagnosis {
    let diagnosis = examine(&folder.join("ocb-runner"));
    let production = Policy { profile: Profile::Production, ..policy() };
    match start(&Launcher::new(folder.join("ocb-runner"), production), &folder.join("honest.so")) {
        Ok(session) => assert!(diagnosis.production, "{:?} but {diagnosis:#?}", session.layers()),
        Err(ending) => {
            assert!(!diagnosis.production, "{ending} but {diagnosis:#?}");
            assert!(ending.outcome.ours() && ending.to_string().contains("--profile dev"), "{ending}");
        }
    }
    for facility in &diagnosis.facilities {
        assert!(facility.state == State::Good || facility.get.is_some_and(|get| get.len() > 10), "{facility:?}");
    }
    diagnosis
}

/// Foreign plugins are refused with the reason; the ones we built run under the layers that remain, and a developer may
/// run others so.
fn where_namespaces_are_refused(folder: &Path) {
    work_is_done(&folder.join("test"), false);
    let diagnosis = production_is_what_the_doctor_says(folder);
    assert!(!diagnosis.production && diagnosis.own_plugins, "{diagnosis:#?}");
    let namespaces = diagnosis.facilities.iter().find(|f| f.name == "user namespaces").unwrap();
    assert_eq!(namespaces.state, State::Missing);
    assert!(namespaces.get.unwrap().contains("max_user_namespaces"));

    let production = Policy { profile: Profile::Production, ..policy() };
    let foreign = Launcher::new(folder.join("ocb-runner"), production.clone());
    let Err(refused) = start(&foreign, &folder.join("honest.so")) else { panic!("it ran without namespaces") };
    let Outcome::SandboxFault { step, reason } = &refused.outcome else { panic!("{refused}") };
    assert!(step == "Namespaces" && reason.contains("max_user_namespaces"), "{refused}");

    let several = Policy { trusted: true, threads: 2, ..production.clone() };
    let Err(refused) = start(&Launcher::new(folder.join("ocb-runner"), several), &folder.join("honest.so")) else {
        panic!("threads that nobody counts")
    };
    assert!(matches!(&refused.outcome, Outcome::SandboxFault { step, .. } if step == "Threads"), "{refused}");

    for policy in [Policy { trusted: true, ..production }, Policy { profile: Profile::Dev, ..policy() }] {
        let launcher = Launcher::new(folder.join("ocb-runner"), policy);
        let mut session = start(&launcher, &folder.join("honest.so")).unwrap();
        let layers = session.layers().join("; ");
        assert!(layers.contains("NO namespaces") && layers.contains("Landlock"), "{layers}");
        session.query(Query::CollisionFirst, &apart(0.5)).unwrap();
        assert_eq!(session.finish().outcome, Outcome::Completed);
        let mut session = start(&launcher, &folder.join("socket.so")).unwrap();
        let outcome = session.query(Query::CollisionFirst, &apart(0.5)).unwrap_err();
        assert!(matches!(&outcome, Outcome::SyscallDenied { call, .. } if call.nr == libc::SYS_socket), "{outcome}");
        // Without a root of its own it is Landlock that keeps files shut.
        let mut session = start(&launcher, &folder.join("open.so")).unwrap();
        let outcome = session.query(Query::CollisionFirst, &apart(0.5)).unwrap_err();
        assert!(outcome.to_string().contains("EACCES"), "{outcome}");
    }
}
