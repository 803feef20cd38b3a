//! Checks of plugins that developers sent: work of the queue, one at a time, never beside a measurement.

use std::sync::Arc;
use std::thread;

use ocb_lab::check::{Extent, Step, Term, check_plugin};
use tokio::runtime::Handle;

use crate::attempts::{Attempt, MOST_LOST, superseded};
use crate::audit::Note;
use crate::engine::Inner;
use crate::mail::outbox::Outbox;
use crate::measure::Stop;
use crate::model::{CheckVerdict, PluginReport, PluginState};
use crate::plugins::checks_sql::CheckEnd;
use crate::plugins::conflict;
use crate::plugins::notices::of_check;
use crate::plugins::registry::submitted;
use crate::plugins::sql::{PluginRow, THE_SERVICE};
use crate::store::Store;
use crate::{EngineError, Result};

/// Carries out an attempt at a check and notes where the plugin stands then; false when it was stopped.
pub async fn carry_out(inner: &Arc<Inner>, attempt: &Attempt, row: &PluginRow, stop: &Stop) -> Result<bool> {
    let file = submitted::plugin_file(&inner.blobs, &inner.config.data, &row.blob).await?;
    let (sender, ended) = tokio::sync::oneshot::channel();
    let (for_check, for_stop, handle) = (inner.clone(), stop.clone(), Handle::current());
    let (for_attempt, for_row) = (attempt.clone(), row.clone());
    // A thread of its own: a jail ends with the thread that started it.
    let thread = thread::Builder::new().name("check".into()).spawn(move || {
        let _ = sender.send(check(&for_check, &for_attempt, &for_row, &file, &for_stop, &handle));
    });
    thread.map_err(|e| EngineError::fault("Starting the check's thread failed", e))?;
    let report = ended.await.unwrap_or_else(|_| Err(EngineError::Fault("The check failed; see the log.".into())));
    match report {
        _ if stop.asked() => Ok(false),
        Ok(Some(report)) => settle(inner, attempt, row, report).await.map(|()| true),
        Ok(None) => Ok(false),
        Err(e) => Err(e),
    }
}

/// The report; `None` when stopped while another process measured.
fn check(
    inner: &Inner,
    attempt: &Attempt,
    row: &PluginRow,
    file: &std::path::Path,
    stop: &Stop,
    handle: &Handle,
) -> Result<Option<PluginReport>> {
    let Some(_right) = stop.right_to_measure(|| {})? else { return Ok(None) };
    let (mut seq, mut fault) = (0, None);
    let mut tell = |step: Step<'_>| {
        let kept = handle.block_on(async {
            match step {
                Step::Line(line) => {
                    seq += 1;
                    inner.store.add_line(attempt, seq, line).await
                }
                Step::Loads => inner.store.note_vetted(attempt).await,
            }
        });
        match kept {
            Ok(true) => {}
            Ok(false) => fault = Some(superseded()),
            Err(e) => fault = Some(e),
        }
        fault.is_none() && !stop.asked()
    };
    let quick = inner.config.quick_checks;
    let extent = Extent { manifest: Some(row.manifest.clone()), quick, ..Extent::default() };
    let term = Term::new(stop, inner.config.check_limit);
    let report = check_plugin(inner.registry.runner(), file, &extent, &term, &mut tell)?;
    fault.map_or(Ok(Some(report)), Err)
}

async fn settle(inner: &Inner, attempt: &Attempt, row: &PluginRow, report: PluginReport) -> Result<()> {
    let class = &inner.machine.hardware_class;
    let described = PluginRow { algorithms: report.algorithms, ..row.clone() };
    let all = inner.store.plugins().await?;
    let failed = report.lines.iter().find(|line| line.verdict == CheckVerdict::Fail);
    let reason = match failed {
        Some(line) => Some(format!("{}: {}", line.check, line.evidence)),
        None if !report.passed => Some("The check did not finish.".to_owned()),
        None => conflict(&described, &all, |id| inner.registry.algorithm(id).is_some()),
    };
    let (state, reason) = match reason {
        Some(reason) => (PluginState::Failed, reason),
        None => (PluginState::Validated, format!("Passed on hardware class {class}.")),
    };
    let notice = of_check(row, state, &reason);
    let new_notice = inner.outbox.new_notice(&row.account, &notice);
    let end = CheckEnd { algorithms: &described.algorithms, class, state, new_notice, note: note(row, state, &reason) };
    if inner.store.accept_check(attempt, end).await? {
        inner.outbox.post_soon();
    } else {
        tracing::warn!("plugin {}: the report of attempt {} comes too late and is not kept", row.id, attempt.number);
    }
    inner.registry.renew().await
}

fn note<'a>(row: &'a PluginRow, state: PluginState, reason: &'a str) -> Note<'a> {
    let action = if state == PluginState::Validated { "validated" } else { "failed the check" };
    Note { actor: THE_SERVICE, action, subject: &row.id, detail: reason }
}

/// Checks that were lost too often fail, and their authors are told, once.
pub async fn give_up(store: &Store, outbox: &Outbox) -> Result<()> {
    let (from, to) = (PluginState::Uploaded, PluginState::Failed);
    for row in store.checks_to_give_up().await? {
        let reason =
            format!("The service ended {MOST_LOST} times in the middle of this check, so it is not tried again.");
        let notice = of_check(&row, to, &reason);
        let new_notice = Some(outbox.new_notice(&row.account, &notice));
        let note = Some(note(&row, to, &reason));
        if store.move_plugin(&row.id, from, to, &reason, new_notice, note).await? {
            outbox.post_soon();
        }
    }
    Ok(())
}
