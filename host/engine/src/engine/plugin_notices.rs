//! What authors are told of their plugins.

use super::Inner;
use crate::model::{Action, PluginState};
use crate::store::SubmissionRow;

impl Inner {
    /// Tells the author what a curator decided. That the decision stands is more than that it was told: a fault goes to the log.
    pub(super) async fn tell_decision(&self, row: &SubmissionRow, action: Action, reason: &str) {
        if let Some((what, text)) = decided(action) {
            self.tell_author(row, what, text, reason).await;
        }
    }

    /// Tells the author that the check of their plugin has ended.
    pub async fn tell_check(&self, row: &SubmissionRow, state: PluginState, reason: &str) {
        let (what, text) = match state {
            PluginState::Validated => {
                ("passed its check", "You may benchmark it now, and offer it to the curators on its page.")
            }
            _ => ("failed its check", "Its page shows the report line by line."),
        };
        self.tell_author(row, what, text, reason).await;
    }

    /// Tells the author something of a plugin, with the words that are the reason in front. That it happened is more than that it was told.
    pub(super) async fn tell_author(&self, row: &SubmissionRow, what: &str, text: &str, reason: &str) {
        let subject = format!("Your plugin {} {} {what}", row.manifest.name, row.manifest.version);
        let text = if reason.is_empty() { text.to_owned() } else { format!("{reason}\n\n{text}") };
        if let Err(e) = self.notify(&row.account, &subject, &text, &format!("/p/{}", row.id)).await {
            tracing::error!("the author of plugin {} could not be told that it {what}: {e}", row.id);
        }
    }
}

/// What the author of a plugin hears of a step; nothing of the steps that are the author's own.
fn decided(action: Action) -> Option<(&'static str, &'static str)> {
    match action {
        Action::Offer | Action::Answer | Action::Withdraw => None,
        Action::Approve => Some(("is public", "A curator approved it: everybody may benchmark it from now on.")),
        Action::Ask => Some(("raises a question", "A curator asks that; answer on its page.")),
        Action::Reject => Some(("was rejected", "A curator decided so, for the reason above.")),
        Action::Suspend => {
            Some(("was suspended", "A curator decided so: nobody may benchmark it until that is settled."))
        }
        Action::Exclude => {
            Some(("was excluded", "A curator decided so: its results have no place among the others any more."))
        }
        Action::Reinstate => Some(("was reinstated", "A curator decided so: everybody may benchmark it from now on.")),
    }
}
