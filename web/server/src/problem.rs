//! Errors as RFC 9457 problem documents.

use axum::Json;
use axum::extract::rejection::{JsonRejection, PathRejection, QueryRejection};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use ocb_service::EngineError;
use serde::Serialize;
use utoipa::ToSchema;
use uuid::Uuid;

/// An error: what is wrong, where, and how to mend it (RFC 9457, `application/problem+json`).
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
pub struct Problem {
    /// Kind of problem: always `about:blank`, the status says it.
    pub r#type: String,
    /// The status in words.
    pub title: String,
    /// HTTP status.
    pub status: u16,
    /// One sentence for the person who asked.
    pub detail: String,
    /// Seconds until a retry is useful; sent as `Retry-After`.
    #[serde(skip)]
    pub retry_seconds: Option<u32>,
}

/// What a handler returns.
pub(crate) type Result<T> = std::result::Result<T, Problem>;

impl Problem {
    /// A problem whose `detail` is one clear sentence.
    pub fn new(status: StatusCode, detail: impl Into<String>) -> Self {
        Self {
            r#type: "about:blank".to_owned(),
            title: status.canonical_reason().unwrap_or("Error").to_owned(),
            status: status.as_u16(),
            detail: detail.into(),
            retry_seconds: None,
        }
    }

    /// A limit is reached (429); a retry is useful after so many seconds.
    pub fn too_much(detail: impl Into<String>, retry_seconds: u32) -> Self {
        Self { retry_seconds: Some(retry_seconds), ..Self::new(StatusCode::TOO_MANY_REQUESTS, detail) }
    }

    /// There is no such thing.
    pub fn not_found(detail: impl Into<String>) -> Self {
        Self::new(StatusCode::NOT_FOUND, detail)
    }

    /// The caller's input is bad.
    pub fn bad_request(detail: impl Into<String>) -> Self {
        Self::new(StatusCode::BAD_REQUEST, detail)
    }

    /// The upload is larger than what may be sent there.
    pub fn too_large(most: usize) -> Self {
        let detail = if most < 1 << 20 {
            format!("A form field exceeds the limit of {} KiB.", most >> 10)
        } else {
            format!("The file exceeds the limit of {} MiB.", most >> 20)
        };
        Self::new(StatusCode::PAYLOAD_TOO_LARGE, detail)
    }

    /// Our fault: the cause goes to the log under a number, the caller gets the number.
    ///
    /// Causes name paths and addresses of the machine, which are nobody else's business.
    pub fn fault(cause: impl std::fmt::Display) -> Self {
        let number = Uuid::new_v4().simple().to_string();
        tracing::error!(number, %cause, "a request failed: internal error");
        Self::new(
            StatusCode::INTERNAL_SERVER_ERROR,
            format!("Internal error; the cause is in the service's log under {number}. Please try again."),
        )
    }
}

impl From<EngineError> for Problem {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::NotFound(detail) => Self::not_found(detail),
            EngineError::Invalid(detail) => Self::new(StatusCode::UNPROCESSABLE_ENTITY, detail),
            EngineError::Forbidden(detail) => Self::new(StatusCode::FORBIDDEN, detail),
            EngineError::Busy(detail) => Self::new(StatusCode::CONFLICT, detail),
            EngineError::TooMuch { message, retry_seconds } => Self::too_much(message, retry_seconds),
            EngineError::Ended(detail) => Self::new(StatusCode::INTERNAL_SERVER_ERROR, detail),
            EngineError::Fault(cause) => Self::fault(cause),
        }
    }
}

impl From<JsonRejection> for Problem {
    fn from(rejection: JsonRejection) -> Self {
        Self::new(rejection.status(), sentence(&rejection.body_text()))
    }
}

impl From<QueryRejection> for Problem {
    fn from(rejection: QueryRejection) -> Self {
        Self::bad_request(sentence(&rejection.body_text()))
    }
}

impl From<PathRejection> for Problem {
    fn from(rejection: PathRejection) -> Self {
        Self::bad_request(sentence(&rejection.body_text()))
    }
}

/// One line with a full stop.
fn sentence(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.ends_with('.') { line } else { format!("{line}.") }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let retry = self.retry_seconds.map(HeaderValue::from);
        let mut response = (status, Json(self)).into_response();
        let media_type = HeaderValue::from_static("application/problem+json");
        response.headers_mut().insert(header::CONTENT_TYPE, media_type);
        response.headers_mut().extend(retry.map(|seconds| (header::RETRY_AFTER, seconds)));
        response
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_never_shows_its_cause() {
        let problem = Problem::from(EngineError::Fault("disk /srv/secret is full".to_owned()));
        assert_eq!(problem.status, 500);
        assert!(problem.detail.contains("Internal error"));
        assert!(!problem.detail.contains("secret"));
    }

    #[test]
    fn each_kind_has_its_status() {
        let status = |error| Problem::from(error).status;
        assert_eq!(status(EngineError::NotFound("x".to_owned())), 404);
        assert_eq!(status(EngineError::Invalid("x".to_owned())), 422);
        assert_eq!(status(EngineError::Forbidden("x".to_owned())), 403);
        assert_eq!(status(EngineError::Busy("x".to_owned())), 409);
        let too_much =
            Problem::from(EngineError::TooMuch { message: "x".to_owned(), retry_seconds: 7 }).into_response();
        assert_eq!(
            (too_much.status().as_u16(), &too_much.headers()[header::RETRY_AFTER]),
            (429, &HeaderValue::from(7))
        );
    }
}
