//! Bodies that come too slowly: each must keep a pace, or whoever sends one byte a minute would hold what it is read into.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use axum::body::{Body, BodyDataStream, HttpBody};
use axum::extract::Request;
use axum::http::{HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use futures::StreamExt;
use tokio::time::{Instant, timeout_at};

use crate::Problem;

/// How late a body may be, at its beginning and later.
const GRACE: Duration = Duration::from_secs(20);

/// The slowest pace at which a body may come: a quarter of a megabit per second.
const BYTES_PER_SECOND: u64 = 32 << 10;

/// Answers 408 when the body of a request falls behind.
pub(crate) async fn refuse_slow_bodies(request: Request, next: Next) -> Response {
    if request.body().is_end_stream() {
        return next.run(request).await;
    }
    let late = Arc::new(AtomicBool::new(false));
    let (parts, body) = request.into_parts();
    let paced = Paced { body: body.into_data_stream(), began: None, bytes: 0, late: late.clone() };
    // Fused: whoever refuses an upload reads on to its end, and may have been there.
    let stream = futures::stream::unfold(paced, Paced::next).fuse();
    let response = next.run(Request::from_parts(parts, Body::from_stream(stream))).await;
    if !late.load(Ordering::Relaxed) {
        return response;
    }
    let detail = "The body of this request came too slowly; send it again over a faster connection.";
    let mut response = Problem::new(StatusCode::REQUEST_TIMEOUT, detail).into_response();
    // The rest of the body may still come; it would be taken for the next request.
    response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
    response
}

/// A body and how far it has come.
struct Paced {
    body: BodyDataStream,
    /// When it was first asked for: an upload that waits for its turn is not late.
    began: Option<Instant>,
    bytes: u64,
    late: Arc<AtomicBool>,
}

impl Paced {
    async fn next(mut self) -> Option<(Result<axum::body::Bytes, axum::Error>, Self)> {
        let began = *self.began.get_or_insert_with(Instant::now);
        let chunk = match timeout_at(due(began, self.bytes), self.body.next()).await {
            Ok(chunk) => chunk?,
            Err(_) => {
                self.late.store(true, Ordering::Relaxed);
                Err(axum::Error::new(io::Error::from(io::ErrorKind::TimedOut)))
            }
        };
        if let Ok(bytes) = &chunk {
            self.bytes += bytes.len() as u64;
        }
        Some((chunk, self))
    }
}

/// When the next bytes must be there.
fn due(began: Instant, bytes: u64) -> Instant {
    began + GRACE + Duration::from_secs(bytes / BYTES_PER_SECOND)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_has_more_time_the_more_of_it_has_come() {
        let began = Instant::now();
        assert_eq!(due(began, 0), began + GRACE);
        assert_eq!(due(began, 256 << 20), began + GRACE + Duration::from_secs(8192));
    }
}
