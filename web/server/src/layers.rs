//! What every answer passes through: headers that protect the visitor, compression, tracing, and a net for panics.

use std::any::Any;

use axum::Router;
use axum::extract::Request;
use axum::http::{HeaderName, HeaderValue, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{DefaultPredicate, NotForContentType, Predicate};
use tower_http::trace::TraceLayer;

use crate::{App, Problem, guest, metrics, origin, pace, privacy};

/// Scripts only from here and never inline. Style attributes are what Vue and the chart kit write; `blob:` is how the
/// viewer loads workers, textures and pictures that the page itself has made.
const CONTENT_SECURITY_POLICY: &str = "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
    img-src 'self' blob: data:; connect-src 'self' blob: data:; worker-src 'self' blob:; object-src 'none'; \
    base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

/// Name and value of the headers that every answer carries.
const HEADERS: [(HeaderName, &str); 5] = [
    (header::CONTENT_SECURITY_POLICY, CONTENT_SECURITY_POLICY),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    // A run's link is its key: it must not leak to the page that a link leads to.
    (header::REFERRER_POLICY, "no-referrer"),
    (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
];

pub(crate) fn wrap(router: Router<App>, app: &App) -> Router<App> {
    // Parquet is compressed inside, and columns of random digits take seconds to become little smaller. The default leaves
    // out event streams, pictures and small answers.
    let worth_it = DefaultPredicate::new()
        .and(NotForContentType::const_new("application/vnd.apache.parquet"))
        .and(NotForContentType::const_new("application/vnd.apache.arrow.stream"))
        .and(NotForContentType::const_new("application/x-tar"));
    router
        .layer(middleware::from_fn_with_state(app.clone(), privacy::hide_private_things))
        .layer(middleware::from_fn_with_state(app.clone(), guest::recognise))
        .layer(middleware::from_fn(origin::refuse_other_sites))
        .layer(middleware::from_fn_with_state(app.clone(), origin::refuse_other_names))
        .layer(middleware::from_fn(pace::refuse_slow_bodies))
        .layer(CatchPanicLayer::custom(after_panic))
        .layer(middleware::from_fn_with_state(app.clone(), metrics::count))
        .layer(middleware::from_fn(protect))
        .layer(CompressionLayer::new().compress_when(worth_it))
        .layer(TraceLayer::new_for_http())
}

async fn protect(request: Request, next: Next) -> Response {
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    for (name, value) in HEADERS {
        headers.insert(name, HeaderValue::from_static(value));
    }
    headers.entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    response
}

fn after_panic(cause: Box<dyn Any + Send + 'static>) -> Response {
    let cause = cause.downcast_ref::<&str>().map(|text| (*text).to_owned());
    Problem::fault(cause.unwrap_or_else(|| "a handler panicked".to_owned())).into_response()
}
