//! How often somebody may try what others could be harmed by: guessing passwords, making accounts, uploading.

use std::collections::HashMap;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use axum::extract::{ConnectInfo, FromRequestParts};
use axum::http::StatusCode;
use axum::http::request::Parts;

use crate::problem::{Problem, Result};

/// How many of one thing are allowed in which time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limit {
    name: &'static str,
    times: u32,
    per: Duration,
}

const fn limit(name: &'static str, times: u32, seconds: u64) -> Limit {
    Limit { name, times, per: Duration::from_secs(seconds) }
}

/// Wrong passwords, per address and per name.
pub(crate) const LOG_IN: Limit = limit("log in", 10, 60);
/// New accounts, per address.
pub(crate) const MAKE_ACCOUNT: Limit = limit("make an account", 20, 3600);

/// Secrets of invitations, per address.
pub(crate) const ACCEPT: Limit = limit("accept an invitation", 20, 60);

/// Addresses that mails are to go to, per address of the visitor and per account; and mails asking about one, per that address.
pub(crate) const GIVE_ADDRESS: Limit = limit("give an address", 10, 3600);
pub(crate) const MAIL_TO: Limit = limit("have a mail sent", 5, 3600);

/// Secrets of links that confirm an address, per address of the visitor and per account.
pub(crate) const CONFIRM: Limit = limit("confirm an address", 20, 60);

/// Wrong links that would turn mails off, per address of the visitor.
pub(crate) const TURN_OFF: Limit = limit("turn mails off", 20, 60);

/// Plugins, per account.
pub(crate) const SUBMIT: Limit = limit("submit a plugin", 30, 3600);

/// Addresses and names that are remembered at most; beyond it those that may try again are forgotten.
const MOST: usize = 10_000;

/// What is limited, and who tried.
type Tried = (&'static str, String);

/// What was tried lately: a bucket each that drains evenly, with its level and when that was.
#[derive(Default)]
pub(crate) struct Limits {
    buckets: Mutex<HashMap<Tried, (f64, Instant)>>,
}

impl Limits {
    /// Counts a try of `who`.
    ///
    /// # Errors
    /// 429 with the seconds to wait when there were too many.
    pub(crate) fn count(&self, limit: Limit, who: &str) -> Result<()> {
        self.count_at(limit, who, Instant::now())
    }

    fn count_at(&self, limit: Limit, who: &str, now: Instant) -> Result<()> {
        let mut buckets = self.buckets.lock().unwrap_or_else(PoisonError::into_inner);
        if buckets.len() >= MOST {
            buckets.retain(|_, (level, then)| *level > now.duration_since(*then).as_secs_f64());
        }
        let drained = f64::from(limit.times) / limit.per.as_secs_f64();
        let (level, then) = buckets.entry((limit.name, who.to_lowercase())).or_insert((0.0, now));
        *level = (*level - now.duration_since(*then).as_secs_f64() * drained).max(0.0);
        *then = now;
        let over = *level + 1.0 - f64::from(limit.times);
        if over > 0.0 {
            let wait = (over / drained).ceil();
            let detail = format!("Too many tries to {}; wait {wait} seconds and try again.", limit.name);
            return Err(Problem::new(StatusCode::TOO_MANY_REQUESTS, detail));
        }
        *level += 1.0;
        Ok(())
    }
}

/// The address of who asks. A proxy on the same machine says whose request it passes on; nobody else is believed.
pub(crate) struct Address(pub String);

impl<S: Send + Sync> FromRequestParts<S> for Address {
    type Rejection = std::convert::Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> std::result::Result<Self, Self::Rejection> {
        let peer = parts.extensions.get::<ConnectInfo<SocketAddr>>().map_or(Ipv4Addr::LOCALHOST.into(), |c| c.0.ip());
        let told = parts.headers.get_all("x-forwarded-for").iter().next_back().and_then(|value| value.to_str().ok());
        let last = told.and_then(|list| list.rsplit(',').next()?.trim().parse::<IpAddr>().ok());
        Ok(Self(last.filter(|_| peer.is_loopback()).unwrap_or(peer).to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bucket_fills_and_drains_for_each_alone() {
        let (limits, now) = (Limits::default(), Instant::now());
        let at = |seconds| now + Duration::from_secs(seconds);
        for _ in 0..10 {
            limits.count_at(LOG_IN, "a", now).unwrap();
        }
        let refused = limits.count_at(LOG_IN, "A", now).unwrap_err();
        assert_eq!(refused.status, 429);
        assert!(refused.detail.contains("wait 6 seconds"), "{}", refused.detail);
        limits.count_at(LOG_IN, "b", now).unwrap();
        limits.count_at(LOG_IN, "a", at(7)).unwrap();
        assert!(limits.count_at(LOG_IN, "a", at(7)).is_err());
    }
}
