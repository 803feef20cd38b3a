//! What an attempt at a run hands in, and accepting it: all of it at once, or nothing.

use ocb_core::query::Query;

use crate::Result;
use crate::attempts::sql::end;
use crate::attempts::{Attempt, Outcome};
use crate::locks::Keeping;
use crate::model::{Environment, Preview, RunEvent, State};
use crate::results::sql::{StoredResult, keep_result};
use crate::runs::events::plain_event;
use crate::runs::events_sql::append_event;
use crate::runs::sql::state_name;
use crate::store::{Store, now_us, to_json};

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Handed {
    /// Of each algorithm, with its place among those of the run.
    pub results: Vec<(usize, StoredResult)>,
    /// Triangles of both objects.
    pub triangles: u64,
    pub query: Query,
    /// The machine; absent when nothing was measured.
    pub environment: Option<Environment>,
    /// What the results are a preview of; absent when all configurations were measured.
    pub preview: Option<Preview>,
    /// Why nothing could be measured.
    pub failed: Option<String>,
}

/// How a run ended when nothing went wrong.
#[derive(Debug)]
pub enum End {
    /// All stages are through, or nothing could be measured. Its files stay although no row names them yet.
    Done { handed: Box<Handed>, _keeping: Keeping },
    /// Its configurations are stored, and a measuring machine can take it.
    Prepared,
    /// It was stopped from outside.
    Stopped,
}

/// How a run ended, as it is recorded.
#[derive(Clone, Copy, Debug)]
pub struct RunEnd<'a> {
    pub state: State,
    /// Why it failed or was cancelled.
    pub message: Option<&'a str>,
    pub handed: Option<&'a Handed>,
}

impl Store {
    /// Ends a run with all that its attempt hands in; false, and nothing is kept, when the attempt is not the current one. Repeated
    /// results replace earlier ones.
    pub async fn accept_run(&self, attempt: &Attempt, RunEnd { state, message, handed }: RunEnd<'_>) -> Result<bool> {
        let run = attempt.job.as_str();
        let mut transaction = self.pool.begin().await?;
        if !end(&mut transaction, attempt, Outcome::Accepted).await? {
            return Ok(false);
        }
        if let Some(handed) = handed {
            for (position, stored) in &handed.results {
                keep_result(&mut transaction, run, *position, stored, handed.triangles, handed.query).await?;
            }
            let text = "UPDATE runs SET environment = COALESCE($1, environment), preview = $2 WHERE id = $3";
            sqlx::query(text)
                .bind(handed.environment.as_ref().map(to_json).transpose()?)
                .bind(handed.preview.as_ref().map(to_json).transpose()?)
                .bind(run)
                .execute(&mut *transaction)
                .await?;
        }
        let text = "UPDATE runs SET state = $1, message = $2, finished_us = $3 WHERE id = $4 AND state = 'running'";
        let query = sqlx::query(text).bind(state_name(state)).bind(message).bind(now_us()).bind(run);
        query.execute(&mut *transaction).await?;
        let results = handed.iter().flat_map(|handed| &handed.results);
        let measured = |(_, stored): &(usize, StoredResult)| RunEvent {
            result: Some(stored.result.clone()),
            ..plain_event(State::Running, 0)
        };
        for mut event in results.map(measured).chain([plain_event(state, 0)]) {
            append_event(&mut transaction, run, &mut event).await?;
        }
        transaction.commit().await?;
        Ok(true)
    }
}
