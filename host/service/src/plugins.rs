//! Plugins that developers bring: sending, looking, deciding.

mod algorithms;
pub mod checks;
pub mod checks_sql;
pub mod lists;
pub mod names;
pub mod notices;
pub mod registry;
pub mod signature;
pub mod sql;
pub mod standing;

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use ocb_lab::check::{check_manifest, is_free};
use ocb_sandbox::text::one_line;

use crate::accounts::said;
use crate::attempts::Kind;
use crate::audit::{A_FORMER_ACCOUNT, Note};
use crate::boxed;
use crate::engine::Engine;
use crate::locks::Lock;
use crate::model::{
    AccountInfo, Action, CheckLine, CheckVerdict, Cursor, Decision, Manifest, Page, Part, PluginInfo, PluginState, Role,
};
use crate::plugins::names::{ids, taken};
use crate::plugins::notices::of_decision;
use crate::plugins::sql::PluginRow;
use crate::sha256_hex;
use crate::store::now_us;
use crate::{EngineError, Result};

/// Largest plugin file that may be sent, and bytes of all that one account keeps.
pub const MAX_PLUGIN_BYTES: usize = 64 << 20;
const QUOTA: u64 = 1 << 30;
/// Longest name of a file that is kept.
const MAX_NAME_BYTES: usize = 255;
/// Checks of one account that wait at a time.
const MAX_WAITING: usize = 5;

impl Engine {
    /// Is this a developer?
    pub fn may_submit(&self, account: &AccountInfo) -> Result<()> {
        if account.role < Role::Developer {
            return Err(EngineError::Forbidden(
                "Only developers can submit plugins; request the role on the account page.".into(),
            ));
        }
        Ok(())
    }

    /// Takes a plugin file; true when these bytes are new. The same bytes of one account are one; a signature may come later.
    #[boxed]
    pub async fn submit_plugin(
        &self,
        account: &AccountInfo,
        file: &str,
        bytes: Vec<u8>,
        manifest: Manifest,
        signature: Option<&str>,
    ) -> Result<(PluginInfo, bool)> {
        self.may_submit(account)?;
        check_manifest(&manifest)?;
        if bytes.len() > MAX_PLUGIN_BYTES {
            return Err(EngineError::Invalid(format!("A plugin may have at most {} MiB.", MAX_PLUGIN_BYTES >> 20)));
        }
        if !bytes.starts_with(b"\x7fELF") {
            return Err(EngineError::Invalid(format!(
                "{file:?} is not a plugin: it is not an ELF file; build a shared library (.so) for Linux."
            )));
        }
        let signed_by = signature.map(|signature| signed_by(account, &bytes, signature)).transpose()?;
        let store = &self.inner.store;
        let blob = sha256_hex(&bytes);
        if let Some(known) = store.plugin_of(&account.id, &blob).await? {
            if let Some(key) = signed_by.filter(|key| known.signed_by.as_ref() != Some(key)) {
                let note = Note { actor: &account.name, action: "signed", subject: &known.id, detail: &key };
                store.sign_plugin(&known.id, &key, note).await?;
            }
            return Ok((self.plugin(&known.id, Some(account)).await?, false));
        }
        self.has_room(account, bytes.len() as u64).await?;
        let length = bytes.len();
        let _keeping = self.inner.store.locks.keeping().await?;
        self.inner.blobs.put(bytes).await?;
        store.add_blob(&blob, length, "application/octet-stream").await?;
        let now = now_us();
        let row = PluginRow {
            id: uuid::Uuid::now_v7().to_string(),
            account: account.id.clone(),
            blob,
            file: one_line(file, MAX_NAME_BYTES),
            bytes: length as u64,
            manifest,
            signed_by,
            state: PluginState::Uploaded,
            reason: String::new(),
            hardware_class: None,
            excluded_on: None,
            algorithms: Vec::new(),
            created_us: now,
            changed_us: now,
        };
        // Two uploads of the same bytes at once: the first stands.
        let note = Note { actor: &account.name, action: "submitted", subject: &row.id, detail: &row.manifest.version };
        let new = store.add_plugin(&row, note).await?;
        let missing = || EngineError::Fault("The plugin was lost while it was being stored.".into());
        let kept = store.plugin_of(&account.id, &row.blob).await?.ok_or_else(missing)?;
        if new {
            self.inner.work.call();
        }
        Ok((self.plugin(&kept.id, Some(account)).await?, new))
    }

    /// What failed counts for nothing.
    async fn has_room(&self, account: &AccountInfo, bytes: u64) -> Result<()> {
        let all = self.inner.store.plugins().await?;
        let mine = || all.iter().filter(|row| row.account == account.id && row.state != PluginState::Failed);
        if mine().map(|row| row.bytes).sum::<u64>() + bytes > QUOTA {
            return Err(EngineError::Busy(format!("With this file, your plugins would exceed {} MiB.", QUOTA >> 20)));
        }
        if mine().filter(|row| row.state.is_checking()).count() >= MAX_WAITING {
            return Err(EngineError::Busy(format!(
                "{MAX_WAITING} of your plugins are waiting for their check; submit this one when one of them has been \
                 checked."
            )));
        }
        Ok(())
    }

    /// The public plugins and those of the viewer, newest first; without reports and history.
    #[boxed]
    pub async fn plugins(&self, viewer: Option<&AccountInfo>, page: &Page) -> Result<Part<PluginInfo>> {
        let (from, limit) = page.start()?;
        let account = viewer.map(|viewer| viewer.id.as_str());
        let rows = self.inner.store.plugins_for(account, &from, limit + 1).await?;
        let Part { entries, next } = Part::of(rows, limit, |row: &PluginRow| Cursor::behind(row.created_us, &row.id));
        Ok(Part { entries: self.listed(&entries, viewer).await?, next })
    }

    /// What waits for a curator, oldest first; without reports and history.
    #[boxed]
    pub async fn curation(&self, curator: &AccountInfo, page: &Page) -> Result<Part<PluginInfo>> {
        let (from, limit) = page.start()?;
        let rows = self.inner.store.waiting_plugins(&from, limit + 1).await?;
        let Part { entries, next } = Part::of(rows, limit, |row: &PluginRow| Cursor::behind(-row.changed_us, &row.id));
        Ok(Part { entries: self.listed(&entries, Some(curator)).await?, next })
    }

    async fn listed(&self, rows: &[PluginRow], viewer: Option<&AccountInfo>) -> Result<Vec<PluginInfo>> {
        let store = &self.inner.store;
        let (mut infos, mut published) = (Vec::new(), HashMap::new());
        for row in rows {
            // Once for each author of the part.
            let published = match published.entry(row.account.as_str()) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => new.insert(store.published_by(&row.account).await?),
            };
            let lines = store.lines(&row.id).await?;
            let mut info = self.shown(row, lines, published, viewer).await?;
            info.lines.clear();
            infos.push(info);
        }
        Ok(infos)
    }

    /// One plugin with its report. To who may not see it, it is not there.
    #[boxed]
    pub async fn plugin(&self, id: &str, viewer: Option<&AccountInfo>) -> Result<PluginInfo> {
        let whole = self.inner.store.whole_plugin(id).await?.filter(|(row, ..)| may_see(row, viewer));
        let (row, lines, history) = whole.ok_or_else(|| no_plugin(id))?;
        let published = self.inner.store.published_by(&row.account).await?;
        Ok(PluginInfo { history, ..self.shown(&row, lines, &published, viewer).await? })
    }

    async fn visible(&self, id: &str, viewer: Option<&AccountInfo>) -> Result<PluginRow> {
        let row = self.inner.store.plugin(id).await?.filter(|row| may_see(row, viewer));
        row.ok_or_else(|| no_plugin(id))
    }

    /// With what its author has published, newest first.
    async fn shown(
        &self,
        row: &PluginRow,
        lines: Vec<CheckLine>,
        published: &[PluginRow],
        viewer: Option<&AccountInfo>,
    ) -> Result<PluginInfo> {
        let owner = self.inner.store.account(&row.account).await?;
        let mine = viewer.is_some_and(|v| v.id == row.account);
        let close = mine || viewer.is_some_and(|v| v.role >= Role::Curator);
        let previous = published.iter().find(|other| is_version_before(other, row)).map(|other| other.id.clone());
        let before = match &previous {
            Some(id) if close => self.inner.store.lines(id).await?,
            _ => Vec::new(),
        };
        let flags = if close {
            let twins = self.inner.store.twins(&row.blob, &row.account).await?;
            flags(row, &lines, &before, twins, owner.as_ref())
        } else {
            Vec::new()
        };
        Ok(PluginInfo {
            id: row.id.clone(),
            sha256: row.blob.clone(),
            bytes: row.bytes,
            file: row.file.clone(),
            owner: owner.as_ref().map_or_else(|| A_FORMER_ACCOUNT.to_owned(), |account| account.name.clone()),
            mine,
            manifest: row.manifest.clone(),
            signed_by: row.signed_by.clone(),
            state: row.state,
            reason: row.reason.clone(),
            hardware_class: row.hardware_class.clone(),
            excluded_on: row.excluded_on.clone(),
            flags,
            lines,
            algorithms: row.algorithms.clone(),
            previous,
            created_us: row.created_us,
            changed_us: row.changed_us,
            history: Vec::new(),
        })
    }

    /// Takes a step on a plugin's way.
    #[boxed]
    pub async fn decide(&self, id: &str, by: &AccountInfo, decision: Decision) -> Result<PluginInfo> {
        let row = self.visible(id, Some(by)).await?;
        let Decision { action, reason } = decision;
        let step = step(action);
        may_take(&step, row.account == by.id, by.role)?;
        let reason = if action == Action::EndCheck {
            ended_by(row.account == by.id, &reason)
        } else if step.wants_reason {
            said(&reason, "give a reason for the author and the log")?
        } else {
            reason.trim().chars().take(2000).collect()
        };
        if !step.from.contains(&row.state) {
            return Err(EngineError::Busy(format!(
                "This plugin is {}, so this action is not possible.",
                row.state.name()
            )));
        }
        // Of two concurrent approvals of one id the second must see the first.
        let store = &self.inner.store;
        let mut publishing = None;
        if step.to == PluginState::Public {
            publishing = Some(store.locks.alone(Lock::Publishing).await?);
            self.is_free_to_publish(&row).await?;
        }
        let note = Note { actor: &by.name, action: step.word, subject: id, detail: &reason };
        // Nobody is told of a step of one's own.
        let notice = of_decision(&row, action, &reason).filter(|_| row.account != by.id);
        let mut moved = false;
        // A check goes on while its end is asked for.
        let from = if action == Action::EndCheck { step.from } else { &[row.state] };
        for from in from {
            let new_notice = notice.as_ref().map(|notice| self.inner.outbox.new_notice(&row.account, notice));
            moved = moved || store.move_plugin(id, *from, step.to, &reason, new_notice, Some(note)).await?;
        }
        if !moved {
            return Err(EngineError::Busy(
                "This plugin has just been changed by someone else; reload the page.".into(),
            ));
        }
        if action == Action::EndCheck {
            self.inner.work.stop_current(Some(id), None);
        }
        drop(publishing);
        self.inner.outbox.post_soon();
        // The decision is stored, so a failure from here on is logged, not answered; the next start reads the registry again.
        if let Err(e) = self.follow_decision(&row, step.to).await {
            tracing::error!("plugin {id}: the decision is stored, but applying it failed: {e}");
        }
        self.plugin(id, Some(by)).await
    }

    async fn follow_decision(&self, row: &PluginRow, now: PluginState) -> Result<()> {
        if now == PluginState::Failed {
            self.inner.store.withdraw(Kind::Check, &row.id, &self.inner.work.worker).await?;
        }
        self.inner.registry.renew().await?;
        if now == PluginState::Public {
            self.measure_submitted(row.algorithms.iter()).await?;
        } else if row.state == PluginState::Public {
            self.inner.campaigns.forget_waiting().await?;
        }
        Ok(())
    }

    /// The ids of its algorithms belong to nobody else.
    async fn is_free_to_publish(&self, row: &PluginRow) -> Result<()> {
        let all = self.inner.store.plugins().await?;
        match taken(row, &all) {
            Some(id) => Err(EngineError::Busy(format!("The algorithm id {id:?} belongs to another author's plugin."))),
            None => Ok(()),
        }
    }
}

fn may_see(row: &PluginRow, viewer: Option<&AccountInfo>) -> bool {
    row.state.is_shown() || viewer.is_some_and(|viewer| viewer.id == row.account || viewer.role >= Role::Curator)
}

fn no_plugin(id: &str) -> EngineError {
    EngineError::NotFound(format!("There is no plugin {id:?}; check the link."))
}

/// The key of the account, when the signature is that of this file by it.
fn signed_by(account: &AccountInfo, file: &[u8], signature: &str) -> Result<String> {
    let missing = "This account has no key to verify a signature; register your minisign.pub on the account page.";
    let key = account.signing_key.clone().ok_or_else(|| EngineError::Invalid(missing.into()))?;
    signature::check(file, signature, &key).map(|()| key)
}

/// Who takes a step.
#[derive(Clone, Copy, PartialEq, Eq)]
enum By {
    /// Who sent the plugin.
    Author,
    /// A curator who did not.
    Curator,
    /// Either, and a curator about an own plugin, too.
    Both,
}

/// What a step needs and does.
struct Step {
    by: By,
    wants_reason: bool,
    from: &'static [PluginState],
    to: PluginState,
    word: &'static str,
}

/// May somebody of this role take it, about an own plugin or another's?
fn may_take(step: &Step, mine: bool, role: Role) -> Result<()> {
    let refused = match step.by {
        By::Author if !mine => "Only the author of this plugin may do that.",
        By::Curator if role < Role::Curator => "Only curators may do that.",
        By::Curator if mine => "You cannot decide about your own plugin; another curator must.",
        By::Both if !mine && role < Role::Curator => "Only the author of this plugin and curators may do that.",
        _ => return Ok(()),
    };
    Err(EngineError::Forbidden(refused.into()))
}

/// Why a check has no result.
fn ended_by(mine: bool, reason: &str) -> String {
    let by = if mine { "its author" } else { "a curator" };
    let reason: String = reason.trim().chars().take(2000).collect();
    if reason.is_empty() {
        format!("The check was ended by {by}.")
    } else {
        format!("The check was ended by {by}: {reason}")
    }
}

fn step(action: Action) -> Step {
    use By::{Author, Both, Curator};
    use PluginState::*;
    let (by, wants_reason, from, to, word): (_, _, &'static [PluginState], _, _) = match action {
        Action::Offer => (Author, false, &[Validated], Awaiting, "offered"),
        Action::Answer => (Author, true, &[Asked], Awaiting, "answered"),
        Action::Withdraw => (Author, false, &[Public, Suspended, Excluded], Withdrawn, "withdrew"),
        Action::Approve => (Curator, false, &[Awaiting], Public, "approved"),
        Action::Ask => (Curator, true, &[Awaiting], Asked, "asked"),
        Action::Reject => (Curator, true, &[Awaiting, Asked], Rejected, "rejected"),
        Action::Suspend => (Curator, true, &[Public], Suspended, "suspended"),
        Action::Exclude => (Curator, true, &[Public], Excluded, "excluded"),
        Action::Reinstate => (Curator, true, &[Suspended, Excluded, Rejected], Public, "reinstated"),
        Action::EndCheck => (Both, false, &[Uploaded, Vetted], Failed, "ended the check"),
    };
    Step { by, wants_reason, from, to, word }
}

/// A public version of the same author that offers one of the same algorithms and came before.
fn is_version_before(other: &PluginRow, row: &PluginRow) -> bool {
    let same = ids(row).any(|id| ids(other).any(|known| known == id));
    other.account == row.account && other.state.is_shown() && same && other.created_us < row.created_us
}

/// What a curator should look at.
fn flags(
    row: &PluginRow,
    lines: &[CheckLine],
    before: &[CheckLine],
    twins: usize,
    owner: Option<&AccountInfo>,
) -> Vec<String> {
    let mut flags = Vec::new();
    if row.signed_by.is_none() && owner.is_some_and(|owner| owner.signing_key.is_some()) {
        flags.push("It is not signed, although its author has registered a key.".to_owned());
    }
    if !is_free(&row.manifest.license) {
        flags.push(format!("The licence {} is not a known free licence.", row.manifest.license));
    }
    if row.manifest.source.is_empty() {
        flags.push("The address of its source is missing.".to_owned());
    }
    let noted = lines.iter().filter(|line| line.verdict == CheckVerdict::Note);
    flags.extend(noted.map(|line| format!("{}: {}", line.check, line.evidence)));
    let worse = |line: &&CheckLine| {
        let passed = |old: &CheckLine| old.check == line.check && old.verdict == CheckVerdict::Pass;
        line.verdict != CheckVerdict::Pass && before.iter().any(passed)
    };
    flags.extend(lines.iter().filter(worse).map(|line| format!("{}: the previous version passed.", line.check)));
    flags.extend((0..twins).map(|_| "Another account submitted the same file.".to_owned()));
    flags
}
