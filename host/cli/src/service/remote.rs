//! How a service elsewhere is asked, and how its refusals are told.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use reqwest::multipart::{Form, Part};
use reqwest::{Method, RequestBuilder, Response, StatusCode};
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::{Service, Upload, client};
use crate::failure::{Failure, Result};

impl Service<'_> {
    /// What is at this path.
    pub async fn get<T: DeserializeOwned>(&self, path: &str) -> Result<T> {
        answer(&self.address(path), self.request(Method::GET, path)?).await
    }

    /// Posts this body to this path.
    pub async fn post<T: DeserializeOwned>(&self, path: &str, body: &Value) -> Result<T> {
        answer(&self.address(path), self.request(Method::POST, path)?.json(body)).await
    }

    /// Says how what is at this path is to be.
    pub async fn put<T: DeserializeOwned>(&self, path: &str, body: &Value) -> Result<T> {
        answer(&self.address(path), self.request(Method::PUT, path)?.json(body)).await
    }

    /// Deletes what is at this path.
    pub async fn delete<T: DeserializeOwned>(&self, path: &str) -> Result<T> {
        answer(&self.address(path), self.request(Method::DELETE, path)?).await
    }

    /// Sends a file and what is said beside it.
    pub async fn upload<T: DeserializeOwned>(&self, path: &str, upload: Upload) -> Result<T> {
        let form = upload.fields.into_iter().fold(Form::new(), |form, (name, value)| form.text(name, value));
        let (name, bytes) = upload.file;
        let form = form.part("file", Part::bytes(bytes).file_name(name));
        answer(&self.address(path), self.request(Method::POST, path)?.multipart(form)).await
    }

    /// Writes what is at this path into a file as it comes; gives its length.
    pub async fn save(&self, path: &str, to: &Path) -> Result<u64> {
        let address = self.address(path);
        let mut response = granted(&address, self.request(Method::GET, path)?).await?;
        let unwritten = |e| Failure::file("write", to, &e);
        let (mut file, mut length) = (File::create(to).map_err(unwritten)?, 0);
        let cut = |e| Failure::Input(format!("The response from {address} was cut off ({e}); try again."));
        while let Some(chunk) = response.chunk().await.map_err(cut)? {
            file.write_all(&chunk).map_err(unwritten)?;
            length += chunk.len() as u64;
        }
        Ok(length)
    }

    fn request(&self, method: Method, path: &str) -> Result<RequestBuilder> {
        let request = client(self.server)?.request(method, self.address(path));
        Ok(match self.token {
            Some(token) => request.bearer_auth(token),
            None => request,
        })
    }
}

/// What the service at this address answered, or its sentence about why not.
async fn answer<T: DeserializeOwned>(address: &str, request: RequestBuilder) -> Result<T> {
    let response = granted(address, request).await?;
    let status = response.status();
    response.json().await.map_err(|_| strange(address, status))
}

async fn granted(address: &str, request: RequestBuilder) -> Result<Response> {
    let unreachable = |_| Failure::Input(format!("No service answers at {address}; set its URL with --server."));
    let response = request.send().await.map_err(unreachable)?;
    let status = response.status();
    if status.is_success() {
        return Ok(response);
    }
    let problem: Value = response.json().await.map_err(|_| strange(address, status))?;
    Err(Failure::Input(problem["detail"].as_str().unwrap_or("The service refused.").to_owned()))
}

fn strange(address: &str, status: StatusCode) -> Failure {
    Failure::Input(format!("{address} is not an OpenCollBench service ({status}); set its URL with --server."))
}
