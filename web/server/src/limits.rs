//! How often somebody may try what others could be harmed by: guessing passwords, making accounts, uploading, asking for runs.

use std::collections::HashMap;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::num::NonZeroU32;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use governor::clock::{Clock, DefaultClock};
use governor::state::keyed::HashMapStateStore;
use governor::{Quota, RateLimiter};

use ocb_service::RateLimit as Limit;

use crate::App;
use crate::problem::{Problem, Result};

const fn limit(name: &'static str, of: &'static str, times: u32, seconds: u64) -> Limit {
    Limit { name, of, times, per: Duration::from_secs(seconds) }
}

/// Login attempts per address, per address and name, and per name alone; the last does not apply to browsers that have logged in
/// before, and one address cannot exhaust it, so that no visitor can lock an account.
pub(crate) const LOG_IN: Limit = limit("log in", "address", 10, 60);
pub(crate) const LOG_IN_AS: Limit = limit("log in", "address and name", 10, 3600);
pub(crate) const LOG_IN_ANYWHERE: Limit = limit("log in", "name", 100, 3600);
/// Old passwords, per account.
pub(crate) const CHANGE_PASSWORD: Limit = limit("change the password", "account", 10, 60);
/// New accounts, per address.
pub(crate) const MAKE_ACCOUNT: Limit = limit("create an account", "address", 20, 3600);

/// Secrets of invitations, per address.
pub(crate) const ACCEPT: Limit = limit("accept an invitation", "address", 20, 60);

/// Addresses that mails are to go to, per address of the visitor and per account; and mails asking about one, per that address.
pub(crate) const GIVE_ADDRESS: Limit = limit("set an address", "anybody", 10, 3600);
pub(crate) const MAIL_TO: Limit = limit("send a mail", "address", 5, 3600);

/// Secrets of links that confirm an address, per address of the visitor and per account.
pub(crate) const CONFIRM: Limit = limit("confirm an address", "anybody", 20, 60);

/// Wrong links that would turn mails off, per address of the visitor.
pub(crate) const TURN_OFF: Limit = limit("turn mail off", "address", 20, 60);

/// Plugins, per account.
pub(crate) const SUBMIT: Limit = limit("submit a plugin", "account", 30, 3600);

/// Runs, requests for advice, objects and uploaded MiB, per address.
pub(crate) const ASK_RUN: Limit = limit("request a run", "address", 120, 600);
pub(crate) const START_STABILITY: Limit = limit("start stability runs", "address", 60, 3600);
pub(crate) const ADD_WORKLOAD: Limit = limit("replay recordings", "address", 60, 3600);
pub(crate) const ASK_ADVICE: Limit = limit("request advice", "address", 60, 3600);
pub(crate) const ADD_OBJECT: Limit = limit("add an object", "address", 120, 3600);
pub(crate) const SAVE_CONFIGURATIONS: Limit = limit("save configurations", "address", 120, 3600);
pub(crate) const ADD_MEBIBYTES: Limit = limit("upload so much", "MiB", 4096, 24 * 3600);

/// A keyed hash of the address or name. 16 bits bound the memory; two visitors share a bucket with a probability of 1 in 65,536.
type Place = u16;

type Limiter = RateLimiter<Place, HashMapStateStore<Place>, DefaultClock>;

impl App {
    /// Counts an attempt of `who`, ignoring case: here, and then with all services on the same database.
    ///
    /// # Errors
    /// 429 with the seconds to wait when there were too many.
    pub(crate) async fn count(&self, limit: Limit, who: &str) -> Result<()> {
        self.count_many(limit, who, 1).await
    }

    /// Counts `many` attempts at once, which may be 0.
    pub(crate) async fn count_many(&self, limit: Limit, who: &str, many: u32) -> Result<()> {
        if many == 0 {
            return Ok(());
        }
        // A flood ends here and does not reach the database.
        self.limits.count_many(limit, who, many)?;
        match self.engine.count_against(limit, who, many).await? {
            Some(wait) => Err(too_many(limit, wait)),
            None => Ok(()),
        }
    }
}

fn too_many(limit: Limit, wait: Duration) -> Problem {
    let wait = wait.as_secs_f64().ceil().max(1.0) as u32;
    Problem::too_much(format!("Too many attempts to {}; wait {wait} seconds and try again.", limit.name), wait)
}

/// Recent attempts at this service.
#[derive(Default)]
pub(crate) struct Limits {
    limiters: Mutex<HashMap<(&'static str, &'static str), Limiter>>,
    secret: RandomState,
}

impl Limits {
    fn count_many(&self, limit: Limit, who: &str, many: u32) -> Result<()> {
        let Some(many) = NonZeroU32::new(many.min(limit.times)) else { return Ok(()) };
        let mut limiters = self.limiters.lock().unwrap_or_else(PoisonError::into_inner);
        let limiter = limiters.entry((limit.name, limit.of)).or_insert_with(|| RateLimiter::hashmap(quota(limit)));
        let Ok(Err(not_until)) = limiter.check_key_n(&self.place(who), many) else { return Ok(()) };
        Err(too_many(limit, not_until.wait_time_from(DefaultClock::default().now())))
    }

    fn place(&self, who: &str) -> Place {
        let mut hasher = self.secret.build_hasher();
        who.chars().flat_map(char::to_lowercase).for_each(|c| hasher.write_u32(c.into()));
        hasher.finish() as Place
    }
}

fn quota(limit: Limit) -> Quota {
    let times = NonZeroU32::new(limit.times).unwrap_or(NonZeroU32::MIN);
    Quota::with_period(limit.per / limit.times).expect("a limit has a time").allow_burst(times)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bucket_fills_for_each_alone() {
        let limits = Limits::default();
        for _ in 0..10 {
            limits.count_many(LOG_IN, "a", 1).unwrap();
        }
        let refused = limits.count_many(LOG_IN, "A", 1).unwrap_err();
        assert_eq!(refused.status, 429);
        assert!(refused.detail.contains("wait 6 seconds") && refused.retry_seconds == Some(6), "{refused:?}");
        limits.count_many(LOG_IN, "b", 1).unwrap();
        limits.count_many(LOG_IN_AS, "a", 1).unwrap();
    }

    #[test]
    fn a_bucket_drains() {
        const QUICK: Limit = Limit { name: "test", of: "test", times: 2, per: Duration::from_millis(400) };
        let limits = Limits::default();
        limits.count_many(QUICK, "a", 2).unwrap();
        assert!(limits.count_many(QUICK, "a", 1).is_err());
        std::thread::sleep(Duration::from_millis(250));
        limits.count_many(QUICK, "a", 1).unwrap();
    }

    #[test]
    fn many_at_once_count_as_many() {
        let limits = Limits::default();
        limits.count_many(ADD_MEBIBYTES, "a", 4000).unwrap();
        limits.count_many(ADD_MEBIBYTES, "a", 0).unwrap();
        let refused = limits.count_many(ADD_MEBIBYTES, "a", 256).unwrap_err();
        assert!(refused.retry_seconds.is_some_and(|wait| (3000..=3600).contains(&wait)), "{refused:?}");
    }

    #[test]
    fn a_flood_of_names_takes_no_more_memory_than_there_are_places() {
        let limits = Limits::default();
        for i in 0..200_000 {
            let _ = limits.count_many(LOG_IN_ANYWHERE, &format!("name {i}"), 1);
        }
        let limiters = limits.limiters.lock().unwrap();
        let known = limiters[&(LOG_IN_ANYWHERE.name, LOG_IN_ANYWHERE.of)].len();
        assert!((50_000..=65_536).contains(&known), "{known}");
    }
}
