//! What a program calls its request, so that sending it again, because its answer was lost, makes nothing twice.

use axum::extract::FromRequestParts;
use axum::http::HeaderMap;
use axum::http::request::Parts;
use utoipa::IntoParams;

use crate::problem::{Problem, Result};

const KEY: &str = "idempotency-key";

/// The header of requests that make something.
#[derive(IntoParams)]
#[into_params(parameter_in = Header)]
#[expect(dead_code, reason = "only described; the value is read by `RequestKey`")]
pub(crate) struct IdempotencyKey {
    /// 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
    /// as long as a run, and for 30 days otherwise.
    #[param(rename = "Idempotency-Key", min_length = 1, max_length = 200)]
    key: Option<String>,
}

/// The key, if the request has one.
pub(crate) struct RequestKey(Option<String>);

impl<S: Send + Sync> FromRequestParts<S> for RequestKey {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self> {
        of(&parts.headers).map(Self)
    }
}

impl RequestKey {
    /// As text.
    pub(crate) fn as_deref(&self) -> Option<&str> {
        self.0.as_deref()
    }
}

fn of(headers: &HeaderMap) -> Result<Option<String>> {
    let Some(value) = headers.get(KEY) else { return Ok(None) };
    let key = value.to_str().ok().filter(|key| (1..=200).contains(&key.len()));
    let bad = || Problem::bad_request("An Idempotency-Key must have 1 to 200 visible ASCII characters.");
    key.map(|key| Some(key.to_owned())).ok_or_else(bad)
}
