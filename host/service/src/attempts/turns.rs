//! Whose turn it is. Visitors take turns, whatever it is that each waits for: of a run, the next part of a stability run, a replay
//! and advice, that is due first which is for the visitor who was served longest ago.

use super::Kind;
use super::worker::Worker;
use crate::Result;
use crate::runs::priority::INTERACTIVE;
use crate::store::Store;

impl Store {
    /// The kinds of which a job may be due, in their order, and runs, which may be none. For a measuring machine, with the usual
    /// hardware class, only runs count that are prepared.
    pub async fn in_turn(&self, worker: &Worker, machine_of: Option<&str>) -> Result<Vec<Kind>> {
        let others = [
            (self.next_part(INTERACTIVE).await?, Kind::Stability),
            (self.next_replay().await?, Kind::Replay),
            (self.next_advice(false).await?, Kind::Advise),
        ];
        let mut due: Vec<_> = others.into_iter().filter_map(|(next, kind)| Some((next?, kind))).collect();
        due.sort_by(|(next, _), (other, _)| next.cmp(other));
        let run_is_first = match due.first() {
            Some((next, _)) => self.run_is_due_before(next, worker, machine_of).await?,
            None => true,
        };
        let mut kinds: Vec<Kind> = due.into_iter().map(|(_, kind)| kind).collect();
        kinds.insert(if run_is_first { 0 } else { kinds.len() }, Kind::Measure);
        Ok(kinds)
    }
}
