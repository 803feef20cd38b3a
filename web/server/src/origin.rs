//! A page of another site must not act in a visitor's name: browsers say where a request comes from.

use axum::extract::Request;
use axum::http::{HeaderMap, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::Problem;

/// Refuses what changes something and was sent by a page of another site. `SameSite` cookies stop most of that already;
/// programs send neither header, and carry no cookie that a page could ride on.
pub(crate) async fn refuse_other_sites(request: Request, next: Next) -> Response {
    let reads = matches!(*request.method(), Method::GET | Method::HEAD | Method::OPTIONS);
    if !reads && from_elsewhere(request.headers()) {
        let detail = "This request was sent by a page of another site; open this service's own pages to do it.";
        return Problem::new(StatusCode::FORBIDDEN, detail).into_response();
    }
    next.run(request).await
}

fn from_elsewhere(headers: &HeaderMap) -> bool {
    let text = |name: &str| headers.get(name).map(|value| value.to_str().unwrap_or("unreadable"));
    if matches!(text("sec-fetch-site"), Some(site) if site != "same-origin" && site != "none") {
        return true;
    }
    // The scheme is left out: behind a proxy this service does not see it.
    let host = text(header::HOST.as_str()).unwrap_or_default();
    text(header::ORIGIN.as_str()).is_some_and(|origin| origin.split_once("://").is_none_or(|(_, of)| of != host))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_own_pages_and_programs_are_at_home() {
        let from = |pairs: &[(&'static str, &'static str)]| {
            let all = [("host", "a.example:8080")].into_iter().chain(pairs.iter().copied());
            from_elsewhere(&all.map(|(k, v)| (k.parse().unwrap(), v.parse().unwrap())).collect())
        };
        assert!(!from(&[]));
        assert!(!from(&[("origin", "https://a.example:8080"), ("sec-fetch-site", "same-origin")]));
        assert!(from(&[("origin", "https://b.example")]));
        assert!(from(&[("origin", "https://a.example")]));
        assert!(from(&[("origin", "null")]));
        assert!(from(&[("sec-fetch-site", "cross-site")]) && from(&[("sec-fetch-site", "same-site")]));
    }
}
