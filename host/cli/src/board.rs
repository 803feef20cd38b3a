//! `ocb board`: who is how fast and how right, over all runs of this command line and those of the service.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use ocb_service::chart::svg;
use ocb_service::model::{Board, BoardFilter, BoardRequest, BoardRow, BoardSuite};

use crate::args::Store;
use crate::choice::AccuracyArg;
use crate::failure::{Failure, Result};
use crate::open::{self, OWNER, Purpose};
use crate::{output, picture, units};

/// `ocb board`
#[derive(Debug, Args)]
pub struct BoardArgs {
    /// Version of the suite whose results are compared, or `none` for user runs [default: the newest measured suite].
    #[arg(long, value_name = "VERSION")]
    pub suite: Option<String>,
    /// The query: collision_first, collision_all or proximity, with +solid for solid bodies.
    #[arg(long)]
    pub question: Option<String>,
    /// Contract class, as the board prints it.
    #[arg(long)]
    pub class: Option<String>,
    /// Hardware class.
    #[arg(long)]
    pub hardware: Option<String>,
    /// Pair of objects, as the board prints it, or `all`.
    #[arg(long)]
    pub scene: Option<String>,
    /// Distance: 0.1 (relative), step:1e-4, ladder, grid:0, ..., or `all`.
    #[arg(long)]
    pub distance: Option<String>,
    /// Required precision: any, none_seen (no wrong answer), or the largest acceptable eps*, e.g. 1e-6.
    #[arg(long)]
    pub precision: Option<String>,
    /// What to chart speed against.
    #[arg(long, value_enum, default_value_t = AccuracyArg::Wrong)]
    pub accuracy: AccuracyArg,
    /// File for the chart, .svg or .png.
    #[arg(long, value_name = "FILE")]
    pub chart: Option<PathBuf>,
}

const HEADINGS: [&str; 13] = [
    "rank",
    "algorithm",
    "family",
    "queries/s",
    "n",
    "wrong",
    "missed",
    "false alarms",
    "eps*",
    "build",
    "memory",
    "stability",
    "measured",
];

/// Prints the table and writes the chart.
pub async fn board(store: &Store, args: &BoardArgs, json: bool) -> Result<ExitCode> {
    let request = BoardRequest {
        suite: args.suite.clone(),
        question: args.question.clone(),
        class: args.class.clone(),
        hardware: args.hardware.clone(),
        scene: args.scene.clone(),
        distance: args.distance.clone(),
        precision: args.precision.clone(),
        accuracy: args.accuracy.into(),
    };
    let engine = open::open(store, Purpose::Look).await?;
    let board = engine.board(&request, Some(OWNER)).await;
    engine.shutdown().await;
    let board = board?;
    if let Some(file) = &args.chart {
        let picture = picture::bytes(file, svg::chart(&board.chart))?;
        std::fs::write(file, picture).map_err(|e| Failure::file("write", file, &e))?;
    }
    if json {
        output::print_json(&board)?
    } else {
        output::print(&text(&board))?
    }
    Ok(ExitCode::SUCCESS)
}

/// The board as lines of text.
pub fn text(board: &Board) -> String {
    let mut lines: Vec<String> = board.filters.iter().map(filter).collect();
    lines.extend(board.suite.as_ref().map(suite));
    if board.rows.is_empty() {
        lines.push(empty(board));
        return lines.join("\n");
    }
    lines.push(board.finding.clone());
    lines.push(output::table(&HEADINGS, board.rows.iter().map(row).collect(), &[0, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]));
    lines.push(
        "Queries per second follow from the mean time, with the 95 % interval over the processes. Ranks follow them; \
         overlapping intervals are ties (=). Wrong answers have the 95 % Wilson interval of their share; none seen means \
         below 3/n. *: on the frontier of speed and accuracy. stability: stress families without a wrong answer (`ocb \
         stability`)."
            .to_owned(),
    );
    let reason = |row: &BoardRow| Some(format!("{}: no rank. {}", row.algorithm, row.reason.as_ref()?));
    lines.extend(board.rows.iter().filter_map(reason));
    lines.join("\n")
}

fn suite(suite: &BoardSuite) -> String {
    let [newest, oldest] = [suite.newest_us, suite.oldest_us].map(|us| units::wait(seconds_since(us)));
    format!(
        "suite {} ({}), {} scenarios, on {}, measured {newest} to {oldest} ago",
        suite.version,
        &suite.sha256[..12],
        suite.scenarios,
        suite.hardware
    )
}

/// A filter with what else could be chosen.
fn filter(filter: &BoardFilter) -> String {
    let words = |value: &str| filter.options.iter().find(|o| o.value == value).map_or(value, |o| &o.words).to_owned();
    let others = filter.options.iter().filter(|o| o.value != filter.chosen && o.algorithms > 0);
    let others: Vec<String> = others.map(|o| format!("{} ({})", o.value, o.algorithms)).collect();
    let others = if others.is_empty() { String::new() } else { format!("; also {}", others.join(", ")) };
    format!("--{} {}: {}{others}", filter.name, filter.chosen, words(&filter.chosen))
}

fn empty(board: &Board) -> String {
    if board.results == 0 {
        return "No results yet; `ocb bench stock:torus-knot` makes some.".to_owned();
    }
    let removed = board.filters.iter().filter(|f| f.removed > 0);
    let removed: Vec<String> = removed.map(|f| format!("--{} {} removes {}", f.name, f.chosen, f.removed)).collect();
    format!("0 of {} results match: {}.", board.results, removed.join(", "))
}

fn row(row: &BoardRow) -> Vec<String> {
    let dash = || "-".to_owned();
    let rate = |x: f64| units::mean(x);
    let share = row.wrong_share.map_or_else(String::new, |s| format!(" [{:.1e}, {:.1e}]", s.lo, s.hi));
    let bound = if row.eps_seen { "" } else { "<" };
    vec![
        row.rank.map_or_else(dash, |rank| format!("{rank}{}", if row.tied { "=" } else { "" })),
        format!("{}{}", row.algorithm, if row.frontier { " *" } else { "" }),
        row.family.clone(),
        row.rate.map_or_else(dash, |r| format!("{} [{}, {}]", rate(r.value), rate(r.lo), rate(r.hi))),
        row.n.to_string(),
        if row.n == 0 { dash() } else { format!("{}{share}", row.wrong) },
        row.missed.to_string(),
        row.false_alarms.to_string(),
        row.eps.map_or_else(dash, |eps| format!("{bound}{eps:.1e}")),
        row.build_ms.map_or_else(dash, |ms| units::time(ms * 1e6)),
        row.memory_bytes.map_or_else(dash, units::bytes),
        row.stability.map_or_else(dash, |s| format!("{} of {}", s.passed, s.of)),
        format!("{} ago", units::wait(seconds_since(row.finished_us))),
    ]
}

fn seconds_since(us: i64) -> f64 {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0.0, |t| t.as_secs_f64());
    (now - us as f64 / 1e6).max(0.0)
}
