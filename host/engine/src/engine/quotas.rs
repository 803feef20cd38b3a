//! How much one visitor may have, so that nobody fills the queue or the disk. The command line has no quota.

use super::Engine;
use crate::{EngineError, Result};

/// What guests and accounts may have.
struct Quota {
    /// Runs that wait.
    waiting: u64,
    /// Bytes of objects.
    objects: u64,
}

const GUEST: Quota = Quota { waiting: 20, objects: 512 << 20 };
const ACCOUNT: Quota = Quota { waiting: 100, objects: 4 << 30 };

/// Guests are random ids.
fn quota(owner: Option<&str>) -> Option<Quota> {
    let owner = owner?;
    if owner.starts_with("account:") {
        return Some(ACCOUNT);
    }
    uuid::Uuid::try_parse(owner).is_ok().then_some(GUEST)
}

impl Engine {
    /// # Errors
    /// `Busy` when so many runs of this owner wait already.
    pub(super) async fn has_room_for_a_run(&self, owner: Option<&str>) -> Result<()> {
        let (Some(Quota { waiting, .. }), Some(owner)) = (quota(owner), owner) else { return Ok(()) };
        if self.inner.store.waiting_runs(owner).await? < waiting {
            return Ok(());
        }
        Err(EngineError::Busy(format!(
            "{waiting} runs of yours wait already; ask again when one of them has begun, or delete some."
        )))
    }

    /// # Errors
    /// `Busy` when the objects of this owner would have too many bytes with these.
    pub(super) async fn has_room_for_an_object(&self, owner: Option<&str>, bytes: usize) -> Result<()> {
        let (Some(Quota { objects, .. }), Some(owner)) = (quota(owner), owner) else { return Ok(()) };
        if self.inner.store.object_bytes(owner).await? + bytes as u64 <= objects {
            return Ok(());
        }
        Err(EngineError::Busy(format!(
            "Your objects would have more than {} MiB; delete some on the page of objects.",
            objects >> 20
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guests_have_less_than_accounts_and_the_command_line_as_much_as_it_wants() {
        let of = |owner| quota(owner).map(|quota| (quota.waiting, quota.objects >> 20));
        assert_eq!(of(Some("0193f1a0-0000-4000-8000-000000000000")), Some((20, 512)));
        assert_eq!(of(Some("account:0193f1a0-0000-4000-8000-000000000000")), Some((100, 4096)));
        assert_eq!((of(Some("cli")), of(None)), (None, None));
    }
}
