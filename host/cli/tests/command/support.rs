//! Running the binary on a data folder of the test's own.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;

/// A data folder and what is run on it.
pub struct Desk {
    folder: TempDir,
    /// The plugins that are there; every one that is built when none is named.
    plugins: &'static [&'static str],
}

/// The plugins that most tests ask. To describe all of them takes longer than most tests.
const OURS: &[&str] = &["libocb_box_tree.so", "libocb_brute_force.so", "libocb_fast.so"];

/// The password of every account.
const PASSWORD: &str = "a long enough password";

/// How a command ended.
#[derive(Debug)]
pub struct Ended {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Desk {
    pub fn new() -> Self {
        Self::with(OURS)
    }

    /// With these plugins, or with every one beside the program, as it is where none is named.
    pub fn with(plugins: &'static [&'static str]) -> Self {
        for path in ["ocb-runner"].iter().chain(plugins).map(|name| built(name)) {
            assert!(path.exists(), "{} is missing; run `cargo build --release` first", path.display());
        }
        Self { folder: tempfile::tempdir().expect("a temporary folder"), plugins }
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
        if !self.plugins.is_empty() {
            let plugins: Vec<String> = self.plugins.iter().map(|name| built(name).display().to_string()).collect();
            command.env("OCB_PLUGINS", plugins.join(":"));
        }
        command.args(args).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.arg("--data").arg(self.path("data"));
        command
    }

    /// Makes an account.
    pub fn account(&self, name: &str) {
        let made = self.command(&["admin", "create", name]).env("OCB_PASSWORD", PASSWORD).output().expect("it starts");
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
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

/// A file beside the program.
fn built(name: &str) -> PathBuf {
    Path::new(env!("CARGO_BIN_EXE_ocb")).with_file_name(name)
}

/// A service on a data folder of its own; ends when dropped.
pub struct Serving {
    child: Child,
    pub url: String,
}

impl Serving {
    pub fn start(desk: &Desk) -> Self {
        let mut child =
            desk.command(&["serve", "--address", "127.0.0.1:0", "--json", "--idle", "off"]).spawn().expect("it starts");
        let lines = BufReader::new(child.stdout.take().expect("stdout")).lines().map_while(Result::ok);
        let url = lines.into_iter().find_map(|line| {
            let (_, rest) = line.split_once("http://")?;
            rest.split('"').next().map(|address| format!("http://{address}"))
        });
        Self { child, url: url.expect("an address") }
    }

    /// A token of this account for runs and objects, and a way to send JSON as the account.
    pub fn log_in(&self, name: &str) -> (String, impl Fn(&str, Value) -> Value) {
        let client = reqwest::blocking::Client::builder().cookie_store(true).build().expect("a client");
        let url = self.url.clone();
        let post = move |path: &str, body: Value| {
            let sent = client.post(format!("{url}/api/v1{path}")).json(&body).send().expect("an answer");
            assert!(sent.status().is_success(), "{path}: {}", sent.status());
            sent.json::<Value>().expect("JSON")
        };
        post("/account/login", json!({ "name": name, "password": PASSWORD }));
        let token = post("/account/tokens", json!({ "name": "t", "scopes": ["runs"] }));
        (token["secret"].as_str().expect("a secret").to_owned(), post)
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
