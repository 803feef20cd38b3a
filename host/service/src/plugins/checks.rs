//! Checks of plugins that developers sent: work of the queue, never beside a measurement, here or on measuring machines.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use ocb_lab::check::{Extent, Step, Term, check_plugin};
use tokio::runtime::Handle;

use crate::attempts::worker::Worker;
use crate::attempts::{Attempt, BACK_OFF, MOST_LOST, superseded};
use crate::audit::Note;
use crate::blobs::Blobs;
use crate::mail::outbox::Outbox;
use crate::measure::Stop;
use crate::model::{CheckVerdict, Errand, PluginReport, PluginState, Told, Wanted};
use crate::plugins::checks_sql::CheckEnd;
use crate::plugins::names::conflict;
use crate::plugins::notices::of_check;
use crate::plugins::registry::{Registry, submitted};
use crate::plugins::sql::{PluginRow, THE_SERVICE};
use crate::runs::current::Work;
use crate::store::Store;
use crate::{EngineError, Result};

/// The checks that wait, and what carries them out.
pub struct Checks {
    pub store: Store,
    pub blobs: Blobs,
    pub registry: Arc<Registry>,
    pub outbox: Arc<Outbox>,
    pub work: Arc<Work>,
    /// The data folder.
    pub data: PathBuf,
    /// They ask only the short part of their questions.
    pub quick: bool,
    /// Time of a whole check.
    pub limit: Duration,
    /// Measuring machines do it.
    pub elsewhere: bool,
}

impl Checks {
    /// Checks the plugin whose turn it is; false when none waits here.
    pub async fn next(self: &Arc<Self>) -> Result<bool> {
        if self.elsewhere {
            return Ok(false);
        }
        let Some((attempt, row)) = self.store.begin_check(&self.work.worker).await? else { return Ok(false) };
        let stop = Stop::default();
        let _held = self.work.begin(&attempt, &stop, None);
        // Who ended it between the beginning and this line found nothing to stop.
        let done = match self.store.plugin(&row.id).await {
            Ok(Some(now)) if now.state.is_checking() => self.carry_out(&attempt, &row, &stop).await,
            other => other.map(|_| false),
        };
        self.work.unset_current();
        // What was stopped, or went wrong by our fault and not the plugin's, is no attempt. A database error is retried.
        while !matches!(done, Ok(true))
            && let Err(e) = self.store.put_back_check(&attempt).await
        {
            tracing::error!("the check of plugin {} cannot be put back: {e}", row.id);
            if self.work.closing() {
                break;
            }
            tokio::time::sleep(BACK_OFF).await;
        }
        done.map(|_| true)
    }

    /// Carries out an attempt at a check and notes where the plugin stands then; false when it was stopped.
    async fn carry_out(self: &Arc<Self>, attempt: &Attempt, row: &PluginRow, stop: &Stop) -> Result<bool> {
        let file = submitted::plugin_file(&self.blobs, &self.data, &row.blob).await?;
        let (sender, ended) = tokio::sync::oneshot::channel();
        let (checks, for_stop, handle) = (self.clone(), stop.clone(), Handle::current());
        let (for_attempt, for_row) = (attempt.clone(), row.clone());
        // A thread of its own: a jail ends with the thread that started it.
        let thread = thread::Builder::new().name("check".into()).spawn(move || {
            let _ = sender.send(checks.check(&for_attempt, &for_row, &file, &for_stop, &handle));
        });
        thread.map_err(|e| EngineError::fault("Starting the check's thread failed", e))?;
        let report = ended.await.unwrap_or_else(|_| Err(EngineError::Fault("The check failed; see the log.".into())));
        match report {
            _ if stop.asked() => Ok(false),
            Ok(Some(report)) => self.settle(attempt, row, report, &self.work.worker.class).await.map(|_| true),
            Ok(None) => Ok(false),
            Err(e) => Err(e),
        }
    }

    /// The report; `None` when stopped while another process measured.
    fn check(
        &self,
        attempt: &Attempt,
        row: &PluginRow,
        file: &Path,
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
                        self.store.add_line(attempt, seq, line).await
                    }
                    Step::Loads => self.store.note_vetted(attempt).await,
                }
            });
            match kept {
                Ok(true) => {}
                Ok(false) => fault = Some(superseded()),
                Err(e) => fault = Some(e),
            }
            fault.is_none() && !stop.asked()
        };
        let extent = Extent { manifest: Some(row.manifest.clone()), quick: self.quick, ..Extent::default() };
        let term = Term::new(stop, self.limit);
        let report = check_plugin(self.registry.runner(), file, &extent, &term, &mut tell)?;
        fault.map_or(Ok(Some(report)), Err)
    }

    /// Notes where a plugin stands after its check on this hardware class; false when the attempt is not the current one.
    async fn settle(&self, attempt: &Attempt, row: &PluginRow, report: PluginReport, class: &str) -> Result<bool> {
        let described = PluginRow { algorithms: report.algorithms, ..row.clone() };
        let all = self.store.plugins().await?;
        let failed = report.lines.iter().find(|line| line.verdict == CheckVerdict::Fail);
        let reason = match failed {
            Some(line) => Some(format!("{}: {}", line.check, line.evidence)),
            None if !report.passed => Some("The check did not finish.".to_owned()),
            None => conflict(&described, &all, |id| self.registry.algorithm(id).is_some()),
        };
        let (state, reason) = match reason {
            Some(reason) => (PluginState::Failed, reason),
            None => (PluginState::Validated, format!("Passed on hardware class {class}.")),
        };
        let notice = of_check(row, state, &reason);
        let new_notice = self.outbox.new_notice(&row.account, &notice);
        let end =
            CheckEnd { algorithms: &described.algorithms, class, state, new_notice, note: note(row, state, &reason) };
        let accepted = self.store.accept_check(attempt, end).await?;
        if accepted {
            self.outbox.post_soon();
        } else {
            tracing::warn!(
                "plugin {}: the report of attempt {} comes too late and is not kept",
                row.id,
                attempt.number
            );
        }
        self.registry.renew().await.map(|()| accepted)
    }

    /// The check whose turn it is, for a measuring machine.
    pub async fn errand(&self, worker: &Worker) -> Result<Option<Errand>> {
        let Some((attempt, row)) = self.store.begin_check(worker).await? else { return Ok(None) };
        let wanted = Wanted::Check {
            plugin_sha256: row.blob,
            manifest: Box::new(row.manifest),
            quick: self.quick,
            limit_seconds: self.limit.as_secs_f64(),
        };
        Ok(Some(Errand { attempt: attempt.id, job: attempt.job, wanted, most_seconds: None }))
    }

    /// Keeps what a machine tells of a check; false when the attempt is not the current one.
    pub async fn told(&self, attempt: &Attempt, told: &Told) -> Result<bool> {
        match told {
            Told::Line { number, line } => self.store.add_line(attempt, i64::from(*number), line).await,
            Told::Loads => self.store.note_vetted(attempt).await,
            _ => Ok(true),
        }
    }

    /// Takes the report of a machine; false when the attempt is not the current one.
    pub async fn take(&self, attempt: &Attempt, plugin_sha256: &str, report: PluginReport) -> Result<bool> {
        if report.sha256.as_deref() != Some(plugin_sha256) {
            return Err(EngineError::Invalid("This report is of another plugin file.".into()));
        }
        let Some(row) = self.store.plugin(&attempt.job).await?.filter(|row| row.state.is_checking()) else {
            return Ok(false);
        };
        // Some may have been lost on their way.
        for (place, line) in report.lines.iter().enumerate() {
            self.store.add_line(attempt, place as i64 + 1, line).await?;
        }
        let class = self.store.class_of_attempt(&attempt.id).await?;
        self.settle(attempt, &row, report, &class).await
    }
}

fn note<'a>(row: &'a PluginRow, state: PluginState, reason: &'a str) -> Note<'a> {
    let action = if state == PluginState::Validated { "validated" } else { "failed the check" };
    Note { actor: THE_SERVICE, action, subject: &row.id, detail: reason }
}

/// Checks that were lost too often fail, and their authors are told, once.
pub async fn give_up(store: &Store, outbox: &Outbox) -> Result<()> {
    let (from, to) = (PluginState::Uploaded, PluginState::Failed);
    for row in store.checks_to_give_up().await? {
        let reason = format!(
            "The service or a measuring machine ended {MOST_LOST} times in the middle of this check, so it is not tried again."
        );
        let notice = of_check(&row, to, &reason);
        let new_notice = Some(outbox.new_notice(&row.account, &notice));
        let note = Some(note(&row, to, &reason));
        if store.move_plugin(&row.id, from, to, &reason, new_notice, note).await? {
            outbox.post_soon();
        }
    }
    Ok(())
}
