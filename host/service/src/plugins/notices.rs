//! What authors are told of their plugins.

use crate::model::{Action, NoticeInfo, PluginState};
use crate::notices::telling::notice;
use crate::plugins::sql::PluginRow;

/// What the author of a plugin is told of a curator's decision; nothing of the steps that are the author's alone.
pub(crate) fn of_decision(row: &PluginRow, action: Action, reason: &str) -> Option<NoticeInfo> {
    decided(action).map(|(what, text)| to_author(row, what, text, reason))
}

/// What they are told when its check has ended.
pub fn of_check(row: &PluginRow, state: PluginState, reason: &str) -> NoticeInfo {
    let (what, text) = match state {
        PluginState::Validated => {
            ("passed its check", "You can benchmark it now and submit it for review on its page.")
        }
        _ => ("failed its check", "Its page shows the full report."),
    };
    to_author(row, what, text, reason)
}

/// A notice of a plugin, with the words that are the reason in front.
pub(crate) fn to_author(row: &PluginRow, what: &str, text: &str, reason: &str) -> NoticeInfo {
    let subject = format!("Your plugin {} {} {what}", row.manifest.name, row.manifest.version);
    let text = if reason.is_empty() { text.to_owned() } else { format!("{reason}\n\n{text}") };
    notice(&subject, &text, &format!("/p/{}", row.id))
}

/// What has become of the plugin, and what that means.
fn decided(action: Action) -> Option<(&'static str, &'static str)> {
    match action {
        Action::Offer | Action::Answer | Action::Withdraw => None,
        Action::EndCheck => Some(("was not checked", "Make it faster to check and submit it again.")),
        Action::Approve => Some(("is public", "A curator approved it: anyone may benchmark it now.")),
        Action::Ask => Some(("needs an answer", "A curator asked this question; answer it on the plugin's page.")),
        Action::Reject => Some(("was rejected", "A curator rejected it for the reason above.")),
        Action::Suspend => Some(("was suspended", "A curator suspended it: it cannot be benchmarked for now.")),
        Action::Exclude => Some(("was excluded", "A curator excluded it: its results are no longer ranked.")),
        Action::Reinstate => Some(("was reinstated", "A curator reinstated it: anyone may benchmark it now.")),
    }
}
