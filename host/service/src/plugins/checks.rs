//! Checks of plugins that developers sent: work of the queue, one at a time, never beside a measurement.

use std::sync::Arc;
use std::thread;

use ocb_lab::check::{Extent, Step, Term, check_plugin};
use tokio::runtime::Handle;

use crate::audit::Note;
use crate::engine::Inner;
use crate::machine::MeasuringRight;
use crate::measure::Stop;
use crate::model::{CheckVerdict, PluginReport, PluginState};
use crate::plugins::conflict;
use crate::plugins::notices::of_check;
use crate::plugins::registry::brought;
use crate::plugins::sql::{SubmissionRow, THE_SERVICE};
use crate::{EngineError, Result};

/// A check that was begun this often is not begun again: it may be what ends the service.
pub const MAX_ATTEMPTS: i64 = 3;

/// Carries out a claimed check and notes where the plugin stands then.
pub async fn carry_out(inner: &Arc<Inner>, row: &SubmissionRow, stop: &Stop) -> Result<()> {
    let file = brought::plugin_file(&inner.blobs, &inner.config.data, &row.blob).await?;
    let (sender, ended) = tokio::sync::oneshot::channel();
    let (for_check, for_row, for_stop, handle) = (inner.clone(), row.clone(), stop.clone(), Handle::current());
    // A thread of its own: a jail ends with the thread that started it.
    let thread = thread::Builder::new().name("check".into()).spawn(move || {
        let _ = sender.send(check(&for_check, &for_row, &file, &for_stop, &handle));
    });
    thread.map_err(|e| EngineError::fault("Starting the check's thread failed", e))?;
    let report = ended.await.unwrap_or_else(|_| Err(EngineError::Fault("The check failed; see the log.".into())));
    match report {
        _ if stop.asked() => inner.store.put_back_check(&row.id).await,
        Ok(Some(report)) => settle(inner, row, report).await,
        Ok(None) => inner.store.put_back_check(&row.id).await,
        Err(e) => Err(e),
    }
}

/// The report; `None` when stopped while another process measured.
fn check(
    inner: &Inner,
    row: &SubmissionRow,
    file: &std::path::Path,
    stop: &Stop,
    handle: &Handle,
) -> Result<Option<PluginReport>> {
    let Some(_right) = MeasuringRight::wait(|| stop.asked(), || {})? else { return Ok(None) };
    let (mut seq, mut fault) = (0, None);
    let mut tell = |step: Step<'_>| {
        let kept = handle.block_on(async {
            match step {
                Step::Line(line) => {
                    seq += 1;
                    inner.store.add_line(&row.id, seq, line).await
                }
                Step::Loads => {
                    let (from, to) = (PluginState::Uploaded, PluginState::Vetted);
                    inner.store.move_submission(&row.id, from, to, "", None, None).await.map(|_| ())
                }
            }
        });
        if let Err(e) = kept {
            fault = Some(e);
        }
        fault.is_none() && !stop.asked()
    };
    let quick = inner.config.quick_checks;
    let extent = Extent { manifest: Some(row.manifest.clone()), quick, ..Extent::default() };
    let term = Term::new(stop, inner.config.check_limit);
    let report = check_plugin(inner.registry.runner(), file, &extent, &term, &mut tell)?;
    fault.map_or(Ok(Some(report)), Err)
}

async fn settle(inner: &Inner, row: &SubmissionRow, report: PluginReport) -> Result<()> {
    let store = &inner.store;
    let class = &inner.machine.hardware_class;
    store.describe_submission(&row.id, &report.algorithms, class).await?;
    let described = SubmissionRow { algorithms: report.algorithms, ..row.clone() };
    let all = store.submissions().await?;
    let failed = report.lines.iter().find(|line| line.verdict == CheckVerdict::Fail);
    let reason = match failed {
        Some(line) => Some(format!("{}: {}", line.check, line.evidence)),
        None if !report.passed => Some("The check did not finish.".to_owned()),
        None => conflict(&described, &all, |id| inner.registry.contestant(id).is_some()),
    };
    match reason {
        Some(reason) => end(inner, row, PluginState::Failed, &reason).await?,
        None => end(inner, row, PluginState::Validated, &format!("Passed on hardware class {class}.")).await?,
    }
    inner.renew_plugins().await
}

/// Where the plugin stands after its check, and what its author is told of that.
async fn end(inner: &Inner, row: &SubmissionRow, state: PluginState, reason: &str) -> Result<()> {
    let action = if state == PluginState::Validated { "validated" } else { "failed the check" };
    let note = Note { actor: THE_SERVICE, action, subject: &row.id, detail: reason };
    let notice = of_check(row, state, reason);
    for from in [PluginState::Uploaded, PluginState::Vetted] {
        let new_notice = inner.new_notice(&row.account, &notice);
        if inner.store.move_submission(&row.id, from, state, reason, Some(new_notice), Some(note)).await? {
            inner.post_soon();
        }
    }
    Ok(())
}

/// Checks that did not come to their end wait again; those begun too often fail, and their authors are told.
pub async fn recover(inner: &Inner) -> Result<()> {
    for row in inner.store.recover_checks(MAX_ATTEMPTS).await? {
        let reason =
            format!("The service ended {MAX_ATTEMPTS} times in the middle of this check, so it is not tried again.");
        end(inner, &row, PluginState::Failed, &reason).await?;
    }
    Ok(())
}
