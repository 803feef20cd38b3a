//! A service elsewhere, as the commands that talk to one see it.

use reqwest::Response;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::args::ServiceArgs;
use crate::failure::{Failure, Result};

impl ServiceArgs {
    /// Where this path is there.
    pub fn address(&self, path: &str) -> String {
        format!("{}{path}", self.server.trim_end_matches('/'))
    }
}

/// What the service at this address answered, or its sentence about why not.
pub async fn answer<T: DeserializeOwned>(address: &str, sent: reqwest::Result<Response>) -> Result<T> {
    let unreachable = |_| Failure::Input(format!("Nothing answers on {address}; name the service with --server."));
    let response = sent.map_err(unreachable)?;
    let status = response.status();
    let strange = |_| Failure::Input(format!("What answers on {address} is no service of this kind ({status})."));
    if status.is_success() {
        return response.json().await.map_err(strange);
    }
    let problem: Value = response.json().await.map_err(strange)?;
    Err(Failure::Input(problem["detail"].as_str().unwrap_or("The service refused.").to_owned()))
}
