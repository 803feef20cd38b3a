//! Starting programs from tests.

use std::process::Command;

/// A command to run.
#[expect(clippy::disallowed_methods, reason = "tests start the programs that they test, and git")]
pub fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    Command::new(program)
}

/// Standard output of a command that must succeed.
pub fn output(command: &mut Command) -> String {
    let done = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    assert!(done.status.success(), "{command:?}: {}\n{}", done.status, String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).expect("the output is text")
}
