//! How many jobs there should be; pure.

use crate::{Job, State};

/// What is to be done.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// How many jobs to submit.
    pub submit: usize,
    /// Which pending jobs to cancel.
    pub cancel: Vec<u64>,
}

/// A job for each waiting run, but no more than one for each free node and one more, which begins as soon as the next node is
/// free. (If all runs had a job, thousands would wait in Slurm, and each would be one that Slurm can forget.) Superfluous
/// pending jobs are cancelled, the latest first. Jobs that run stay: they take whichever run is next.
///
/// `usable_nodes` are those that work or could begin a job. Which of them are free is derived from the jobs: two lists that
/// are read one after the other disagree about a job that starts in between. A node that runs a job of another user looks
/// free, and then one more of our jobs waits.
pub fn plan(waiting_runs: usize, jobs: &[Job], usable_nodes: usize) -> Plan {
    let count = |state| jobs.iter().filter(|job| job.state == state).count();
    let free_nodes = usable_nodes.saturating_sub(count(State::Running) + count(State::Ending));
    let wanted = waiting_runs.min(free_nodes + 1);
    let mut pending: Vec<u64> = jobs.iter().filter(|job| job.state == State::Pending).map(|job| job.id).collect();
    let without_run = pending.len() + count(State::Starting);
    pending.sort_unstable();
    let stay = pending.len().saturating_sub(without_run.saturating_sub(wanted));
    Plan { submit: wanted.saturating_sub(without_run), cancel: pending.split_off(stay) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Jobs from a word of states, `p` pending, `s` starting, `r` running, `e` ending, with ids from 1.
    fn jobs(states: &str) -> Vec<Job> {
        let state = |letter| match letter {
            'p' => State::Pending,
            's' => State::Starting,
            'r' => State::Running,
            _ => State::Ending,
        };
        (1..).zip(states.chars()).map(|(id, letter)| Job { id, state: state(letter) }).collect()
    }

    #[track_caller]
    fn check(waiting_runs: usize, states: &str, nodes: usize, submit: usize, cancel: &[u64]) {
        assert_eq!(plan(waiting_runs, &jobs(states), nodes), Plan { submit, cancel: cancel.to_vec() });
    }

    #[test]
    fn each_free_node_gets_a_job_and_one_more_waits() {
        check(5, "", 2, 3, &[]);
        check(5, "r", 2, 2, &[]);
        check(5, "rr", 2, 1, &[]);
        check(5, "rrp", 2, 0, &[]);
        check(5, "ppp", 2, 0, &[]);
    }

    #[test]
    fn no_more_jobs_than_runs() {
        check(0, "", 2, 0, &[]);
        check(1, "", 2, 1, &[]);
        check(1, "rr", 2, 1, &[]);
        check(2, "p", 2, 1, &[]);
    }

    #[test]
    fn superfluous_pending_jobs_are_cancelled_the_latest_first() {
        check(0, "rrp", 2, 0, &[3]);
        check(1, "ppp", 2, 0, &[2, 3]);
        check(9, "ppppr", 2, 0, &[3, 4]);
        let mut mixed = jobs("ppp");
        mixed.reverse();
        assert_eq!(plan(2, &mixed, 2).cancel, [3]);
    }

    #[test]
    fn jobs_that_have_a_node_are_never_cancelled() {
        check(0, "rr", 2, 0, &[]);
        check(0, "ses", 2, 0, &[]);
        check(0, "rs", 0, 0, &[]);
        check(1, "ssp", 2, 0, &[3]);
    }

    #[test]
    fn a_job_that_starts_has_yet_to_take_a_run() {
        check(5, "ssp", 2, 0, &[]);
        check(5, "s", 2, 2, &[]);
        check(2, "s", 2, 1, &[]);
    }

    #[test]
    fn a_job_that_ends_has_its_node_still() {
        check(5, "re", 2, 1, &[]);
        check(5, "rep", 2, 0, &[]);
    }

    #[test]
    fn without_nodes_one_job_waits_for_the_first() {
        check(5, "", 0, 1, &[]);
        check(5, "p", 0, 0, &[]);
        check(5, "ppp", 0, 0, &[2, 3]);
        // More of our jobs than nodes: one has died under its job, and Slurm has not noticed it.
        check(5, "rrp", 1, 0, &[]);
    }

    #[test]
    fn one_step_brings_the_right_number() {
        for waiting_runs in 0..6 {
            for nodes in 0..4 {
                for pattern in 0..4_usize.pow(4) {
                    let letter = |i: u32| char::from(b"psre"[pattern / 4_usize.pow(i) % 4]);
                    let mut all = jobs(&(0..4).map(letter).collect::<String>());
                    let plan = plan(waiting_runs, &all, nodes);
                    assert!(plan.submit == 0 || plan.cancel.is_empty());
                    all.retain(|job| !plan.cancel.contains(&job.id));
                    all.extend((5..).take(plan.submit).map(|id| Job { id, state: State::Pending }));
                    assert_eq!(super::plan(waiting_runs, &all, nodes), Plan::default(), "{all:?}");
                }
            }
        }
    }
}
