//! `ocb generate`: a certified configuration set as a file.

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use ocb_core::query::{Query, Semantics};
use ocb_service::Engine;
use ocb_service::model::{RunSpec, SetInfo};
use serde::Serialize;

use crate::args::{GenerateArgs, Store};
use crate::bench::table;
use crate::failure::{Failure, INTERRUPTED, Result};
use crate::named::Object;
use crate::open::{self, Purpose};
use crate::output;
use crate::truth::work;

/// What `--json` prints.
#[derive(Serialize)]
struct Generated {
    file: String,
    set: SetInfo,
    /// Stored by an earlier command; then there are no seconds.
    reused: bool,
    seconds: Option<f64>,
    cores: usize,
    per_second_and_core: Option<f64>,
    /// Share of the configurations whose truth needed exact arithmetic.
    exact_share: f64,
}

/// Finds, certifies, writes.
pub async fn generate(store: &Store, args: &GenerateArgs, json: bool) -> Result<ExitCode> {
    let method = args.placing.method()?;
    let a = Object::named(&args.a)?;
    let b = args.b.as_deref().filter(|b| *b != args.a).map(Object::named).transpose()?;
    for object in [Some(&a), b.as_ref()].into_iter().flatten() {
        object.check()?;
    }
    let folder = args.output.parent().filter(|folder| !folder.as_os_str().is_empty());
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return Err(Failure::Input(format!("Cannot write {}: there is no such folder.", args.output.display())));
    }
    let engine = open::open(store, Purpose::Look).await?;
    let spec = async |engine: &Engine| {
        Ok(RunSpec {
            object_a: a.into_id(engine).await?,
            object_b: match b {
                Some(object) => Some(object.into_id(engine).await?),
                None => None,
            },
            query: Query::Proximity,
            semantics: Semantics::Surface,
            method,
            separation: args.placing.separation(),
            algorithms: Vec::new(),
            passes: 1,
            budget_seconds: 1.0,
            seed: None,
            precision: None,
            at_most: None,
            hardware_class: None,
        })
    };
    let done = match spec(&engine).await {
        Ok(spec) => find(&engine, &spec, args, json).await,
        Err(failure) => Err(failure),
    };
    engine.shutdown().await;
    done
}

async fn find(engine: &Engine, spec: &RunSpec, args: &GenerateArgs, json: bool) -> Result<ExitCode> {
    let job = Arc::new(engine.set_job(spec).await?);
    let (set, seconds) = match &job.stored {
        Some(info) => (info.clone(), None),
        None => {
            let started = Instant::now();
            let for_work = job.clone();
            let found = work::watch("configurations", job.size as usize, move |gauge| for_work.find(gauge).transpose());
            let Some(found) = found.await? else { return Ok(ExitCode::from(INTERRUPTED)) };
            let seconds = started.elapsed().as_secs_f64();
            (engine.keep_set(&job, &found?, seconds).await?, Some(seconds))
        }
    };
    let bytes = engine.set_parquet(&set).await?;
    std::fs::write(&args.output, bytes).map_err(|e| Failure::file("write", &args.output, &e))?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let n = f64::from(set.configurations);
    let generated = Generated {
        file: args.output.display().to_string(),
        reused: seconds.is_none(),
        seconds,
        cores,
        per_second_and_core: seconds.map(|seconds| n / seconds / cores as f64),
        exact_share: f64::from(set.exact) / n,
        set,
    };
    if json {
        output::print_json(&generated)?
    } else {
        output::print(&summary(&generated, spec))?
    }
    Ok(ExitCode::SUCCESS)
}

fn summary(generated: &Generated, spec: &RunSpec) -> String {
    let Generated { set, file, cores, .. } = generated;
    let mut text = vec![format!("{file}: {}, {}", table::placing(spec), table::set(set))];
    text.push(match (generated.seconds, generated.per_second_and_core) {
        (Some(seconds), Some(rate)) => {
            format!("Found and certified in {seconds:.1} s: {rate:.0} per second on each of {cores} cores.")
        }
        _ => "Saved positions were reused.".to_owned(),
    });
    text.push(format!("{:.2} % needed exact arithmetic.", 100.0 * generated.exact_share));
    text.push(format!("SHA-256 {}", set.sha256));
    text.join("\n")
}
