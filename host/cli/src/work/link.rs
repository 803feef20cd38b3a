//! What a measuring machine asks its service, over HTTP.

use std::fmt;
use std::time::Duration;

use ocb_service::model::{Beat, Ended, GoOn, MachineFacts, NextWork, Sentinel, Told};
use ocb_service::worker::Seen;
use reqwest::header::RETRY_AFTER;
use reqwest::multipart::{Form, Part};
use reqwest::{Client, RequestBuilder, Response, StatusCode};
use serde_json::Value;

use crate::failure::Result;
use crate::service::client;

/// Longer than the service lets a machine wait for work.
const PATIENCE: Duration = Duration::from_secs(60);
/// Results may be large, and the service looks at them before it answers.
const LONG_PATIENCE: Duration = Duration::from_secs(900);

/// The service, and who asks.
pub struct Link {
    server: String,
    token: String,
    client: Client,
}

/// Why there is no answer.
#[derive(Debug)]
pub enum Refused {
    /// It answered, and refused with this sentence; asking again does not help.
    For(String),
    /// The same, but asking again after so many seconds may help.
    ForNow(String, u64),
    /// It did not answer.
    Unreached(String),
    /// It had a fault of its own.
    Fault(String),
}

impl Refused {
    /// How long it wants not to be asked.
    pub fn rest(&self) -> Option<Duration> {
        match self {
            Self::ForNow(_, seconds) => Some(Duration::from_secs(*seconds)),
            _ => None,
        }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::For(sentence) | Self::ForNow(sentence, _) | Self::Unreached(sentence) | Self::Fault(sentence) => {
                f.write_str(sentence)
            }
        }
    }
}

type Answer<T> = std::result::Result<T, Refused>;

impl Link {
    /// To the service at this URL.
    pub fn new(server: &str, token: &str) -> Result<Self> {
        Ok(Self { server: server.trim_end_matches('/').to_owned(), token: token.to_owned(), client: client(server)? })
    }

    /// What this machine has to do next, once there is something.
    pub async fn next(&self, facts: &MachineFacts) -> Answer<NextWork> {
        let request = self.client.post(self.at("/attempts")).json(facts).timeout(PATIENCE);
        let response = self.granted(request).await?;
        self.read(response).await
    }

    /// What the sentinel took here.
    pub async fn sentinel(&self, sentinel: &Sentinel) -> Answer<()> {
        self.granted(self.client.post(self.at("/sentinel")).json(sentinel).timeout(PATIENCE)).await.map(|_| ())
    }

    /// A file of the attempt.
    pub async fn file(&self, attempt: &str, name: &str) -> Answer<Vec<u8>> {
        let request = self.client.get(self.at(&format!("/attempts/{attempt}/files/{name}"))).timeout(LONG_PATIENCE);
        let bytes = self.granted(request).await?.bytes().await;
        bytes.map(|bytes| bytes.to_vec()).map_err(|e| Refused::Unreached(format!("The answer was cut off ({e}).")))
    }

    /// The work goes on, and this happened; false when it has ended at the service.
    pub async fn beat(&self, attempt: &str, steps: Vec<Told>) -> Answer<bool> {
        let request =
            self.client.post(self.at(&format!("/attempts/{attempt}/beat"))).json(&Beat { steps }).timeout(PATIENCE / 6);
        let response = self.granted(request).await?;
        self.read(response).await.map(|GoOn { current }| current)
    }

    /// An algorithm has found this so far; false when the attempt has ended at the service.
    pub async fn show(&self, attempt: &str, seen: &Seen) -> Answer<bool> {
        let request = self.client.post(self.at(&format!("/attempts/{attempt}/seen"))).json(seen).timeout(PATIENCE);
        let response = self.granted(request).await?;
        self.read(response).await.map(|GoOn { current }| current)
    }

    /// Hands in; false when it is not wanted any more.
    pub async fn end(&self, attempt: &str, ended: &Ended, files: &[Vec<u8>]) -> Answer<bool> {
        let ended =
            serde_json::to_string(ended).map_err(|e| Refused::For(format!("The results cannot be written: {e}.")))?;
        let form = files.iter().fold(Form::new().text("ended", ended), |form, file| {
            form.part("file", Part::bytes(file.clone()).file_name("file"))
        });
        let request =
            self.client.post(self.at(&format!("/attempts/{attempt}/end"))).multipart(form).timeout(LONG_PATIENCE);
        let response = self.granted(request).await?;
        self.read(response).await.map(|GoOn { current }| current)
    }

    fn at(&self, path: &str) -> String {
        format!("{}/internal/v1{path}", self.server)
    }

    async fn granted(&self, request: RequestBuilder) -> Answer<Response> {
        let unreached = |_| Refused::Unreached(format!("No service answers at {}.", self.server));
        let response = request.bearer_auth(&self.token).send().await.map_err(unreached)?;
        let status = response.status();
        if status.is_success() {
            return Ok(response);
        }
        let retry = response.headers().get(RETRY_AFTER).and_then(|value| value.to_str().ok()?.parse().ok());
        let problem: Option<Value> = response.json().await.ok();
        let sentence = problem.as_ref().and_then(|problem| problem["detail"].as_str());
        let sentence = sentence.map_or_else(|| self.strange(status), str::to_owned);
        Err(match (status.is_client_error(), status) {
            (_, StatusCode::TOO_MANY_REQUESTS) => Refused::ForNow(sentence, retry.unwrap_or(60)),
            (true, _) => Refused::For(sentence),
            (false, _) => Refused::Fault(sentence),
        })
    }

    async fn read<T: serde::de::DeserializeOwned>(&self, response: Response) -> Answer<T> {
        let status = response.status();
        let bytes = response.bytes().await.map_err(|e| Refused::Unreached(format!("The answer was cut off ({e}).")))?;
        serde_json::from_slice(&bytes).map_err(|_| Refused::For(self.strange(status)))
    }

    fn strange(&self, status: StatusCode) -> String {
        format!(
            "{} is not the address for machines of an OpenCollBench service ({status}); `ocb serve --internal` opens it.",
            self.server
        )
    }
}
