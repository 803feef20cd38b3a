//! Who asks: an account by its session or token, or a guest, whose random cookie owns what a visitor makes.

use axum::extract::{FromRequestParts, Request, State};
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header, request::Parts};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use axum_extra::extract::CookieJar;
use axum_extra::extract::cookie::{Cookie, SameSite};
use ocb_service::model::{AccountInfo, Role, Scope};
use uuid::Uuid;

use crate::App;
use crate::problem::{Problem, Result};

const GUEST: &str = "ocb_guest";
/// The cookie of a session.
pub(crate) const SESSION: &str = "ocb_session";
const YEAR_SECONDS: u64 = 365 * 24 * 3600;

/// The owner of what is made: an account, or the guest of this browser.
#[derive(Clone, Debug)]
pub(crate) struct Guest(pub String);

/// The guest of this browser, whoever is logged in.
#[derive(Clone, Debug)]
pub(crate) struct Browser(pub String);

/// Who is logged in; for anybody else the answer is 401.
#[derive(Clone, Debug)]
pub(crate) struct Member(pub AccountInfo);

/// The account of a browser session, as opposed to a token.
#[derive(Clone, Debug)]
pub(crate) struct Person(pub AccountInfo);

/// The scopes of the request's token.
#[derive(Clone, Debug)]
pub(crate) struct Token(pub Vec<Scope>);

/// A curator or an administrator.
#[derive(Clone, Debug)]
pub(crate) struct Curator(pub AccountInfo);

/// Reads cookies and token, or gives the visitor a cookie.
///
/// A guest's value that is no UUID is replaced: the engine stores owners as they come, and nobody else may choose them.
pub(crate) async fn recognise(State(app): State<App>, mut request: Request, next: Next) -> Response {
    let jar = CookieJar::from_headers(request.headers());
    let known = jar.get(GUEST).and_then(|cookie| Uuid::try_parse(cookie.value()).ok());
    let guest = known.unwrap_or_else(Uuid::new_v4).to_string();
    let reads = matches!(*request.method(), Method::GET | Method::HEAD);
    let (account, token) = match account(&app, request.headers(), request.uri().path(), reads, &jar).await {
        Ok(Some((account, token))) => (Some(account), token),
        Ok(None) => (None, None),
        Err(problem) => return problem.into_response(),
    };
    let secure = is_secure(request.headers());
    let owner = account.as_ref().map_or_else(|| guest.clone(), AccountInfo::owner);
    let programs = request.headers().contains_key(header::AUTHORIZATION);
    let extensions = request.extensions_mut();
    extensions.insert(Guest(owner));
    extensions.insert(Browser(guest.clone()));
    if let Some(account) = account {
        match token {
            Some(scopes) => drop(extensions.insert(Token(scopes))),
            None => drop(extensions.insert(Person(account.clone()))),
        }
        extensions.insert(Member(account));
    }
    let mut response = next.run(request).await;
    if known.is_none() && !programs {
        response.headers_mut().append(header::SET_COOKIE, cookie(GUEST, &guest, YEAR_SECONDS, secure));
    }
    response
}

/// The account of the session or token, and the token's scopes.
async fn account(
    app: &App,
    headers: &HeaderMap,
    path: &str,
    reads: bool,
    jar: &CookieJar,
) -> Result<Option<(AccountInfo, Option<Vec<Scope>>)>> {
    let Some(value) = headers.get(header::AUTHORIZATION) else {
        return match jar.get(SESSION) {
            Some(session) => Ok(app.engine.session(session.value()).await?.map(|account| (account, None))),
            None => Ok(None),
        };
    };
    let secret = value.to_str().ok().and_then(|text| text.strip_prefix("Bearer "));
    let opened = match secret {
        Some(secret) => app.engine.token(secret.trim()).await?,
        None => None,
    };
    let unknown =
        || Problem::new(StatusCode::UNAUTHORIZED, "This token is not valid; create a new one on the account page.");
    let (account, scopes) = opened.ok_or_else(unknown)?;
    match scope_of(path, reads) {
        Some(scope) if scopes.contains(&scope) => Ok(Some((account, Some(scopes)))),
        // What is there for everybody may be read by everybody.
        _ if reads && anybody_reads(path) => Ok(None),
        _ => {
            let detail = "This token does not have the required scope; log in, or create a token that has it.";
            Err(Problem::new(StatusCode::FORBIDDEN, detail))
        }
    }
}

/// The scope that a token needs for a path; none opens accounts, notices and decisions, which need a browser session. Repro archives
/// contain plugins.
pub(crate) fn scope_of(path: &str, reads: bool) -> Option<Scope> {
    match resource(path) {
        "account" | "accounts" | "curation" | "invitations" | "notices" => None,
        "campaigns" if !reads => None,
        "plugins" => Some(Scope::Plugins),
        "runs" if path.ends_with("/repro.zip") => Some(Scope::Plugins),
        _ => Some(Scope::Runs),
    }
}

/// Can public data at this path be read with any token?
pub(crate) fn anybody_reads(path: &str) -> bool {
    scope_of(path, true).is_some() && resource(path) != "plugins"
}

fn resource(path: &str) -> &str {
    path.strip_prefix("/api/v1/").and_then(|rest| rest.split('/').next()).unwrap_or_default()
}

/// Behind a proxy that speaks TLS: cookies must not be sent without it.
pub(crate) fn is_secure(headers: &HeaderMap) -> bool {
    headers.get("x-forwarded-proto").is_some_and(|proto| proto.as_bytes() == b"https")
}

/// A cookie that scripts cannot read and other sites cannot use; with no seconds to live it is taken away.
pub(crate) fn cookie(name: &str, value: &str, seconds: u64, secure: bool) -> HeaderValue {
    let mut cookie = Cookie::new(name, value);
    cookie.set_path("/");
    cookie.set_http_only(true);
    cookie.set_same_site(SameSite::Lax);
    cookie.set_secure(secure);
    HeaderValue::from_str(&format!("{cookie}; Max-Age={seconds}")).expect("names and secrets are plain text")
}

fn outside() -> Problem {
    Problem::fault("a route lies outside the guest layer")
}

impl<S: Send + Sync> FromRequestParts<S> for Guest {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self> {
        parts.extensions.get::<Self>().cloned().ok_or_else(outside)
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Browser {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self> {
        parts.extensions.get::<Self>().cloned().ok_or_else(outside)
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Member {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self> {
        let nobody =
            || Problem::new(StatusCode::UNAUTHORIZED, "Log in first, or create an account on the account page.");
        parts.extensions.get::<Self>().cloned().ok_or_else(nobody)
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Curator {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self> {
        let Member(account) = Member::from_request_parts(parts, state).await?;
        if account.role < Role::Curator {
            return Err(Problem::new(StatusCode::FORBIDDEN, "Only curators may do that."));
        }
        Ok(Self(account))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_for_one_thing() {
        assert_eq!(scope_of("/api/v1/plugins/x/events", true), Some(Scope::Plugins));
        assert_eq!(scope_of("/api/v1/runs/x/repro.zip", true), Some(Scope::Plugins));
        assert_eq!(scope_of("/api/v1/runs", false), Some(Scope::Runs));
        assert_eq!(scope_of("/api/v1/campaigns/x", true), Some(Scope::Runs));
        for person in ["/api/v1/invitations", "/api/v1/curation", "/api/v1/notices/x/read"] {
            assert_eq!(scope_of(person, true), None, "{person}");
        }
        assert_eq!(scope_of("/api/v1/campaigns", false), None);
    }

    #[test]
    fn cookies_are_closed_to_scripts_and_other_sites() {
        let text = cookie(SESSION, "abc", 60, true).to_str().unwrap().to_owned();
        for part in ["HttpOnly", "SameSite=Lax", "Secure", "Path=/", "Max-Age=60"] {
            assert!(text.contains(part), "{text}");
        }
        assert!(!cookie(SESSION, "abc", 60, false).to_str().unwrap().contains("Secure"));
    }
}
