//! Answers that are files to save.

use std::fs::File;

use axum::body::Body;
use axum::http::{HeaderName, header};
use axum::response::{IntoResponse, Response};
use futures::stream;
use tokio::io::AsyncReadExt;

use crate::problem::{Problem, Result};

/// Bytes of a file that are read and sent at once.
const CHUNK: usize = 64 << 10;

/// These bytes.
pub(crate) fn download(media_type: &str, name: &str, bytes: Vec<u8>) -> Response {
    (head(media_type, name), bytes).into_response()
}

/// What an open file holds, from where it stands.
pub(crate) fn download_file(media_type: &str, name: &str, file: File) -> Result<Response> {
    let length = file.metadata().map_err(Problem::fault)?.len();
    let chunks = stream::try_unfold(tokio::fs::File::from_std(file), async |mut file| {
        let mut chunk = vec![0; CHUNK];
        let read = file.read(&mut chunk).await?;
        chunk.truncate(read);
        Ok::<_, std::io::Error>((read > 0).then_some((chunk, file)))
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
