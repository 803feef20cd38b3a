//! Deleting an account: what is private goes, what is public stays and is nobody's.

pub mod sql;

use crate::accounts::NAME_OF_OPERATOR;
use crate::audit::Note;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{AccountInfo, DeletionPreview, OwnedCounts, Role, State, Visibility};
use crate::objects::Objects;
use crate::owned::sql::OwnedIds;
use crate::plugins::registry::submitted::forget_file;
use crate::store::Store;
use crate::{EngineError, Result};

impl Engine {
    /// What goes with an account and what stays, and what stands against deleting it; nothing happens.
    #[boxed]
    pub async fn deletion_preview(&self, account: &AccountInfo) -> Result<DeletionPreview> {
        let (goes, stays) = parted(&self.inner.store, &self.inner.objects, account).await?;
        self.inner.store.preview_of(account, &goes, &stays).await
    }

    /// Deletes an account whose owner shows its password, and tells what has gone and what stays.
    #[boxed]
    pub async fn delete_account(&self, account: &AccountInfo, password: &str) -> Result<DeletionPreview> {
        let account = self.account_with(&account.name, password).await?;
        self.delete(&account, &account.name).await
    }

    /// Deletes the account of this name for whoever has the data folder.
    #[boxed]
    pub async fn delete_account_named(&self, name: &str) -> Result<DeletionPreview> {
        let account = self.account_named(name).await?;
        self.delete(&account, NAME_OF_OPERATOR).await
    }

    /// The account of this name.
    #[boxed]
    pub async fn account_named(&self, name: &str) -> Result<AccountInfo> {
        let missing = || EngineError::NotFound(format!("There is no account {:?}.", name.trim()));
        let (id, _) = self.inner.store.password_of(name.trim()).await?.ok_or_else(missing)?;
        self.inner.store.account(&id).await?.ok_or_else(missing)
    }

    async fn delete(&self, account: &AccountInfo, actor: &str) -> Result<DeletionPreview> {
        let (inner, owner) = (&self.inner, account.owner());
        if let Some(blocked_by) = inner.store.blocked_by(account).await? {
            return Err(EngineError::Busy(blocked_by));
        }
        let (goes, stays) = parted(&inner.store, &inner.objects, account).await?;
        self.end_all(&owner, &goes).await?;
        for plugin in &goes.plugins {
            inner.work.stop_current(Some(plugin), None);
        }
        let told = inner.store.preview_of(account, &goes, &stays).await?;
        // Nobody stores a file meanwhile that is about to go.
        let alone = inner.store.locks.removing().await?;
        let note = Note { actor, action: "account deleted", subject: &owner, detail: "" };
        let Some(unused) = inner.store.delete_account(account, &goes, &stays, note).await? else {
            let gone = || "This account has just been deleted.".to_owned();
            return Err(EngineError::Busy(inner.store.blocked_by(account).await?.unwrap_or_else(gone)));
        };
        for file in unused {
            // The account is gone, whatever becomes of a file.
            let removed = inner.blobs.remove(&file.sha256).await;
            if let Err(e) = removed.and_then(|()| forget_file(&inner.config.data, &file.sha256)) {
                tracing::error!("file {} of an account that was deleted stays: {e}", file.sha256);
            }
        }
        drop(alone);
        inner.registry.renew().await?;
        Ok(told)
    }
}

/// What goes with an account, and what stays: runs that have ended and objects, when everybody finds them; plugins that are
/// public or were.
async fn parted(store: &Store, objects: &Objects, account: &AccountInfo) -> Result<(OwnedIds, OwnedIds)> {
    let all = store.owned_ids(&account.owner(), None).await?;
    let (mut goes, mut stays) = (
        OwnedIds {
            advice: all.advice,
            configurations: all.configurations,
            stability: all.stability,
            workloads: all.workloads,
            ..OwnedIds::default()
        },
        OwnedIds::default(),
    );
    for run in all.runs {
        let row = store.run_row(&run.id).await?;
        let ended = !matches!(row.state, State::Queued | State::Running);
        let cited = ended && objects.visibility_of(&row).await? == Visibility::Public;
        let side = if cited { &mut stays } else { &mut goes };
        side.runs.push(run);
    }
    for object in all.objects {
        let public = objects.visibility(&object.id).await? == Visibility::Public;
        let side = if public { &mut stays } else { &mut goes };
        side.objects.push(object);
    }
    for row in store.plugins().await?.into_iter().filter(|row| row.account == account.id) {
        let side = if row.state.is_shown() { &mut stays } else { &mut goes };
        side.plugins.push(row.id);
    }
    Ok((goes, stays))
}

impl Store {
    async fn preview_of(&self, account: &AccountInfo, goes: &OwnedIds, stays: &OwnedIds) -> Result<DeletionPreview> {
        let bytes = self.unused_without(goes).await?.iter().map(|file| file.bytes).sum();
        let blocked_by = self.blocked_by(account).await?;
        Ok(DeletionPreview { goes: counted(goes), stays: counted(stays), bytes, blocked_by })
    }

    /// Who decides for others goes only when somebody else can.
    async fn blocked_by(&self, account: &AccountInfo) -> Result<Option<String>> {
        let what = match account.role {
            Role::User | Role::Developer => return Ok(None),
            Role::Curator => "plugins",
            Role::Administrator => "roles",
        };
        if self.others_may(account.role, &account.id).await? {
            return Ok(None);
        }
        let role = account.role.name();
        Ok(Some(format!(
            "This is the last {role}, who is needed to decide about {what}; create another {role} first, for example \
             with `ocb admin create NAME --role {role}` on the data folder."
        )))
    }
}

fn counted(what: &OwnedIds) -> OwnedCounts {
    OwnedCounts {
        runs: what.runs.len() as u32,
        objects: what.objects.len() as u32,
        configurations: what.configurations.len() as u32,
        advice: what.advice.len() as u32,
        stability: what.stability.len() as u32,
        workloads: what.workloads.len() as u32,
        plugins: what.plugins.len() as u32,
    }
}
