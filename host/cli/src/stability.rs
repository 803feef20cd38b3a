//! `ocb stability`: where methods fail.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use ocb_service::StabilitySelection as Selection;
use ocb_service::model::{
    CellState, FailingCase, FamilyResult, SearchResult, Stability, StabilityTable, Tally, TessellationResult,
};
use ocb_service::{Engine, Stop};

use crate::args::{StabilityArgs, Store};
use crate::failure::{Failure, INTERRUPTED, NOT_ALL_WELL, Result};
use crate::open::{self, Purpose};
use crate::{output, plugin};

/// Tries the algorithms one after the other, prints the table, writes the failing cases.
pub async fn stability(store: &Store, args: &StabilityArgs, json: bool) -> Result<ExitCode> {
    let engine = open::open(store, Purpose::Look).await?;
    let done = work(&engine, args, json).await;
    engine.shutdown().await;
    done
}

async fn work(engine: &Engine, args: &StabilityArgs, json: bool) -> Result<ExitCode> {
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
                return Ok(ExitCode::from(INTERRUPTED));
            }
        };
        table.methods.push(found);
    }
    if let Some(folder) = &args.out {
        table.methods.iter().try_for_each(|method| write(folder, method))?;
    }
    if json {
        output::print_json(&table)?;
    } else {
        output::print(&text(&table))?;
    }
    let well = table.methods.iter().all(|method| faults(&table, method) == 0);
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
    let path = folder.join(format!("{}.json", method.algorithm.replace([':', '='], "-")));
    std::fs::write(&path, output::to_json(method)?).map_err(|e| Failure::file("write", &path, &e))
}

fn text(table: &StabilityTable) -> String {
    let mut blocks = Vec::new();
    for method in &table.methods {
        blocks.push(format!("{} ({}), {} seeds per value", method.name, method.algorithm, method.seeds));
        if !method.families.is_empty() {
            blocks.push(families(table, &method.families));
        }
        if !method.relations.is_empty() {
            let row = |r: &ocb_service::model::RelationResult| {
                let numbers = [r.tried, r.decisions, r.distances, r.grazing].map(|n| n.to_string());
                [vec![r.relation.clone()], numbers.to_vec()].concat()
            };
            let headings = ["relation", "tried", "decisions differ", "distances differ", "within rounding"];
            blocks.push(output::table(&headings, method.relations.iter().map(row).collect(), &[1, 2, 3, 4]));
        }
        if !method.failures.is_empty() {
            let row = |f: &ocb_service::model::FailureResult| {
                vec![f.id.clone(), state(f.state).to_owned(), f.expected.clone(), f.got.clone()]
            };
            let headings = ["reported failure", "", "expected", "answered"];
            blocks.push(output::table(&headings, method.failures.iter().map(row).collect(), &[]));
        }
        if !method.tessellations.is_empty() {
            blocks.push(tessellations(&method.tessellations));
        }
        blocks.extend(method.search.as_ref().map(searched));
        blocks.extend(unit(method));
        if let Some(offset) = method.offset_safe {
            blocks.push(format!("No wrong answer up to {offset} lengths from the origin."));
        }
        let cases = method.families.iter().filter_map(|f| f.first.as_ref().map(|first| (&f.family, first)));
        blocks.extend(cases.map(|(family, first)| case(family, first)));
    }
    blocks.join("\n\n")
}

/// Does the method depend on the unit of length, and in which range does it not?
fn unit(method: &Stability) -> Option<String> {
    let tried = method.relations.iter().find(|found| found.relation == "unit")?;
    let range = method.unit_safe.map(|[low, high]| {
        format!(
            "The unit of length may change from 2^{low} to 2^{high} without a wrong answer, where triangles are about one unit \
             long."
        )
    });
    let depends = (tried.decisions + tried.distances > 0).then(|| {
        format!(
            "Depends on the unit of length: of {} scenes in another unit, {} decisions and {} distances differ.",
            tried.tried, tried.decisions, tried.distances
        )
    });
    let said: Vec<String> = [depends, range].into_iter().flatten().collect();
    (!said.is_empty()).then(|| said.join(" "))
}

fn families(table: &StabilityTable, found: &[FamilyResult]) -> String {
    let row = |f: &FamilyResult| {
        let info = table.families.iter().find(|info| info.id == f.family);
        let Tally { misses, false_alarms, distances, unsteady, broken, slow, .. } = f.tally;
        let from: Vec<String> = f.thresholds.iter().map(|t| format!("{:e}", t.fails)).collect();
        let counts = [f.tally.asked(), misses, false_alarms, distances, unsteady, broken, slow].map(|n| n.to_string());
        let mark = if info.is_some_and(|info| info.beyond) { "*" } else { "" };
        let parameter = info.map_or_else(String::new, |info| info.parameter.clone());
        let threshold = if from.is_empty() { String::new() } else { format!("{} ({parameter})", from.join(", ")) };
        [vec![format!("{}{mark}", f.family), state(f.state).to_owned()], counts.to_vec(), vec![threshold]].concat()
    };
    let headings =
        ["family", "", "queries", "misses", "false alarms", "distances", "unsteady", "broken", "slow", "fails from"];
    let rows = output::table(&headings, found.iter().map(row).collect(), &[2, 3, 4, 5, 6, 7, 8]);
    format!("{rows}\n* beyond what the plugin interface guarantees")
}

fn tessellations(found: &[TessellationResult]) -> String {
    let row = |t: &TessellationResult| {
        let texts = [&t.object, &t.cut, &plugin::query_name(t.query).to_owned()].map(String::clone);
        let time = format!("{:.1} us", t.median_ns / 1000.0);
        let numbers = [t.triangles.to_string(), time, format!("{:.2}", t.ratio), t.decisions.to_string()];
        [texts.to_vec(), numbers.to_vec(), vec![format!("{:.1e}", t.distance), t.wrong.to_string(), t.n.to_string()]]
            .concat()
    };
    let headings = [
        "surface",
        "cut",
        "query",
        "triangles",
        "median",
        "times original",
        "decisions differ",
        "largest distance change",
        "wrong",
        "n",
    ];
    output::table(&headings, found.iter().map(row).collect(), &[3, 4, 5, 6, 7, 8, 9])
}

fn searched(found: &SearchResult) -> String {
    let number = |first: Option<u32>| first.map_or_else(|| format!("none in {}", found.most), |n| format!("query {n}"));
    let us = |ns: f64| format!("{:.1} us", ns / 1000.0);
    format!(
        "First wrong answer: {} by climbing, {} by uniform sampling. Longest time in {} queries: {} by climbing, {} by \
         uniform sampling.",
        number(found.climbing),
        number(found.uniform),
        found.most,
        us(found.costliest_climbing_ns),
        us(found.costliest_uniform_ns)
    )
}

fn case(family: &str, first: &FailingCase) -> String {
    let [a, b] = first.triangles;
    let (expected, got, command) = (&first.expected, &first.got, &first.command);
    format!("{family}: {a} x {b} triangles; expected {expected}; answered {got}\n  {command}")
}

/// A state with its sign.
fn state(state: CellState) -> &'static str {
    match state {
        CellState::Agrees => "● agrees",
        CellState::Slow => "◔ slow",
        CellState::Wrong => "✕ wrong",
        CellState::Broken => "■ broken",
        CellState::Unsupported => "– unsupported",
        CellState::Refused => "⊘ refused",
    }
}
