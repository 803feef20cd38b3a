//! How good the clock is: what a question costs around the plugin, agreement with a clock inside, spread between
//! processes, and whether a plugin differs from itself. Needs a quiet machine with two CPUs.
//!
//! `cargo bench --bench timing -- [REPETITIONS of A/A, default 200]`

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use nalgebra::{Rotation3, Vector3};
use ocb_core::comparison::compare;
use ocb_core::configuration::Configuration;
use ocb_core::instance::{Instance, OTHER_UNITS, Presentation};
use ocb_core::mesh::Mesh;
use ocb_core::numbers::Numbers;
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query};
use ocb_core::statistics::quantile;
use ocb_sandbox::{Launcher, PassFacts, PassPlan, Policy, Question, Session, Trial, integrity};

/// Processes of one measurement.
const K: usize = 5;
/// Measurements whose spread is told.
const GROUPS: usize = 16;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let repetitions = arguments.first().and_then(|n| n.parse().ok()).unwrap_or(200);
    let runner = PathBuf::from(env!("CARGO_BIN_EXE_ocb-runner"));
    let policy = Policy { runner_cpu: Some(1), supervisor_cpu: Some(0), ..Policy::default() };
    let mesh = ocb_core::stock::generate("torus-knot", 20_000).expect("a stock object");
    let configurations = configurations(200, 0.5 * mesh.longest_side());
    let bench = Bench {
        box_tree: runner.with_file_name("libocb_box_tree.so"),
        launcher: Launcher::new(runner, policy),
        mesh,
        configurations,
    };
    println!("| what | value |\n| --- | --- |");
    bench.overhead();
    bench.agreement();
    bench.spread();
    bench.against_itself(repetitions);
}

struct Bench {
    launcher: Launcher,
    box_tree: PathBuf,
    mesh: Mesh,
    configurations: Vec<Configuration>,
}

/// Two knots near each other, turned at random: questions of some microseconds.
fn configurations(n: usize, distance: f64) -> Vec<Configuration> {
    let mut numbers = Numbers::new(1);
    let mut unit = move || numbers.bits() as f64 / 2f64.powi(64);
    let one = |_| {
        let turn = Rotation3::from_euler_angles(TAU * unit(), TAU * unit(), TAU * unit());
        let way = Rotation3::from_euler_angles(0.0, PI * unit(), TAU * unit()) * Vector3::new(distance, 0.0, 0.0);
        Configuration { pose_a: Pose::identity(), pose_b: Pose { linear: *turn.matrix(), translation: way } }
    };
    (0..n).map(one).collect()
}

/// What one process says: every official time by configuration, and the facts of its pass.
type Process = (Vec<f64>, PassFacts);

impl Bench {
    fn start(&self, plugin: &Path, algorithm: &str, mesh: &Mesh) -> Session {
        let trial = Trial::new(plugin, algorithm, mesh, None);
        self.launcher.start(&trial).expect("an honest plugin starts")
    }

    /// One pass of box-tree in a fresh process.
    fn process(&self, seed: u64) -> Process {
        let shown =
            Presentation::drawn(&self.mesh, None, self.configurations.iter(), false, seed, OTHER_UNITS.len() as u32);
        let mut session = self.start(&self.box_tree, "box-tree", shown.first());
        let mut order: Vec<u32> = (0..self.configurations.len() as u32).collect();
        Numbers::new(seed).shuffle(&mut order);
        let plan = PassPlan { order: &order, coherent: false, seed, allowance: Duration::from_secs(60) };
        let present = |i: u32, instance: Instance| {
            Question::of_pair(Query::CollisionFirst, shown.present(&self.configurations[i as usize], i, instance))
        };
        let mut times = vec![0.0; order.len()];
        let (facts, ended) = session.pass(&plan, &present, &mut |seen| {
            if let Some(time) = seen.time {
                times[seen.configuration as usize] = time.ns;
            }
            ControlFlow::Continue(())
        });
        ended.expect("an honest plugin answers");
        (times, facts)
    }

    fn overhead(&self) {
        let clocks: Vec<_> = (0..20).map(|_| *self.start(&self.box_tree, "box-tree", &self.mesh).clock()).collect();
        let median = |of: fn(&ocb_sandbox::ClockFacts) -> f64| middle(clocks.iter().map(of).collect());
        let [low, at, high] = [median(|c| c.null_p05_ns), median(|c| c.null_median_ns), median(|c| c.null_p95_ns)];
        row(
            "null round trip, median of 20 sessions (p05 to p95 within one)",
            format!("{at:.0} ns ({low:.0} to {high:.0})"),
        );
        row("each further question of a batch", format!("{:.0} ns", median(|c| c.null_each_ns)));
        row("calibration loop", format!("{:.2} us", median(|c| c.calibration_ns) / 1e3));
    }

    /// A plugin that works for 10 us and tells its own measurement as the distance. What its own clock says spreads as the
    /// machine does; how the ratio of both spreads is what the clock outside adds.
    fn agreement(&self) {
        let plugin = self_timed();
        let both: Vec<[f64; 2]> = (0..K * GROUPS).map(|_| self.own_measurement(&plugin)).collect();
        let of_groups = |of: fn(&[f64; 2]) -> f64| -> Vec<f64> {
            both.chunks(K).map(|group| middle(group.iter().map(of).collect())).collect()
        };
        let [outside, inside, ratio] = [of_groups(|[o, _]| *o), of_groups(|[_, i]| *i), of_groups(|[o, i]| o / i)];
        let [at, own, apart] = [&outside, &inside, &ratio].map(|values| middle(values.clone()));
        row(
            "10 us plugin, outside against inside",
            format!("{at:.0} against {own:.0} ns: {:+.2} %", 100.0 * (apart - 1.0)),
        );
        let [outside, inside, ratio] = [outside, inside, ratio].map(|values| 100.0 * variation(&values));
        row(
            &format!("the same, median of {K} processes: spread outside, inside, of their ratio"),
            format!("{outside:.2} %, {inside:.2} %, {ratio:.2} %"),
        );
    }

    /// Medians of one process: outside and inside, in nanoseconds.
    fn own_measurement(&self, plugin: &Path) -> [f64; 2] {
        let mut session = self.start(plugin, "self-timed", &self.mesh);
        let (mut outside, mut inside) = (Vec::new(), Vec::new());
        for _ in 0..200 {
            let sample = session.query(Query::Proximity, &self.configurations[0]).expect("an honest plugin answers");
            if let Answer::Distance { distance, .. } = sample.answer {
                outside.push(sample.time_ns);
                inside.push(distance);
            }
        }
        [outside, inside].map(middle)
    }

    fn spread(&self) {
        // The same instances in each group: a hierarchy may well like one of them better than another.
        let all: Vec<Process> = (0..K * GROUPS).map(|i| self.process((i % K) as u64)).collect();
        let groups: Vec<&[Process]> = all.chunks(K).collect();
        for (name, statistic) in [("median", middle as fn(Vec<f64>) -> f64), ("minimum", least)] {
            let of_group = |group: &[Process], i: usize| statistic(group.iter().map(|(times, _)| times[i]).collect());
            let each: Vec<Vec<f64>> = (0..self.configurations.len())
                .map(|i| groups.iter().map(|group| of_group(group, i)).collect())
                .collect();
            let mut spreads: Vec<f64> = each.iter().map(|values| 100.0 * variation(values)).collect();
            spreads.sort_by(f64::total_cmp);
            let totals: Vec<f64> = (0..GROUPS).map(|g| each.iter().map(|values| values[g]).sum()).collect();
            let (mid, high) = (quantile(&spreads, 0.5), quantile(&spreads, 0.9));
            row(
                &format!("{name} of {K} processes: spread of a query, median and p90 over {}", each.len()),
                format!("{mid:.2} %, {high:.2} %"),
            );
            row(
                &format!("{name} of {K} processes: spread of the suite's total"),
                format!("{:.2} %", 100.0 * variation(&totals)),
            );
        }
        let facts: Vec<PassFacts> = all.iter().map(|(_, facts)| facts.clone()).collect();
        let blocks: [u32; 2] = [0, 1].map(|i| facts.iter().map(|f| f.blocks[i]).sum());
        row(
            "disturbed stretches",
            format!(
                "{} of {}, {} times missed by the clock",
                blocks[1],
                blocks[0],
                facts.iter().map(|f| f.disturbed).sum::<u32>()
            ),
        );
        for finding in integrity::measured(&facts) {
            let [low, high] = finding.check.allowed();
            row(
                &format!("integrity: {} ({low} to {high} allowed)", finding.check.name()),
                format!("{:.3}", finding.found),
            );
        }
    }

    /// The same plugin as two algorithms, in turn: how often are they told apart?
    fn against_itself(&self, repetitions: u64) {
        let (mut apart, mut ratios) = (0, Vec::new());
        for repetition in 0..repetitions {
            let mut times = [(); 2].map(|()| vec![Vec::new(); self.configurations.len()]);
            for round in 0..K as u32 {
                for algorithm in &mut times {
                    let seed = 1000 + repetition * 10 + u64::from(round);
                    for (cell, ns) in algorithm.iter_mut().zip(self.process(seed).0) {
                        cell.push((round, ns));
                    }
                }
            }
            let [a, b] = &times;
            let of = self.configurations.len() as u64;
            let both = [a, b].map(|times| compare(times, Some(a), K as u32, of).expect("it was measured"));
            let [mean_a, mean_b] = both.map(|c| c.mean_ns);
            apart += u64::from(mean_a.hi < mean_b.lo || mean_b.hi < mean_a.lo);
            ratios.extend(both[1].ratio.map(|ratio| ratio.value));
        }
        if repetitions > 0 {
            let share = 100.0 * apart as f64 / repetitions as f64;
            row(
                &format!("A/A: {repetitions} comparisons of a plugin with itself, {K} processes each"),
                format!("{apart} found a difference ({share:.1} %)"),
            );
            ratios.sort_by(f64::total_cmp);
            let [low, high] = [0.025, 0.975].map(|q| quantile(&ratios, q));
            row("A/A: ratio, 2.5 % to 97.5 %", format!("{low:.4} to {high:.4}"));
        }
    }
}

fn row(what: &str, value: String) {
    println!("| {what} | {value} |");
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    quantile(&values, 0.5)
}

fn least(values: Vec<f64>) -> f64 {
    values.into_iter().fold(f64::INFINITY, f64::min)
}

/// Standard deviation divided by the mean.
fn variation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt() / mean
}

#[expect(clippy::disallowed_methods, reason = "the bench compiles its own plugin")]
fn self_timed() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = std::env::temp_dir().join(format!("ocb-self-timed-{}.so", std::process::id()));
    let done = Command::new("cc")
        .args(["-std=gnu11", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-I"])
        .arg(root.join("../plugin-api/include"))
        .arg(root.join("benches/self_timed.c"))
        .arg("-o")
        .arg(&file)
        .output()
        .expect("a C compiler named cc");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    file
}
