//! What an account chooses, and the address that its mails go to. An address counts once its link was opened.

pub mod sql;

use crate::audit::Note;
use crate::boxed;
use crate::engine::Engine;
use crate::mail::address;
use crate::model::{AccountInfo, Choices, NewChoices, Owner};
use crate::sha256_hex;
use crate::store::now_us;
use crate::{EngineError, Result};

impl Engine {
    /// What the account has chosen.
    #[boxed]
    pub async fn choices(&self, account: &AccountInfo) -> Result<Choices> {
        let gone = || EngineError::NotFound("This account no longer exists.".into());
        let row = self.inner.store.choices(&account.id).await?.ok_or_else(gone)?;
        Ok(Choices {
            agrees_to_reruns: row.agrees_to_reruns,
            mail_notices: row.mail_notices,
            confirmed: row.confirmed_us.is_some(),
            address: row.address,
            mailing: self.inner.config.mail.is_some(),
        })
    }

    /// Changes what is said; the rest stays.
    #[boxed]
    pub async fn choose(&self, account: &AccountInfo, new: &NewChoices) -> Result<Choices> {
        self.inner.store.choose(&account.id, new).await?;
        self.choices(account).await
    }

    /// Sends the account's mails to this address from the moment on that its link is opened; the link goes there, unless it was
    /// opened before or went there often enough already (`asking` is false then), which nobody is told.
    #[boxed]
    pub async fn set_address(&self, account: &AccountInfo, to: &str, asking: bool) -> Result<Choices> {
        let to = address(to)?.to_string();
        let asking = asking && self.inner.config.mail.is_some();
        let subject = account.owner();
        // Where to is the account's own business, and the log is kept for ever.
        let note = Note { actor: &account.name, action: "address added", subject: &subject, detail: "" };
        self.inner.store.set_address(&account.id, &to, asking, note).await?;
        if asking {
            self.inner.outbox.post_soon();
        }
        self.choices(account).await
    }

    /// Forgets the account's address, with all that waits to go there.
    #[boxed]
    pub async fn forget_address(&self, account: &AccountInfo) -> Result<Choices> {
        let subject = account.owner();
        let note = Note { actor: &account.name, action: "address removed", subject: &subject, detail: "" };
        self.inner.store.forget_address(&account.id, note).await?;
        self.choices(account).await
    }

    /// Turns off the mails of the account that a mail with this secret in its link went to. Whatever is wrong with it, the answer is
    /// the same; who does it again changes nothing.
    #[boxed]
    pub async fn turn_mails_off(&self, secret: &str) -> Result<()> {
        let known = self.inner.store.account_of_off_link(&sha256_hex(secret.as_bytes()), now_us()).await?;
        let Some(([id, name], wanted)) = known else {
            return Err(EngineError::NotFound(
                "This unsubscribe link is not valid: it has expired, the address was changed, or the link is \
                 incomplete; use the link of a newer mail, or log in and turn mail off on the account page."
                    .into(),
            ));
        };
        let subject = Owner::Account(&id).to_string();
        let note = Note { actor: &name, action: "mail turned off by link", subject: &subject, detail: "" };
        self.inner.store.turn_mails_off(&id, wanted.then_some(note)).await
    }

    /// Confirms the account's address by the secret of the link that went there. Whatever is wrong with it, the answer is the same.
    #[boxed]
    pub async fn confirm_address(&self, account: &AccountInfo, secret: &str) -> Result<Choices> {
        let (subject, hash) = (account.owner(), sha256_hex(secret.trim().as_bytes()));
        let note = Note { actor: &account.name, action: "address confirmed", subject: &subject, detail: "" };
        if !self.inner.store.confirm_address(&hash, &account.id, now_us(), note).await? {
            return Err(EngineError::NotFound(
                "This confirmation link is not valid: it was used before, it has expired, or the address was changed; \
                 request a new one."
                    .into(),
            ));
        }
        self.choices(account).await
    }
}
