//! Mails to servers with certificates: by whom, for whom, and what is said when somebody else answers.

use std::io;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use ocb_service::MailServer;
use ocb_service::model::Role;
use tracing::subscriber::DefaultGuard;

use crate::authority::Authority;
use crate::mail::given;
use crate::mail_server::Post;
use crate::people::member;
use crate::support::Service;

/// The name of the server that these tests talk to.
const HERE: &str = "IP:127.0.0.1";
/// How its lock is opened.
const USER: &str = "ada:s%3Acret@";

/// What this thread logs as long as it is there.
struct Log {
    lines: Arc<Mutex<Vec<u8>>>,
    _guard: DefaultGuard,
}

struct Sink(Arc<Mutex<Vec<u8>>>);

impl io::Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Log {
    fn open() -> Self {
        let lines = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&lines);
        let writer = move || Sink(Arc::clone(&sink));
        let subscriber = tracing_subscriber::fmt().with_ansi(false).with_writer(writer).finish();
        Self { lines, _guard: tracing::subscriber::set_default(subscriber) }
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.lines.lock().unwrap_or_else(PoisonError::into_inner)).into_owned()
    }

    /// Waits for a line with this in it, and gives it.
    async fn line(&self, part: &str) -> String {
        let end = Instant::now() + Duration::from_secs(60);
        loop {
            if let Some(line) = self.text().lines().find(|line| line.contains(part)) {
                return line.to_owned();
            }
            assert!(Instant::now() < end, "{part:?} is not logged: {}", self.text());
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    fn forget(&self) {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }
}

fn trusting(server: MailServer, authority: &Authority) -> MailServer {
    server.trusting(&authority.pem()).expect("a certificate")
}

#[tokio::test]
async fn a_mail_goes_through_tls_to_a_server_that_is_vouched_for() {
    let authority = Authority::new();
    let certificate = authority.certificate(HERE);
    let early = Post::certified("starttls", &certificate).await;
    let service = Service::start_mailing(trusting(early.reached_by("smtp", USER), &authority)).await;
    let ada = member(&service, "ada", Role::User).await;
    given(&ada, "ada@example.org").await;
    let mails = early.exactly(1).await;
    assert_eq!((&mails[0]["encrypted"], &mails[0]["to"][0]), (&true.into(), &"ada@example.org".into()));
    let heard = early.heard_in_the_clear();
    let polite = |line: &str| line.starts_with("EHLO ") || line == "STARTTLS";
    assert!(heard.contains("STARTTLS") && heard.lines().all(polite), "{heard}");

    let wrapped = Post::certified("tls", &certificate).await;
    let service = service.restart_mailing(trusting(wrapped.reached_by("smtps", USER), &authority)).await;
    let bob = member(&service, "bob", Role::User).await;
    given(&bob, "bob@example.org").await;
    let mails = wrapped.exactly(1).await;
    assert_eq!((&mails[0]["encrypted"], &mails[0]["to"][0]), (&true.into(), &"bob@example.org".into()));
    assert_eq!(wrapped.heard_in_the_clear(), "");
    service.stop().await;
}

#[tokio::test]
async fn nothing_is_said_to_a_server_that_nobody_trusted_vouches_for() {
    let log = Log::open();
    let (ours, theirs) = (Authority::new(), Authority::new());
    let (certificate, of_another) = (ours.certificate(HERE), ours.certificate("DNS:mail.example.org"));
    let vouches = "cannot verify the certificate of 127.0.0.1:";
    let names = "is for another host";
    for (mode, scheme, trusted, certificate, expected) in [
        ("starttls", "smtp", &theirs, &certificate, vouches),
        ("tls", "smtps", &theirs, &certificate, vouches),
        ("starttls", "smtp", &ours, &of_another, names),
        ("tls", "smtps", &ours, &of_another, names),
    ] {
        let post = Post::certified(mode, certificate).await;
        log.forget();
        let service = Service::start_mailing(trusting(post.reached_by(scheme, USER), trusted)).await;
        given(&member(&service, "ada", Role::User).await, "ada@example.org").await;
        let told = log.line(expected).await;
        assert!(told.contains("a mail to account") && told.contains("nothing was sent"), "{told}");
        assert!(!told.contains("cret") && !told.contains("ada@example.org"), "{told}");
        post.exactly(0).await;
        let heard = post.heard_in_the_clear();
        assert!(heard.lines().all(|line| line.starts_with("EHLO ") || line == "STARTTLS"), "{mode}: {heard}");
        service.stop().await;
    }
    // Nobody is named at all.
    let post = Post::certified("tls", &certificate).await;
    log.forget();
    let service = Service::start_mailing(post.reached_by("smtps", USER)).await;
    given(&member(&service, "ada", Role::User).await, "ada@example.org").await;
    log.line("a mail to account").await;
    post.exactly(0).await;
    // It was kept until somebody mends it.
    let service = service.restart_mailing(trusting(post.reached_by("smtps", USER), &ours)).await;
    post.exactly(1).await;
    service.stop().await;
}
