//! The fixed cost of a trial: from the order to the first question, and what ending it takes, for plugins of different sizes.
//!
//! `cargo bench --bench trial -- [ROUNDS] [PLUGIN.so:ALGORITHM ...]`

use std::path::{Path, PathBuf};
use std::time::Instant;

use nalgebra::Point3;
use ocb_core::mesh::Mesh;
use ocb_sandbox::{Launcher, Policy, Session, Trial};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let rounds = arguments.first().and_then(|n| n.parse().ok()).unwrap_or(50usize);
    // Cargo builds the shipped plugins into the same folder as the runner.
    let runner = PathBuf::from(env!("CARGO_BIN_EXE_ocb-runner"));
    let shipped = [
        ("libocb_brute_force.so", "brute-force"),
        ("libocb_box_tree.so", "box-tree"),
        ("libocb_fast.so", "ocb-fast"),
        ("libocb_parry.so", "parry"),
    ];
    let named: Vec<(PathBuf, String)> = match arguments.get(1..) {
        None | Some([]) => shipped.iter().map(|(f, a)| (runner.with_file_name(f), (*a).to_string())).collect(),
        Some(named) => named.iter().filter_map(|n| n.split_once(':')).map(|(f, a)| (f.into(), a.into())).collect(),
    };
    let policy = Policy { runner_cpu: Some(1), supervisor_cpu: Some(0), ..Policy::default() };
    let launcher = Launcher::new(runner, policy);
    println!("fixed cost of a trial, {rounds} each, milliseconds: median (fastest to slowest)");
    for (plugin, algorithm) in named.iter().filter(|(plugin, _)| plugin.exists()) {
        let bytes = std::fs::metadata(plugin).map_or(0, |m| m.len());
        let (start, end) = median(rounds, || begin(&launcher, plugin, algorithm));
        let (describe, _) = median(rounds, || launcher.describe(plugin).expect("it describes itself"));
        println!("{algorithm:<12} {:>7.2} MB  start {start}   end {end}   describe {describe}", bytes as f64 / 1e6);
    }
}

fn begin(launcher: &Launcher, plugin: &Path, algorithm: &str) -> Session {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]].map(Point3::from);
    let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2], [2, 1, 3]]).expect("two triangles");
    let trial = Trial::new(plugin, algorithm, &mesh, None);
    launcher.start(&trial).expect("it starts")
}

/// Of what the closure takes, and of what it takes to drop its result; the first is warm-up.
fn median<T>(rounds: usize, mut work: impl FnMut() -> T) -> (String, String) {
    drop(work());
    let mut times = [(); 2].map(|()| Vec::with_capacity(rounds));
    for _ in 0..rounds {
        let begun = Instant::now();
        let result = work();
        times[0].push(begun.elapsed().as_secs_f64() * 1e3);
        let begun = Instant::now();
        drop(result);
        times[1].push(begun.elapsed().as_secs_f64() * 1e3);
    }
    let [start, end] = times.map(|mut all| {
        all.sort_by(f64::total_cmp);
        format!("{:6.2} ({:.2} to {:.2})", all[rounds / 2], all[0], all[rounds - 1])
    });
    (start, end)
}
