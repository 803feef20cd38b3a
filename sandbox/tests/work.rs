//! A program that does one piece of work in a jail: what it can do, how it may end badly, and that nothing of it stays.
//!
//! This program has no test harness: under other names, it is the program in the jail.

mod common;

use std::fs::File;
use std::net::TcpStream;
use std::path::Path;
use std::time::{Duration, Instant};

use common::alive;
use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
use nix::unistd::Pid;
use ocb_sandbox::inside::{program, task};
use ocb_sandbox::work::{Seen, Work};
use ocb_sandbox::{Ending, Outcome, Policy};

/// Room for a result.
const ROOM: usize = 1 << 20;

fn main() {
    match std::env::args().nth(1).as_deref() {
        Some("launch" | "run") => task::main(behave),
        Some("--list") => println!("work: test"),
        _ => {
            work_is_done_with_and_without_threads();
            it_tells_how_far_it_is_and_keeps_to_the_cpus_of_its_watcher();
            times_are_taken_by_leave_alone();
            what_fails_has_a_name_and_harms_nothing();
            who_is_stopped_is_gone();
            println!("work in a jail ... ok");
        }
    }
}

/// What the program does is its name.
fn behave(input: &[u8], may_start_threads: bool, desk: &task::Desk<'_>) -> Vec<u8> {
    match program().as_str() {
        "adds" => {
            let sum = || input.iter().map(|byte| u64::from(*byte)).sum::<u64>();
            let sums = || {
                std::thread::scope(|scope| {
                    let threads = [0; 8].map(|_| scope.spawn(sum));
                    threads.into_iter().map(|thread| thread.join().unwrap()).sum::<u64>()
                })
            };
            desk.ask_to_measure();
            (if may_start_threads { sums() } else { 8 * sum() }).to_string().into_bytes()
        }
        "reads" => format!("{:?}", File::open("/etc/passwd").map(|_| ()).map_err(|e| e.kind())).into_bytes(),
        "writes" => format!("{:?}", File::create("/left")).into_bytes(),
        "connects" => format!("{:?}", TcpStream::connect("127.0.0.1:9")).into_bytes(),
        "crashes" => {
            // SAFETY: none; this is the crash.
            unsafe { std::ptr::dangling_mut::<u8>().write_volatile(1) };
            Vec::new()
        }
        "loops" => {
            desk.progress(3, 5, 9);
            loop {
                std::hint::spin_loop();
            }
        }
        "swells" => {
            let mut all = Vec::new();
            loop {
                all.push(std::hint::black_box(vec![1u8; 1 << 20]));
            }
        }
        "says too much" => vec![0; ROOM + 1],
        other => panic!("no such program: {other}"),
    }
}

fn policy() -> Policy {
    Policy { threads: 2, memory_bytes: 256 << 20, trial_seconds: 60.0, ..Policy::default() }
}

/// This program under another name, with so many bytes of value 2.
fn start(name: &str, policy: &Policy) -> Work {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join(name);
    std::os::unix::fs::symlink(std::env::current_exe().unwrap(), &program).unwrap();
    Work::start(&program, policy, &[2; 1000], ROOM).unwrap_or_else(|ending| panic!("{name}: {ending}"))
}

/// Its result or how it ended.
fn end(mut work: Work) -> Result<Vec<u8>, Ending> {
    loop {
        match work.look() {
            Ok(Seen::Done) => return work.finish(),
            Ok(Seen::AsksToMeasure) => work.grant(),
            Ok(Seen::Working { .. }) => std::thread::sleep(Duration::from_millis(1)),
            Err(outcome) => return Err(work.fail(outcome)),
        }
    }
}

fn work_is_done_with_and_without_threads() {
    let text = |work| String::from_utf8(end(work).unwrap_or_else(|e| panic!("{e}: {}", e.stderr))).unwrap();
    assert_eq!(text(start("adds", &policy())), "16000");
    assert_eq!(text(start("adds", &Policy { threads: 1, ..policy() })), "16000");
}

fn times_are_taken_by_leave_alone() {
    let mut work = start("adds", &Policy { trial_seconds: 0.5, ..policy() });
    while work.look().unwrap() != Seen::AsksToMeasure {}
    // Waiting costs nothing of its time.
    std::thread::sleep(Duration::from_millis(700));
    assert_eq!(work.look().unwrap(), Seen::AsksToMeasure);
    work.grant();
    assert_eq!(end(work).unwrap(), b"16000");
}

fn what_fails_has_a_name_and_harms_nothing() {
    // It finds no file, as there is none.
    assert_eq!(end(start("reads", &policy())).unwrap(), b"Err(NotFound)");
    let denied = |name, call: &str| match end(start(name, &policy())).unwrap_err().outcome {
        Outcome::SyscallDenied { call: denied, .. } => assert_eq!(denied.name, call),
        other => panic!("{name}: {other}"),
    };
    denied("writes", "openat");
    denied("connects", "socket");
    let crash = end(start("crashes", &policy())).unwrap_err().outcome;
    assert!(matches!(crash, Outcome::Signaled { signal: libc::SIGSEGV, .. }), "{crash}");
    let late = end(start("loops", &Policy { trial_seconds: 0.2, ..policy() })).unwrap_err().outcome;
    assert!(matches!(late, Outcome::TimedOut { .. }), "{late}");
    let large = end(start("swells", &policy())).unwrap_err().outcome;
    // Without a memory group its own allocator ends it.
    assert!(matches!(large, Outcome::OutOfMemory { .. } | Outcome::Signaled { signal: libc::SIGABRT, .. }), "{large}");
    let long = end(start("says too much", &policy())).unwrap_err();
    assert!(long.stderr.contains("too many"), "{long}: {}", long.stderr);
    let missing = Work::start(Path::new("/nowhere/at-all"), &policy(), &[], ROOM).err().expect("it is not there");
    assert!(missing.outcome.ours(), "{missing}");
    assert_eq!(end(start("adds", &policy())).unwrap(), b"16000");
}

fn it_tells_how_far_it_is_and_keeps_to_the_cpus_of_its_watcher() {
    let mut work = start("loops", &policy());
    while work.look().unwrap() != (Seen::Working { step: 3, done: 5, total: 9 }) {}
    let (this, it) = (Pid::from_raw(0), Pid::from_raw(work.pid()));
    let all = sched_getaffinity(this).unwrap();
    let last = (0..CpuSet::count()).rfind(|cpu| all.is_set(*cpu).unwrap()).unwrap();
    let mut one = CpuSet::new();
    one.set(last).unwrap();
    for cpus in [one, all] {
        sched_setaffinity(this, &cpus).unwrap();
        work.look().unwrap();
        assert_eq!(sched_getaffinity(it).unwrap(), cpus);
    }
}

fn who_is_stopped_is_gone() {
    let work = start("loops", &policy());
    let pid = work.pid();
    assert!(alive(pid));
    let begun = Instant::now();
    drop(work);
    assert!(!alive(pid));
    // It is killed, not asked.
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
}
