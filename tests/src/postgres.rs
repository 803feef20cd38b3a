//! A PostgreSQL of one test's own, which may be stopped and started again.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use nix::unistd::geteuid;
use tempfile::TempDir;

use crate::process::{command, output};
use crate::service::free_address;

/// Dropping it ends it.
pub struct Postgres {
    programs: PathBuf,
    folder: TempDir,
    port: String,
}

impl Postgres {
    /// On a free port of the loopback interface.
    pub fn start() -> Self {
        let versions =
            fs::read_dir("/usr/lib/postgresql").expect("PostgreSQL is not installed: tests/setup/tools.sh test");
        let programs = versions.flatten().map(|version| version.path().join("bin")).max().expect("a version");
        let (folder, address) = (TempDir::new().expect("a folder"), free_address());
        let port = address.rsplit(':').next().expect("a port").to_owned();
        let database = Self { programs, folder, port };
        if geteuid().is_root() {
            output(command("chown").arg("postgres").arg(database.folder.path()));
        }
        let mut made = database.program("initdb");
        output(made.args(["-U", "ocb", "--auth=trust", "--encoding=UTF8", "--locale=C", "-N"]));
        database.start_again();
        database
    }

    /// After a stop.
    pub fn start_again(&self) {
        let folder = self.folder.path().display();
        let settings = format!(
            "-c listen_addresses=127.0.0.1 -c port={} -c fsync=off -c unix_socket_directories={folder}",
            self.port
        );
        let mut started = self.program("pg_ctl");
        output(started.args(["-w", "-t", "60", "-o", &settings, "start", "-l"]).arg(self.folder.path().join("log")));
    }

    /// At once, as when its machine fails: what is under way is lost.
    pub fn stop(&self) {
        output(self.program("pg_ctl").args(["-m", "immediate", "stop"]));
    }

    /// Where it is.
    pub fn url(&self) -> String {
        format!("postgres://ocb@127.0.0.1:{}/postgres", self.port)
    }

    /// It refuses to run as root: then its own user runs it.
    fn program(&self, name: &str) -> Command {
        let program = self.programs.join(name);
        let mut run = match geteuid().is_root() {
            true => command("runuser"),
            false => command(&program),
        };
        if geteuid().is_root() {
            run.args(["-u", "postgres", "--"]).arg(&program);
        }
        run.current_dir(Path::new("/")).arg("-D").arg(self.folder.path().join("data"));
        run
    }
}

impl Drop for Postgres {
    fn drop(&mut self) {
        let _ = self.program("pg_ctl").args(["-m", "immediate", "stop"]).output();
    }
}
