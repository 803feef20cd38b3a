//! Asking twice and making once: what a program calls its request names the id of what it makes.
//!
//! The id is chosen when the request comes first and found again when it comes again, so that adding a row under it does the
//! rest. Files are one by their content anyway; there the key only refuses another file.

pub mod sql;

use std::time::Duration;

use serde::Serialize;

use crate::engine::Engine;
use crate::requests::sql::Request;
use crate::sha256_hex;
use crate::store::now_us;
use crate::{EngineError, Result};

/// How long keys are remembered.
const REMEMBERED: Duration = Duration::from_secs(30 * 24 * 3600);

/// Kinds of things that are made, as far as keys go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    /// An object.
    Object,
    /// A plugin.
    Plugin,
    /// Advice.
    Advice,
    /// A token.
    Token,
    /// An invitation.
    Invitation,
    /// A campaign.
    Campaign,
    /// A stability run.
    StabilityRun,
    /// A recording with its replay.
    Workload,
}

impl Engine {
    /// The id of what this request makes: a new one, or that of the same request before.
    ///
    /// # Errors
    /// `Invalid` when the key was used for something else.
    pub async fn id_of_request(
        &self,
        owner: &str,
        made: Made,
        key: Option<&str>,
        asked: &(impl Serialize + Sync),
    ) -> Result<String> {
        let id = uuid::Uuid::now_v7().to_string();
        let Some(key) = key else { return Ok(id) };
        let digest = serde_json::to_vec(asked).map_err(|e| EngineError::fault("Naming a request failed", e))?;
        let digest = sha256_hex(&digest);
        let request = Request { owner, resource: made.name(), key, digest: &digest };
        let (id, first) = self.inner.store.request(request, &id).await?;
        if first != digest {
            let told = format!("The key {key:?} was used for another request; use a new key for each request.");
            return Err(EngineError::Invalid(told));
        }
        Ok(id)
    }

    /// Forgets keys that nobody will ask under again.
    pub(crate) async fn forget_requests(&self) -> Result<()> {
        self.inner.store.forget_requests(now_us() - REMEMBERED.as_micros() as i64).await
    }
}

impl Made {
    fn name(self) -> &'static str {
        match self {
            Self::Object => "object",
            Self::Plugin => "plugin",
            Self::Advice => "advice",
            Self::Token => "token",
            Self::Invitation => "invitation",
            Self::Campaign => "campaign",
            Self::StabilityRun => "stability run",
            Self::Workload => "workload",
        }
    }
}
