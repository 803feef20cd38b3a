//! Answers that are files to save.

use std::fs::File;
use std::sync::Arc;

use axum::body::Body;
use axum::http::{HeaderName, header};
use axum::response::{IntoResponse, Response};
use futures::stream;
use tokio::io::AsyncReadExt;
use tokio::sync::{Mutex, OwnedSemaphorePermit, Semaphore};

use crate::problem::{Problem, Result};

/// Bytes of a file that are read and sent at once.
const CHUNK: usize = 64 << 10;

/// These bytes.
pub(crate) fn download(media_type: &str, name: &str, bytes: Vec<u8>) -> Response {
    (head(media_type, name), bytes).into_response()
}

/// Most archives on the disk at a time: downloads may be slow.
const ARCHIVES: usize = 8;

/// Limits the archives being written or downloaded.
pub(crate) struct Archives {
    places: Arc<Semaphore>,
    writing: Mutex<()>,
}

impl Default for Archives {
    fn default() -> Self {
        Self { places: Arc::new(Semaphore::new(ARCHIVES)), writing: Mutex::default() }
    }
}

impl Archives {
    /// Writes one and sends it.
    ///
    /// # Errors
    /// 429 while too many are being sent.
    pub(crate) async fn send(
        &self,
        media_type: &str,
        name: &str,
        write: impl Future<Output = ocb_service::Result<File>>,
    ) -> Result<Response> {
        let place = self
            .places
            .clone()
            .try_acquire_owned()
            .map_err(|_| Problem::too_much("Too many archives are being downloaded; try again in a moment.", 30))?;
        let writing = self.writing.lock().await;
        let file = write.await?;
        drop(writing);
        download_file(media_type, name, file, place)
    }
}

/// The rest of an open file; `place` is released when it is sent or the client leaves.
fn download_file(media_type: &str, name: &str, file: File, place: OwnedSemaphorePermit) -> Result<Response> {
    let length = file.metadata().map_err(Problem::fault)?.len();
    let chunks = stream::try_unfold((tokio::fs::File::from_std(file), place), async |(mut file, place)| {
        let mut chunk = vec![0; CHUNK];
        let read = file.read(&mut chunk).await?;
        chunk.truncate(read);
        Ok::<_, std::io::Error>((read > 0).then_some((chunk, (file, place))))
    });
    Ok((head(media_type, name), [(header::CONTENT_LENGTH, length.to_string())], Body::from_stream(chunks))
        .into_response())
}

/// Ids and algorithm names come from the request: only plain characters reach the header.
fn head(media_type: &str, name: &str) -> [(HeaderName, String); 2] {
    let plain = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '-' | '.' | '_') { c } else { '_' };
    let name: String = name.chars().map(plain).collect();
    let disposition = format!("attachment; filename=\"{name}\"");
    [(header::CONTENT_TYPE, media_type.to_owned()), (header::CONTENT_DISPOSITION, disposition)]
}
