//! Who sees objects and runs.

use crate::model::Visibility;
use crate::store::Store;
use crate::{EngineError, Result};

impl Store {
    /// Decides who sees an object.
    pub async fn set_object_visibility(&self, id: &str, to: Visibility) -> Result<()> {
        let text = "UPDATE objects SET visibility = $1 WHERE id = $2";
        sqlx::query(text).bind(to.name()).bind(id).execute(&self.pool).await?;
        Ok(())
    }

    /// Decides who sees a run.
    pub async fn set_run_visibility(&self, id: &str, to: Visibility) -> Result<()> {
        let text = "UPDATE runs SET visibility = $1 WHERE id = $2";
        sqlx::query(text).bind(to.name()).bind(id).execute(&self.pool).await?;
        Ok(())
    }
}

/// From a column.
pub(crate) fn visibility(name: &str) -> Result<Visibility> {
    Visibility::named(name)
        .ok_or_else(|| EngineError::Fault(format!("The database holds something of the unknown visibility {name:?}.")))
}
