//! What Slurm's programs print, read strictly.

use crate::Error;

/// A job that Slurm has not ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// Its id; later jobs have higher ones.
    pub id: u64,
    /// Where it is.
    pub state: State,
}

/// Where a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It waits for a node.
    Pending,
    /// It has a node, which is being made ready; its command does not run yet.
    Starting,
    /// Its command runs.
    Running,
    /// It is ending, or in a state that we do not know. It may still have its node.
    Ending,
}

/// How many nodes of a partition count. Nodes that are down, drained or do not answer do not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nodes {
    /// Nodes that could begin a job now.
    pub free: usize,
    /// Nodes that run a job, whoever submitted it.
    pub working: usize,
}

impl Nodes {
    /// Both together.
    pub fn usable(&self) -> usize {
        self.free + self.working
    }
}

/// The jobs in the output of `squeue`: `ID STATE` a line.
pub fn jobs(said: &str) -> Result<Vec<Job>, Error> {
    let job = |line: &str| {
        let (id, state) = line.trim().split_once(' ')?;
        Some(Job { id: id.parse().ok()?, state: state_of(state)? })
    };
    said.lines().map(|line| job(line).ok_or_else(|| unreadable("squeue", line))).collect()
}

fn state_of(word: &str) -> Option<State> {
    Some(match word {
        "PENDING" => State::Pending,
        "CONFIGURING" => State::Starting,
        // A suspended job keeps its node, as one does that is being signalled or resized.
        "RUNNING" | "SUSPENDED" | "STOPPED" | "SIGNALING" | "RESIZING" => State::Running,
        _ if word.chars().all(|c| c.is_ascii_uppercase() || c == '_') => State::Ending,
        _ => return None,
    })
}

/// The nodes in the output of `sinfo`: `NAME AVAILABILITY STATE` a line, the availability being that of the partition. `None`
/// when there is no line.
pub fn nodes(said: &str) -> Result<Option<Nodes>, Error> {
    let mut nodes = Nodes::default();
    for line in said.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [_, availability, state] = words[..] else { return Err(unreadable("sinfo", line)) };
        // Of a state such as `idle*`: the word, and a mark. `*` is a node that does not answer.
        let (word, mark) =
            state.split_at(state.find(|c: char| !c.is_ascii_lowercase() && c != '_').unwrap_or(state.len()));
        match (word, mark) {
            ("", _) => return Err(unreadable("sinfo", line)),
            _ if availability != "up" => {}
            // Whatever comes after their jobs: these jobs are among those that `plan` takes off.
            ("allocated" | "mixed" | "completing" | "draining", _) => nodes.working += 1,
            // Powered down to save power, being powered up, or planned for a job.
            ("idle" | "planned", "" | "~" | "#" | "-") => nodes.free += 1,
            _ => {}
        }
    }
    Ok((!said.is_empty()).then_some(nodes))
}

/// The id in the output of `sbatch --parsable`: `ID`, or `ID;CLUSTER`.
pub fn submitted(said: &str) -> Result<u64, Error> {
    let id = said.trim_end().split(';').next().and_then(|id| id.parse().ok());
    id.ok_or_else(|| unreadable("sbatch", said.lines().next().unwrap_or_default()))
}

fn unreadable(program: &'static str, line: &str) -> Error {
    Error::Unreadable { program, line: line.chars().take(200).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jobs_have_ids_and_states() {
        let said = "12 PENDING\n11 RUNNING\n10 COMPLETING\n9 CONFIGURING\n8 SUSPENDED\n7 SOME_NEW_STATE\n";
        let states = [State::Pending, State::Running, State::Ending, State::Starting, State::Running, State::Ending];
        let expected: Vec<_> = (7..=12).rev().zip(states).map(|(id, state)| Job { id, state }).collect();
        assert_eq!(jobs(said).unwrap(), expected);
        assert_eq!(jobs("").unwrap(), []);
        for line in ["12", "12_4 RUNNING", "RUNNING 12", "12 running", "12 RUNNING n0", "-1 RUNNING", "12 ", " "] {
            assert!(jobs(&format!("1 RUNNING\n{line}\n")).is_err(), "{line:?}");
        }
        assert_eq!(jobs("x y").unwrap_err().to_string(), "The output of squeue was not understood: \"x y\".");
    }

    #[test]
    fn nodes_count_that_work_or_could_begin() {
        let of = |states: &[&str]| {
            let lines = states.iter().enumerate().map(|(i, state)| format!("n{i} up {state}\n"));
            nodes(&lines.collect::<String>()).unwrap().unwrap()
        };
        assert_eq!(of(&["idle", "idle~", "idle#", "idle-", "planned"]), Nodes { free: 5, working: 0 });
        assert_eq!(
            of(&["allocated", "allocated*", "mixed", "completing", "draining", "allocated+"]),
            Nodes { free: 0, working: 6 }
        );
        let none =
            ["idle*", "idle$", "idle@", "idle%", "idle!", "down", "down*", "drained", "unknown", "maint", "reserved"];
        assert_eq!(of(&none), Nodes::default());
        assert_eq!(nodes("n0 down idle\nn1 up idle\n").unwrap(), Some(Nodes { free: 1, working: 0 }));
        assert_eq!(nodes("").unwrap(), None);
        for line in ["n0 idle", "n0 up idle more", "n0 up *", ""] {
            assert!(nodes(&format!("{line}\nn1 up idle\n")).is_err(), "{line:?}");
        }
    }

    #[test]
    fn sbatch_says_one_id() {
        assert_eq!(submitted("123\n").unwrap(), 123);
        assert_eq!(submitted("123;cluster\n").unwrap(), 123);
        for said in ["", "\n", "Submitted batch job 123\n", "123\n124\n", ";cluster\n"] {
            assert!(submitted(said).is_err(), "{said:?}");
        }
    }
}
