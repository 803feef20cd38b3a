//! Attempts whose worker is gone: their jobs wait again, or are given up.

use super::beat::Leases;
use super::worker::Worker;
use super::{Attempt, Kind, MOST_LOST, sql};
use crate::Result;
use crate::machines::sql::worker;
use crate::model::State;
use crate::plugins::checks;
use crate::runs::events::plain_event;
use crate::runs::events_sql::append_event;
use crate::runs::sql::{find_run, state_name};
use crate::store::{Store, now_us};

impl Leases {
    /// Takes back attempts whose lease is over, and all of this machine if it has just started: its former process is dead then.
    /// What this process works on itself is never judged by a clock: a machine that slept goes on.
    pub async fn take_back(&self, just_started: Option<&Worker>) -> Result<()> {
        self.store.shorten_leases().await?;
        let mut silent = self.store.silent_attempts(just_started).await?;
        silent.retain(|attempt| !self.work.holding.has(attempt));
        self.lose(&silent, just_started).await?;
        if just_started.is_some() {
            checks::give_up(&self.store, &self.outbox).await?;
        }
        Ok(())
    }

    /// Takes back what a measuring machine worked on: it has ended in the middle of that, or has not heard of it.
    pub async fn take_back_from(&self, machine: &str) -> Result<Vec<Attempt>> {
        let attempts = self.store.attempts_of(machine).await?;
        self.lose(&attempts, Some(&worker(machine, ""))).await?;
        Ok(attempts)
    }

    /// The jobs of attempts wait again, or are given up after so many. Those of a worker that is given up are lost whatever their
    /// lease.
    async fn lose(&self, attempts: &[Attempt], given_up: Option<&Worker>) -> Result<()> {
        let mut checks = false;
        for attempt in attempts {
            let Attempt { kind, job, number, .. } = attempt;
            let lost = match kind {
                Kind::Prepare | Kind::Measure => self.run_ends.lose(attempt, given_up).await?.is_some(),
                Kind::Check => self.store.lose_check(attempt, given_up).await?,
                Kind::Stability | Kind::Replay | Kind::Advise => self.store.lose(attempt, given_up).await?,
            };
            if lost {
                tracing::warn!("the worker of attempt {number} at {job} ({}) is gone", kind.name());
                checks |= *kind == Kind::Check;
                self.work.wake.notify_one();
            }
        }
        if checks {
            checks::give_up(&self.store, &self.outbox).await?;
        }
        Ok(())
    }
}

impl Store {
    /// The run of a lost attempt waits again, or has failed after so many; nothing when the attempt was not lost. Attempts of a
    /// worker that is given up are lost whatever their lease.
    pub async fn lose_run(&self, attempt: &Attempt, given_up: Option<&Worker>) -> Result<Option<State>> {
        let mut transaction = self.pool.begin().await?;
        if !sql::lose(&mut transaction, attempt, given_up).await? {
            return Ok(None);
        }
        let Some(run) = find_run(&mut *transaction, &attempt.job).await?.filter(|run| run.state == State::Running)
        else {
            // It was ended or taken away meanwhile.
            transaction.commit().await?;
            return Ok(None);
        };
        let failed = i64::from(run.attempts) >= MOST_LOST;
        let (state, message, finished_us) = if failed {
            let message = format!(
                "The service or a measuring machine ended or failed {MOST_LOST} times in the middle of this run, so it is not tried again. \
                 That is no fault of the algorithms."
            );
            (run.after(State::Failed), Some(message), Some(now_us()))
        } else {
            (State::Queued, None, None)
        };
        let text = "UPDATE runs SET state = $1, message = $2, finished_us = $3 WHERE id = $4";
        let query = sqlx::query(text).bind(state_name(state)).bind(message).bind(finished_us).bind(&attempt.job);
        query.execute(&mut *transaction).await?;
        append_event(&mut transaction, &attempt.job, &mut plain_event(state, 0)).await?;
        transaction.commit().await?;
        Ok(Some(state))
    }

    /// The check of a lost attempt waits again; false when the attempt was not lost.
    pub async fn lose_check(&self, attempt: &Attempt, given_up: Option<&Worker>) -> Result<bool> {
        let mut transaction = self.pool.begin().await?;
        if !sql::lose(&mut transaction, attempt, given_up).await? {
            return Ok(false);
        }
        let text = "UPDATE submissions SET state = 'uploaded' WHERE id = $1 AND state = 'vetted'";
        sqlx::query(text).bind(&attempt.job).execute(&mut *transaction).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Ends a lost attempt at a job that waits by itself; false when it was not lost.
    pub async fn lose(&self, attempt: &Attempt, given_up: Option<&Worker>) -> Result<bool> {
        let mut connection = self.pool.acquire().await?;
        sql::lose(&mut connection, attempt, given_up).await
    }
}
