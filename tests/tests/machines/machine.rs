//! `ocb work` in a process of its own, on hardware of its own where that matters.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::{Pid, geteuid};
use ocb_tests::place::built;
use ocb_tests::process::command;

use crate::PLUGINS;

/// `ocb work`, killed when it goes out of use.
pub struct Machine {
    child: Child,
    log: PathBuf,
}

impl Machine {
    pub fn start(internal: &str, token: &Path, log: &Path, more: &[&str]) -> Self {
        Self::of(command(built("ocb")), internal, token, log, more)
    }

    /// With a measuring lock of its own, as on hardware of its own: one that stands still keeps the lock.
    pub fn apart(internal: &str, token: &Path, log: &Path) -> Self {
        Self::of(mounted("mount -t tmpfs none /run/lock"), internal, token, log, &[])
    }

    /// On hardware of its own, with no room on its disk for what an order brings.
    pub fn full(internal: &str, token: &Path, log: &Path) -> Self {
        let disk = log.with_extension("disk");
        fs::create_dir_all(&disk).expect("a folder");
        let mut ocb = mounted("mount -t tmpfs none /run/lock && mount -t tmpfs -o nr_inodes=1 none \"$TMPDIR\"");
        ocb.env("TMPDIR", disk);
        Self::of(ocb, internal, token, log, &[])
    }

    fn of(mut ocb: Command, internal: &str, token: &Path, log: &Path, more: &[&str]) -> Self {
        ocb.args(["work", "--server", &format!("http://{internal}"), "--token"]);
        ocb.arg(format!("@{}", token.display())).args(more);
        for plugin in PLUGINS {
            ocb.arg("--plugins").arg(built(plugin));
        }
        let file = File::create(log).expect("a log");
        Self { child: ocb.stderr(file).spawn().expect("it starts"), log: log.to_owned() }
    }

    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    pub fn signal(&self, signal: Signal) {
        kill(Pid::from_raw(self.pid() as i32), signal).expect("it lives");
    }

    pub fn ended(&mut self, within: Duration) -> ExitStatus {
        let end = Instant::now() + within;
        loop {
            if let Some(status) = self.child.try_wait().expect("its state") {
                return status;
            }
            assert!(Instant::now() < end, "it does not end: {}", self.said());
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    pub fn said(&self) -> String {
        fs::read_to_string(&self.log).expect("its log")
    }

    pub fn says(&self, words: &str, within: Duration) {
        let end = Instant::now() + within;
        while !self.said().contains(words) {
            assert!(Instant::now() < end, "it does not say {words:?}: {}", self.said());
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

/// `ocb` behind a mount that only it sees.
fn mounted(mount: &str) -> Command {
    let mut unshare = command("unshare");
    let then = format!("{mount} && exec \"$@\"");
    unshare.arg(if geteuid().is_root() { "-m" } else { "-rm" }).args(["sh", "-c", &then, "sh"]).arg(built("ocb"));
    unshare
}

impl Drop for Machine {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
