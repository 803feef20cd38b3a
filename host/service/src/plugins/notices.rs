//! What authors are told of their plugins.

use crate::model::{Action, NoticeInfo, PluginState};
use crate::notices::notice;
use crate::plugins::sql::SubmissionRow;

/// What the author of a plugin is told of a curator's decision; nothing of the steps that are the author's alone.
pub(crate) fn of_decision(row: &SubmissionRow, action: Action, reason: &str) -> Option<NoticeInfo> {
    decided(action).map(|(what, text)| to_author(row, what, text, reason))
}

/// What they are told when its check has ended.
pub fn of_check(row: &SubmissionRow, state: PluginState, reason: &str) -> NoticeInfo {
    let (what, text) = match state {
        PluginState::Validated => {
            ("passed its check", "You may benchmark it now, and offer it to the curators on its page.")
        }
        _ => ("failed its check", "Its page shows the report line by line."),
    };
    to_author(row, what, text, reason)
}

/// A notice of a plugin, with the words that are the reason in front.
pub(crate) fn to_author(row: &SubmissionRow, what: &str, text: &str, reason: &str) -> NoticeInfo {
    let subject = format!("Your plugin {} {} {what}", row.manifest.name, row.manifest.version);
    let text = if reason.is_empty() { text.to_owned() } else { format!("{reason}\n\n{text}") };
    notice(&subject, &text, &format!("/p/{}", row.id))
}

/// What has become of the plugin, and what that means.
fn decided(action: Action) -> Option<(&'static str, &'static str)> {
    match action {
        Action::Offer | Action::Answer | Action::Withdraw => None,
        Action::EndCheck => Some(("was not checked", "Change it, so that it is checked sooner, and send it again.")),
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
