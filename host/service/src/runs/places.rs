//! Places in the queue: how many runs are served before one that waits.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::Result;
use crate::model::State;
use crate::runs::priority::BACKGROUND;
use crate::runs::share::{OfClass, QueueShare, Since, WaitingRuns};
use crate::runs::sql::named_state;
use crate::store::Store;

/// Shares of which there are so many are not counted anew for everybody who looks, nor so many runs.
const MANY: usize = 100;
const MANY_RUNS: i64 = 1000;
/// So long they stand.
const STAND: Duration = Duration::from_secs(1);

impl Store {
    /// How many runs of a class wait at this priority or a smaller one, and the seconds that they were expected to take.
    pub async fn waiting(&self, priority: i64, of: &OfClass) -> Result<(u32, f64)> {
        self.count_waiting(priority, Some(of)).await
    }

    /// The same of all classes.
    pub async fn waiting_in_all(&self, priority: i64) -> Result<(u32, f64)> {
        self.count_waiting(priority, None).await
    }

    async fn count_waiting(&self, priority: i64, of: Option<&OfClass>) -> Result<(u32, f64)> {
        let counted = self.counted().await?;
        let meant = counted.iter().filter(|it| {
            it.priority <= priority && of.is_none_or(|of| it.hardware_class.as_ref().unwrap_or(&of.usual) == &of.class)
        });
        Ok(meant.fold((0, 0.0), |(runs, seconds), it| (runs + it.runs as u32, seconds + it.seconds)))
    }

    /// What waits. Where that is much, it is not counted anew for everybody who looks.
    async fn counted(&self) -> Result<Arc<Vec<WaitingRuns>>> {
        let mut known = self.counted.lock().await;
        known.take_if(|(counted, _)| counted.elapsed() >= STAND);
        if let Some((_, counts)) = &*known {
            return Ok(counts.clone());
        }
        let text = "SELECT priority, hardware_class, COUNT(*), SUM(expected_seconds) FROM runs \
                    WHERE state = 'queued' GROUP BY priority, hardware_class";
        let rows: Vec<(i64, Option<String>, i64, f64)> = sqlx::query_as(text).fetch_all(&self.pool).await?;
        let counts = rows.into_iter().map(|(priority, hardware_class, runs, seconds)| WaitingRuns {
            priority,
            hardware_class,
            runs,
            seconds,
        });
        let counts = Arc::new(counts.collect::<Vec<_>>());
        if counts.iter().map(|it| it.runs).sum::<i64>() >= MANY_RUNS {
            *known = Some((Instant::now(), counts.clone()));
        }
        Ok(counts)
    }

    /// How many runs of its class are under way, or wait and are served before this one if nothing else is asked for; nothing when
    /// it does not wait. Where many wait, others may have moved for a second.
    pub async fn runs_before(&self, id: &str, of: &OfClass) -> Result<Option<u32>> {
        let Some(waiting) = self.waiting_before(id, of).await? else { return Ok(None) };
        // It may have begun since it was looked at.
        let text = "SELECT COUNT(*) FROM runs \
                    WHERE state = 'running' AND priority <= $1 AND COALESCE(hardware_class, $2) = $3 AND id <> $4";
        let query = sqlx::query_scalar::<_, i64>(text).bind(BACKGROUND).bind(&of.usual).bind(&of.class).bind(id);
        Ok(Some(waiting + query.fetch_one(&self.pool).await? as u32))
    }

    async fn waiting_before(&self, id: &str, of: &OfClass) -> Result<Option<u32>> {
        let own: Option<(String, i64, i64, i64)> = sqlx::query_as(
            "SELECT r.turn, r.priority, r.created_us, COALESCE(s.served_us, 0) \
             FROM runs r LEFT JOIN served s ON s.owner = r.turn WHERE r.id = $1 AND r.state = 'queued'",
        )
        .bind(id)
        .fetch_optional(&self.pool)
        .await?;
        let Some((turn, priority, created_us, served_us)) = own else { return Ok(None) };
        let text =
            "SELECT COUNT(*) FROM runs WHERE state = 'queued' AND priority < $1 AND COALESCE(hardware_class, $2) = $3";
        let query = sqlx::query_scalar(text).bind(priority).bind(&of.usual).bind(&of.class);
        let sooner: i64 = query.fetch_one(&self.pool).await?;
        let (of_turn, first_us, first): (i64, Option<i64>, Option<String>) = sqlx::query_as(
            "SELECT COUNT(CASE WHEN (created_us, id) < ($1, $2) THEN 1 END), MIN(created_us), MIN(id) FROM runs \
             WHERE state = 'queued' AND priority = $3 AND turn = $4 AND COALESCE(hardware_class, $5) = $6",
        )
        .bind(created_us)
        .bind(id)
        .bind(priority)
        .bind(&turn)
        .bind(&of.usual)
        .bind(&of.class)
        .fetch_one(&self.pool)
        .await?;
        let since = (served_us, first_us.unwrap_or(created_us), first.unwrap_or_else(|| id.to_owned()));
        let others = of_others(&turn, &since, of_turn, &self.shares(priority, of).await?);
        Ok(Some((sooner + of_turn + others) as u32))
    }

    /// The shares at this priority of a class. Who comes while they are counted waits for that and has them as well.
    async fn shares(&self, priority: i64, waiting: &OfClass) -> Result<Arc<Vec<QueueShare>>> {
        let mut known = self.shares.lock().await;
        if let Some((counted, of, shares)) = &*known
            && (of.0, &of.1) == (priority, waiting)
            && counted.elapsed() < STAND
        {
            return Ok(shares.clone());
        }
        let rows: Vec<(String, i64, i64, i64, String)> = sqlx::query_as(
            "SELECT t.turn, t.waiting, COALESCE(s.served_us, 0), t.first_us, t.first_id FROM \
             (SELECT turn, COUNT(*) AS waiting, MIN(created_us) AS first_us, MIN(id) AS first_id FROM runs \
             WHERE state = 'queued' AND priority = $1 AND COALESCE(hardware_class, $2) = $3 GROUP BY turn) AS t \
             LEFT JOIN served s ON s.owner = t.turn",
        )
        .bind(priority)
        .bind(&waiting.usual)
        .bind(&waiting.class)
        .fetch_all(&self.pool)
        .await?;
        let share =
            |(of, waiting, served_us, first_us, first)| QueueShare { of, waiting, since: (served_us, first_us, first) };
        let shares: Arc<Vec<QueueShare>> = Arc::new(rows.into_iter().map(share).collect());
        *known = (shares.len() >= MANY).then(|| (Instant::now(), (priority, waiting.clone()), shares.clone()));
        Ok(shares)
    }
}

/// How many runs of others come before the run of this share that has so many of its own before it: the shares are served in
/// turn, and those that are served sooner have one more before it, as far as they have any.
pub(crate) fn of_others(of: &str, since: &Since, before: i64, shares: &[QueueShare]) -> i64 {
    let others = shares.iter().filter(|other| other.of != of);
    others.map(|other| other.waiting.min(before + i64::from(other.since < *since))).sum()
}

/// State, turn, when that was served last, when it was asked for, and id: of a stability run or workload that has not ended.
pub(crate) type Waiting = (String, String, i64, i64, String);

/// How many of these, the oldest first, are under way or carried out before the one with this id, which waits.
pub(crate) fn before(waiting: Vec<Waiting>, of: &str, asked_us: i64, this: &str) -> Result<u32> {
    let (mut running, mut own, mut shares) = (0, 0, Vec::<QueueShare>::new());
    for (state, turn, served_us, created_us, id) in waiting {
        if named_state(&state)? == State::Running {
            // It may have begun since it was read.
            running += u32::from(id != this);
            continue;
        }
        own += i64::from(turn == of && (created_us, id.as_str()) < (asked_us, this));
        match shares.iter_mut().find(|known| known.of == turn) {
            Some(known) => known.waiting += 1,
            None => shares.push(QueueShare { of: turn, waiting: 1, since: (served_us, created_us, id) }),
        }
    }
    let Some(share) = shares.iter().find(|known| known.of == of) else { return Ok(running) };
    Ok(running + (own + of_others(of, &share.since, own, &shares)) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_has_many_runs_does_not_keep_others_waiting() {
        let share =
            |of: &str, waiting, served_us| QueueShare { of: of.into(), waiting, since: (served_us, 1, of.into()) };
        let shares = [share("a", 100, 5), share("b", 2, 7), share("c", 1, 0)];
        // c1 a1 b1 a2 b2 a3 ...
        let place = |name: &str, before| {
            let own = shares.iter().find(|share| share.of == name).unwrap();
            before + of_others(name, &own.since, before, &shares)
        };
        assert_eq!([place("c", 0), place("a", 0), place("b", 0)], [0, 1, 2]);
        assert_eq!([place("a", 1), place("b", 1), place("a", 2), place("a", 99)], [3, 4, 5, 102]);
    }
}
