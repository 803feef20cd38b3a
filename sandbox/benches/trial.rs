//! The fixed cost of a trial: from the order to the first question, for plugins of different sizes.
//!
//! `cargo bench --bench trial -- [ROUNDS] [PLUGIN.so:ALGORITHM ...]`

use std::path::{Path, PathBuf};
use std::time::Instant;

use nalgebra::Point3;
use ocb_core::mesh::Mesh;
use ocb_core::query::Semantics;
use ocb_sandbox::{Launcher, Policy, Trial};

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
        let start = median(rounds, || begin(&launcher, plugin, algorithm));
        let describe = median(rounds, || launcher.describe(plugin).map(drop).expect("it describes itself"));
        println!("{algorithm:<12} {:>7.2} MB  start {start}   describe {describe}", bytes as f64 / 1e6);
    }
}

fn begin(launcher: &Launcher, plugin: &Path, algorithm: &str) {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]].map(Point3::from);
    let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2], [2, 1, 3]]).expect("two triangles");
    let trial =
        Trial { plugin, algorithm, mesh_a: &mesh, mesh_b: None, parameters: &[], semantics: Semantics::Surface };
    drop(launcher.start(&trial).expect("it starts"));
}

/// Of what the closure takes, with the first as warm-up.
fn median(rounds: usize, mut work: impl FnMut()) -> String {
    work();
    let mut times: Vec<f64> = Vec::with_capacity(rounds);
    for _ in 0..rounds {
        let begun = Instant::now();
        work();
        times.push(begun.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    format!("{:6.2} ({:.2} to {:.2})", times[rounds / 2], times[0], times[rounds - 1])
}
