//! `ocb select`: how many configurations a selection holds, what they cost, and their records.

use std::process::ExitCode;

use ocb_service::Engine;
use ocb_service::model::SelectedOf;

use crate::args::{SelectArgs, Store};
use crate::failure::{Failure, Result};
use crate::open::{self, Purpose};
use crate::{heatmap, output, run, units};

/// Prints the table; writes the file when one is asked for.
pub async fn select(store: &Store, args: &SelectArgs, json: bool) -> Result<ExitCode> {
    let engine = open::open(store, Purpose::Look).await?;
    let done = show(&engine, args, json).await;
    engine.shutdown().await;
    done.map(|()| ExitCode::SUCCESS)
}

async fn show(engine: &Engine, args: &SelectArgs, json: bool) -> Result<()> {
    let run = run::find(engine, &args.run).await?;
    let algorithm = heatmap::choose(&run, args.algorithm.as_deref())?;
    let selected = engine.selected(&run.id, &algorithm, &args.selection).await?;
    if let Some(file) = &args.output {
        let bytes = match file.extension().and_then(|end| end.to_str()) {
            Some("parquet") => engine.selected_parquet(&run.id, &algorithm, &args.selection).await?,
            Some("csv") => engine.selected_csv(&run.id, &algorithm, &args.selection).await?,
            _ => return Err(Failure::Input(format!("{} must end in .parquet or .csv.", file.display()))),
        };
        std::fs::write(file, bytes).map_err(|e| Failure::file("write", file, &e))?;
    }
    if json {
        return output::print_json(&selected);
    }
    let row = |of: &SelectedOf| {
        let times = [of.median_ns, of.p99_ns, of.max_ns].map(|ns| ns.map_or_else(String::new, units::time));
        [vec![of.algorithm.clone(), of.n.to_string(), of.wrong.to_string()], times.to_vec()].concat()
    };
    let headings = ["algorithm", "n", "wrong", "median", "p99", "max"];
    let rows = selected.algorithms.iter().map(row).collect();
    let table = output::table(&headings, rows, &[1, 2, 3, 4, 5]);
    output::print(&format!("{} of {} configurations: {}\n{table}", selected.n, selected.of, selected.selection))
}
