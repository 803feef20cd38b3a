//! Accounts: making them, opening them, and what they may do.

pub mod choices;
pub mod deletion;
pub mod devices;
pub mod invitations;
pub mod passwords;
pub mod sql;

use std::time::Duration;

use crate::audit::Note;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{AccountInfo, AuditEntry, Cursor, NewToken, Page, Part, Role, Scope, TokenInfo, TokenRequest};
use crate::plugins::signature;
use crate::requests::Made;
use crate::runs::draw;
use crate::sha256_hex;
use crate::store::now_us;
use crate::{EngineError, Result};

/// How long a browser stays logged in, and how long a token lives.
pub const SESSION: Duration = Duration::from_secs(30 * 24 * 3600);
const TOKEN: Duration = Duration::from_secs(365 * 24 * 3600);
/// Letters of a name, and of what people write about themselves.
const NAME: std::ops::RangeInclusive<usize> = 3..=80;
const WORDS: usize = 2000;
/// Who has the data folder, in the log.
pub(crate) const NAME_OF_OPERATOR: &str = "the operator";
/// Remembered browsers of one account.
const MAX_DEVICES: i64 = 20;
/// Tokens of one account.
const MAX_TOKENS: usize = 20;

impl Engine {
    /// Makes an account. A name is a user name or an e-mail address.
    #[boxed]
    pub async fn add_account(&self, name: &str, password: &str, role: Role) -> Result<AccountInfo> {
        let name = name.trim();
        let plain = |c: char| c.is_ascii_alphanumeric() || "._-@+".contains(c);
        if !NAME.contains(&name.len()) || !name.chars().all(plain) {
            return Err(EngineError::Invalid(format!(
                "A user name has {} to {} letters, digits and . _ - @ +; {name:?} is not valid.",
                NAME.start(),
                NAME.end()
            )));
        }
        let account = AccountInfo {
            id: uuid::Uuid::new_v4().to_string(),
            name: name.to_owned(),
            role,
            developer_request: None,
            signing_key: None,
            created_us: now_us(),
        };
        let password = passwords::hashed(password).await?;
        if !self.inner.store.add_account(&account, &password).await? {
            return Err(EngineError::Busy(format!("The name {name:?} is taken; choose another.")));
        }
        self.inner.store.note(name, "account created", &account.owner(), role.name()).await?;
        Ok(account)
    }

    /// Has this browser logged in to the account of this name before?
    #[boxed]
    pub async fn knows_device(&self, name: &str, browser: &str) -> Result<bool> {
        Ok(name.len() <= *NAME.end() && self.inner.store.knows_device(name, &sha256_hex(browser.as_bytes())).await?)
    }

    /// Remembers a browser that has just logged in; the newest ones are kept.
    #[boxed]
    pub async fn remember_device(&self, account: &AccountInfo, browser: &str) -> Result<()> {
        self.inner.store.remember_device(&account.id, &sha256_hex(browser.as_bytes()), MAX_DEVICES).await
    }

    /// The account that name and password open; the answer to a wrong name is that to a wrong password.
    #[boxed]
    pub async fn account_with(&self, name: &str, password: &str) -> Result<AccountInfo> {
        let name = name.trim();
        // No account has a longer name, and the database need not see megabytes.
        let known = if name.len() <= *NAME.end() { self.inner.store.password_of(name).await? } else { None };
        let (id, stored) = known.map_or((None, None), |(id, stored)| (Some(id), Some(stored)));
        let fits = passwords::fits(password, stored).await?;
        let account = match id.filter(|_| fits) {
            Some(id) => self.inner.store.account(&id).await?,
            None => None,
        };
        account.ok_or_else(|| EngineError::Forbidden("Wrong user name or password.".into()))
    }

    /// Changes the password and logs out everywhere.
    #[boxed]
    pub async fn change_password(&self, account: &AccountInfo, old: &str, new: &str) -> Result<()> {
        self.account_with(&account.name, old).await?;
        let password = passwords::hashed(new).await?;
        self.inner.store.set_password(&account.id, &password).await?;
        self.inner.store.note(&account.name, "password changed", &account.owner(), "").await?;
        self.end_sessions(account).await
    }

    /// A new session of the account; the secret is for its browser alone.
    #[boxed]
    pub async fn add_session(&self, account: &AccountInfo) -> Result<String> {
        self.inner.store.forget_ended_keys().await?;
        let id = uuid::Uuid::new_v4().to_string();
        let scopes = vec![Scope::Runs, Scope::Plugins];
        self.add_key(account, id, String::new(), scopes, SESSION, true).await.map(|(_, key)| key)
    }

    async fn add_key(
        &self,
        account: &AccountInfo,
        id: String,
        name: String,
        scopes: Vec<Scope>,
        life: Duration,
        session: bool,
    ) -> Result<(TokenInfo, String)> {
        let (secret, now) = (draw::secret(), now_us());
        let key = TokenInfo { id, name, scopes, created_us: now, expires_us: now + life.as_micros() as i64 };
        self.inner.store.add_key(&sha256_hex(secret.as_bytes()), &account.id, &key, session).await?;
        Ok((key, secret))
    }

    /// The account of a session.
    #[boxed]
    pub async fn session(&self, secret: &str) -> Result<Option<AccountInfo>> {
        let opened = self.inner.store.opened_by(&sha256_hex(secret.as_bytes()), true).await?;
        Ok(opened.map(|(account, _)| account))
    }

    /// The account of a token, and what the token may be used for.
    #[boxed]
    pub async fn token(&self, secret: &str) -> Result<Option<(AccountInfo, Vec<Scope>)>> {
        self.inner.store.opened_by(&sha256_hex(secret.as_bytes()), false).await
    }

    /// Ends one session.
    #[boxed]
    pub async fn end_session(&self, secret: &str) -> Result<()> {
        self.inner.store.end_session(&sha256_hex(secret.as_bytes())).await
    }

    /// Ends all sessions of the account; its tokens stay.
    #[boxed]
    pub async fn end_sessions(&self, account: &AccountInfo) -> Result<()> {
        self.inner.store.end_sessions(&account.id).await
    }

    /// A new token for programs. Asked again under the same key, because the secret was lost with the answer, it is the same token
    /// with another secret.
    #[boxed]
    pub async fn add_token(&self, account: &AccountInfo, request: TokenRequest, key: Option<&str>) -> Result<NewToken> {
        let name = request.name.trim().to_owned();
        if name.is_empty() || name.chars().count() > *NAME.end() || name.chars().any(char::is_control) {
            return Err(EngineError::Invalid("A token has a name of 1 to 80 characters.".into()));
        }
        if request.scopes.is_empty() {
            return Err(EngineError::Invalid("A token needs at least one scope.".into()));
        }
        let id = self.id_of_request(&account.owner(), Made::Token, key, &request).await?;
        let known = self.tokens(account).await?;
        if known.len() >= MAX_TOKENS && known.iter().all(|token| token.id != id) {
            return Err(EngineError::Busy(format!("An account has at most {MAX_TOKENS} tokens; revoke one first.")));
        }
        self.inner.store.end_token(&account.id, &id).await?;
        let (token, secret) = self.add_key(account, id, name, request.scopes, TOKEN, false).await?;
        self.inner.store.note(&account.name, "token created", &account.owner(), &token.name).await?;
        Ok(NewToken { token, secret })
    }

    /// The account's tokens.
    #[boxed]
    pub async fn tokens(&self, account: &AccountInfo) -> Result<Vec<TokenInfo>> {
        self.inner.store.tokens(&account.id).await
    }

    /// Ends a token.
    #[boxed]
    pub async fn end_token(&self, account: &AccountInfo, id: &str) -> Result<()> {
        if !self.inner.store.end_token(&account.id, id).await? {
            return Err(EngineError::NotFound(format!("There is no token {id:?}.")));
        }
        self.inner.store.note(&account.name, "token revoked", &account.owner(), id).await
    }

    /// Moves what a guest made into an account.
    #[boxed]
    pub async fn keep_things(&self, guest: &str, account: &AccountInfo) -> Result<()> {
        self.inner.store.move_things(guest, &account.owner()).await
    }

    /// Accounts, newest first, for curators.
    #[boxed]
    pub async fn accounts(&self, page: &Page) -> Result<Part<AccountInfo>> {
        let (from, limit) = page.start()?;
        let accounts = self.inner.store.accounts(&from, limit + 1).await?;
        Ok(Part::of(accounts, limit, |account: &AccountInfo| Cursor::behind(account.created_us, &account.id)))
    }

    /// Asks the curators to be made a developer.
    #[boxed]
    pub async fn request_developer_role(&self, account: &AccountInfo, reason: &str) -> Result<()> {
        let reason = said(reason, "describe in a sentence or two what you want to submit")?;
        if account.role != Role::User {
            return Err(EngineError::Busy("This account can already submit plugins.".into()));
        }
        self.inner.store.set_developer_request(&account.id, &reason).await?;
        self.inner.store.note(&account.name, "requested the developer role", &account.owner(), &reason).await
    }

    /// Registers the key that the account signs its plugins with, or forgets it.
    #[boxed]
    pub async fn set_signing_key(&self, account: &AccountInfo, key: Option<&str>) -> Result<AccountInfo> {
        let key = key.map(signature::public_key).transpose()?;
        let (action, detail) =
            key.as_deref().map_or(("signing key removed", ""), |key| ("signing key registered", key));
        let subject = account.owner();
        let note = Note { actor: &account.name, action, subject: &subject, detail };
        self.inner.store.set_signing_key(&account.id, key.as_deref(), note).await?;
        Ok(AccountInfo { signing_key: key, ..account.clone() })
    }

    /// Gives an account a role. Curators decide about users and developers, administrators about all; nobody about
    /// themselves.
    #[boxed]
    pub async fn set_role(&self, by: &AccountInfo, id: &str, role: Role) -> Result<AccountInfo> {
        let store = &self.inner.store;
        let missing = || EngineError::NotFound(format!("There is no account {id:?}."));
        let of = store.account(id).await?.ok_or_else(missing)?;
        let most = if by.role == Role::Administrator { Role::Administrator } else { Role::Developer };
        if of.id == by.id {
            return Err(EngineError::Forbidden("You cannot change your own role.".into()));
        }
        if by.role < Role::Curator || role > most || of.role > most {
            return Err(EngineError::Forbidden(
                "Only an administrator can change the role of a curator or administrator.".into(),
            ));
        }
        let (subject, change) = (of.owner(), format!("{} to {}", of.role.name(), role.name()));
        let note = Note { actor: &by.name, action: "role changed", subject: &subject, detail: &change };
        store.set_role(id, role, note).await?;
        store.account(id).await?.ok_or_else(missing)
    }

    /// What was done to an account or a plugin, oldest first.
    #[boxed]
    pub async fn audit(&self, subject: &str) -> Result<Vec<AuditEntry>> {
        self.inner.store.notes_on(subject).await
    }

    /// The first entry of the audit log that was changed by hand, if any.
    #[boxed]
    pub async fn broken_audit(&self) -> Result<Option<i64>> {
        self.inner.store.broken_note().await
    }
}

/// What somebody wrote: something, not too long.
pub(crate) fn said(text: &str, mend: &str) -> Result<String> {
    let text = text.trim();
    if text.is_empty() || text.chars().count() > WORDS {
        return Err(EngineError::Invalid(format!("Please {mend}, in at most {WORDS} characters.")));
    }
    Ok(text.to_owned())
}
