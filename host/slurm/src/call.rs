//! One call of a program of Slurm, with a time limit.

use std::io::{ErrorKind, Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread::{sleep, spawn};
use std::time::{Duration, Instant};

use crate::Error;

/// No list is longer: a job or a node takes some tens of bytes.
const LARGEST: u64 = 16 << 20;
/// Calls take from 8 ms.
const LOOK: Duration = Duration::from_millis(2);

/// What the program writes to stdout, when it ends well and in time.
pub fn call(program: &'static str, mut command: Command, input: &str, limit: Duration) -> Result<String, Error> {
    let until = Instant::now() + limit;
    let not_started = |cause: std::io::Error| match cause.kind() {
        ErrorKind::NotFound => Error::Missing(program),
        _ => Error::NotStarted { program, cause },
    };
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(not_started)?;
    // Threads read and write, so that no full pipe keeps us or the program waiting. They end when the program has ended.
    let (stdin, input) = (child.stdin.take(), input.to_owned());
    // A program that reads nothing closes the pipe, and says by its status whether that was right.
    spawn(move || stdin.map(|mut pipe| pipe.write_all(input.as_bytes())));
    let (stdout, stderr) = (text_of(child.stdout.take()), text_of(child.stderr.take()));
    let late = || Error::Late { program, limit };
    let status = ended(&mut child, until).ok_or_else(late)?;
    let text = |pipe: Receiver<Vec<u8>>| {
        let bytes = pipe.recv_timeout(until.saturating_duration_since(Instant::now())).map_err(|_| late())?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    let (stdout, stderr) = (text(stdout)?, text(stderr)?);
    if status.success() {
        return Ok(stdout);
    }
    Err(Error::Failed { program, status, said: stderr.lines().map(|line| line.trim().to_owned()).collect() })
}

/// How the program ended; `None` when it had to be killed.
fn ended(child: &mut Child, until: Instant) -> Option<ExitStatus> {
    loop {
        if let Ok(Some(status)) = child.try_wait() {
            return Some(status);
        }
        if Instant::now() >= until {
            // Both fail only for a program that has ended and been waited for.
            let _ = child.kill();
            let _ = child.wait();
            return None;
        }
        sleep(LOOK);
    }
}

fn text_of(pipe: Option<impl Read + Send + 'static>) -> Receiver<Vec<u8>> {
    let (sender, receiver) = channel();
    spawn(move || {
        let mut bytes = Vec::new();
        // What was read before an error is shown as what it is: output that is not understood.
        let _ = pipe.map(|pipe| pipe.take(LARGEST).read_to_end(&mut bytes));
        sender.send(bytes)
    });
    receiver
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sh(script: &str, input: &str, limit: Duration) -> Result<String, Error> {
        #[expect(clippy::disallowed_methods, reason = "the test plays a program of Slurm")]
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        call("sbatch", command, input, limit)
    }

    const LONG: Duration = Duration::from_secs(20);

    #[test]
    fn input_goes_in_and_output_comes_out() {
        assert_eq!(sh("cat; echo more >&2", "some\nlines\n", LONG).unwrap(), "some\nlines\n");
        // More than a pipe holds, and the program reads none of it.
        assert_eq!(sh("echo done", &"x".repeat(1 << 20), LONG).unwrap(), "done\n");
        assert_eq!(sh("head -c 1000000 /dev/zero >&2; echo done", "", LONG).unwrap(), "done\n");
    }

    #[test]
    fn a_failure_says_why() {
        let failed = sh("echo 'sbatch: error: No partition' >&2; echo more >&2; exit 3", "", LONG).unwrap_err();
        assert_eq!(failed.to_string(), "sbatch failed: No partition.");
        let killed = sh("kill -9 $$", "", LONG).unwrap_err();
        assert_eq!(killed.to_string(), "sbatch failed: signal: 9 (SIGKILL), without a word.");
    }

    #[test]
    fn a_program_that_takes_too_long_is_killed() {
        let began = Instant::now();
        let late = sh("exec sleep 60", "", Duration::from_millis(200)).unwrap_err();
        assert_eq!(
            late.to_string(),
            "sbatch did not end within 0.2 s and was killed: is slurmctld down, or slurm.conf missing?"
        );
        // It has ended itself, and a process that it left behind holds the pipe.
        let late = sh("sleep 3 & exit 0", "", Duration::from_millis(200)).unwrap_err();
        assert!(matches!(late, Error::Late { .. }), "{late}");
        assert!(began.elapsed() < Duration::from_secs(3));
    }

    #[test]
    fn a_program_that_is_missing_is_named_with_its_package() {
        #[expect(clippy::disallowed_methods, reason = "there is none")]
        let none = call("sbatch", Command::new("ocb-no-such-program"), "", LONG).unwrap_err();
        assert_eq!(none.to_string(), "sbatch is not installed; it comes with Debian's package slurm-client.");
        #[expect(clippy::disallowed_methods, reason = "it is a folder")]
        let folder = call("sbatch", Command::new("/"), "", LONG).unwrap_err();
        assert_eq!(folder.to_string(), "sbatch cannot be started: Permission denied (os error 13).");
    }
}
