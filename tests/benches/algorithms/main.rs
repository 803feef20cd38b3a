//! All algorithms, interleaved in one run per object and workload: the tables that show who is how fast at what.
//!
//! `cargo bench --bench algorithms -- [--seconds S] [--count N] [--algorithm ID]... OBJECT...`; an object is a file or a stock
//! object. Workloads: W1 almost touching (1e-4 of the longest side apart), W2 a tenth apart, W3 crossing by 5e-4 of
//! the scene's size; poses beside an OBJ file, `NAME.W1.f64`, are taken in their place. Each is a run of the service like
//! any other: in the jail, judged against certified truth. `target/algorithms/` then holds the tables as Markdown and
//! Parquet and a chart as SVG.

mod chart;
mod report;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use futures::StreamExt;
use ocb_core::configuration::{Method, Sampling, Separation};
use ocb_core::query::{Query, Semantics};
use ocb_service::model::{RunInfo, RunSpec};
use ocb_service::{Engine, EngineConfig};
use report::Row;

/// What the command line says.
struct Options {
    seconds: f64,
    count: u32,
    algorithms: Vec<String>,
    objects: Vec<String>,
}

/// What is asked of every object: the workload's name, relative distance, step, question.
const WORKLOADS: [(&str, Separation, Query); 5] = [
    ("W1", Separation::Relative { distance: 1e-4 }, Query::CollisionFirst),
    ("W2", Separation::Relative { distance: 0.1 }, Query::CollisionFirst),
    ("W3", Separation::Step { of_size: -5e-4 }, Query::CollisionFirst),
    ("W1", Separation::Relative { distance: 1e-4 }, Query::Proximity),
    ("W2", Separation::Relative { distance: 0.1 }, Query::Proximity),
];

#[tokio::main]
async fn main() -> Result<(), Box<dyn Error>> {
    let options = options()?;
    let folder = built()?.join("../algorithms");
    fs::create_dir_all(&folder)?;
    let data = tempfile::tempdir()?;
    let config = EngineConfig {
        plugins: vec![built()?],
        runner: built()?.join("ocb-runner"),
        ..EngineConfig::beside_executable(data.path())
    };
    let engine = Engine::open(config).await?;
    for problem in engine.status().await?.problems {
        println!("algorithms: {problem}");
    }
    let mut rows: Vec<Row> = Vec::new();
    let mut machine = String::new();
    for object in &options.objects {
        for workload in WORKLOADS {
            let run = measure(&engine, &options, object, workload).await?;
            if let Some(facts) = &run.environment {
                machine = format!(
                    "{}, {} CPUs, clock {}, null round trip {:.0} ns",
                    facts.cpu, facts.cpus, facts.clock, facts.null_ns.value
                );
            }
            rows.extend(run.results.iter().map(|result| Row::of(&run, workload.0, result)));
            // After each run, so that nothing is lost when the next one is ended.
            fs::write(folder.join("algorithms.md"), report::markdown(&rows, &machine))?;
            fs::write(folder.join("algorithms.parquet"), report::parquet(&rows)?)?;
            fs::write(folder.join("algorithms.svg"), chart::svg(&rows, &machine))?;
        }
    }
    println!("{}", report::markdown(&rows, &machine));
    println!("algorithms: written to {}", folder.canonicalize()?.display());
    engine.shutdown().await;
    Ok(())
}

fn options() -> Result<Options, Box<dyn Error>> {
    let mut options = Options { seconds: 5.0, count: 1000, algorithms: Vec::new(), objects: Vec::new() };
    let mut words = std::env::args().skip(1).filter(|word| word != "--bench");
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
        match word.as_str() {
            "--seconds" => options.seconds = value()?.parse()?,
            "--count" => options.count = value()?.parse()?,
            "--algorithm" => options.algorithms.push(value()?),
            _ => options.objects.push(word),
        }
    }
    if options.objects.is_empty() {
        options.objects.push("stock:torus-knot@20000".into());
    }
    if options.algorithms.is_empty() {
        options.algorithms.push("all".into());
    }
    Ok(options)
}

/// Where runner and plugins lie: two folders above this program.
fn built() -> Result<PathBuf, Box<dyn Error>> {
    let exe = std::env::current_exe()?;
    Ok(exe.ancestors().nth(2).ok_or("this program lies in no target folder")?.to_path_buf())
}

async fn measure(
    engine: &Engine,
    options: &Options,
    object: &str,
    (name, separation, query): (&str, Separation, Query),
) -> Result<RunInfo, Box<dyn Error>> {
    let (id, given) = if object.starts_with("stock:") {
        (object.to_owned(), None)
    } else {
        let file = Path::new(object);
        let stem = file.file_stem().and_then(|s| s.to_str()).ok_or("an object has a name")?;
        let poses = file.with_file_name(format!("{stem}.{name}.f64"));
        (engine.add_object(stem, fs::read(file)?, None).await?.id, poses.is_file().then_some(poses))
    };
    let method = match given {
        Some(poses) => engine.add_configurations(fs::read(poses)?).await?,
        None => Method::Sphere { sampling: Sampling::Count { count: options.count }, seed: 0 },
    };
    // Who does not answer this question is not asked it.
    let known = engine.algorithms(None);
    let answers = |wanted: &String| {
        let name = wanted.split(':').next();
        known.iter().all(|one| Some(one.id.as_str()) != name || one.queries.contains(&query))
    };
    let spec = RunSpec {
        object_a: id,
        object_b: None,
        query,
        semantics: Semantics::Surface,
        method,
        separation,
        algorithms: options.algorithms.iter().filter(|wanted| answers(wanted)).cloned().collect(),
        passes: 5,
        budget_seconds: options.seconds,
        seed: None,
        precision: None,
        at_most: None,
        hardware_class: None,
    };
    let run = engine.submit(spec, None).await?;
    let mut events = Box::pin(engine.follow(&run.id, 0).await?);
    while let Some(event) = events.next().await {
        if let Some(result) = event?.result {
            eprintln!("{object} {name} {query:?}: {} {}", result.algorithm, result.outcome.name);
        }
    }
    Ok(engine.run(&run.id, None).await?)
}
