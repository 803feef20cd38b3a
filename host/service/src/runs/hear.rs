//! Notifications from other services on the same PostgreSQL. Its triggers notify of every event, every change of state and new mails.

use std::sync::Arc;
use std::time::Duration;

use sqlx::postgres::PgListener;
use tokio::sync::Notify;

use crate::engine::Inner;

/// The channels of the triggers; see `migrations/0033_notify.sql` and `migrations/0037_house.sql`.
const RUNS: &str = "ocb_runs";
const PLUGINS: &str = "ocb_plugins";
const MAILS: &str = "ocb_mails";
/// How long until what failed is tried again.
const AGAIN: Duration = Duration::from_secs(1);

/// Wakes those who follow runs, those who work and those who bring mails, and offers the plugins that others offer; until it is
/// aborted.
pub async fn hear(inner: Arc<Inner>, url: String) {
    let plugins = Notify::new();
    let listening = async {
        loop {
            if let Err(e) = listen(&inner, &url, &plugins).await {
                tracing::warn!("changes by other services are noticed late: {e}");
            }
            tokio::time::sleep(AGAIN).await;
        }
    };
    // Apart, because files may have to be fetched.
    let renewing = async {
        loop {
            plugins.notified().await;
            if let Err(e) = inner.renew_plugins().await {
                tracing::error!("plugins that another service offers are not offered here yet: {e}");
                tokio::time::sleep(AGAIN).await;
                plugins.notify_one();
            }
        }
    };
    tokio::join!(listening, renewing);
}

async fn listen(inner: &Inner, url: &str, plugins: &Notify) -> sqlx::Result<()> {
    let mut listener = PgListener::connect(url).await?;
    listener.listen_all([RUNS, PLUGINS, MAILS]).await?;
    // Earlier changes were missed.
    everything(inner, plugins);
    loop {
        // `None`: the connection was lost and made again.
        let Some(told) = listener.try_recv().await? else {
            everything(inner, plugins);
            continue;
        };
        match (told.channel(), told.payload()) {
            (RUNS, "") => changed(inner),
            (RUNS, run) => inner.run_events.ring(run),
            (PLUGINS, _) => {
                plugins.notify_one();
                changed(inner);
            }
            (MAILS, _) => inner.posting.notify_one(),
            _ => {}
        }
    }
}

/// A job is in another state: the queue has moved, and what this process works on may have been cancelled.
fn changed(inner: &Inner) {
    inner.run_events.queue_moved();
    inner.wake.notify_one();
    inner.holding.look.notify_one();
}

fn everything(inner: &Inner, plugins: &Notify) {
    plugins.notify_one();
    inner.posting.notify_one();
    changed(inner);
}
