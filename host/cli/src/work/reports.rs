//! What a machine tells its service while it measures: how far it is, and what there is to see so far.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use ocb_service::Stop;
use ocb_service::model::Told;
use ocb_service::worker::{Report, Seen};
use tokio::time::MissedTickBehavior;

use super::link::{Link, Refused};

/// How often the service hears that the work goes on.
const BEAT: Duration = Duration::from_secs(2);
/// How often it gets what there is to see.
const SHOW: Duration = Duration::from_secs(1);

/// What is to be told of one attempt.
#[derive(Clone, Default)]
pub struct Reports {
    next: Arc<Mutex<Next>>,
}

#[derive(Default)]
struct Next {
    steps: Vec<Told>,
    seen: Vec<Seen>,
    ended: bool,
}

impl Reports {
    /// Keeps what is to be told, the newest of an algorithm alone.
    pub fn note(&self, report: Report) {
        self.with(|next| match report {
            _ if next.ended => {}
            Report::Told(told) => {
                match &told {
                    Told::Progress { place: of, .. } => {
                        next.steps.retain(|known| !matches!(known, Told::Progress { place, .. } if place == of));
                    }
                    Told::Replaying { .. } => next.steps.retain(|known| !matches!(known, Told::Replaying { .. })),
                    Told::Step { .. } => next.steps.retain(|known| !matches!(known, Told::Step { .. })),
                    _ => {}
                }
                next.steps.push(told);
            }
            Report::Seen(seen) => {
                next.seen.retain(|known| known.place != seen.place);
                next.seen.push(*seen);
            }
        });
    }

    /// Nothing more is told: it would come behind the end.
    pub fn end(&self) {
        self.with(|next| *next = Next { ended: true, ..Next::default() });
    }

    /// Tells the service every two seconds that the work goes on, and how far it is; stops the work when the service has ended it. While
    /// the service is not reached, the work goes on: it may have been started again.
    pub async fn beat(self, link: Arc<Link>, attempt: String, stop: Stop) {
        let mut ticks = tokio::time::interval(BEAT);
        loop {
            ticks.tick().await;
            let steps = self.with(|next| std::mem::take(&mut next.steps));
            if matches!(link.beat(&attempt, steps).await, Ok(false) | Err(Refused::For(_))) {
                return stop.stop();
            }
        }
    }

    /// Sends what there is to see every second. What does not arrive is left out, since there will be more; what the service does not
    /// take is said.
    pub async fn show(self, link: Arc<Link>, attempt: String) {
        let mut ticks = tokio::time::interval(SHOW);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            ticks.tick().await;
            for seen in self.with(|next| std::mem::take(&mut next.seen)) {
                if let Err(refused @ Refused::For(_)) = link.show(&attempt, &seen).await {
                    eprintln!("ocb: nothing of this run is shown before its end: {refused}");
                    return;
                }
            }
        }
    }

    fn with<T>(&self, of: impl FnOnce(&mut Next) -> T) -> T {
        of(&mut self.next.lock().unwrap_or_else(PoisonError::into_inner))
    }
}
