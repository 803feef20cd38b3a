//! The hardware classes on which runs are measured: the one of this machine, or those of the machines that measure for it.

pub mod known;

use known::Class;

use crate::engine::Inner;
use crate::model::{ClassStatus, RunSpec};
use crate::runs::priority::BACKGROUND;
use crate::runs::share::OfClass;
use crate::{EngineError, Result};

impl Inner {
    /// The class on which runs are measured that name none: that of the machine which was allowed first.
    pub fn hardware_class(&self) -> String {
        self.classes.all().swap_remove(0).hardware_class
    }

    /// All classes on which runs are measured, the usual one first.
    pub fn hardware_classes(&self) -> Vec<String> {
        self.classes.all().into_iter().map(|class| class.hardware_class).collect()
    }

    /// How many machines measure.
    pub fn measuring_machines(&self) -> u64 {
        self.classes.all().iter().map(|class| u64::from(class.machines)).sum()
    }

    /// This class, or the usual one.
    ///
    /// # Errors
    /// `Invalid` when no machine has it.
    pub fn measures_on(&self, class: Option<&str>) -> Result<String> {
        let mut all = self.hardware_classes();
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
        let usual = self.hardware_class();
        OfClass { class: spec.hardware_class.clone().unwrap_or_else(|| usual.clone()), usual }
    }

    /// How a run of the service names this class: the usual one is not named.
    pub fn named(&self, class: &str) -> Option<String> {
        Some(class.to_owned()).filter(|class| *class != self.hardware_class())
    }

    /// Where machines measure for this service, runs have their hardware classes.
    pub(crate) async fn learn_classes(&self) -> Result<()> {
        if self.config.elsewhere {
            self.classes.learn(&self.store.machines().await?);
        }
        Ok(())
    }

    /// What waits for each class.
    pub(crate) async fn class_status(&self) -> Result<Vec<ClassStatus>> {
        let usual = self.hardware_class();
        let mut all = Vec::new();
        for Class { hardware_class, cpu, machines } in self.classes.all() {
            let waiting = OfClass { class: hardware_class.clone(), usual: usual.clone() };
            let (queued, expected_seconds) = self.store.waiting(BACKGROUND, &waiting).await?;
            all.push(ClassStatus { hardware_class, cpu, machines, queued, expected_seconds });
        }
        Ok(all)
    }
}
