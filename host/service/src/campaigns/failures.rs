//! A plugin that fails in a campaign is taken out on that hardware class, with its report, and its developer is told.

use nix::sys::signal::Signal;

use crate::Result;
use crate::audit::Note;
use crate::board;
use crate::campaigns::course::Campaigns;
use crate::campaigns::sql::CampaignRow;
use crate::model::{AlgorithmResult, OutcomeName, PluginState, RunSpec, State};
use crate::plugins::notices::to_author;
use crate::plugins::sql::{PluginRow, THE_SERVICE};
use crate::runs::events::plain_event;
use crate::runs::log::fresh_stages;
use crate::runs::sql::RunRow;

impl Campaigns {
    /// Looks at what a run of a campaign found out of submitted plugins. Looked at again after a restart, it finds the
    /// same, except where a curator has decided since.
    pub(crate) async fn take_out_failing(&self, campaign: &CampaignRow, run: &RunRow) -> Result<()> {
        let Some(finished_us) = run.finished_us else { return Ok(()) };
        let before = match &run.rerun_of {
            Some(before) => self.store.results(before).await?,
            None => Vec::new(),
        };
        for stored in self.store.results(&run.id).await? {
            let old = before.iter().find(|old| old.result.algorithm == stored.result.algorithm).map(|old| &old.result);
            let Some(why) = failing(&stored.result, run.suite.is_some(), old) else { continue };
            let public = |row: &PluginRow| row.blob == stored.plugin_sha256 && row.state == PluginState::Public;
            for plugin in self.store.plugins().await?.into_iter().filter(public) {
                let report = report(campaign, run, &stored.result.algorithm, &why);
                self.take_out(&plugin, campaign, finished_us, &report).await?;
            }
        }
        Ok(())
    }

    async fn take_out(&self, plugin: &PluginRow, campaign: &CampaignRow, failed_us: i64, report: &str) -> Result<()> {
        let (id, class) = (plugin.id.as_str(), campaign.hardware_class.as_str());
        let note = Note { actor: THE_SERVICE, action: "excluded", subject: id, detail: report };
        let told = "It is no longer measured on this hardware class until a curator reinstates it; its results on other classes stay.";
        let notice = to_author(plugin, &format!("is excluded on the hardware class {class}"), told, report);
        let new_notice = self.outbox.new_notice(&plugin.account, &notice);
        if !self.store.exclude_plugin(id, class, failed_us, Some(new_notice), note).await? {
            return Ok(());
        }
        self.outbox.post_soon();
        self.registry.renew().await?;
        self.forget_waiting().await
    }

    /// Runs of suites and campaigns that wait ask no more for what may not be asked for any more.
    pub(crate) async fn forget_waiting(&self) -> Result<()> {
        for run in self.store.waiting_of_the_service().await? {
            let mut spec: RunSpec = run.spec.clone();
            let there =
                |name: &String| self.registry.choose(name, run.owner.as_deref()).is_ok_and(|found| found.is_some());
            spec.algorithms.retain(there);
            if spec.algorithms == run.spec.algorithms {
                continue;
            }
            if !spec.algorithms.is_empty() {
                self.store.ask_less(&run.id, &spec, &fresh_stages(&spec.algorithms)).await?;
                continue;
            }
            let told = "Its algorithms are no longer public.";
            if self.store.end_waiting_run(&run.id, State::Cancelled, Some(told)).await? {
                self.run_events.tell(&self.store, &run.id, plain_event(State::Cancelled, 0)).await?;
                if let Some(campaign) = &run.campaign {
                    self.end_campaign_when_through(campaign).await?;
                }
            }
        }
        Ok(())
    }
}

/// Why this result takes its plugin out, in a sentence. What a plugin must get through is the suite; in the runs of people, on
/// objects and settings of their own, only what the same run got through before counts.
fn failing(result: &AlgorithmResult, of_suite: bool, before: Option<&AlgorithmResult>) -> Option<String> {
    let outcome = &result.outcome;
    let got_through = |before: &AlgorithmResult| before.outcome.completed();
    let counts = of_suite || before.is_some_and(got_through);
    match outcome.name {
        OutcomeName::Completed if of_suite && result.wrong > 0 => {
            let (wrong, n) = (result.wrong, result.n);
            Some(format!("{wrong} of its {n} answers {} wrong.", if wrong == 1 { "is" } else { "are" }))
        }
        OutcomeName::Completed if of_suite && result.guessed() => {
            result.unranked.as_ref().map(|unranked| unranked.message.clone())
        }
        OutcomeName::Completed => None,
        // Ours, or such that the machine may have done it: times that do not fit together, a stop, a kill from outside.
        _ if outcome.ours || outcome.signal == Some(Signal::SIGKILL as i32) => None,
        OutcomeName::SandboxFault
        | OutcomeName::FileReplaced
        | OutcomeName::Cancelled
        | OutcomeName::TimingIntegrity => None,
        // A slow machine is not the plugin's fault.
        OutcomeName::OutOfBudget | OutcomeName::NotMeasured => None,
        _ => counts.then(|| outcome.message.clone()),
    }
}

fn report(campaign: &CampaignRow, run: &RunRow, algorithm: &str, why: &str) -> String {
    let [question, scene, distance] = board::scenario_words(&run.spec, [&run.object_a_name, &run.object_b_name]);
    format!(
        "It failed on the hardware class {} in the campaign /campaigns/{} ({algorithm}; {question}; {scene}; {distance}; run \
         /r/{}). {why}",
        campaign.hardware_class, campaign.id, run.id
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Controls, UnrankedCause};

    fn result(outcome: &str, message: &str, ours: bool, wrong: u32) -> AlgorithmResult {
        serde_json::from_value(serde_json::json!({
            "algorithm": "x", "name": "X", "outcome": { "name": outcome, "message": message, "ours": ours }, "n": 9, "of": 9,
            "budget_limited": false, "time": null, "verdicts": [], "wrong": wrong, "bv_tests_mean": null,
            "primitive_tests_mean": null, "build_ms": null, "memory_bytes": null,
        }))
        .unwrap()
    }

    #[test]
    fn only_the_plugins_own_failures_take_it_out() {
        let crash = result("Signaled", "The plugin crashed (SIGSEGV, signal 11).", false, 0);
        let well = result("Completed", "The plugin answered every query.", false, 0);
        assert_eq!(failing(&crash, true, None).as_deref(), Some("The plugin crashed (SIGSEGV, signal 11)."));
        for name in
            ["Failed", "LoadError", "TimedOut", "OutOfMemory", "OutputLimit", "SyscallDenied", "ProtocolViolation"]
        {
            assert!(failing(&result(name, "m", false, 0), true, Some(&well)).is_some(), "{name}");
        }
        let ours = result("SandboxFault", "The sandbox failed at step 'Watch'.", true, 0);
        let mut killed = result("Signaled", "The plugin crashed (SIGKILL, signal 9).", false, 0);
        killed.outcome.signal = Some(9);
        // What it says itself spares nobody.
        for name in ["Failed", "Signaled"] {
            let liar = result(name, "The plugin reported an error while loading: SIGKILL, signal 9.", false, 0);
            assert!(failing(&liar, true, Some(&well)).is_some(), "{name}");
        }
        for innocent in [
            &well,
            &ours,
            &killed,
            &result("Cancelled", "m", false, 0),
            &result("FileReplaced", "m", false, 0),
            &result("TimingIntegrity", "m", false, 0),
            &result("OutOfBudget", "m", false, 0),
            &result("NotMeasured", "m", false, 0),
        ] {
            assert_eq!(failing(innocent, true, Some(&well)), None, "{:?}", innocent.outcome);
        }
    }

    #[test]
    fn runs_of_people_count_where_the_plugin_got_through_before() {
        let crash = result("Signaled", "The plugin crashed (SIGSEGV, signal 11).", false, 0);
        let (well, wrong) = (result("Completed", "m", false, 0), result("Completed", "m", false, 1));
        assert!(failing(&crash, false, Some(&well)).is_some());
        assert!(failing(&crash, false, Some(&crash)).is_none() && failing(&crash, false, None).is_none());
        assert_eq!(failing(&wrong, true, None).as_deref(), Some("1 of its 9 answers is wrong."));
        assert_eq!(failing(&wrong, false, Some(&well)), None);
        let mut guessing = well.clone();
        guessing.controls = Some(Controls { n: 24, of: 24, crossing: 12, wrong: 12, silent: 0, guess: 1e-3 });
        guessing.unranked = Some(UnrankedCause::WrongControls { wrong: 12, n: 24 }.into());
        assert_eq!(
            failing(&guessing, true, None).as_deref(),
            Some("12 of 24 control questions were answered wrongly.")
        );
        assert_eq!(failing(&guessing, false, Some(&well)), None);
    }
}
