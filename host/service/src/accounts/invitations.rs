//! Invitations: how somebody becomes a developer without asking. A secret in a link, for one account, once, for a time.

pub mod sql;

use std::time::Duration;

use crate::accounts::NAME_OF_OPERATOR;
use crate::audit::Note;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{
    AccountInfo, Cursor, InvitationInfo, InvitationRequest, InvitationState, NewInvitation, Page, Part, Role,
};
use crate::requests::Made;
use crate::runs::draw;
use crate::sha256_hex;
use crate::store::now_us;
use crate::{EngineError, Result};

/// Days that an invitation may last, letters that say for whom it is, and how many may be open.
const DAYS: std::ops::RangeInclusive<u32> = 1..=90;
const RECIPIENT: usize = 200;
const MOST_OPEN: u64 = 200;
const DAY: Duration = Duration::from_secs(24 * 3600);

impl Engine {
    /// Makes an invitation; `by` is a curator, or nobody when whoever has the data folder makes it. `origin` is where the
    /// service is reached. Asked again under the same key, because the link was lost with the answer, it is the same invitation with
    /// another link.
    #[boxed]
    pub async fn invite(
        &self,
        by: Option<&AccountInfo>,
        asked: InvitationRequest,
        origin: &str,
        key: Option<&str>,
    ) -> Result<NewInvitation> {
        let recipient = asked.recipient.trim().to_owned();
        let length = recipient.chars().count();
        if length == 0 || length > RECIPIENT || recipient.chars().any(char::is_control) {
            return Err(EngineError::Invalid(format!(
                "State in 1 to {RECIPIENT} characters for whom the invitation is."
            )));
        }
        if !DAYS.contains(&asked.days) {
            let (least, most) = (DAYS.start(), DAYS.end());
            return Err(EngineError::Invalid(format!(
                "An invitation is valid for {least} to {most} days, not {}.",
                asked.days
            )));
        }
        let owner = by.map_or_else(|| NAME_OF_OPERATOR.to_owned(), AccountInfo::owner);
        let id = self.id_of_request(&owner, Made::Invitation, key, &asked).await?;
        if self.inner.store.open_invitations().await? >= MOST_OPEN {
            return Err(EngineError::Busy(format!("{MOST_OPEN} invitations are open; withdraw one first.")));
        }
        let (secret, now) = (draw::secret(), now_us());
        let invitation = InvitationInfo {
            id,
            recipient,
            invited_by: by.map(|by| by.name.clone()),
            state: InvitationState::Open,
            accepted_by: None,
            created_us: now,
            expires_us: now + (DAY * asked.days).as_micros() as i64,
        };
        let (actor, subject) = (actor(by), subject(&invitation.id));
        let note = Note { actor, action: "invitation created", subject: &subject, detail: &invitation.recipient };
        let hash = sha256_hex(secret.as_bytes());
        if !self.inner.store.add_invitation(&hash, by.map(|by| by.id.as_str()), &invitation, note).await? {
            return Err(EngineError::Busy(
                "This invitation was already accepted or withdrawn; create a new one.".into(),
            ));
        }
        Ok(NewInvitation { link: format!("{origin}/account#invitation={secret}"), invitation, secret })
    }

    /// Invitations, newest first, for curators.
    #[boxed]
    pub async fn invitations(&self, page: &Page) -> Result<Part<InvitationInfo>> {
        let (from, limit) = page.start()?;
        let all = self.inner.store.invitations(&from, limit + 1).await?;
        Ok(Part::of(all, limit, |one: &InvitationInfo| Cursor::behind(one.created_us, &one.id)))
    }

    /// Withdraws an invitation that nobody has accepted.
    #[boxed]
    pub async fn revoke_invitation(&self, by: Option<&AccountInfo>, id: &str) -> Result<InvitationInfo> {
        let missing = || EngineError::NotFound(format!("There is no invitation {id:?}."));
        self.inner.store.invitation(id).await?.ok_or_else(missing)?;
        let subject = subject(id);
        let note = Note { actor: actor(by), action: "invitation withdrawn", subject: &subject, detail: "" };
        if !self.inner.store.revoke_invitation(id, note).await? {
            return Err(EngineError::Busy("This invitation was already accepted or withdrawn.".into()));
        }
        self.inner.store.invitation(id).await?.ok_or_else(missing)
    }

    /// Accepts an invitation: the account is a developer from then on. Whatever is wrong with a secret, the answer is the same.
    #[boxed]
    pub async fn accept_invitation(&self, account: &AccountInfo, secret: &str) -> Result<AccountInfo> {
        if account.role != Role::User {
            return Err(EngineError::Busy(
                "This account can already submit plugins; the invitation stays open.".into(),
            ));
        }
        let owner = account.owner();
        let note = Note {
            actor: &account.name,
            action: "role changed",
            subject: &owner,
            detail: "user to developer, invited",
        };
        let hash = sha256_hex(secret.trim().as_bytes());
        if self.inner.store.accept_invitation(&hash, &account.id, note).await?.is_none() {
            return Err(EngineError::NotFound(
                "This invitation is not valid: it was accepted or withdrawn, or it has expired; ask for a new one."
                    .into(),
            ));
        }
        let gone = || EngineError::Fault("The account was lost while it accepted the invitation.".into());
        self.inner.store.account(&account.id).await?.ok_or_else(gone)
    }
}

fn actor(by: Option<&AccountInfo>) -> &str {
    by.map_or(NAME_OF_OPERATOR, |by| by.name.as_str())
}

fn subject(id: &str) -> String {
    format!("invitation:{id}")
}
