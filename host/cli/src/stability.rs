//! `ocb stability`: where methods fail.

mod remote;
mod text;

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use ocb_service::StabilitySelection as Selection;
use ocb_service::model::{Stability, StabilityTable};
use ocb_service::{Engine, Stop};

use crate::args::{ServiceArgs, StabilityArgs, Store};
use crate::failure::{Failure, INTERRUPTED, NOT_ALL_WELL, Result};
use crate::open::{self, Purpose};
use crate::output;

/// What the algorithms were found to do.
struct Found {
    table: StabilityTable,
    /// Every test of every algorithm was carried out.
    whole: bool,
}

/// Tries the algorithms one after the other, prints the table, writes the failing cases.
pub async fn stability(store: &Store, args: &StabilityArgs, json: bool) -> Result<ExitCode> {
    let found = match (&args.server, &args.token) {
        (Some(server), Some(token)) => {
            remote::stability(&ServiceArgs { server: server.clone(), token: token.clone() }.service(), args).await?
        }
        _ => {
            let engine = open::open(store, Purpose::Look).await?;
            let found = here(&engine, args).await;
            engine.shutdown().await;
            found?
        }
    };
    match found {
        Some(found) => tell(&found, args, json),
        None => Ok(ExitCode::from(INTERRUPTED)),
    }
}

/// Tries them on this machine; nothing when interrupted.
async fn here(engine: &Engine, args: &StabilityArgs) -> Result<Option<Found>> {
    let selection = Selection {
        parts: args.family.clone(),
        at: args.at,
        seed: args.seed,
        seeds: args.seeds.unwrap_or(0),
        budget: args.budget.map(Duration::from_secs),
    };
    let mut table = engine.stability().await?;
    table.methods.clear();
    for algorithm in &args.algorithms {
        let (stop, name) = (Stop::default(), algorithm.clone());
        let at = move |part: &str| eprintln!("{name}: {part}");
        let run = engine.try_stability(algorithm, selection.clone(), stop.clone(), at);
        tokio::pin!(run);
        let found = tokio::select! {
            found = &mut run => found?,
            _ = tokio::signal::ctrl_c() => {
                stop.stop();
                // The jail under way is ended before we leave; that it was stopped is no news.
                let _ = run.await;
                return Ok(None);
            }
        };
        table.methods.push(found);
    }
    Ok(Some(Found { table, whole: true }))
}

fn tell(Found { table, whole }: &Found, args: &StabilityArgs, json: bool) -> Result<ExitCode> {
    if let Some(folder) = &args.out {
        table.methods.iter().try_for_each(|method| write(folder, method))?;
    }
    if json {
        output::print_json(table)?;
    } else {
        output::print(&text::text(table))?;
    }
    let well = *whole && table.methods.iter().all(|method| faults(table, method) == 0);
    Ok(if well { ExitCode::SUCCESS } else { ExitCode::from(NOT_ALL_WELL) })
}

/// Families within the interface's promise that fail.
fn faults(table: &StabilityTable, method: &Stability) -> usize {
    let beyond = |id: &str| table.families.iter().any(|family| family.id == id && family.beyond);
    let families = method.families.iter().filter(|family| family.tally.failed());
    families.filter(|family| family.tally.broken > 0 || !beyond(&family.family)).count()
}

/// A folder per method, a folder in it per failing part: both objects, and the rest as JSON.
fn write(folder: &Path, method: &Stability) -> Result<()> {
    let families = method.families.iter().map(|family| (&family.family, &family.first));
    let relations = method.relations.iter().map(|relation| (&relation.relation, &relation.first));
    for (part, first) in families.chain(relations) {
        let Some(repro) = first else { continue };
        let here = folder.join(method.algorithm.replace([':', '='], "-")).join(part);
        std::fs::create_dir_all(&here).map_err(|e| Failure::file("create", &here, &e))?;
        let put = |name: &str, text: &str| {
            let path = here.join(name);
            std::fs::write(&path, text).map_err(|e| Failure::file("write", &path, &e))
        };
        put("a.obj", &repro.a)?;
        put("b.obj", &repro.b)?;
        put("case.json", &output::to_json(repro)?)?;
    }
    std::fs::create_dir_all(folder).map_err(|e| Failure::file("create", folder, &e))?;
    let path = folder.join(format!("{}.json", method.algorithm.replace([':', '='], "-")));
    std::fs::write(&path, output::to_json(method)?).map_err(|e| Failure::file("write", &path, &e))
}
