//! Who sees objects and runs: their owner decides, and to others what is private is not there.
//!
//! A run is seen by no more than see its objects, and advice by those who see the objects that it is about: both show the
//! objects themselves. Whoever lost sight of an object has lost sight of everything made with it.

pub mod sql;

use crate::boxed;
use crate::engine::Engine;
use crate::model::{ObjectInfo, Owner, RunInfo, Visibility};
use crate::objects::{Objects, unknown};
use crate::runs::sql::{RunRow, no_run};
use crate::{EngineError, Result};

impl Engine {
    /// Decides who sees an object; only its owner may.
    #[boxed]
    pub async fn change_object_visibility(&self, id: &str, to: Visibility, caller: &str) -> Result<ObjectInfo> {
        let inner = &self.inner;
        if !inner.objects.info_for(id, Some(caller)).await?.mine {
            return Err(EngineError::Forbidden("Only the owner of this object may change its visibility.".to_owned()));
        }
        may_publish(to, caller)?;
        inner.store.set_object_visibility(id, to).await?;
        inner.objects.info_for(id, Some(caller)).await
    }

    /// Decides who sees a run; only its owner may, and no more than see its objects.
    #[boxed]
    pub async fn change_run_visibility(&self, id: &str, to: Visibility, caller: &str) -> Result<RunInfo> {
        let row = self.inner.store.run_row(id).await?;
        if row.owner.as_deref() != Some(caller) {
            return Err(EngineError::Forbidden("Only the owner of this run may change its visibility.".to_owned()));
        }
        may_publish(to, caller)?;
        if row.private && to > Visibility::Private {
            return Err(EngineError::Busy(
                "It was measured with a plugin that was not public, so it stays private; measure it again with the public \
                 one."
                    .to_owned(),
            ));
        }
        for (id, name) in [(row.object_a(), &row.object_a_name), (row.object_b(), &row.object_b_name)] {
            let most = self.inner.objects.visibility(id).await?;
            if to > most {
                let told = format!("Its object {name:?} is {}; make that {} first.", most.name(), to.name());
                return Err(EngineError::Busy(told));
            }
        }
        self.inner.store.set_run_visibility(id, to).await?;
        self.run(id, Some(caller)).await
    }

    /// # Errors
    /// `NotFound` when the object is there and not for this viewer. What is not there at all may be looked for.
    #[boxed]
    pub async fn object_is_for(&self, id: &str, viewer: Option<&str>) -> Result<()> {
        if self.inner.objects.is_for(id, viewer).await? { Ok(()) } else { Err(unknown(id)) }
    }

    /// # Errors
    /// As [`Self::object_is_for`], for a run.
    #[boxed]
    pub async fn run_is_for(&self, id: &str, viewer: Option<&str>) -> Result<()> {
        match self.inner.store.run(id).await? {
            Some(row) if !self.inner.objects.may_see(&row, viewer).await? => Err(no_run(id)),
            _ => Ok(()),
        }
    }

    /// # Errors
    /// As [`Self::object_is_for`], for advice.
    #[boxed]
    pub async fn advice_is_for(&self, id: &str, viewer: Option<&str>) -> Result<()> {
        let Some(row) = self.inner.store.advice(id).await? else { return Ok(()) };
        let spec = &row.info.spec;
        for object in std::iter::once(&spec.object_a).chain(&spec.object_b) {
            if !self.inner.objects.is_for(object, viewer).await? {
                return Err(crate::advice::no_advice(id));
            }
        }
        Ok(())
    }
}

impl Objects {
    /// Who sees the run besides its owner: what that decided, and no more than see its objects.
    #[boxed]
    pub async fn visibility_of(&self, row: &RunRow) -> Result<Visibility> {
        let decided = if row.private { Visibility::Private } else { row.visibility };
        let (a, b) = (self.visibility(row.object_a()).await?, self.visibility(row.object_b()).await?);
        Ok(decided.min(a).min(b))
    }

    /// Is this run there for the viewer? Its owner, too, sees it only while they see its objects.
    #[boxed]
    pub async fn may_see(&self, row: &RunRow, viewer: Option<&str>) -> Result<bool> {
        for object in [row.object_a(), row.object_b()] {
            if !self.is_for(object, viewer).await? {
                return Ok(false);
            }
        }
        let own = viewer.is_some() && row.owner.as_deref() == viewer;
        Ok(own || self.visibility_of(row).await? > Visibility::Private)
    }
}

/// Guests do everything except publishing.
fn may_publish(to: Visibility, owner: &str) -> Result<()> {
    if to == Visibility::Public && Owner::of(owner).account().is_none() {
        return Err(EngineError::Forbidden(
            "Publishing requires an account; create one on the account page and move your data into it.".to_owned(),
        ));
    }
    Ok(())
}
