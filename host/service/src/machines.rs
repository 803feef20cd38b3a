//! Machines that measure for this service: each has a token, asks for prepared runs, checks of plugins and parts of stability runs, and
//! hands in what it found.
//!
//! The token is shown once and known by its hash. It opens the machine's own attempts and the files that their orders name, and
//! nothing else.

pub mod elsewhere;
mod errands;
mod files;
mod handing;
pub mod orders;
mod sentinel;
mod slurm;
pub mod sql;
pub mod under_way;
mod work;

use ocb_lab::algorithm::plugin_hash;

use crate::attempts::Attempt;
use crate::blocking::blocking;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{MachineFacts, MachineInfo};
use crate::runs::draw;
use crate::store::now_us;
use crate::{EngineError, Result, sha256_hex};

pub use handing::Handing;
use sentinel::drift;

/// Longest name of a machine.
const MAX_NAME: usize = 80;

impl Engine {
    /// Allows a machine to measure: its token, which is not shown again. The same machine again gets another token, and its hardware
    /// class is that of its next contact.
    #[boxed]
    pub async fn add_machine(&self, name: &str) -> Result<String> {
        let name = name.trim();
        if name.is_empty() || name.chars().count() > MAX_NAME || name.chars().any(char::is_control) {
            return Err(EngineError::Invalid(format!("A machine has a name of 1 to {MAX_NAME} characters.")));
        }
        let token = draw::secret();
        // It may be another machine now, or have another kernel.
        self.inner.store.forget_readings(name).await?;
        self.inner.store.keep_machine(name, &sha256_hex(token.as_bytes())).await?;
        Ok(token)
    }

    /// All machines by name, also the revoked ones.
    #[boxed]
    pub async fn machines(&self) -> Result<Vec<MachineInfo>> {
        let mut all = self.inner.store.machines().await?;
        for class in self.inner.classes.names() {
            let readings = self.inner.store.readings(&class).await?;
            let of_class = |it: &&mut MachineInfo| it.facts.as_ref().is_some_and(|facts| facts.hardware_class == class);
            all.iter_mut().filter(of_class).for_each(|machine| machine.drift = drift(&readings, &machine.name));
        }
        Ok(all)
    }

    /// Revokes the token of a machine. What it works on waits again.
    #[boxed]
    pub async fn revoke_machine(&self, name: &str) -> Result<()> {
        if !self.inner.store.revoke_machine(name.trim()).await? {
            return Err(EngineError::NotFound(format!(
                "There is no machine {name:?} with a valid token; `ocb admin machines` lists them."
            )));
        }
        self.inner.store.forget_readings(name.trim()).await?;
        self.put_back_work_of(name.trim()).await
    }

    /// The machine of a token that was not revoked.
    #[boxed]
    pub async fn machine_of(&self, token: &str) -> Result<Option<String>> {
        self.inner.store.machine_of(&sha256_hex(token.as_bytes())).await
    }

    /// Refuses a machine that would not measure the same as this service, or not the same as before.
    pub(crate) async fn admit(&self, machine: &str, facts: &MachineFacts) -> Result<()> {
        let rests_us = self.inner.store.machine_rests(machine).await? - now_us();
        if rests_us > 0 {
            let retry_seconds = (rests_us / 1_000_000 + 1) as u32;
            let message = format!("{machine} has failed and gets its next run in {retry_seconds} s; its log says why.");
            return Err(EngineError::TooMuch { message, retry_seconds });
        }
        let admitted = self.is_as_wanted(machine, facts).await;
        if let Err(EngineError::Busy(why)) = &admitted {
            // Jobs of a cluster have no log of their own.
            tracing::warn!("{machine} gets no run. {why}");
            self.inner.store.machine_is_refused(machine, why).await?;
        }
        admitted
    }

    async fn is_as_wanted(&self, machine: &str, facts: &MachineFacts) -> Result<()> {
        let differs = |what: &str| {
            EngineError::Busy(format!(
                "This machine cannot measure for this service: {what}. Install the same package on both."
            ))
        };
        let registry = &self.inner.registry;
        if facts.version != env!("CARGO_PKG_VERSION") {
            return Err(differs(&format!("it has version {}, not {}", facts.version, env!("CARGO_PKG_VERSION"))));
        }
        let program = registry.runner().program.clone();
        if facts.runner_sha256 != blocking(move || Ok(plugin_hash(&program)?)).await? {
            return Err(differs("its ocb-runner is another file"));
        }
        if facts.profile != registry.profile().as_str() {
            return Err(differs(&format!("its profile is {}", facts.profile)));
        }
        let missing = registry.installed().into_iter().find(|known| !facts.plugins.contains(&known.plugin_sha256));
        if let Some(missing) = missing {
            return Err(differs(&format!("its plugin of {} is missing or another file", missing.id)));
        }
        match self.inner.store.machine_was_seen(machine, facts).await? {
            None => self.inner.classes.learn_from(&self.inner.store).await,
            Some(what) => Err(EngineError::Busy(format!(
                "The {what} of {machine} has changed since it was allowed to measure; if that is right, allow it again with `ocb admin \
                 machine {machine}`."
            ))),
        }
    }

    /// What a machine works on waits again; it hears of that with its next beat.
    pub(crate) async fn put_back_work_of(&self, machine: &str) -> Result<()> {
        for attempt in self.inner.store.attempts_of(machine).await? {
            self.put_back(&attempt).await?;
            self.waits_again(&attempt);
        }
        Ok(())
    }

    /// Takes back what a machine works on that asks anew. A job that ends each machine is not tried for ever.
    pub(crate) async fn take_back_from(&self, machine: &str) -> Result<()> {
        for attempt in self.inner.leases().take_back_from(machine).await? {
            self.waits_again(&attempt);
        }
        Ok(())
    }

    fn waits_again(&self, attempt: &Attempt) {
        self.inner.orders.forget(&attempt.id);
        self.inner.run_events.ring(&attempt.job);
        self.inner.work.prepared.notify_waiters();
    }
}
