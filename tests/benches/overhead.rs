//! What interface and jail cost: FCL as a plugin against FCL called directly, on the same configurations, in turn.
//!
//! `cargo bench --bench overhead -- FILE.obj [RAYS]`, after `make plugins-cpp`. Both run on the same CPU, block by block;
//! printed is the ratio of the medians over the configurations that take more than 20 us directly.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::Arc;
use std::time::Duration;

use ocb_core::configuration::{Configuration, Method, Sampling, Separation};
use ocb_core::mesh::{Mesh, obj};
use ocb_core::oracle::Shape;
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling::Plan;
use ocb_sandbox::{ClockChoice, Launcher, Objects, Policy, Profile, Session, Trial};
use ocb_tests::place::built;
use ocb_tests::process::command;

/// Questions in a row.
const BLOCK: usize = 25;
/// Every question is asked so often on either side, and its smallest time counts.
const ROUNDS: usize = 5;
/// The CPU of both; the supervisor has the other.
const CPU: usize = 1;
/// Shorter ones do not count, ns.
const LEAST: f64 = 20_000.0;
/// Until the runner has fallen asleep and the CPU is free.
const ASLEEP: Duration = Duration::from_millis(4);

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let plugin = built("ocb-runner").with_file_name("libocb_fcl.so");
    let (Some(file), true) = (arguments.first(), plugin.exists()) else {
        println!("overhead: cargo bench --bench overhead -- FILE.obj [RAYS], after make plugins-cpp");
        return;
    };
    let rays: u32 = arguments.get(1).map_or(200, |x| x.parse().expect("a number of rays"));
    let read = obj::read(&std::fs::read(file).expect("a readable OBJ file")).expect("a valid mesh");
    let mesh = Arc::new(read.mesh.to_f32_representable().expect("fits into f32"));
    let shape = Shape::new(mesh.clone());
    let method = Method::Sphere { sampling: Sampling::Count { count: rays }, seed: 0 };
    let plan = Plan::new(&shape, &shape, &method, Separation::Relative { distance: 1e-4 }).expect("a plan");
    let placed = (0..plan.units()).flat_map(|unit| plan.place(unit).placed);
    let configurations: Vec<Configuration> = placed.map(|placed| placed.configuration).collect();
    let Some(mut direct) = Direct::start(&mesh, &configurations) else { return };
    let policy = Policy {
        trusted: true,
        profile: Profile::Dev,
        clock: ClockChoice::Spin,
        runner_cpu: Some(CPU),
        supervisor_cpu: Some(1 - CPU),
        ..Policy::default()
    };
    let (algorithm, parameters, semantics) = ("fcl", &[][..], Semantics::Surface);
    let trial = Trial { plugin: &plugin, algorithm, objects: Objects::Pair(&mesh, None), parameters, semantics };
    let mut session = Launcher::new(built("ocb-runner"), policy).start(&trial).expect("a session");
    for (question, query) in [Query::CollisionFirst, Query::Proximity].into_iter().enumerate() {
        compare(question as u64, query, &configurations, &mut session, &mut direct);
    }
}

fn compare(question: u64, query: Query, configurations: &[Configuration], session: &mut Session, direct: &mut Direct) {
    let mut least = vec![[f64::INFINITY; 2]; configurations.len()];
    for _ in 0..ROUNDS {
        for (block, wanted) in configurations.chunks(BLOCK).enumerate() {
            let first = block * BLOCK;
            // The first one also wakes whoever sleeps.
            let mut ask = |configuration| session.query(query, configuration).expect("an answer").time_ns;
            ask(&wanted[0]);
            for (i, configuration) in wanted.iter().enumerate() {
                least[first + i][0] = least[first + i][0].min(ask(configuration));
            }
            std::thread::sleep(ASLEEP);
            direct.ask(question, first, 1);
            for (i, took) in direct.ask(question, first, wanted.len()).into_iter().enumerate() {
                least[first + i][1] = least[first + i][1].min(took);
            }
        }
    }
    least.retain(|[_, direct]| *direct > LEAST);
    let median = |side: usize| {
        let mut all: Vec<f64> = least.iter().map(|pair| pair[side]).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    if least.is_empty() {
        println!("{query:?}: no configuration takes more than 20 us");
        return;
    }
    let (jailed, bare) = (median(0), median(1));
    println!(
        "{query:?}: n {}, median of the smallest of {ROUNDS}: {:.1} us in the jail, {:.1} us directly, ratio {:.4}",
        least.len(),
        jailed / 1e3,
        bare / 1e3,
        jailed / bare
    );
}

/// The program in `fcl_direct.cpp`, compiled and started.
struct Direct {
    child: Child,
    _files: tempfile::TempDir,
}

impl Direct {
    /// `None`, with the reason printed, when it cannot be built.
    fn start(mesh: &Mesh, configurations: &[Configuration]) -> Option<Self> {
        let files = tempfile::tempdir().expect("a temporary folder");
        let program = files.path().join("fcl_direct");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/fcl_direct.cpp");
        let flags = ["-std=c++17", "-O3", "-DNDEBUG", "-w", "-isystem", "/usr/include/eigen3", "-o"];
        let compiled = command("c++").args(flags).arg(&program).arg(source).arg("-lfcl").output();
        if !compiled.is_ok_and(|done| done.status.success()) {
            println!("overhead: the program that calls FCL cannot be built (Debian package libfcl-dev)");
            return None;
        }
        let numbers = [mesh.positions().len() as u64, mesh.triangles().len() as u64];
        let mut bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        mesh.positions().iter().for_each(|p| bytes.extend(p.coords.iter().flat_map(|x| x.to_le_bytes())));
        bytes.extend(mesh.triangles().iter().flatten().flat_map(|i| i.to_le_bytes()));
        std::fs::write(files.path().join("mesh"), bytes).expect("room for a mesh");
        let poses = configurations.iter().flat_map(|c| c.pose_b.to_row_major());
        let poses: Vec<u8> = poses.flat_map(f64::to_le_bytes).collect();
        std::fs::write(files.path().join("poses"), poses).expect("room for poses");
        let mut pinned = command("taskset");
        pinned
            .args(["-c", &CPU.to_string()])
            .arg(program)
            .arg(files.path().join("mesh"))
            .arg(files.path().join("poses"));
        let child = pinned.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the program starts");
        Some(Self { child, _files: files })
    }

    /// Nanoseconds of each question of a block.
    fn ask(&mut self, question: u64, first: usize, count: usize) -> Vec<f64> {
        let block = [question, first as u64, count as u64].map(u64::to_le_bytes).concat();
        let stdin = self.child.stdin.as_mut().expect("piped");
        stdin.write_all(&block).and_then(|()| stdin.flush()).expect("the program listens");
        let mut answer = vec![0; 8 * count];
        self.child.stdout.as_mut().expect("piped").read_exact(&mut answer).expect("the program answers");
        answer.chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().expect("eight bytes"))).collect()
    }
}

impl Drop for Direct {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
    }
}
