//! A service elsewhere, as the commands that talk to one see it.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use reqwest::{Response, StatusCode};
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::args::{LookArgs, ServiceArgs};
use crate::failure::{Failure, Result};

impl ServiceArgs {
    /// Where this path is there.
    pub fn address(&self, path: &str) -> String {
        at(&self.server, path)
    }
}

impl LookArgs {
    /// Where this path is there.
    pub fn address(&self, path: &str) -> String {
        at(&self.server, path)
    }
}

fn at(server: &str, path: &str) -> String {
    format!("{}{path}", server.trim_end_matches('/'))
}

/// What the service at this address answered, or its sentence about why not.
pub async fn answer<T: DeserializeOwned>(address: &str, sent: reqwest::Result<Response>) -> Result<T> {
    let response = granted(address, sent).await?;
    let status = response.status();
    response.json().await.map_err(|_| strange(address, status))
}

/// Writes what the service at this address answered into a file as it comes; gives its length.
pub async fn save(address: &str, sent: reqwest::Result<Response>, path: &Path) -> Result<u64> {
    let mut response = granted(address, sent).await?;
    let unwritten = |e| Failure::file("write", path, &e);
    let (mut file, mut length) = (File::create(path).map_err(unwritten)?, 0);
    let cut = |e| Failure::Input(format!("The answer of {address} was cut off ({e}); try again."));
    while let Some(chunk) = response.chunk().await.map_err(cut)? {
        file.write_all(&chunk).map_err(unwritten)?;
        length += chunk.len() as u64;
    }
    Ok(length)
}

async fn granted(address: &str, sent: reqwest::Result<Response>) -> Result<Response> {
    let unreachable = |_| Failure::Input(format!("Nothing answers on {address}; name the service with --server."));
    let response = sent.map_err(unreachable)?;
    let status = response.status();
    if status.is_success() {
        return Ok(response);
    }
    let problem: Value = response.json().await.map_err(|_| strange(address, status))?;
    Err(Failure::Input(problem["detail"].as_str().unwrap_or("The service refused.").to_owned()))
}

fn strange(address: &str, status: StatusCode) -> Failure {
    Failure::Input(format!("What answers on {address} is no service of this kind ({status})."))
}
