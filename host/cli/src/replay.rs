//! `ocb replay`: are the answers of a run those that its plugins give here and now?

use std::process::ExitCode;

use ocb_service::Unpacked;
use ocb_service::model::{Replay, Replayed};

use crate::args::{ReplayArgs, Store};
use crate::failure::{NOT_ALL_WELL, Result};
use crate::{open, output};

/// Asks everything again and tells what was another answer.
pub async fn replay(store: &Store, args: &ReplayArgs, json: bool) -> Result<ExitCode> {
    // Refused, if it is, before anything is started.
    let archive = Unpacked::read(&args.file)?;
    let (engine, _folder) = open::open_aside(store).await?;
    let each = move |replayed: &Replayed| {
        if !json {
            // Whoever reads it may have gone; the exit code still tells.
            let _ = output::print(&line(replayed));
        }
    };
    let replay = engine.replay(archive, &args.algorithm, each).await;
    engine.shutdown().await;
    let replay = replay?;
    if json {
        output::print_json(&replay)?;
    } else {
        output::print(&summary(&replay))?;
    }
    Ok(if replay.identical { ExitCode::SUCCESS } else { ExitCode::from(NOT_ALL_WELL) })
}

fn line(replayed: &Replayed) -> String {
    let Replayed { algorithm, answers, equal, first, trouble } = replayed;
    let mut text = format!("{algorithm}: {equal} of {answers} answers are the same, bit for bit");
    if let Some(first) = first {
        let (configuration, recorded, now) = (first.configuration, &first.recorded, &first.replayed);
        text += &format!("\n  first difference, configuration {configuration}: {recorded} in the run, {now} now");
    }
    if let Some(trouble) = trouble {
        text += &format!("\n  stopped: {trouble}");
    }
    text
}

fn summary(replay: &Replay) -> String {
    let [equal, answers] = [|r: &Replayed| r.equal, |r: &Replayed| r.answers]
        .map(|of| replay.algorithms.iter().map(|r| u64::from(of(r))).sum::<u64>());
    let verdict = if replay.identical { "identical" } else { "NOT identical" };
    format!("run {}: {verdict}, {equal} of {answers} answers", replay.run)
}
