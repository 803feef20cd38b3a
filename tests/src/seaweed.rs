//! A store of files (S3, SeaweedFS) of one test's own, which may be killed and started again.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Child;
use std::sync::Mutex;

use tempfile::TempDir;

use crate::process::{command, output};
use crate::service::free_address;

const KEY: &str = "test";
const BUCKET: &str = "ocb";

/// Dropping it ends it.
pub struct Seaweed {
    folder: TempDir,
    /// Of the master, the volume, the filer and S3, and each once more for gRPC.
    ports: Vec<String>,
    running: Mutex<Child>,
}

impl Seaweed {
    /// On free ports of the loopback interface, with an empty bucket.
    pub fn start() -> Self {
        let folder = TempDir::new().expect("a folder");
        let port = |address: String| address.rsplit(':').next().expect("a port").to_owned();
        let ports: Vec<String> = (0..8).map(|_| port(free_address())).collect();
        let running = Mutex::new(run(folder.path(), &ports));
        let bucket = format!("http://127.0.0.1:{}/{BUCKET}", ports[3]);
        let store = Self { folder, ports, running };
        // It listens some seconds before all of it is there.
        let patient = ["--retry", "60", "--retry-delay", "1", "--retry-connrefused", "--retry-all-errors"];
        let signed = ["--aws-sigv4", "aws:amz:us-east-1:s3", "--user", "test:test"];
        let mut put = command("curl");
        output(put.args(["-sS", "--fail", "--noproxy", "*", "-X", "PUT"]).args(patient).args(signed).arg(bucket));
        store
    }

    /// Kills it at once and starts it again; it answers after some twenty seconds.
    pub fn kill_and_start_again(&self) {
        let mut running = self.running.lock().expect("nobody failed");
        running.kill().expect("it runs");
        running.wait().expect("it has ended");
        *running = run(self.folder.path(), &self.ports);
    }

    /// As `ocb serve --blobs` takes it.
    pub fn address(&self) -> String {
        format!("s3://{KEY}:{KEY}@{BUCKET}?endpoint=http://127.0.0.1:{}", self.ports[3])
    }
}

fn run(folder: &Path, ports: &[String]) -> Child {
    let program = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.tools/seaweedfs/bin/weed"));
    assert!(program.exists(), "SeaweedFS is not installed: tests/setup/tools.sh test");
    let names = ["master.port", "volume.port", "filer.port", "s3.port"];
    let log = File::options().create(true).append(true).open(folder.join("log")).expect("a log");
    let mut weed = command(program);
    weed.args([
        "-logtostderr=true",
        "server",
        "-ip=127.0.0.1",
        "-ip.bind=127.0.0.1",
        "-filer",
        "-s3",
        "-s3.port.iceberg=0",
    ]);
    weed.args(["-master.volumeSizeLimitMB=64", "-volume.max=20"]).arg(format!("-dir={}", folder.display()));
    for (i, name) in names.into_iter().enumerate() {
        weed.arg(format!("-{name}={}", ports[i])).arg(format!("-{name}.grpc={}", ports[4 + i]));
    }
    weed.env("AWS_ACCESS_KEY_ID", KEY).env("AWS_SECRET_ACCESS_KEY", KEY).stderr(log);
    weed.spawn().expect("it starts")
}

impl Drop for Seaweed {
    fn drop(&mut self) {
        if let Ok(mut running) = self.running.lock() {
            let _ = running.kill();
            let _ = running.wait();
        }
    }
}
