//! The layers of one jail that are in force, and whether they are enough for a plugin.

use serde::{Deserialize, Serialize};

use crate::outcome::Outcome;
use crate::policy::Policy;

/// Landlock from this ABI on also keeps signals and abstract sockets inside (Linux 6.12).
pub const LANDLOCK_ABI: u32 = 6;
/// How somebody who knows the plugin may run it all the same.
const OR_DEV: &str = "or run your own plugins with --profile dev (its results are not ranked)";

/// How much a machine must have before a foreign plugin may run on it. A plugin built from our own sources
/// ([`Policy::trusted`]) runs in both under the layers that there are; the system call filter is never given up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// Every required layer, or nothing foreign runs.
    #[default]
    Production,
    /// A developer's machine: foreign plugins run with what there is, and results are not ranked.
    Dev,
}

impl Profile {
    /// `production` or `dev`.
    pub fn as_str(self) -> &'static str {
        match self {
            Profile::Production => "production",
            Profile::Dev => "dev",
        }
    }
}

/// What is in force around one runner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Layers {
    /// Namespaces and a root of its own.
    pub namespaces: bool,
    /// User and group ids of its own.
    pub own_ids: bool,
    /// Version of the memory group's hierarchy.
    pub group: Option<&'static str>,
    /// It limits the number of processes, too.
    pub counted: bool,
    /// ABI of Landlock; 0: none.
    pub landlock_abi: u32,
    /// Mappings of code that can no longer be changed.
    pub sealed_mappings: u32,
    /// Memory can no longer become executable.
    pub no_new_code: bool,
    /// Threads that the plugin may start.
    pub startable_threads: usize,
}

impl Layers {
    /// One phrase each, for people; what is missing in capital letters.
    pub fn phrases(&self) -> Vec<String> {
        let mut phrases = Vec::new();
        if self.namespaces {
            phrases.push("user, pid, net, mount, ipc, uts and cgroup namespaces".to_string());
            phrases.push("empty read-only root".to_string());
        } else {
            phrases.push("NO namespaces and NO root of its own (this machine refuses them)".to_string());
        }
        phrases.push(if self.own_ids { "ids of its own" } else { "ids of this user" }.into());
        phrases.push(match self.group {
            Some(version) if self.counted => format!("memory group ({version}), its processes counted"),
            Some(version) => format!("memory group ({version})"),
            None => "address space limit instead of a memory group".to_string(),
        });
        phrases.push("resource limits".into());
        phrases.push("no capabilities, no new privileges".into());
        phrases.push(match self.landlock_abi {
            0 => "NO Landlock (this kernel has none)".to_string(),
            abi => format!("Landlock ABI {abi}"),
        });
        if self.sealed_mappings > 0 {
            phrases.push("sealed code (mseal)".into());
        }
        if self.no_new_code {
            phrases.push("no new executable memory (MDWE)".into());
        }
        phrases.push("system call allow-list with notification".into());
        if self.startable_threads > 0 {
            phrases.push(format!("multi-threaded track: at most {} threads started", self.startable_threads));
        }
        phrases
    }

    /// Are they enough for a plugin under this policy? Otherwise which one is missing, and how it is got.
    pub fn enough(&self, policy: &Policy) -> Result<(), Outcome> {
        let missing = |step: &str, what: &str, get: &str| {
            Err(Outcome::fault(
                step,
                format!("third-party plugins need {what}, which this machine does not provide; {get}, {OR_DEV}"),
            ))
        };
        if self.startable_threads > 0 && !self.namespaces {
            return missing(
                "Threads",
                "namespaces of their own, in which threads can be counted,",
                "allow user namespaces",
            );
        }
        match (policy.trusted, policy.profile) {
            (true, _) => Ok(()),
            // Files are kept away by an own root or by Landlock; without both there is nothing between them.
            (_, Profile::Dev) if !self.namespaces && self.landlock_abi == 0 => Err(Outcome::fault(
                "Landlock",
                "third-party plugins need namespaces or Landlock even in the development profile; use Linux 5.13 or newer with \
                 lsm=landlock",
            )),
            (_, Profile::Dev) => Ok(()),
            (_, Profile::Production) if !self.namespaces => {
                missing("Namespaces", "namespaces of their own", "allow user namespaces (see ocb doctor)")
            }
            (_, Profile::Production) if self.landlock_abi < LANDLOCK_ABI => {
                let what = format!("Landlock ABI {LANDLOCK_ABI} (found {})", self.landlock_abi);
                missing("Landlock", &what, "use Linux 6.12 or newer with lsm=landlock")
            }
            (_, Profile::Production) if self.group.is_none() => {
                missing("MemoryGroup", "a memory group", "run as root or in a delegated control group")
            }
            (_, Profile::Production) => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: Layers = Layers {
        namespaces: true,
        own_ids: true,
        group: Some("v2"),
        counted: true,
        landlock_abi: LANDLOCK_ABI,
        sealed_mappings: 1,
        no_new_code: true,
        startable_threads: 0,
    };

    fn refused(layers: Layers, trusted: bool, profile: Profile) -> Option<String> {
        let policy = Policy { trusted, profile, ..Policy::default() };
        layers.enough(&policy).err().map(|outcome| match outcome {
            Outcome::SandboxFault { step, .. } => step,
            other => panic!("{other}"),
        })
    }

    #[test]
    fn each_required_layer_is_required_in_production_alone() {
        assert_eq!(refused(ALL, false, Profile::Production), None);
        for (without, step) in [
            (Layers { namespaces: false, ..ALL }, "Namespaces"),
            (Layers { landlock_abi: 5, ..ALL }, "Landlock"),
            (Layers { group: None, ..ALL }, "MemoryGroup"),
        ] {
            assert_eq!(refused(without, false, Profile::Production).as_deref(), Some(step));
            assert_eq!(refused(without, false, Profile::Dev), None);
            assert_eq!(refused(without, true, Profile::Production), None);
        }
        // Depth that the external clock does not need.
        let shallow = Layers { sealed_mappings: 0, no_new_code: false, own_ids: false, ..ALL };
        assert_eq!(refused(shallow, false, Profile::Production), None);
        let naked = Layers { namespaces: false, landlock_abi: 0, ..ALL };
        assert_eq!(refused(naked, false, Profile::Dev).as_deref(), Some("Landlock"));
        // Nobody can count threads without a namespace, not even those of a plugin that is trusted.
        let uncounted = Layers { namespaces: false, startable_threads: 16, ..ALL };
        assert_eq!(refused(uncounted, true, Profile::Dev).as_deref(), Some("Threads"));
        let text = Layers { group: None, ..ALL }.enough(&Policy::default()).unwrap_err().to_string();
        assert!(text.contains("--profile dev") && text.contains("run as root"), "{text}");
    }
}
