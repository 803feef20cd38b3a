//! The hardware classes on which runs are measured: the one of this machine, or those of the machines that measure for it.

use std::sync::{PoisonError, RwLock};

use crate::model::{ClassStatus, MachineInfo, RunSpec};
use crate::runs::priority::BACKGROUND;
use crate::runs::share::OfClass;
use crate::store::Store;
use crate::{EngineError, Result};

/// A hardware class and its machines.
#[derive(Clone)]
struct Class {
    hardware_class: String,
    cpu: String,
    machines: u32,
}

/// All of them, at least one, the usual one first.
pub struct Classes {
    known: RwLock<Vec<Class>>,
    /// Machines measure for this service, so that runs have their classes.
    elsewhere: bool,
}

impl Classes {
    /// This one, with this CPU, until others are known.
    pub fn of(hardware_class: &str, cpu: &str, elsewhere: bool) -> Self {
        let own = Class { hardware_class: hardware_class.to_owned(), cpu: cpu.to_owned(), machines: 1 };
        Self { known: RwLock::new(vec![own]), elsewhere }
    }

    /// The class on which runs are measured that name none: that of the machine which was allowed first.
    pub fn usual(&self) -> String {
        self.all().swap_remove(0).hardware_class
    }

    /// All classes on which runs are measured, the usual one first.
    pub fn names(&self) -> Vec<String> {
        self.all().into_iter().map(|class| class.hardware_class).collect()
    }

    /// How many machines measure.
    pub fn machines(&self) -> u64 {
        self.all().iter().map(|class| u64::from(class.machines)).sum()
    }

    /// This class, or the usual one.
    ///
    /// # Errors
    /// `Invalid` when no machine has it.
    pub fn measures_on(&self, class: Option<&str>) -> Result<String> {
        let mut all = self.names();
        let Some(class) = class else { return Ok(all.swap_remove(0)) };
        let unknown = || {
            EngineError::Invalid(format!(
                "No machine here has the hardware class {class:?}; there is {}.",
                all.join(", ")
            ))
        };
        all.iter().find(|known| *known == class).cloned().ok_or_else(unknown)
    }

    /// The class for which such a run waits.
    pub fn waiting_for(&self, spec: &RunSpec) -> OfClass {
        let usual = self.usual();
        OfClass { class: spec.hardware_class.clone().unwrap_or_else(|| usual.clone()), usual }
    }

    /// How a run of the service names this class: the usual one is not named.
    pub fn named(&self, class: &str) -> Option<String> {
        Some(class.to_owned()).filter(|class| *class != self.usual())
    }

    /// Where machines measure for this service, runs have their hardware classes.
    pub async fn learn_from(&self, store: &Store) -> Result<()> {
        if self.elsewhere {
            self.learn(&store.machines().await?);
        }
        Ok(())
    }

    /// What waits for each class.
    pub async fn status(&self, store: &Store) -> Result<Vec<ClassStatus>> {
        let usual = self.usual();
        let mut all = Vec::new();
        for Class { hardware_class, cpu, machines } in self.all() {
            let waiting = OfClass { class: hardware_class.clone(), usual: usual.clone() };
            let (queued, expected_seconds) = store.waiting(BACKGROUND, &waiting).await?;
            all.push(ClassStatus { hardware_class, cpu, machines, queued, expected_seconds });
        }
        Ok(all)
    }

    /// Takes those of these machines; where none has told its class, what was known stays.
    fn learn(&self, machines: &[MachineInfo]) {
        let mut known: Vec<_> = machines.iter().filter(|machine| machine.revoked_us.is_none()).collect();
        known.sort_by_key(|machine| (machine.created_us, machine.name.clone()));
        let mut classes: Vec<Class> = Vec::new();
        for facts in known.iter().filter_map(|machine| machine.facts.as_ref()) {
            match classes.iter_mut().find(|class| class.hardware_class == facts.hardware_class) {
                Some(class) => class.machines += 1,
                None => classes.push(Class {
                    hardware_class: facts.hardware_class.clone(),
                    cpu: facts.cpu.clone(),
                    machines: 1,
                }),
            }
        }
        if !classes.is_empty() {
            *self.known.write().unwrap_or_else(PoisonError::into_inner) = classes;
        }
    }

    fn all(&self) -> Vec<Class> {
        self.known.read().unwrap_or_else(PoisonError::into_inner).clone()
    }
}
