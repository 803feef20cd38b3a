//! Whose turn it is. Visitors take turns, whatever it is that each waits for: of a run, the next part of a stability run, a replay
//! and advice, that is due first which is for the visitor who was served longest ago.

use super::Kind;
use crate::Result;
use crate::runs::priority::INTERACTIVE;
use crate::runs::share::Since;
use crate::store::Store;

impl Store {
    /// The kinds of which a job is due, in their order. The run that is due, with its priority, is looked for only where
    /// something else waits as well.
    pub async fn in_turn(&self, run: impl Future<Output = Result<Option<(i64, Since)>>> + Send) -> Result<Vec<Kind>> {
        let others = [
            (Kind::Stability, self.next_part(INTERACTIVE).await?),
            (Kind::Replay, self.next_replay().await?),
            (Kind::Advise, self.next_advice(false).await?),
        ];
        let others = others.into_iter().filter_map(|(kind, next)| Some((INTERACTIVE, next?, kind)));
        let mut due: Vec<_> = others.collect();
        if due.is_empty() {
            return Ok(vec![Kind::Measure]);
        }
        due.extend(run.await?.map(|(priority, next)| (priority, next, Kind::Measure)));
        due.sort_by(|(priority, since, _), (other, than, _)| (priority, since).cmp(&(other, than)));
        Ok(due.into_iter().map(|(.., kind)| kind).collect())
    }
}
