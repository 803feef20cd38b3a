//! Where a request was sent from, and to. A page of another site must not act in a visitor's name: browsers say where a request
//! comes from.

use std::net::IpAddr;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::App;
use crate::guest::is_secure;
use crate::problem::{Problem, Result};

/// Host names of this service, in lower case, in addition to IP addresses and loopback names.
///
/// Against DNS rebinding: a foreign site can point its own name at this machine, but its requests then carry that name.
#[derive(Clone, Debug, Default)]
pub struct Names(Vec<String>);

impl Names {
    /// These names, without ports.
    pub fn new(names: impl IntoIterator<Item = String>) -> Self {
        Self(names.into_iter().map(|name| name.trim().to_lowercase()).filter(|name| !name.is_empty()).collect())
    }

    fn know(&self, host: &str) -> bool {
        let name = match host.rsplit_once(':') {
            Some((name, port)) if port.bytes().all(|c| c.is_ascii_digit()) => name,
            _ => host,
        };
        let name = name.trim_end_matches('.').to_lowercase();
        let literal = name.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>().is_ok();
        literal || name == "localhost" || name.ends_with(".localhost") || self.0.contains(&name)
    }
}

/// Refuses requests for other host names.
pub(crate) async fn refuse_other_names(State(app): State<App>, request: Request, next: Next) -> Response {
    let host = request.headers().get(header::HOST).map(|host| host.to_str().unwrap_or_default());
    if let Some(host) = host.filter(|host| !app.network.names.know(host)) {
        let shown: String = host.chars().filter(|c| !c.is_control()).take(100).collect();
        let detail = format!("Unknown host name {shown:?}; the operator can add it with `ocb serve --host-name`.");
        return Problem::new(StatusCode::MISDIRECTED_REQUEST, detail).into_response();
    }
    next.run(request).await
}

/// Refuses what changes something and was sent by a page of another site. `SameSite` cookies stop most of that already;
/// programs send neither header, and carry no cookie that a page could ride on.
pub(crate) async fn refuse_other_sites(request: Request, next: Next) -> Response {
    let reads = matches!(*request.method(), Method::GET | Method::HEAD | Method::OPTIONS);
    if !reads && from_elsewhere(request.headers()) {
        let detail = "This request was sent by a page of another site; use this service's own pages.";
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

/// Where this service was reached, for links that are to lead back to it.
pub(crate) fn own_origin(headers: &HeaderMap) -> Result<String> {
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    let plain = |c: char| c.is_ascii_alphanumeric() || ".-:[]".contains(c);
    if host.is_empty() || !host.chars().all(plain) {
        return Err(Problem::bad_request("The request has no valid Host header, so there is no link."));
    }
    Ok(format!("{}://{host}", if is_secure(headers) { "https" } else { "http" }))
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

    #[test]
    fn foreign_host_names_are_unknown() {
        let names = Names::new(["Bench.Example".to_owned(), String::new()]);
        for own in [
            "localhost",
            "localhost:8080",
            "a.localhost:1",
            "127.0.0.1:80",
            "[::1]:8080",
            "192.0.2.7",
            "bench.example:443",
        ] {
            assert!(names.know(own), "{own}");
        }
        for other in ["evil.example", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example", ""] {
            assert!(!names.know(other), "{other}");
        }
    }

    #[test]
    fn links_lead_back_to_where_the_request_was_sent() {
        let of = |pairs: &[(&'static str, &'static str)]| {
            own_origin(&pairs.iter().map(|(k, v)| (k.parse().unwrap(), v.parse().unwrap())).collect())
        };
        assert_eq!(of(&[("host", "127.0.0.1:8080")]).unwrap(), "http://127.0.0.1:8080");
        assert_eq!(of(&[("host", "a.example"), ("x-forwarded-proto", "https")]).unwrap(), "https://a.example");
        for odd in ["", "a/b", "a\"b", "a b", "a{b", "a@b"] {
            assert_eq!(of(&[("host", odd)]).unwrap_err().status, 400, "{odd}");
        }
    }
}
