//! Mails on their way: each waits in the database until the mail server says that it has it, or a day is over. The service that
//! keeps house brings them, one after the other, in the background. While it tries one, no other service takes that. A restart loses no mail. The text is written when the mail is sent, so
//! that an account that has turned mails off receives none that were waiting.

use std::time::Duration;

use tokio::sync::Notify;

use crate::Result;
use crate::house::House;
use crate::mail::sql::{MailLink, WaitingMail};
use crate::mail::{Letter, MailServer, Refused, deliver};
use crate::runs::draw;
use crate::sha256_hex;
use crate::store::{Store, now_us};

/// The waiting mails are looked at this often even if nothing rings.
const IDLE: Duration = Duration::from_secs(600);
/// After a fault of the database.
const BACK_OFF: Duration = Duration::from_secs(10);

/// The mails that wait, and the server that takes them.
pub struct Outbox {
    pub(crate) store: Store,
    /// Without one, nothing is mailed.
    pub(crate) server: Option<MailServer>,
    /// Rung when there is a mail to bring.
    ring: Notify,
}

impl Outbox {
    /// The mails of this database, for this server.
    pub fn new(store: Store, server: Option<MailServer>) -> Self {
        Self { store, server, ring: Notify::new() }
    }

    /// Somebody was told something: there may be a mail to bring. PostgreSQL tells the other services.
    pub fn post_soon(&self) {
        self.ring.notify_one();
    }

    /// Brings mails to the server while this service keeps house, until the engine closes; without a server, nothing.
    pub async fn post(&self, house: &House) {
        let Some(server) = &self.server else { return };
        tracing::info!("mails are sent through {}", server.named());
        while house.here().await {
            let wait = match self.post_due(server, house).await {
                Ok(wait) => wait.min(IDLE),
                Err(e) => {
                    tracing::error!("mails could not be read: {e}");
                    BACK_OFF
                }
            };
            tokio::select! {
                () = tokio::time::sleep(wait) => {}
                () = self.ring.notified() => {}
                () = house.gone() => {}
            }
        }
    }

    /// Brings what is due, and gives how long the next one waits.
    async fn post_due(&self, server: &MailServer, house: &House) -> Result<Duration> {
        while house.is_here()
            && let Some(mail) = self.store.due_mail(now_us()).await?
        {
            if !mail.wanted {
                self.store.forget_mail(&mail.id).await?;
                continue;
            }
            // After that it is tried again, should this service end meanwhile.
            let over = now_us() + 2 * server.pace.delivery.as_micros() as i64;
            if !self.store.hold_mail(&mail.id, mail.due_us, over).await? {
                continue;
            }
            let letter = self.letter(server, &mail).await?;
            let brought = tokio::select! {
                brought = bring(server, &letter, &mail.id) => brought,
                // It waits for the next start, and the server may have it already: then it gets it twice, under one id.
                () = house.closing() => {
                    self.store.hold_mail(&mail.id, over, mail.due_us).await?;
                    return Ok(Duration::ZERO);
                }
            };
            match brought {
                Ok(()) => self.store.forget_mail(&mail.id).await?,
                Err(refused) => self.put_off(server, &mail, &refused).await?,
            }
        }
        let next = self.store.next_mail_us().await?;
        Ok(next.map_or(IDLE, |next| Duration::from_micros((next - now_us()).max(0) as u64)))
    }

    /// The secret of a link is drawn when it is sent, so that no row ever holds it.
    async fn letter(&self, server: &MailServer, mail: &WaitingMail) -> Result<Letter> {
        let WaitingMail { account: [id, name], address, notice, .. } = mail;
        let (off, until) = (draw::secret(), |time: Duration| now_us() + time.as_micros() as i64);
        let (sha256, expires_us) = (&sha256_hex(off.as_bytes()), until(server.pace.off));
        self.store.add_off_link(MailLink { sha256, account: id, address, expires_us }).await?;
        if let Some([subject, text, link]) = notice {
            return Ok(Letter::notice(server, name, address, [subject, text, link], &off));
        }
        let secret = draw::secret();
        let (sha256, expires_us) = (&sha256_hex(secret.as_bytes()), until(server.pace.link));
        self.store.add_confirmation(MailLink { sha256, account: id, address, expires_us }).await?;
        Ok(Letter::confirmation(server, name, address, &secret, &off))
    }

    async fn put_off(&self, server: &MailServer, mail: &WaitingMail, refused: &Refused) -> Result<()> {
        // The log names the account; its address is nobody's business.
        let (account, reason) = (&mail.account[0], refused.reason.replace(&mail.address, "the address"));
        let waited = Duration::from_micros((now_us() - mail.created_us).max(0) as u64);
        if refused.for_good || waited >= server.pace.give_up {
            tracing::error!("a mail to account {account} was dropped: {reason}");
            return self.store.forget_mail(&mail.id).await;
        }
        let wait = server.pace.wait(mail.tries + 1);
        tracing::warn!("a mail to account {account} is retried in {} s: {reason}", wait.as_secs_f64());
        self.store.postpone_mail(&mail.id, now_us() + wait.as_micros() as i64).await
    }
}

async fn bring(server: &MailServer, letter: &Letter, id: &str) -> std::result::Result<(), Refused> {
    let unwritten = |e: crate::EngineError| Refused { reason: e.to_string(), for_good: true };
    deliver(server, &letter.written(server, id).map_err(unwritten)?).await
}
