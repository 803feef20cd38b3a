//! Machines measure for a service (`ocb serve --internal`, `ocb work`), and machine or service fail at the worst moment.

mod errands;
mod fair;
mod machine;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use machine::Machine;
use nix::sys::signal::Signal;
use ocb_tests::place::built;
use ocb_tests::postgres::Postgres;
use ocb_tests::process::{command, output};
use ocb_tests::seaweed::Seaweed;
use ocb_tests::service::{Guest, Service, free_address, runner_below};
use ocb_tests::wire::Wire;
use serde_json::{Value, json};
use tempfile::TempDir;

const PLUGINS: [&str; 3] = ["libocb_brute_force.so", "libocb_box_tree.so", "libocb_parry.so"];
/// Beside other programs, what the sentinel takes says nothing about the machine.
const ANY_DRIFT: &str = "100000";
/// How long the service believes that a silent machine lives.
const LEASE: Duration = Duration::from_secs(20);

/// Most tests share a data folder, one after the other: a machine measures the sentinel only once there.
static ALONE: Mutex<()> = Mutex::new(());

/// A service that does not measure by itself, on the shared data folder.
struct Site {
    _alone: MutexGuard<'static, ()>,
    data: PathBuf,
    internal: String,
    service: Option<Service>,
    guest: Guest,
}

impl Site {
    fn open() -> Self {
        let alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let data = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("machines-{}", std::process::id()));
        let mut site = Self { _alone: alone, internal: free_address(), service: None, guest: Guest::default(), data };
        let new = !site.data.exists();
        site.start();
        if new {
            // The usual hardware class is that of the machine that was allowed first.
            site.machine("first").says("a query of the sentinel takes", Duration::from_secs(180));
        }
        site
    }

    fn start(&mut self) {
        let internal = self.internal.clone();
        self.service =
            Some(Service::start_saying(&self.data, &PLUGINS, &["--internal", &internal, "--most-drift", ANY_DRIFT]));
    }

    fn service(&self) -> &Service {
        self.service.as_ref().expect("it was started")
    }

    /// `ocb admin` needs the data folder for itself.
    fn admin(&mut self, arguments: &[&str]) -> String {
        let stopped = self.service.take().map(Service::kill).is_some();
        let said = output(command(built("ocb")).arg("--data").arg(&self.data).arg("admin").args(arguments));
        if stopped {
            self.start();
        }
        said
    }

    /// The token of a machine, in a file.
    fn token(&mut self, name: &str) -> PathBuf {
        let file = self.data.join(format!("{name}.token"));
        if !file.exists() {
            let token = self.admin(&["machine", name]);
            fs::write(&file, token).expect("the token is written");
        }
        file
    }

    /// Starts a machine.
    fn machine(&mut self, name: &str) -> Machine {
        let token = self.token(name);
        Machine::start(&self.internal, &token, &self.data.join(format!("{name}.log")), &[])
    }

    fn submit(&self, budget_seconds: f64) -> String {
        self.guest.submit(self.service(), &spec(budget_seconds))
    }

    fn wait(&self, run: &str, what: &str, enough: impl Fn(&Value) -> bool) -> Value {
        self.guest.wait(self.service(), run, what, enough)
    }

    fn ended(&self, run: &str) -> Value {
        ended(&self.guest, self.service(), run)
    }

    /// Waits until the machine asks a plugin for this run.
    fn measures(&self, run: &str, machine: &Machine) {
        measures(&self.guest, self.service(), run, machine);
    }
}

fn spec(budget_seconds: f64) -> Value {
    json!({
        "object_a": "stock:torus-knot@2000", "query": "proximity", "passes": 2, "budget_seconds": budget_seconds,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 300 } },
        "algorithms": ["brute-force", "box-tree", "parry"],
    })
}

/// Waits for the end of a run, and checks that nothing of it is missing or twice.
fn ended(guest: &Guest, service: &Service, run: &str) -> Value {
    let over = |run: &Value| !["queued", "running"].iter().any(|state| run["state"] == *state);
    let run = guest.wait(service, run, "the run has ended", over);
    assert_eq!(run["state"], "done", "{run}");
    let results = run["results"].as_array().expect("results");
    let names: Vec<_> = results.iter().map(|r| r["algorithm"].as_str().expect("a name")).collect();
    assert_eq!(names, ["brute-force", "box-tree", "parry"], "each once");
    for result in results {
        assert_eq!((&result["outcome"]["name"], &result["wrong"]), (&json!("Completed"), &json!(0)), "{result}");
    }
    run
}

fn measures(guest: &Guest, service: &Service, run: &str, machine: &Machine) {
    guest.wait(service, run, "it is measured", |r| {
        r["state"] == "running" && r["stages"][2]["state"] == "running" && runner_below(machine.pid()).is_some()
    });
}

#[test]
fn a_machine_measures_what_the_service_has_prepared() {
    let mut site = Site::open();
    site.token("alpha");
    let run = site.submit(0.5);
    let waiting = site.wait(&run, "it is prepared", |r| r["stages"][1]["state"] == "done" && r["state"] == "queued");
    assert_eq!((&waiting["stages"][2]["state"], &waiting["attempts"]), (&json!("queued"), &json!(0)));
    std::thread::sleep(Duration::from_secs(1));
    let still = site.wait(&run, "anything", |_| true);
    assert_eq!(still["state"], "queued", "the service measures nothing by itself: {still}");
    let machine = site.machine("alpha");
    let shown =
        |run: &Value| run["results"].as_array().is_some_and(|all| all.iter().any(|it| it["preliminary"] == true));
    site.wait(&run, "something is seen before the end", shown);
    let run = site.ended(&run);
    assert!(!shown(&run), "{run}");
    machine.says("is handed in", Duration::from_secs(5));
    drop(machine);
    // The seed follows from a secret that the machine never had.
    let draw = &run["environment"]["draw"];
    assert!(draw["secret"].is_string() && draw["commitment"] == run["commitment"], "{draw}");
    let machines: Value = serde_json::from_str(&site.admin(&["machines", "--json"])).expect("JSON");
    let alpha = machines.as_array().expect("machines").iter().find(|it| it["name"] == "alpha").expect("alpha");
    assert_eq!(alpha["facts"]["hardware_class"], run["environment"]["hardware_class"]);
}

/// One is killed, one stands still, and the network of one is cut, all for longer than the lease.
#[test]
fn runs_of_machines_that_are_silent_are_measured_by_another() {
    let mut site = Site::open();
    let [alpha, beta, gamma, delta] =
        ["alpha", "beta", "gamma", "delta"].map(|name| (site.token(name), site.data.join(name)));
    let machine = |(token, log): &(PathBuf, PathBuf)| Machine::apart(&site.internal, token, log);
    let wire = Wire::to(&site.internal);
    let cut = Machine::apart(&wire.address, &gamma.0, &gamma.1);
    let zeroth = site.submit(1.0);
    site.measures(&zeroth, &cut);
    wire.cut();
    let cut_since = Instant::now();
    let still = machine(&alpha);
    let first = site.submit(1.0);
    site.measures(&first, &still);
    still.signal(Signal::SIGSTOP);
    let killed = machine(&beta);
    let second = site.submit(1.0);
    site.measures(&second, &killed);
    let runner = runner_below(killed.pid()).expect("a runner");
    killed.signal(Signal::SIGKILL);
    let begun = Instant::now();
    let delta = machine(&delta);
    delta.says(&format!("at work on the run {second}"), 2 * LEASE + Duration::from_secs(15));
    println!("from the kill to the next attempt, behind another run: {:.1} s", begun.elapsed().as_secs_f64());
    assert!(!Path::new(&format!("/proc/{runner}")).exists(), "its runner has ended with it");
    let done = [zeroth, first, second].map(|run| site.ended(&run));
    assert!(done.iter().all(|run| run["attempts"] == 2), "{done:?}");
    still.signal(Signal::SIGCONT);
    still.says("ended by the service", Duration::from_secs(60));
    std::thread::sleep(Duration::from_secs(30).saturating_sub(cut_since.elapsed()));
    assert!(!cut.said().contains("too late") && !cut.said().contains("ended by"), "{}", cut.said());
    wire.mend();
    // It has measured meanwhile, or hears by a beat that it need not go on.
    let end = Instant::now() + Duration::from_secs(60);
    while !["comes too late", "ended by the service"].iter().any(|words| cut.said().contains(words)) {
        assert!(Instant::now() < end, "it does not hear that it is too late: {}", cut.said());
        std::thread::sleep(Duration::from_millis(20));
    }
    for run in &done[..2] {
        let later = site.wait(run["id"].as_str().expect("an id"), "anything", |_| true);
        assert_eq!(later["results"], run["results"], "nothing of the first attempt counts");
    }
    // It takes the next run, if it is the only one.
    drop((still, delta));
    let next = site.submit(0.5);
    cut.says(&format!("at work on the run {next}"), Duration::from_secs(30));
    assert_eq!(site.ended(&next)["attempts"], 1);
}

#[test]
fn a_run_whose_machine_has_a_full_disk_goes_to_another() {
    let mut site = Site::open();
    let (token, log) = (site.token("full"), site.data.join("full.log"));
    let _alpha = site.token("alpha");
    let full = Machine::full(&site.internal, &token, &log);
    let run = site.submit(0.5);
    full.says("No space left on device", Duration::from_secs(30));
    let _machine = site.machine("alpha");
    assert_eq!(site.ended(&run)["attempts"], 2);
    drop(full);
    let machines = site.admin(&["machines"]);
    assert!(machines.contains("No space left on device"), "{machines}");
}

#[test]
fn a_cancelled_run_ends_on_its_machine() {
    let mut site = Site::open();
    let machine = site.machine("alpha");
    let run = site.submit(30.0);
    site.measures(&run, &machine);
    let begun = Instant::now();
    site.guest.post(site.service(), &format!("/runs/{run}/cancel"), &json!({}));
    machine.says("ended by the service", Duration::from_secs(5));
    println!("from cancelling to the end on the machine: {:.1} s", begun.elapsed().as_secs_f64());
    assert_eq!(runner_below(machine.pid()), None);
    let run = site.wait(&run, "it has ended", |r| r["state"] != "running");
    assert_eq!((&run["state"], run["results"].as_array().map(Vec::len)), (&json!("cancelled"), Some(0)), "{run}");
}

#[test]
fn a_machine_that_is_asked_to_stop_puts_its_run_back() {
    let mut site = Site::open();
    let mut machine = site.machine("alpha");
    let run = site.submit(1.5);
    site.measures(&run, &machine);
    machine.signal(Signal::SIGTERM);
    assert_eq!(machine.ended(Duration::from_secs(10)).code(), Some(0), "{}", machine.said());
    let waiting = site.wait(&run, "it waits again", |r| r["state"] == "queued");
    assert_eq!((&waiting["attempts"], &waiting["stages"][1]["state"]), (&json!(0), &json!("done")), "{waiting}");
    let _again = site.machine("alpha");
    assert_eq!(site.ended(&run)["attempts"], 1);
}

/// What has ended so often is perhaps what ends the machines.
#[test]
fn a_run_in_the_middle_of_which_three_machines_ended_is_not_tried_again() {
    let mut site = Site::open();
    site.token("alpha");
    let run = site.submit(30.0);
    for attempt in 1..=3 {
        let machine = site.machine("alpha");
        machine.says(&format!("at work on the run {run}"), Duration::from_secs(60));
        site.measures(&run, &machine);
        let now = site.wait(&run, "anything", |_| true);
        assert_eq!(now["attempts"], attempt, "{now}");
        machine.signal(Signal::SIGKILL);
    }
    let _machine = site.machine("alpha");
    let given_up = site.wait(&run, "it is given up", |r| r["state"] == "failed");
    let why = given_up["message"].as_str().expect("a reason");
    assert!(why.contains("no fault of the algorithms"), "{why}");
    let next = site.submit(0.5);
    site.ended(&next);
}

#[test]
fn a_machine_outlives_its_service() {
    let mut site = Site::open();
    let machine = site.machine("alpha");
    let run = site.submit(1.5);
    site.measures(&run, &machine);
    site.service.take().expect("a service").kill();
    // Longer than the lease: the run is measured to its end, and the machine asks again and again whether it may hand in.
    std::thread::sleep(LEASE + Duration::from_secs(2));
    site.start();
    assert_eq!(site.ended(&run)["attempts"], 1, "it was measured once");
    machine.says("is handed in", Duration::from_secs(5));
    // The next run finds the machine waiting.
    let next = site.submit(0.5);
    site.ended(&next);
}

#[test]
fn a_run_outlives_the_database_and_the_files_of_its_service() {
    let files = Seaweed::start();
    let (postgres, folder, internal) = (Postgres::start(), TempDir::new().expect("a folder"), free_address());
    let url = postgres.url();
    let mut admin = command(built("ocb"));
    admin.arg("--data").arg(folder.path().join("admin")).args(["--database", &url, "admin", "machine", "alpha"]);
    let token = folder.path().join("token");
    fs::write(&token, output(&mut admin)).expect("the token is written");
    let blobs = files.address();
    let more = ["--internal", &internal, "--most-drift", ANY_DRIFT, "--database", &url, "--blobs", &blobs];
    let service = Service::start_saying(&folder.path().join("service"), &PLUGINS, &more);
    let machine = Machine::start(&internal, &token, &folder.path().join("log"), &[]);
    let guest = Guest::default();

    // Away for a moment while the run is prepared, and for longer than the lease while it is measured and handed in.
    let run = guest.submit(&service, &spec(1.5));
    postgres.stop();
    std::thread::sleep(Duration::from_secs(3));
    postgres.start_again();
    measures(&guest, &service, &run, &machine);
    postgres.stop();
    std::thread::sleep(LEASE + Duration::from_secs(5));
    postgres.start_again();
    let to_end = |what: &str, run: &str| {
        let begun = Instant::now();
        let run = ended(&guest, &service, run);
        println!("from {what} to the end: {:.1} s, attempts: {}", begun.elapsed().as_secs_f64(), run["attempts"]);
        run
    };
    to_end("the database's return", &run);

    // The files away while it is measured and handed in.
    let next = guest.submit(&service, &spec(1.5));
    measures(&guest, &service, &next, &machine);
    files.kill_and_start_again();
    let next = to_end("the kill of the store of files", &next);
    let csv = format!("/runs/{}/records.csv?algorithm=parry", next["id"].as_str().expect("an id"));
    let records = guest.look(&service, &csv).text().expect("text").lines().count();
    assert_eq!(Some(records as u64 - 1), next["results"][2]["n"].as_u64(), "its records are there");
}

#[test]
fn a_machine_of_another_class_measures_for_it_and_one_that_is_not_wanted_is_told_why() {
    let mut site = Site::open();
    let token = site.token("omega");
    let log = site.data.join("omega.log");
    // Whoever made this file: reading is enough to lock it.
    let measures = "exec 9< /run/lock/opencollbench-measuring.lock && flock 9 && exec sleep 90";
    let mut measures = command("sh").args(["-c", measures]).spawn().expect("a shell");
    let differing = Machine::start(&site.internal, &token, &log, &["--machine-note", "another"]);
    differing.says("waiting for another process that measures on this machine", Duration::from_secs(60));
    measures.kill().expect("it lives");
    measures.wait().expect("it has ended");
    // The usual class is that of the machine that was allowed first; nobody of it is there now.
    let classes = || {
        let status = site.guest.get(site.service(), "/status");
        let all = status["classes"].as_array().expect("a list");
        all.iter().map(|class| class["hardware_class"].as_str().expect("a class").to_owned()).collect::<Vec<_>>()
    };
    let begun = Instant::now();
    while classes().len() < 2 {
        assert!(begun.elapsed() < Duration::from_secs(60), "it tells its class: {}", differing.said());
        std::thread::sleep(Duration::from_millis(50));
    }
    let other = classes().swap_remove(1);
    let plain = site.submit(0.5);
    let mut named = spec(0.5);
    named["hardware_class"] = json!(other);
    let named = site.guest.submit(site.service(), &named);
    assert_eq!(site.ended(&named)["environment"]["hardware_class"], json!(other));
    assert_eq!(
        site.wait(&plain, "it is there", |_| true)["state"],
        "queued",
        "it waits for a machine of the usual class"
    );
    drop(differing);
    let alpha = site.machine("alpha");
    assert_ne!(site.ended(&plain)["environment"]["hardware_class"], json!(other));
    drop(alpha);
    let mut lacking = command(built("ocb"));
    lacking.args(["work", "--once", "--server", &format!("http://{}", site.internal), "--token"]);
    lacking.arg(format!("@{}", token.display())).arg("--plugins").arg(built("libocb_parry.so"));
    let refused = lacking.output().expect("it starts");
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("its plugin of box-tree is missing or another file"), "{said}");
    site.admin(&["revoke-machine", "omega"]);
    let mut revoked = Machine::start(&site.internal, &token, &log, &[]);
    assert_eq!(revoked.ended(Duration::from_secs(5)).code(), Some(2));
    assert!(revoked.said().contains("The token of this machine is not valid"), "{}", revoked.said());
}
