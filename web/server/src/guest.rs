//! Guests: a random cookie owns what a visitor makes, without an account.

use axum::extract::{FromRequestParts, Request};
use axum::http::{HeaderValue, header, request::Parts};
use axum::middleware::Next;
use axum::response::Response;
use axum_extra::extract::CookieJar;
use axum_extra::extract::cookie::{Cookie, SameSite};
use uuid::Uuid;

use crate::Problem;

const COOKIE: &str = "ocb_guest";
const YEAR_SECONDS: u64 = 365 * 24 * 3600;

/// Who asks: the owner of the runs and objects made in this browser.
#[derive(Clone, Debug)]
pub(crate) struct Guest(pub String);

/// Reads the cookie, or gives the visitor one.
///
/// A value that is no UUID is replaced: the engine stores owners as they come, and nobody else may choose them.
pub(crate) async fn recognise(mut request: Request, next: Next) -> Response {
    let jar = CookieJar::from_headers(request.headers());
    let known = jar.get(COOKIE).and_then(|cookie| Uuid::try_parse(cookie.value()).ok());
    let id = known.unwrap_or_else(Uuid::new_v4).to_string();
    request.extensions_mut().insert(Guest(id.clone()));
    let mut response = next.run(request).await;
    if known.is_none() {
        let mut cookie = Cookie::new(COOKIE, id);
        cookie.set_path("/");
        cookie.set_http_only(true);
        cookie.set_same_site(SameSite::Lax);
        let value = format!("{cookie}; Max-Age={YEAR_SECONDS}");
        if let Ok(value) = HeaderValue::from_str(&value) {
            response.headers_mut().append(header::SET_COOKIE, value);
        }
    }
    response
}

impl<S: Send + Sync> FromRequestParts<S> for Guest {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        parts.extensions.get::<Self>().cloned().ok_or_else(|| Problem::fault("a route lies outside the guest layer"))
    }
}
