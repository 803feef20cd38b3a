//! A real mail server of our own, which keeps what it takes, and servers that do not behave.

use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use ocb_service::{MailServer, Pace};
use serde_json::Value;
use tempfile::TempDir;

/// Where the mails of these tests come from.
pub const FROM: &str = "ocb@example.org";
/// Where their links lead.
pub const PAGES: &str = "https://ocb.example.org";

/// A place for a mail server: its port, and what was taken there.
pub struct Post {
    port: u16,
    folder: TempDir,
    server: Option<Child>,
}

impl Post {
    /// With a server in this mode (`tests/setup/mail_server.py` lists them).
    pub async fn open(mode: &str) -> Self {
        let mut post = Self::closed();
        post.serve(mode).await;
        post
    }

    /// With a server in this mode that has this certificate and key.
    pub async fn certified(mode: &str, certificate: &[PathBuf; 2]) -> Self {
        let mut post = Self::closed();
        post.serve_certified(mode, certificate).await;
        post
    }

    /// Nobody listens there yet.
    pub fn closed() -> Self {
        let port = TcpListener::bind("127.0.0.1:0").and_then(|l| l.local_addr()).expect("a free port").port();
        Self::at(port)
    }

    /// At this port, where somebody else listens.
    pub fn at(port: u16) -> Self {
        Self { port, folder: tempfile::tempdir().expect("a temporary folder"), server: None }
    }

    /// Starts the server and waits until it listens.
    pub async fn serve(&mut self, mode: &str) {
        self.serve_certified(mode, &[]).await;
    }

    #[expect(clippy::disallowed_methods, reason = "the test starts the mail server that it talks to")]
    async fn serve_certified(&mut self, mode: &str, certificate: &[PathBuf]) {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let python = root.join(".tools/smtp/bin/python");
        assert!(python.exists(), "the mail server for tests is missing: run tests/setup/tools.sh test");
        let mut command = Command::new(python);
        command.arg(root.join("tests/setup/mail_server.py")).arg(self.port.to_string());
        command.arg(self.folder.path()).arg(mode).args(certificate);
        self.server = Some(command.spawn().expect("the mail server starts"));
        let end = Instant::now() + Duration::from_secs(30);
        while tokio::net::TcpStream::connect(("127.0.0.1", self.port)).await.is_err() {
            assert!(Instant::now() < end, "the mail server does not listen");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Who takes our mails, impatient enough for tests.
    pub fn server(&self) -> MailServer {
        self.as_user("")
    }

    /// The same, known there as somebody: `name:password@`.
    pub fn as_user(&self, user: &str) -> MailServer {
        self.reached_by("smtp", user)
    }

    /// The same, by `smtp` or `smtps`.
    pub fn reached_by(&self, scheme: &str, user: &str) -> MailServer {
        let url = format!("{scheme}://{user}127.0.0.1:{}", self.port);
        let mut server = MailServer::new(&url, FROM, PAGES).expect("a mail server");
        server.pace = Pace {
            delivery: Duration::from_secs(5),
            first_wait: Duration::from_millis(200),
            give_up: Duration::from_secs(3600),
            link: Duration::from_secs(3600),
            off: Duration::from_secs(3600),
        };
        server
    }

    /// What was heard unencrypted.
    pub fn heard_in_the_clear(&self) -> String {
        std::fs::read_to_string(self.folder.path().join("clear")).unwrap_or_default()
    }

    /// What was taken, in its order.
    pub fn taken(&self) -> Vec<Value> {
        let files = std::fs::read_dir(self.folder.path()).expect("a folder").flatten().map(|file| file.path());
        let mut files: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == "json")).collect();
        files.sort();
        let read = |path| serde_json::from_slice(&std::fs::read(path).expect("a mail")).expect("JSON");
        files.into_iter().map(read).collect()
    }

    /// Waits for so many mails, and a while longer: no more come.
    pub async fn exactly(&self, count: usize) -> Vec<Value> {
        let end = Instant::now() + Duration::from_secs(60);
        while self.taken().len() < count {
            assert!(Instant::now() < end, "waited in vain for {count} mails: {:#?}", self.taken());
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
        tokio::time::sleep(Duration::from_millis(800)).await;
        let taken = self.taken();
        assert_eq!(taken.len(), count, "{taken:#?}");
        taken
    }
}

impl Drop for Post {
    fn drop(&mut self) {
        if let Some(mut server) = self.server.take() {
            let _ = server.kill();
            let _ = server.wait();
        }
    }
}
