//! Lists part by part: the body is the part, the `Link` header (RFC 8288) says where the list goes on.

use axum::Json;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use ocb_service::model::{Page, Part};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use serde::Serialize;

/// The answer with a part of the list at this path.
pub(crate) fn answer<T: Serialize>(path: &str, page: &Page, part: Part<T>) -> Response {
    let next = part.next.map(|next| {
        let cursor = next.to_string();
        let cursor = utf8_percent_encode(&cursor, NON_ALPHANUMERIC);
        [(header::LINK, format!("<{path}?limit={}&cursor={cursor}>; rel=\"next\"", page.limit))]
    });
    (next, Json(part.entries)).into_response()
}
