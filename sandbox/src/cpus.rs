//! Which CPUs a runner and its supervisor have, and which hand-off fits.

use crate::clock::ClockKind;
use crate::confine::own_cpus;
use crate::outcome::Outcome;
use crate::policy::{ClockChoice, Policy};

/// Who runs where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Places {
    /// CPUs of the runner; the scheduler's choice when empty.
    pub runner: Vec<usize>,
    /// CPU of the supervising thread; the scheduler's choice when absent.
    pub supervisor: Option<usize>,
    /// The hand-off between them.
    pub kind: ClockKind,
}

impl Places {
    /// Of a policy, here: among the CPUs that the calling thread may use and those that the policy names.
    pub fn here(policy: &Policy) -> Result<Self, Outcome> {
        let mut own = own_cpus().map_err(|e| Outcome::fault("Cpu", e))?;
        own.extend(policy.runner_cpu.iter().chain(&policy.supervisor_cpu));
        own.sort_unstable();
        own.dedup();
        Places::of(policy, &own)
    }

    fn of(policy: &Policy, own: &[usize]) -> Result<Self, Outcome> {
        let mut places = match policy.threads {
            0 | 1 => single(policy, own),
            _ => several(policy, own)?,
        };
        match policy.clock {
            ClockChoice::Auto => {}
            ClockChoice::Spin => places.kind = ClockKind::Spin,
            ClockChoice::Futex => places.kind = ClockKind::Futex,
        }
        Ok(places)
    }
}

fn single(policy: &Policy, own: &[usize]) -> Places {
    let apart = match (policy.runner_cpu, policy.supervisor_cpu) {
        (Some(runner), Some(supervisor)) => runner != supervisor,
        _ => own.len() > 1,
    };
    let kind = if apart { ClockKind::Spin } else { ClockKind::Futex };
    Places { runner: policy.runner_cpu.into_iter().collect(), supervisor: policy.supervisor_cpu, kind }
}

/// The supervisor has a CPU of its own where one is left; otherwise it sleeps while the plugin works.
fn several(policy: &Policy, own: &[usize]) -> Result<Places, Outcome> {
    let threads = policy.threads;
    if own.len() < threads {
        let reason = format!(
            "{threads} threads need {threads} CPUs, and this process may use {}; ask for fewer threads or give it more",
            own.len()
        );
        return Err(Outcome::fault("Cpu", reason));
    }
    let supervisor = policy.supervisor_cpu.unwrap_or(own[0]);
    let mut runner: Vec<usize> = own.iter().copied().filter(|cpu| *cpu != supervisor).collect();
    // The one that was named comes first.
    runner.sort_by_key(|cpu| Some(*cpu) != policy.runner_cpu);
    if runner.len() < threads {
        return Ok(Places { runner: own.to_vec(), supervisor: policy.supervisor_cpu, kind: ClockKind::Futex });
    }
    runner.truncate(threads);
    Ok(Places { runner, supervisor: Some(supervisor), kind: ClockKind::Spin })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(threads: usize, own: &[usize]) -> (Vec<usize>, Option<usize>, ClockKind) {
        let Places { runner, supervisor, kind } =
            Places::of(&Policy { threads, ..Policy::default() }, own).expect("enough CPUs");
        (runner, supervisor, kind)
    }

    #[test]
    fn threads_get_cpus_of_their_own_and_the_supervisor_what_is_left() {
        assert_eq!(places(1, &[0, 1]), (vec![], None, ClockKind::Spin));
        assert_eq!(places(1, &[3]), (vec![], None, ClockKind::Futex));
        assert_eq!(places(2, &[0, 1]), (vec![0, 1], None, ClockKind::Futex));
        assert_eq!(places(2, &[0, 1, 2, 5]), (vec![1, 2], Some(0), ClockKind::Spin));
        let named = Policy { threads: 2, runner_cpu: Some(5), supervisor_cpu: Some(2), ..Policy::default() };
        let Places { runner, supervisor, kind } = Places::of(&named, &[0, 1, 2, 5]).expect("enough CPUs");
        assert_eq!((runner, supervisor, kind), (vec![5, 0], Some(2), ClockKind::Spin));
    }

    #[test]
    fn too_few_cpus_are_a_fault_of_the_machine() {
        let policy = Policy { threads: 3, ..Policy::default() };
        let refused = Places::of(&policy, &[0, 1]).expect_err("two CPUs");
        assert!(refused.ours() && refused.to_string().contains("fewer threads"), "{refused}");
    }

    #[test]
    fn a_choice_of_the_clock_is_kept() {
        let policy =
            Policy { clock: ClockChoice::Futex, runner_cpu: Some(1), supervisor_cpu: Some(0), ..Policy::default() };
        let kept = Places { runner: vec![1], supervisor: Some(0), kind: ClockKind::Futex };
        assert_eq!(Places::of(&policy, &[0, 1]), Ok(kept));
    }
}
