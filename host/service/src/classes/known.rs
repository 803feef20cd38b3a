//! The hardware classes that are known, and how many machines each has.

use std::sync::{PoisonError, RwLock};

use crate::model::MachineInfo;

/// A hardware class and its machines.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    pub hardware_class: String,
    pub cpu: String,
    pub machines: u32,
}

/// All of them, at least one, the usual one first.
pub struct Classes(RwLock<Vec<Class>>);

impl Classes {
    /// This one, with this CPU, until others are known.
    pub fn of(hardware_class: &str, cpu: &str) -> Self {
        let own = Class { hardware_class: hardware_class.to_owned(), cpu: cpu.to_owned(), machines: 1 };
        Self(RwLock::new(vec![own]))
    }

    pub fn all(&self) -> Vec<Class> {
        self.0.read().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Takes those of these machines; where none has told its class, what was known stays.
    pub fn learn(&self, machines: &[MachineInfo]) {
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
            *self.0.write().unwrap_or_else(PoisonError::into_inner) = classes;
        }
    }
}
