//! Notifications from other services on the same PostgreSQL. Its triggers notify of every event, every change of state, new
//! mails, and what machines have found so far.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use ocb_lab::worker::Seen;
use sqlx::postgres::PgListener;
use tokio::sync::{Notify, mpsc};

use crate::Result;
use crate::machines::under_way::Orders;
use crate::mail::outbox::Outbox;
use crate::runs::current::Work;
use crate::runs::live::LiveRuns;
use crate::runs::preliminary::Shown;
use crate::store::{Store, from_json};

/// The channels of the triggers; see `migrations/0033_notify.sql`, `migrations/0037_house.sql` and `migrations/0045_seen.sql`.
const RUNS: &str = "ocb_runs";
const PLUGINS: &str = "ocb_plugins";
const MAILS: &str = "ocb_mails";
const SEEN: &str = "ocb_seen";
/// So much of what machines have found so far may wait to be shown; more of it is shown with the next news.
const MOST_SEEN: usize = 100;
/// For so long after the last news it is shown; that the run has ended is known at once.
const SHOWN: Duration = Duration::from_secs(120);
/// How long until what failed is tried again.
const AGAIN: Duration = Duration::from_secs(1);

/// What notifications from other services concern.
pub struct Notifications {
    pub work: Arc<Work>,
    pub outbox: Arc<Outbox>,
    pub live: Arc<LiveRuns>,
    pub orders: Arc<Orders>,
}

impl Notifications {
    /// Wakes those who follow runs, those who work and those who bring mails, offers the plugins that others offer, and shows what
    /// machines tell others; until it is aborted.
    pub async fn hear(self, url: String) {
        let plugins = Notify::new();
        let (seen, mut shown) = mpsc::channel(MOST_SEEN);
        let listening = async {
            loop {
                if let Err(e) = self.listen(&url, &plugins, &seen).await {
                    tracing::warn!("changes by other services are noticed late: {e}");
                }
                tokio::time::sleep(AGAIN).await;
            }
        };
        // Apart, because files may have to be fetched.
        let renewing = async {
            loop {
                plugins.notified().await;
                if let Err(e) = self.live.registry.renew().await {
                    tracing::error!("plugins that another service offers are not offered here yet: {e}");
                    tokio::time::sleep(AGAIN).await;
                    plugins.notify_one();
                }
            }
        };
        // Apart, because it may be large.
        let showing = async {
            let mut elsewhere = HashMap::new();
            while let Some(told) = shown.recv().await {
                if let Err(e) = self.show(&mut elsewhere, &told).await {
                    tracing::warn!("what a machine told another service is not shown here: {e}");
                }
            }
        };
        tokio::join!(listening, renewing, showing);
    }

    async fn listen(&self, url: &str, plugins: &Notify, seen: &mpsc::Sender<String>) -> sqlx::Result<()> {
        let mut listener = PgListener::connect(url).await?;
        listener.listen_all([RUNS, PLUGINS, MAILS, SEEN]).await?;
        // Earlier changes were missed.
        self.everything(plugins);
        loop {
            // `None`: the connection was lost and made again.
            let Some(told) = listener.try_recv().await? else {
                self.everything(plugins);
                continue;
            };
            match (told.channel(), told.payload()) {
                (RUNS, "") => self.changed(),
                (RUNS, run) => self.live.run_events.ring(run),
                (PLUGINS, _) => {
                    plugins.notify_one();
                    self.changed();
                }
                (MAILS, _) => self.outbox.post_soon(),
                (SEEN, told) => drop(seen.try_send(told.to_owned())),
                _ => {}
            }
        }
    }

    fn everything(&self, plugins: &Notify) {
        plugins.notify_one();
        self.outbox.post_soon();
        self.changed();
    }

    /// A job is in another state: the queue has moved, and what this process works on may have been cancelled.
    fn changed(&self) {
        self.live.run_events.queue_moved();
        self.work.wake.notify_one();
        self.work.holding.look.notify_one();
    }

    /// Shows what a machine told another service: the words of its notification. `elsewhere` are the attempts that are shown so.
    async fn show(&self, elsewhere: &mut HashMap<String, Shown>, told: &str) -> Result<()> {
        let words: Vec<&str> = told.splitn(4, ' ').collect();
        let &[run, place, attempt, service] = &words[..] else { return Ok(()) };
        let Ok(place) = place.parse() else { return Ok(()) };
        if service == self.work.worker.machine {
            return Ok(());
        }
        let Some(Seen { place, preliminary }) = self.live.store.seen(run, place, attempt).await? else { return Ok(()) };
        // The machine may have been heard from here before.
        if !self.orders.heard(attempt) {
            let row = self.live.store.run_row(run).await?;
            elsewhere.retain(|_, shown| shown.is_heard());
            elsewhere.entry(attempt.to_owned()).or_insert_with(|| self.live.show(&row)).heard(SHOWN);
        }
        self.live.seen(run, place, preliminary);
        Ok(())
    }
}

impl Store {
    /// What this attempt has found so far of the algorithm at this place of the run, while it is current.
    async fn seen(&self, run: &str, place: i64, attempt: &str) -> Result<Option<Seen>> {
        let text = "SELECT seen FROM seen WHERE run_id = $1 AND place = $2 AND attempt = $3";
        let query = sqlx::query_scalar(text).bind(run).bind(place).bind(attempt);
        let found: Option<String> = query.fetch_optional(&self.pool).await?;
        found.as_deref().map(from_json).transpose()
    }
}
