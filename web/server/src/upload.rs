//! File uploads: written to disk while they arrive, read into memory one after the other.

use std::sync::{Arc, PoisonError};
use std::time::Duration;

use axum::body::{Body, BodyDataStream};
use axum::extract::multipart::{Field, Multipart};
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use futures::StreamExt;
use ocb_service::MAX_PLUGIN_BYTES;
use ocb_service::model::Manifest;
use tokio::fs::File;
use tokio::io::{AsyncReadExt, AsyncSeekExt, AsyncWriteExt};
use tokio::sync::{Mutex, Semaphore, SemaphorePermit};

use crate::App;
use crate::limits::ADD_MEBIBYTES;
use crate::problem::{Problem, Result};

/// The most that an uploaded file may have.
pub(crate) const MAX_BYTES: usize = ocb_core::mesh::MAX_BYTES;

/// The most that a body with such a file may have: boundaries, names and headers come on top.
pub(crate) const MAX_BODY_BYTES: u64 = MAX_BYTES as u64 + (1 << 20);

/// The most that a manifest may have, and a signature.
const MANIFEST_BYTES: usize = 64 << 10;
const SIGNATURE_BYTES: usize = 4 << 10;

/// Most bytes of any other part of the form.
const OTHER_BYTES: usize = 64 << 10;

/// What counts as a small upload, and how many small and large ones are held in memory at a time; others wait. A large one may
/// take long to be read, and must not keep the small ones waiting.
const SMALL_BYTES: usize = 8 << 20;
const SMALL_AT_A_TIME: usize = 16;
const LARGE_AT_A_TIME: usize = 2;

/// Most concurrent uploads, in all and from one address.
const COMING: usize = 400;
const COMING_FROM_ONE: usize = 100;

/// How much and for how long a refused body is read on.
const DRAIN_BYTES: u64 = 4 << 30;
const DRAIN_TIME: Duration = Duration::from_secs(60);

/// Bounds memory and disk space of concurrent uploads.
pub(crate) struct UploadSlots {
    small: Semaphore,
    large: Semaphore,
    /// Addresses of the uploads in progress.
    coming: std::sync::Mutex<Vec<String>>,
}

/// An upload in progress.
pub(crate) struct Coming<'a>(&'a UploadSlots, String);

impl Drop for Coming<'_> {
    fn drop(&mut self) {
        let mut coming = self.0.coming.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = coming.iter().position(|from| *from == self.1) {
            coming.swap_remove(at);
        }
    }
}

impl Default for UploadSlots {
    fn default() -> Self {
        let coming = std::sync::Mutex::default();
        Self { small: Semaphore::new(SMALL_AT_A_TIME), large: Semaphore::new(LARGE_AT_A_TIME), coming }
    }
}

impl UploadSlots {
    /// Admits an upload; hold the result until the body has been received.
    ///
    /// # Errors
    /// 429 when too many are in progress.
    pub(crate) fn begin(&self, from: &str) -> Result<Coming<'_>> {
        let mut coming = self.coming.lock().unwrap_or_else(PoisonError::into_inner);
        let of_one = coming.iter().filter(|other| *other == from).count();
        if coming.len() >= COMING || of_one >= COMING_FROM_ONE {
            return Err(Problem::too_much("Too many uploads are in progress; try again in a moment.", 30));
        }
        coming.push(from.to_owned());
        Ok(Coming(self, from.to_owned()))
    }

    /// Waits until a received file may be read into memory; hold the permit until it is stored.
    pub(crate) async fn take(&self, file: &Spooled) -> Result<SemaphorePermit<'_>> {
        let pool = if file.bytes <= SMALL_BYTES { &self.small } else { &self.large };
        pool.acquire().await.map_err(Problem::fault)
    }
}

/// An unnamed temporary file.
pub(crate) struct Spooled {
    file: File,
    bytes: usize,
}

impl Spooled {
    /// Its content.
    pub(crate) async fn read(mut self) -> Result<Vec<u8>> {
        let mut bytes = Vec::with_capacity(self.bytes);
        self.file.rewind().await.map_err(Problem::fault)?;
        self.file.read_to_end(&mut bytes).await.map_err(Problem::fault)?;
        Ok(bytes)
    }
}

/// An uploaded file.
pub(crate) struct Upload {
    /// Its name, without folder and control characters.
    pub name: String,
    /// Its content.
    pub file: Spooled,
    /// The part `spec` before it, which says how to use the file.
    pub spec: Option<Vec<u8>>,
}

/// Answers a body that is too large, or refused half-way, so that the client sees the answer.
///
/// A client that still sends does not read. Were the connection closed at once, the kernel would reset it and the
/// answer would be lost; so the rest of the body is read and thrown away first.
pub(crate) async fn refuse_gently(request: Request, next: Next) -> Response {
    let declared = content_length(request.headers());
    let waits = request.headers().contains_key(header::EXPECT);
    let (parts, body) = request.into_parts();
    let rest = Arc::new(Mutex::new(body.into_data_stream()));
    if declared.is_some_and(|length| length > MAX_BODY_BYTES) {
        // A client that waits for `100 Continue` has sent nothing yet, and reading would ask it to.
        if !waits {
            drain(&rest).await;
        }
        return Problem::too_large(MAX_BYTES).into_response();
    }
    let shared = rest.clone();
    let stream = futures::stream::unfold(shared, |body| async move {
        let chunk = body.lock().await.next().await?;
        Some((chunk, body))
    });
    let response = next.run(Request::from_parts(parts, Body::from_stream(stream))).await;
    if response.status().is_client_error() {
        drain(&rest).await;
    }
    response
}

async fn drain(body: &Mutex<BodyDataStream>) {
    let read_on = async {
        let mut body = body.lock().await;
        let mut read = 0u64;
        while let Some(Ok(chunk)) = body.next().await {
            read += chunk.len() as u64;
            if read > DRAIN_BYTES {
                break;
            }
        }
    };
    // Too slow or too long: then the connection is closed under the client after all.
    let _ = tokio::time::timeout(DRAIN_TIME, read_on).await;
}

fn content_length(headers: &HeaderMap) -> Option<u64> {
    headers.get(header::CONTENT_LENGTH)?.to_str().ok()?.parse().ok()
}

impl Upload {
    /// From a form with a file of at most so many bytes in a field of that name.
    pub(crate) async fn read(request: Request, most: usize, app: &App, from: &str) -> Result<Self> {
        let mut form = Multipart::from_request(request, app)
            .await
            .map_err(|_| Problem::bad_request("Send the file as multipart/form-data in a field named \"file\"."))?;
        let mut spec = None;
        while let Some(field) = form.next_field().await.map_err(broken)? {
            match field.name() {
                Some("file") => {
                    let name = clean_name(field.file_name().unwrap_or_default());
                    return Ok(Self { name, file: spool(field, most, app, from).await?, spec });
                }
                Some("spec") => spec = Some(read(field, OTHER_BYTES).await?),
                _ => drop(read(field, OTHER_BYTES).await?),
            }
        }
        Err(Problem::bad_request("The form has no field named \"file\"."))
    }
}

/// A submitted plugin.
pub(crate) struct PluginUpload {
    /// Name of the file, without folder and control characters.
    pub name: String,
    /// Its content.
    pub file: Spooled,
    /// What its author says of it.
    pub manifest: Manifest,
    /// What minisign wrote of it.
    pub signature: Option<String>,
}

impl PluginUpload {
    /// From a form with the manifest first, then a signature if there is one, and the file last.
    pub(crate) async fn read(request: Request, app: &App, from: &str) -> Result<Self> {
        let explained = "Send multipart/form-data with \"manifest\" (JSON), then \"file\" (the shared library).";
        let mut form = Multipart::from_request(request, app).await.map_err(|_| Problem::bad_request(explained))?;
        let (mut manifest, mut signature) = (None, None);
        while let Some(field) = form.next_field().await.map_err(broken)? {
            match (field.name().unwrap_or_default(), manifest.take()) {
                ("manifest", _) => {
                    let text = read(field, MANIFEST_BYTES).await?;
                    let parsed = serde_json::from_slice(&text).map_err(|e| {
                        Problem::new(StatusCode::UNPROCESSABLE_ENTITY, format!("The manifest cannot be read: {e}."))
                    })?;
                    manifest = Some(parsed);
                }
                ("signature", kept) => {
                    let text = read(field, SIGNATURE_BYTES).await?;
                    signature = Some(String::from_utf8_lossy(&text).into_owned());
                    manifest = kept;
                }
                ("file", Some(manifest)) => {
                    let name = clean_name(field.file_name().unwrap_or_default());
                    return Ok(Self {
                        name,
                        file: spool(field, MAX_PLUGIN_BYTES, app, from).await?,
                        manifest,
                        signature,
                    });
                }
                (_, kept) => {
                    read(field, OTHER_BYTES).await?;
                    manifest = kept;
                }
            }
        }
        Err(Problem::bad_request(explained))
    }
}

/// Writes and counts each chunk as it arrives: slow senders hold no memory, and many senders together cannot fill the disk.
async fn spool(mut field: Field<'_>, most: usize, app: &App, from: &str) -> Result<Spooled> {
    let mut file = File::from_std(app.engine.temporary_file()?);
    let mut bytes = 0;
    while let Some(chunk) = field.chunk().await.map_err(broken)? {
        let before = bytes >> 20;
        bytes += chunk.len();
        if bytes > most {
            return Err(Problem::too_large(most));
        }
        app.count_many(ADD_MEBIBYTES, from, ((bytes >> 20) - before) as u32).await?;
        file.write_all(&chunk).await.map_err(Problem::fault)?;
    }
    file.flush().await.map_err(Problem::fault)?;
    Ok(Spooled { file, bytes })
}

async fn read(mut field: Field<'_>, most: usize) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    while let Some(chunk) = field.chunk().await.map_err(broken)? {
        if bytes.len() + chunk.len() > most {
            return Err(Problem::too_large(most));
        }
        bytes.extend_from_slice(&chunk);
    }
    Ok(bytes)
}

fn broken(error: axum::extract::multipart::MultipartError) -> Problem {
    if error.status() == StatusCode::PAYLOAD_TOO_LARGE {
        return Problem::too_large(MAX_BYTES);
    }
    Problem::bad_request("The upload ended early or is not well-formed multipart/form-data; send it again.")
}

/// The last part of the name, without what could mislead a terminal or a page: control characters and directions.
pub(crate) fn clean_name(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let kept: String = last
        .chars()
        .filter(|c| !c.is_control() && !matches!(c, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}'))
        .take(120)
        .collect();
    let kept = kept.trim();
    if kept.is_empty() { "object.obj".to_owned() } else { kept.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::clean_name;

    #[test]
    fn names_lose_folders_and_hidden_characters() {
        assert_eq!(clean_name("../../etc/passwd"), "passwd");
        assert_eq!(clean_name(r"C:\meshes\gear.obj"), "gear.obj");
        assert_eq!(clean_name("a\u{202e}jbo.exe\n"), "ajbo.exe");
        assert_eq!(clean_name(" \u{7}"), "object.obj");
        assert_eq!(clean_name(&"x".repeat(500)).len(), 120);
    }
}
