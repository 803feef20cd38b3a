//! Quotas that keep one visitor from filling the queue or the disk. The command line has none.
//!
//! Guest cookies and accounts are free, so addresses have a quota as well. The main quota is measuring time, because the number
//! of runs says little about their cost.

use std::time::Duration;

use crate::config::Ceilings;
use crate::model::{Owner, RunSpec, WorkloadSpec};
use crate::runs::queue::Granted;
use crate::runs::sql::RunRow;
use crate::store::Store;
use crate::{EngineError, Result};

/// The sender of a request over the network.
#[derive(Clone, Debug)]
pub struct Visitor {
    /// The account or the guest.
    pub owner: String,
    /// Its network, if known.
    pub address: Option<String>,
}

/// The turn in the queue that a run takes. Each account has one; guests of one address share one, because a client without
/// cookies is a new guest at every request.
pub(crate) fn turn(owner: &str, address: Option<&str>) -> String {
    match (kind(owner), address) {
        (Some(Kind::Guest), Some(address)) => format!("address:{address}"),
        _ => owner.to_owned(),
    }
}

/// What has a quota.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Guest,
    Account,
    Address,
}

/// Bytes of objects, saved configurations and recordings.
const GUEST_OBJECTS: u64 = 512 << 20;
const ACCOUNT_OBJECTS: u64 = 4 << 30;

fn kind(owner: &str) -> Option<Kind> {
    match Owner::of(owner) {
        Owner::Account(_) => Some(Kind::Account),
        Owner::Guest(_) => Some(Kind::Guest),
        Owner::Operator(_) => None,
    }
}

impl Kind {
    /// Runs that wait.
    fn waiting(self) -> u64 {
        match self {
            Kind::Guest => 20,
            Kind::Account => 100,
            Kind::Address => 200,
        }
    }

    fn whose(self) -> &'static str {
        match self {
            Kind::Guest | Kind::Account => "of yours",
            Kind::Address => "from your address",
        }
    }
}

impl Ceilings {
    fn of(&self, kind: Kind) -> f64 {
        let ceiling = match kind {
            Kind::Guest => self.guest,
            Kind::Account => self.account,
            Kind::Address => self.address,
        };
        ceiling.as_secs_f64()
    }

    /// The time limit of a run, if it has one.
    pub(crate) fn longest_run(&self, row: &RunRow) -> Option<Duration> {
        self.longest_of(row.owner.as_deref()).filter(|_| row.campaign.is_none())
    }

    /// The time limit of a stability run or replay of this owner, if there is one, and what the owner is told when it is over.
    pub(crate) fn limit_of(&self, owner: Option<&str>, advice: &str) -> Option<(Duration, String)> {
        let longest = self.longest_of(owner)?;
        Some((longest, format!("Stopped after {}, the time limit for guests. {advice}", time(longest.as_secs_f64()))))
    }

    /// The time limit of a run, stability run or replay of this owner, if there is one.
    fn longest_of(&self, owner: Option<&str>) -> Option<Duration> {
        (owner.and_then(kind) == Some(Kind::Guest)).then_some(self.guest_run)
    }

    /// # Errors
    /// `Invalid` when the run exceeds the time limit of a guest's run, or the ceiling of its owner even alone.
    pub(crate) fn may_be_asked_for(&self, owner: &str, spec: &RunSpec, expected_seconds: f64) -> Result<()> {
        let Some(kind) = kind(owner) else { return Ok(()) };
        let (asks, ceiling) = (granted(spec), self.of(kind));
        if kind == Kind::Guest {
            can_be_run(spec, expected_seconds, self.guest_run)?;
        }
        if asks <= ceiling {
            return Ok(());
        }
        Err(EngineError::Invalid(format!(
            "This run may measure for {}, but your limit is {} for all your runs together. Lower the budget per algorithm or choose \
             fewer algorithms.",
            time(asks),
            time(ceiling)
        )))
    }

    /// # Errors
    /// `Invalid` when a replay may measure longer than a guest's run may take, or its owner may in all.
    pub(crate) fn replay_may_take(&self, owner: &str, spec: &WorkloadSpec, algorithms: usize) -> Result<()> {
        let Some(kind) = kind(owner) else { return Ok(()) };
        let turns = (algorithms * spec.turns()) as f64;
        let limit = match kind {
            Kind::Guest => self.guest_run.as_secs_f64(),
            Kind::Account | Kind::Address => self.of(kind),
        };
        if spec.budget_seconds * turns <= limit {
            return Ok(());
        }
        Err(EngineError::Invalid(format!(
            "This replay may measure for {}, but your limit is {}. Set the budget to {:.0} s per algorithm and order or less, or \
             choose fewer algorithms.",
            time(spec.budget_seconds * turns),
            time(limit),
            (limit / turns).floor()
        )))
    }
}

/// Measuring time that a run may take in all.
pub(crate) fn granted(spec: &RunSpec) -> f64 {
    spec.budget_seconds * spec.algorithms.len() as f64
}

impl Ceilings {
    /// # Errors
    /// `Invalid` when the run alone exceeds a limit, `TooMuch` when it does so together with the queued and running ones.
    pub(crate) async fn have_room_for_a_run(&self, store: &Store, row: &RunRow) -> Result<()> {
        let Some((owner, kind)) = row.owner.as_deref().and_then(|owner| Some((owner, kind(owner)?))) else {
            return Ok(());
        };
        self.may_be_asked_for(owner, &row.spec, row.expected_seconds)?;
        let own = store.granted_to(owner).await?;
        room(kind, own, row, self.of(kind))?;
        if let Some(address) = &row.address {
            let all = store.granted_at(address).await?;
            room(Kind::Address, all, row, self.of(Kind::Address))?;
        }
        Ok(())
    }
}

/// # Errors
/// `Busy` when the objects, saved configurations and recordings of this owner would have too many bytes with these.
pub(crate) async fn has_room_for_a_file(store: &Store, owner: Option<&str>, bytes: usize) -> Result<()> {
    let Some((owner, kind)) = owner.and_then(|owner| Some((owner, kind(owner)?))) else { return Ok(()) };
    let most = if kind == Kind::Guest { GUEST_OBJECTS } else { ACCOUNT_OBJECTS };
    if store.uploaded_bytes(owner).await? + bytes as u64 <= most {
        return Ok(());
    }
    Err(EngineError::Busy(format!(
        "With this file, your objects, saved configurations and recordings would exceed {} MiB; delete some of them.",
        most >> 20
    )))
}

/// Can a guest's run finish within its time limit?
fn can_be_run(spec: &RunSpec, expected_seconds: f64, longest: Duration) -> Result<()> {
    let (longest, algorithms) = (longest.as_secs_f64(), spec.algorithms.len());
    if granted(spec) > longest {
        return Err(EngineError::Invalid(format!(
            "A guest's run may measure for at most {}; {algorithms} algorithms at {} each may take {}. Set the budget to {:.0} s \
             per algorithm or less, choose fewer algorithms, or log in.",
            time(longest),
            time(spec.budget_seconds),
            time(granted(spec)),
            (longest / algorithms as f64).floor()
        )));
    }
    if expected_seconds > longest {
        return Err(EngineError::Invalid(format!(
            "A guest's run may take at most {}; this one is expected to take {}. Choose fewer configurations or algorithms, or \
             log in.",
            time(longest),
            time(expected_seconds)
        )));
    }
    Ok(())
}

fn room(kind: Kind, has: Granted, row: &RunRow, ceiling: f64) -> Result<()> {
    let (whose, asks) = (kind.whose(), row.granted_seconds);
    if has.waiting >= kind.waiting() {
        let message =
            format!("{} runs {whose} are queued already; try again when one has started, or delete some.", has.waiting);
        return Err(EngineError::TooMuch { message, retry_seconds: later(row.expected_seconds) });
    }
    let over = has.seconds + asks - ceiling;
    if over > 0.0 {
        let message = format!(
            "Queued and running runs {whose} may measure for {} already; with this one they would exceed the limit of {}. Try again \
             when some have finished, in about {}.",
            time(has.seconds),
            time(ceiling),
            time(f64::from(later(over)))
        );
        return Err(EngineError::TooMuch { message, retry_seconds: later(over) });
    }
    Ok(())
}

/// Seconds until a retry is useful, an hour at most.
fn later(seconds: f64) -> u32 {
    seconds.ceil().clamp(10.0, 3600.0) as u32
}

/// A time for people.
pub(crate) fn time(seconds: f64) -> String {
    let of = |n: f64, unit: &str| format!("{n:.0} {unit}{}", if n.round() == 1.0 { "" } else { "s" });
    match seconds {
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => of((s / 60.0).ceil(), "minute"),
        s => of((s / 3600.0).ceil(), "hour"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUEST: &str = "0193f1a0-0000-4000-8000-000000000000";

    #[test]
    fn guests_have_less_than_accounts_and_the_command_line_as_much_as_it_wants() {
        let of = |owner: &str| kind(owner).map(Kind::waiting);
        assert_eq!(of(GUEST), Some(20));
        assert_eq!(of(&format!("account:{GUEST}")), Some(100));
        assert_eq!(of("cli"), None);
    }

    #[test]
    fn guests_of_one_address_share_a_turn() {
        assert_eq!(turn(GUEST, Some("203.0.113.7")), "address:203.0.113.7");
        assert_eq!((turn(GUEST, None), turn("account:x", Some("203.0.113.7"))), (GUEST.into(), "account:x".into()));
    }

    #[test]
    fn times_are_said_as_people_say_them() {
        let said = [59.6, 600.0, 6000.0, 86_400.0].map(time);
        assert_eq!(said, ["60 s", "10 minutes", "100 minutes", "24 hours"]);
        assert_eq!([later(0.2), later(61.5), later(1e9)], [10, 62, 3600]);
    }
}
