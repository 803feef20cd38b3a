//! `ocb`: serve the pages, or do from a terminal what they do.

mod admin;
mod advise;
mod args;
mod backup;
mod bench;
mod board;
mod campaign;
mod chart;
mod choice;
mod cite;
mod data;
mod doctor;
mod failure;
mod generate;
mod heatmap;
mod memory;
mod named;
mod object;
mod open;
mod output;
mod picture;
mod placing;
mod plugin;
mod record;
mod replay;
mod run;
mod scene;
mod select;
mod serve;
mod service;
mod stability;
mod submit;
mod suite;
mod truth;
mod units;
mod visibility;
#[cfg(feature = "remote")]
mod work;
#[cfg(not(feature = "remote"))]
#[path = "work/left_out.rs"]
mod work;
mod workload;
mod worst;

use std::process::ExitCode;

use clap::Parser;
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::prelude::*;

use args::{Cli, Command};
use failure::Result;

#[tokio::main]
async fn main() -> ExitCode {
    memory::give_back();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return failure::usage(&error),
    };
    let level = if matches!(cli.command, Command::Serve(_)) { LevelFilter::INFO } else { LevelFilter::ERROR };
    let wanted = std::env::var("OCB_LOG").ok().and_then(|wanted| wanted.parse().ok());
    let filter: Targets = wanted.unwrap_or_else(|| Targets::new().with_default(level));
    tracing_subscriber::registry()
        .with(tracing_subscriber::fmt::layer().with_writer(std::io::stderr))
        .with(filter)
        .init();
    match command(cli).await {
        Ok(code) => code,
        Err(failure) => failure.report(),
    }
}

async fn command(cli: Cli) -> Result<ExitCode> {
    let Cli { command, store, json } = cli;
    match command {
        Command::Serve(args) => serve::serve(&store, &args, json).await,
        Command::Bench(args) => bench::bench(&store, &args, json).await,
        Command::Advise(args) => advise::advise(&store, &args, json).await,
        Command::Generate(args) => generate::generate(&store, &args, json).await,
        Command::Truth(args) => truth::truth(&store, &args, json).await,
        Command::Plugin { command } => plugin::plugin(&store, &command, json).await,
        Command::Object { command } => object::object(&store, &command, json).await,
        Command::Run { command } => run::run(&store, &command, json).await,
        Command::Scene { command } => scene::scene(&store, &command, json).await,
        Command::Record(args) => record::record(&args, json).await,
        Command::Replay(args) => replay::replay(&store, &args, json).await,
        Command::Submit(args) => submit::submit(&args, json).await,
        Command::Data { command } => data::data(&store, &command, json).await,
        Command::Cite(args) => cite::cite(&args, json).await,
        Command::Visibility(args) => visibility::visibility(&args, json).await,
        Command::Backup(args) => backup::back_up(&store, &args.file, json).await,
        Command::Restore(args) => backup::restore(&store, &args.file, json).await,
        Command::Admin { command } => admin::admin(&store, &command, json).await,
        Command::Work(args) => work::work(&store, &args).await,
        Command::Stability(args) => stability::stability(&store, &args, json).await,
        Command::Doctor => doctor::doctor(&store, json),
        Command::Suite { command } => suite::suite(&store, &command, json).await,
        Command::Campaign { command } => campaign::campaign(&store, &command, json).await,
        Command::Board(args) => board::board(&store, &args, json).await,
        Command::Chart(args) => chart::chart(&store, &args, json).await,
        Command::Heatmap(args) => heatmap::heatmap(&store, &args, json).await,
        Command::Worst(args) => worst::worst(&store, &args, json).await,
        Command::Select(args) => select::select(&store, &args, json).await,
    }
}
