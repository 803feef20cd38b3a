//! Why a call failed, one sentence each.

use std::io;
use std::process::ExitStatus;
use std::time::Duration;

/// Why a call failed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A name of a partition or of jobs that Slurm would read as something else.
    #[error("{0:?} cannot name a partition or a job: only letters, digits, '-', '_', '.'.")]
    Name(String),
    /// A command without a program, or with characters that have no place in a script.
    #[error("{0:?} cannot be the command of a job: it needs a program, and has no control characters.")]
    Command(Vec<String>),
    /// There is no such program.
    #[error("{0} is not installed; it comes with Debian's package slurm-client.")]
    Missing(&'static str),
    /// The system did not start the program.
    #[error("{program} cannot be started: {cause}.")]
    NotStarted {
        /// Which program.
        program: &'static str,
        /// What the system says.
        cause: io::Error,
    },
    /// The program ended with a failure.
    #[error("{program} failed: {}.", first(.said, .status))]
    Failed {
        /// Which program.
        program: &'static str,
        /// How it ended.
        status: ExitStatus,
        /// The lines that it wrote to stderr.
        said: Vec<String>,
    },
    /// The program did not end in time, and was killed. What it was to do may have been done.
    #[error("{program} did not end within {} s and was killed: is slurmctld down, or slurm.conf missing?", .limit.as_secs_f64())]
    Late {
        /// Which program.
        program: &'static str,
        /// Its time limit.
        limit: Duration,
    },
    /// The program wrote something that does not have the expected form.
    #[error("The output of {program} was not understood: {line:?}.")]
    Unreadable {
        /// Which program.
        program: &'static str,
        /// The first line that was not understood.
        line: String,
    },
    /// Slurm lists no node of the partition.
    #[error("Slurm knows no nodes of the partition {0}.")]
    Partition(String),
}

/// The first line that says something of the cause, without the name of the program.
fn first(said: &[String], status: &ExitStatus) -> String {
    // Where munged is down, its client advises to restart it with more threads before it says that it is down.
    let line = said.iter().find(|line| !line.is_empty() && !line.contains("If munged is up, restart"));
    let line = line.map(|line| line.rsplit_once(" error: ").map_or(line.as_str(), |(_, line)| line));
    line.map_or_else(|| format!("{status}, without a word"), |line| line.trim_end_matches('.').to_owned())
}

#[cfg(test)]
mod tests {
    use std::os::unix::process::ExitStatusExt;

    use super::*;

    #[test]
    fn the_sentence_of_a_failure_is_its_first_line() {
        let of = |said: &[&str]| {
            let said = said.iter().map(|&line| line.to_owned()).collect();
            Error::Failed { program: "sbatch", status: ExitStatus::from_raw(256), said }.to_string()
        };
        let refused =
            ["sbatch: error: invalid partition specified: nope", "sbatch: error: Batch job submission failed."];
        assert_eq!(of(&refused), "sbatch failed: invalid partition specified: nope.");
        let down = "slurm_load_jobs error: Unable to contact slurm controller (connect failure)";
        assert_eq!(of(&[down]), "sbatch failed: Unable to contact slurm controller (connect failure).");
        let munge =
            ["sinfo: error: If munged is up, restart with --num-threads=10", "sinfo: error: Munge encode failed."];
        assert_eq!(of(&munge), "sbatch failed: Munge encode failed.");
        assert_eq!(of(&[]), "sbatch failed: exit status: 1, without a word.");
    }
}
