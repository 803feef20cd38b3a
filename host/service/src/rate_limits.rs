//! What visitors do, counted by all services on one database together, by its clock.
//!
//! A bucket drains evenly, and what does not fit into it is refused (the generic cell rate algorithm). Its row holds the time at
//! which it will be empty.

use std::time::Duration;

use ocb_lab::sha256_hex;
use uuid::Uuid;

use crate::engine::Engine;
use crate::store::Store;
use crate::{Result, boxed};

/// How often one thing may be done in which time.
#[derive(Clone, Copy, Debug)]
pub struct RateLimit {
    /// What is tried, as refusals say it.
    pub name: &'static str,
    /// What it is counted by: several limits of one name differ in this.
    pub of: &'static str,
    /// So many at once, and in any later time of this length.
    pub times: u32,
    /// The time.
    pub per: Duration,
}

impl Engine {
    /// Counts that `who`, ignoring case, does this so many times; when that is too often, the time to wait. A service that has its
    /// database alone has nobody to count with.
    #[boxed]
    pub async fn count_against(&self, limit: RateLimit, who: &str, many: u32) -> Result<Option<Duration>> {
        let store = &self.inner.store;
        if store.is_shared() { store.count_against(limit, who, many).await } else { Ok(None) }
    }
}

impl Store {
    /// See [`Engine::count_against`].
    pub(crate) async fn count_against(&self, limit: RateLimit, who: &str, many: u32) -> Result<Option<Duration>> {
        let one = limit.per / limit.times.max(1);
        let [asked_us, most_us] = [one * many.min(limit.times), limit.per].map(|time| time.as_micros() as i64);
        let place = place(self.rate_limit_key.get_or_try_init(|| self.read_rate_limit_key()).await?, who);
        let kind = format!("{}, {}", limit.name, limit.of);
        let text = "INSERT INTO rate_limits (kind, place, empty_us) SELECT $1, $2, now_us + $3 FROM database_clock WHERE TRUE \
                    ON CONFLICT (kind, place) DO UPDATE SET empty_us = $3 + CASE \
                        WHEN rate_limits.empty_us > (SELECT now_us FROM database_clock) THEN rate_limits.empty_us \
                        ELSE (SELECT now_us FROM database_clock) END \
                    WHERE rate_limits.empty_us + $3 <= (SELECT now_us FROM database_clock) + $4";
        let counted = sqlx::query(text).bind(&kind).bind(place).bind(asked_us).bind(most_us);
        if counted.execute(&self.pool).await?.rows_affected() > 0 {
            return Ok(None);
        }
        let text = "SELECT empty_us + $3 - $4 - now_us FROM rate_limits, database_clock WHERE kind = $1 AND place = $2";
        let wait_us = sqlx::query_scalar(text).bind(&kind).bind(place).bind(asked_us).bind(most_us);
        let wait_us: Option<i64> = wait_us.fetch_optional(&self.pool).await?;
        Ok(Some(Duration::from_micros(wait_us.unwrap_or(0).max(1) as u64)))
    }

    /// Forgets the buckets that are empty.
    pub(crate) async fn forget_empty_buckets(&self) -> Result<u64> {
        let text = "DELETE FROM rate_limits WHERE empty_us < (SELECT now_us FROM database_clock)";
        Ok(sqlx::query(text).execute(&self.pool).await?.rows_affected())
    }

    async fn read_rate_limit_key(&self) -> Result<String> {
        let read = || sqlx::query_scalar("SELECT key FROM rate_limit_key WHERE one = 1").fetch_optional(&self.pool);
        if let Some(key) = read().await? {
            return Ok(key);
        }
        let text = "INSERT INTO rate_limit_key (one, key) VALUES (1, $1) ON CONFLICT (one) DO NOTHING";
        sqlx::query(text).bind(Uuid::new_v4().to_string()).execute(&self.pool).await?;
        Ok(read().await?.unwrap_or_default())
    }
}

/// 16 bits bound the number of rows; two visitors share a bucket with a probability of 1 in 65,536.
fn place(key: &str, who: &str) -> i64 {
    let hash = sha256_hex(format!("{key} {}", who.to_lowercase()).as_bytes());
    i64::from_str_radix(&hash[..4], 16).unwrap_or_default()
}
