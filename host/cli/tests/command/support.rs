//! Running the binary on a data folder of the test's own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// A data folder and what is run on it.
pub struct Desk {
    folder: TempDir,
}

/// How a command ended.
#[derive(Debug)]
pub struct Ended {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Desk {
    pub fn new() -> Self {
        let folder = Path::new(env!("CARGO_BIN_EXE_ocb")).parent().expect("a folder");
        for file in ["ocb-runner", "libocb_box_tree.so", "libocb_brute_force.so"] {
            let path = folder.join(file);
            assert!(path.exists(), "{} is missing; run `cargo build --release` first", path.display());
        }
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    /// A path in the test's folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A file in the test's folder.
    pub fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> String {
        let path = self.path(name);
        std::fs::write(&path, bytes).expect("a file");
        path.to_str().expect("text").to_owned()
    }

    /// The command, ready to start.
    #[expect(clippy::disallowed_methods, reason = "the test runs the program that it tests")]
    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ocb"));
        for variable in [
            "OCB_DATA",
            "OCB_DATABASE",
            "OCB_BLOBS",
            "OCB_RUNNER",
            "OCB_PLUGINS",
            "OCB_STOCK",
            "OCB_LOG",
            "OCB_MACHINE_NOTE",
        ] {
            command.env_remove(variable);
        }
        command.env("HOME", self.path("home")).env_remove("XDG_DATA_HOME");
        command.args(args).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.arg("--data").arg(self.path("data"));
        command
    }

    /// Runs a command to its end.
    pub fn run(&self, args: &[&str]) -> Ended {
        let Output { status, stdout, stderr } = self.command(args).output().expect("it starts");
        let text = |bytes| String::from_utf8(bytes).expect("text");
        Ended { code: status.code().unwrap_or(-1), stdout: text(stdout), stderr: text(stderr) }
    }

    /// Runs a command that must succeed and gives its JSON, which is all of stdout.
    pub fn json(&self, args: &[&str]) -> Value {
        let ended = self.run(&[args, &["--json"]].concat());
        assert_eq!(ended.code, 0, "{args:?}: {ended:?}");
        serde_json::from_str(&ended.stdout).unwrap_or_else(|e| panic!("{args:?} gave no JSON ({e}): {ended:?}"))
    }

    /// Runs a command that must be refused: exit code 2, nothing on stdout, one sentence on stderr, which it gives.
    pub fn refused(&self, args: &[&str]) -> String {
        let Ended { code, stdout, stderr } = self.run(args);
        assert_eq!((code, stdout.as_str()), (2, ""), "{args:?}: {stderr}");
        let lines: Vec<&str> = stderr.lines().collect();
        assert_eq!(lines.len(), 1, "{args:?}: one sentence, not {stderr:?}");
        assert!(lines[0].starts_with("ocb: ") && lines[0].len() > 15, "{args:?}: {stderr}");
        lines[0].to_owned()
    }
}
