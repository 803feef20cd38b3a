//! An authority of a test's own, and certificates by it.

use std::path::PathBuf;
use std::process::Command;

use tempfile::TempDir;

/// How the authority's own certificate is made. `openssl` has settings of its own in a file of the machine's, which are left out.
const SETTINGS: &str = "[req]\ndistinguished_name = name\nprompt = no\n[name]\nCN = somebody\n\
    [authority]\nbasicConstraints = critical, CA:TRUE\nkeyUsage = critical, keyCertSign\n";

/// Somebody who vouches for servers.
pub struct Authority {
    folder: TempDir,
}

impl Authority {
    pub fn new() -> Self {
        let authority = Self { folder: tempfile::tempdir().expect("a temporary folder") };
        std::fs::write(authority.folder.path().join("settings"), SETTINGS).expect("a file");
        authority.openssl(
            "req -x509 -config settings -extensions authority -days 2 -newkey ec \
            -pkeyopt ec_paramgen_curve:P-256 -nodes -keyout authority.key -out authority.pem -subj /CN=authority",
        );
        authority
    }

    /// Its own certificate.
    pub fn pem(&self) -> Vec<u8> {
        std::fs::read(self.folder.path().join("authority.pem")).expect("a certificate")
    }

    /// A certificate and its key for a server of this name, such as `IP:127.0.0.1` or `DNS:mail.example.org`.
    pub fn certificate(&self, name: &str) -> [PathBuf; 2] {
        std::fs::write(self.folder.path().join("names"), format!("subjectAltName = {name}\n")).expect("a file");
        let file = name.replace([':', '.'], "-");
        self.openssl(&format!(
            "req -new -config settings -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -keyout {file}.key \
             -out {file}.csr -subj /CN=server"
        ));
        self.openssl(&format!(
            "x509 -req -in {file}.csr -CA authority.pem -CAkey authority.key -CAcreateserial -days 2 -extfile names \
             -out {file}.pem"
        ));
        ["pem", "key"].map(|kind| self.folder.path().join(format!("{file}.{kind}")))
    }

    #[expect(clippy::disallowed_methods, reason = "the test makes the certificates that it talks about")]
    fn openssl(&self, arguments: &str) {
        let mut command = Command::new("openssl");
        let made = command.args(arguments.split_whitespace()).current_dir(self.folder.path()).output();
        let made = made.expect("openssl is there: tests/setup/tools.sh test");
        assert!(made.status.success(), "{arguments}: {}", String::from_utf8_lossy(&made.stderr));
    }
}
