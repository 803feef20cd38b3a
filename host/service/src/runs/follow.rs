//! The events of a run: replayed, then followed.

use std::collections::VecDeque;
use std::time::Duration;

use futures::Stream;
use tokio::sync::broadcast::Receiver;

use crate::Result;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{RunEvent, State};
use crate::runs::events::{QUEUE, plain_event};
use crate::runs::share::OfClass;
use crate::store::now_us;

/// The database is looked at this often even if no change was announced: a missed one must not end in silence.
const LOOK_AGAIN: Duration = Duration::from_secs(5);
/// The event of a run's end follows its state this closely.
const LAST_WORD: Duration = Duration::from_millis(500);

impl Engine {
    /// The run's events behind `after_seq` (0: all), oldest first.
    #[boxed]
    pub async fn events(&self, id: &str, after_seq: i64) -> Result<Vec<RunEvent>> {
        self.inner.store.run_row(id).await?;
        self.inner.store.events(id, after_seq).await
    }

    /// Replays the run's events behind `after_seq`, then follows; ends behind the event in which the run ends.
    pub async fn follow(
        &self,
        id: &str,
        after_seq: i64,
    ) -> Result<impl Stream<Item = Result<RunEvent>> + Send + 'static + use<>> {
        // Listen first, read then: what happens in between is heard.
        let changes = self.inner.run_events.listen();
        let row = self.inner.store.run_row(id).await?;
        let follower = Follower {
            engine: self.clone(),
            id: id.to_owned(),
            after: after_seq,
            read: VecDeque::new(),
            changes,
            waits: self.inner.classes.waiting_for(&row.spec),
            place: None,
            shown: 0,
            ended: false,
        };
        Ok(futures::stream::unfold(follower, async |mut follower| {
            let event = follower.next().await?;
            Some((event, follower))
        }))
    }
}

struct Follower {
    engine: Engine,
    id: String,
    after: i64,
    read: VecDeque<RunEvent>,
    changes: Receiver<std::sync::Arc<str>>,
    waits: OfClass,
    /// The runs ahead of a waiting one that were told last. Places are computed when somebody looks, and no event is kept.
    place: Option<u32>,
    /// The version of the preliminary results that were sent last; these events are not kept.
    shown: u64,
    ended: bool,
}

impl Follower {
    async fn next(&mut self) -> Option<Result<RunEvent>> {
        loop {
            if let Some(event) = self.read.pop_front() {
                self.after = event.seq;
                self.ended = matches!(event.state, State::Done | State::Failed | State::Cancelled);
                return Some(Ok(event));
            }
            if self.ended {
                return None;
            }
            match self.engine.inner.store.events(&self.id, self.after).await {
                Ok(events) => self.read.extend(events),
                Err(e) => {
                    self.ended = true;
                    return Some(Err(e));
                }
            }
            if self.read.is_empty() {
                self.look_at_preliminary_results();
            }
            if self.read.is_empty() && self.place_has_changed().await {
                let event = plain_event(State::Queued, self.place.unwrap_or(0));
                return Some(Ok(RunEvent { seq: self.after, at_us: now_us(), ..event }));
            }
            if self.read.is_empty() && !self.more_may_come().await {
                return None;
            }
        }
    }

    /// Reads preliminary results that are newer than those sent before.
    fn look_at_preliminary_results(&mut self) {
        let (results, version) = self.engine.inner.under_way.newer(&self.id, self.shown);
        self.shown = version;
        let (seq, seconds_left) = (self.after, self.engine.inner.under_way.seconds_left(&self.id));
        self.read.extend(results.into_iter().map(|result| RunEvent {
            seq,
            at_us: now_us(),
            result: Some(result),
            seconds_left,
            ..plain_event(State::Running, 0)
        }));
    }

    /// Looks at the place of a run that waits.
    async fn place_has_changed(&mut self) -> bool {
        // A database that cannot tell it now is asked again with the next look.
        let now = self.engine.inner.store.runs_before(&self.id, &self.waits).await.unwrap_or(self.place);
        let told = std::mem::replace(&mut self.place, now);
        now.is_some() && now != told
    }

    /// Waits for news; false when the run has ended and everything was read.
    async fn more_may_come(&mut self) -> bool {
        match self.engine.inner.store.run(&self.id).await {
            Ok(Some(run)) if matches!(run.state, State::Queued | State::Running) => {}
            // The end is written a moment before its event: look once more before believing that there is none.
            _ => {
                tokio::time::sleep(LAST_WORD).await;
                let last = self.engine.inner.store.events(&self.id, self.after).await.unwrap_or_default();
                self.read.extend(last);
                return !self.read.is_empty();
            }
        }
        let heard = async {
            while let Ok(run) = self.changes.recv().await {
                if *run == *self.id || (*run == *QUEUE && self.place.is_some()) {
                    return;
                }
            }
        };
        let _ = tokio::time::timeout(LOOK_AGAIN, heard).await;
        true
    }
}
