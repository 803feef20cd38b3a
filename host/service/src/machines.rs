//! Machines that measure for this service: each has a token, asks for prepared runs, and hands in what it found.
//!
//! The token is shown once and known by its hash. It opens the machine's own attempts and the files that their orders name, and
//! nothing else.

mod files;
mod orders;
mod slurm;
pub mod sql;
mod work;

use std::path::Path;
use std::sync::PoisonError;

use ocb_lab::algorithm::plugin_hash;

use crate::boxed;
use crate::engine::{Engine, Inner};
use crate::model::{MachineFacts, MachineInfo};
use crate::runs::draw;
use crate::{EngineError, Result, sha256_hex};

pub use orders::Orders;
pub use slurm::SlurmJobs;
pub use work::Handing;

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
        self.inner.store.keep_machine(name, &sha256_hex(token.as_bytes())).await?;
        Ok(token)
    }

    /// All machines by name, also the revoked ones.
    #[boxed]
    pub async fn machines(&self) -> Result<Vec<MachineInfo>> {
        self.inner.store.machines().await
    }

    /// Revokes the token of a machine. What it works on waits again.
    #[boxed]
    pub async fn revoke_machine(&self, name: &str) -> Result<()> {
        if self.inner.store.revoke_machine(name.trim()).await? {
            return Ok(());
        }
        Err(EngineError::NotFound(format!(
            "There is no machine {name:?} with a valid token; `ocb admin machines` lists them."
        )))
    }

    /// The machine of a token that was not revoked.
    #[boxed]
    pub async fn machine_of(&self, token: &str) -> Result<Option<String>> {
        self.inner.store.machine_of(&sha256_hex(token.as_bytes())).await
    }

    /// Refuses a machine that would not measure the same as this service, or not the same as before.
    pub(crate) async fn admit(&self, machine: &str, facts: &MachineFacts) -> Result<()> {
        let differs = |what: &str| {
            EngineError::Busy(format!(
                "This machine cannot measure for this service: {what}. Install the same package on both."
            ))
        };
        let registry = &self.inner.registry;
        if facts.version != env!("CARGO_PKG_VERSION") {
            return Err(differs(&format!("it has version {}, not {}", facts.version, env!("CARGO_PKG_VERSION"))));
        }
        if Some(&facts.runner_sha256) != self.inner.orders.runner(&registry.runner().program).as_ref() {
            return Err(differs("its ocb-runner is another file"));
        }
        if facts.profile != registry.profile().as_str() {
            return Err(differs(&format!("its profile is {}", facts.profile)));
        }
        let missing = registry.installed().into_iter().find(|known| !facts.plugins.contains(&known.plugin_sha256));
        if let Some(missing) = missing {
            return Err(differs(&format!("its plugin of {} is missing or another file", missing.id)));
        }
        let others = self.inner.store.machines().await?;
        let others = others.iter().filter(|other| other.name != machine && other.revoked_us.is_none());
        let mut classes = others.filter_map(|other| Some(&other.facts.as_ref()?.hardware_class));
        if let Some(class) = classes.find(|class| **class != facts.hardware_class) {
            return Err(EngineError::Busy(format!(
                "The machines of a service have one hardware class: {machine} has {}, the others {class}. Revoke those of the other \
                 class first with `ocb admin revoke-machine`.",
                facts.hardware_class
            )));
        }
        match self.inner.store.machine_was_seen(machine, facts).await? {
            None => self.inner.learn_class().await,
            Some(what) => Err(EngineError::Busy(format!(
                "The {what} of {machine} has changed since it was allowed to measure; if that is right, allow it again with `ocb admin \
                 machine {machine}`."
            ))),
        }
    }
}

impl Inner {
    /// Where machines measure for this service, runs have their hardware class.
    pub(crate) async fn learn_class(&self) -> Result<()> {
        if !self.config.elsewhere {
            return Ok(());
        }
        let machines = self.store.machines().await?;
        let measuring = machines.iter().filter(|machine| machine.revoked_us.is_none());
        if let Some(facts) = measuring.filter_map(|machine| machine.facts.as_ref()).next() {
            self.class.write().unwrap_or_else(PoisonError::into_inner).clone_from(&facts.hardware_class);
        }
        Ok(())
    }
}

/// SHA-256 of the runner's file.
fn runner_hash(program: &Path) -> Option<String> {
    plugin_hash(program).ok()
}
