//! A cluster of two nodes on this machine, of the real daemons.

use std::fs::{self, Permissions};
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio, id};
use std::sync::atomic::{AtomicU16, Ordering};
use std::thread::sleep;
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::{Pid, User, getuid};
use ocb_slurm::Slurm;
use tempfile::TempDir;

/// How long the daemons have for what they do in one or two seconds on a machine without other work.
pub const LIMIT: Duration = Duration::from_secs(20);
pub const NODES: usize = 2;
/// As their jobs find them in `SLURMD_NODENAME`.
pub const NAMES: [&str; NODES] = ["n0", "n1"];

/// Ends with everything that it started.
pub struct Cluster {
    munged: Option<Child>,
    controller: Option<Child>,
    nodes: [Option<Child>; NODES],
    folder: TempDir,
}

impl Cluster {
    /// Daemons that are ready for jobs.
    pub fn start() -> Self {
        let programs = ["munged", "slurmctld", "slurmd", "sbatch"];
        let missing: Vec<_> = programs.into_iter().filter(|name| !is_installed(name)).collect();
        let packages = "Debian's packages slurmctld, slurmd, slurm-client and munge";
        assert!(missing.is_empty(), "not run: {missing:?} not installed ({packages})");

        let folder = tempfile::Builder::new().prefix("ocb-slurm-").tempdir().expect("a folder");
        // munged wants its socket where every user can reach it.
        fs::set_permissions(folder.path(), Permissions::from_mode(0o755)).expect("the folder is ours");
        let mut key = vec![0; 128];
        std::io::Read::read_exact(&mut fs::File::open("/dev/urandom").expect("random bytes"), &mut key).expect("bytes");
        fs::write(folder.path().join("key"), key).expect("a key");
        fs::set_permissions(folder.path().join("key"), Permissions::from_mode(0o600)).expect("the key is ours");
        fs::create_dir(folder.path().join("state")).expect("a folder");
        fs::write(folder.path().join("slurm.conf"), configuration(folder.path())).expect("a configuration");

        let mut cluster = Self { munged: None, controller: None, nodes: [const { None }; NODES], folder };
        let file = |option: &str, name: &str| format!("--{option}={}", cluster.path(name).display());
        let files = [file("key-file", "key"), file("socket", "munge"), file("pid-file", "munged.pid")];
        let more = [file("log-file", "munged.log"), file("seed-file", "seed"), "--num-threads=4".to_owned()];
        let words = ["--foreground".to_owned(), "--force".to_owned()].into_iter().chain(files).chain(more);
        cluster.munged = Some(cluster.daemon("munged", &words.collect::<Vec<_>>()));
        wait_for("the socket of munged", || cluster.path("munge").exists().then_some(()));
        cluster.start_controller();
        (0..NODES).for_each(|node| cluster.start_node(node));
        let slurm = cluster.slurm("ocb-none", &["true"]);
        wait_for("both nodes", || slurm.nodes().is_ok_and(|nodes| nodes.free == NODES).then_some(()));
        cluster
    }

    /// Jobs of this name and command in this cluster.
    pub fn slurm(&self, name: &str, command: &[&str]) -> Slurm {
        let command: Vec<String> = command.iter().map(|&word| word.to_owned()).collect();
        Slurm::new("measuring", name, &command).expect("good names").configured_by(self.path("slurm.conf"))
    }

    /// A path in the folder of the cluster.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn start_controller(&mut self) {
        self.controller = Some(self.daemon("slurmctld", &["-D".to_owned()]));
    }

    /// Ends slurmctld by SIGKILL.
    pub fn kill_controller(&mut self) {
        end(&mut self.controller);
    }

    pub fn start_node(&mut self, node: usize) {
        self.nodes[node] = Some(self.daemon("slurmd", &["-D".to_owned(), "-N".to_owned(), NAMES[node].to_owned()]));
    }

    /// Ends the slurmd of a node by SIGKILL. Its jobs run on, as processes of their own.
    pub fn kill_node(&mut self, node: usize) {
        end(&mut self.nodes[node]);
    }

    /// Starts a daemon. The kernel ends it with this thread, so that none is left when the test itself is killed.
    fn daemon(&self, program: &str, words: &[String]) -> Child {
        let log = fs::File::options().create(true).append(true).open(self.path("daemons.log")).expect("a log");
        #[expect(clippy::disallowed_methods, reason = "the test starts the daemons of Slurm")]
        let mut command = Command::new("setpriv");
        command.arg("--pdeathsig=KILL").arg(program).args(words).env("SLURM_CONF", self.path("slurm.conf"));
        command.env("PATH", path_of_daemons()).current_dir("/").stdin(Stdio::null());
        command.stdout(log.try_clone().expect("a log")).stderr(log).spawn().expect("a daemon")
    }

    /// What jobs left: slurmd hands them to processes that outlive it. They are known by their environment.
    fn left_behind(&self) -> Vec<Pid> {
        let ours = format!("SLURM_CONF={}", self.path("slurm.conf").display());
        let processes = fs::read_dir("/proc").expect("processes").filter_map(|entry| {
            let path = entry.ok()?.path();
            let process = path.file_name()?.to_str()?.parse().ok()?;
            let environment = fs::read(path.join("environ")).ok()?;
            environment.split(|&byte| byte == 0).any(|pair| pair == ours.as_bytes()).then_some(Pid::from_raw(process))
        });
        processes.collect()
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let log = fs::read_to_string(self.path("daemons.log")).unwrap_or_default();
            let lines: Vec<_> = log.lines().collect();
            println!("The last of what the daemons said:\n{}", lines[lines.len().saturating_sub(60)..].join("\n"));
        }
        self.nodes.iter_mut().chain([&mut self.controller, &mut self.munged]).for_each(end);
        let until = Instant::now() + LIMIT;
        loop {
            let left = self.left_behind();
            if left.is_empty() || Instant::now() > until {
                return;
            }
            for process in left {
                // It may have ended meanwhile.
                let _ = kill(process, Signal::SIGKILL);
            }
            sleep(Duration::from_millis(20));
        }
    }
}

fn end(daemon: &mut Option<Child>) {
    if let Some(mut daemon) = daemon.take() {
        // Both fail only for a process that has ended and been waited for.
        let _ = daemon.kill();
        let _ = daemon.wait();
    }
}

/// The answer as soon as there is one.
#[track_caller]
pub fn wait_for<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let until = Instant::now() + LIMIT;
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(Instant::now() < until, "no {what} within {} s", LIMIT.as_secs());
        sleep(Duration::from_millis(100));
    }
}

/// Debian's users have no `sbin` in their path.
fn path_of_daemons() -> String {
    format!("{}:/usr/sbin:/sbin", std::env::var("PATH").unwrap_or_default())
}

fn is_installed(program: &str) -> bool {
    path_of_daemons().split(':').any(|folder| Path::new(folder).join(program).is_file())
}

/// Short timeouts: a node is down 5 s after its slurmd was killed, and a program that finds no slurmctld gives up after 1 s.
fn configuration(folder: &Path) -> String {
    let [controller, first, second] = ports();
    let folder = folder.display();
    let user = User::from_uid(getuid()).ok().flatten().map_or_else(|| getuid().to_string(), |user| user.name);
    format!(
        "ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/linear
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
ReturnToService=2
SlurmdTimeout=2
MessageTimeout=2
TCPTimeout=1
InactiveLimit=0
KillWait=1
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
NodeName=n0 NodeHostname=localhost NodeAddr=127.0.0.1 Port={first} CPUs=1
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port={second} CPUs=1
PartitionName=measuring Nodes=n0,n1 OverSubscribe=EXCLUSIVE State=UP Default=YES MaxTime=INFINITE
PartitionName=first Nodes=n0 OverSubscribe=EXCLUSIVE State=UP MaxTime=INFINITE
PartitionName=second Nodes=n1 OverSubscribe=EXCLUSIVE State=UP MaxTime=INFINITE
"
    )
}

/// Ports that are free now, below those that the system gives to connections.
fn ports<const N: usize>() -> [u16; N] {
    static NEXT: AtomicU16 = AtomicU16::new(0);
    // Two programs that look at the same time begin at different places.
    let begin = (id() % 200) as u16 * 50;
    let free = || {
        (0..1000).map(|_| 20_000 + (begin + NEXT.fetch_add(1, Ordering::Relaxed)) % 10_000).find(|&port| {
            // The daemons listen on every address.
            TcpListener::bind(("0.0.0.0", port)).is_ok()
        })
    };
    std::array::from_fn(|_| free().expect("a free port"))
}
