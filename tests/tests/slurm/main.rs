//! A service whose measuring machines are nodes of a Slurm cluster: jobs come while runs wait, and a killed job costs no run.

#[path = "../../../host/slurm/tests/daemons/cluster.rs"]
#[allow(dead_code, reason = "the test of the daemons uses all of it")]
mod cluster;

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::time::{Duration, Instant};

use cluster::Cluster;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use ocb_tests::place::built;
use ocb_tests::postgres::Postgres;
use ocb_tests::process::{command, output};
use ocb_tests::service::{Guest, Service, free_address};
use serde_json::{Value, json};

const PLUGINS: [&str; 2] = ["libocb_brute_force.so", "libocb_box_tree.so"];

/// What each job runs: the token is that of its node. Both nodes are this machine, so that their jobs take turns in measuring.
fn job(folder: &Path, internal: &str, more: &str) -> String {
    let plugins: Vec<String> = PLUGINS.iter().map(|name| format!("--plugins '{}'", built(name).display())).collect();
    let script = format!(
        "#!/bin/sh\nexec '{}' work --once --server http://{internal} \
         --token \"@{}/$SLURMD_NODENAME\" {} {more} 2>> '{}/jobs.log'\n",
        built("ocb").display(),
        folder.display(),
        plugins.join(" "),
        folder.display(),
    );
    let file = folder.join("job");
    fs::write(&file, script).expect("a script");
    fs::set_permissions(&file, Permissions::from_mode(0o755)).expect("the script is ours");
    file.to_str().expect("UTF-8").to_owned()
}

fn wait(what: &str, within: Duration, there: impl Fn() -> bool) {
    let end = Instant::now() + within;
    while !there() {
        assert!(Instant::now() < end, "waited in vain until {what}");
        std::thread::sleep(Duration::from_millis(200));
    }
}

/// A service on this PostgreSQL whose machines are the nodes of these partitions, which allows the first node first; with more
/// arguments for the jobs. They read its folder as the user of the node.
fn service(cluster: &Cluster, folder: &Path, database: &Postgres, partitions: &str, more: &str) -> Service {
    let (data, url) = (folder.join("data"), database.url());
    let internal = free_address();
    for node in cluster::NAMES {
        let mut admin = command(built("ocb"));
        let token = output(admin.arg("--data").arg(&data).args(["--database", &url, "admin", "machine", node]));
        fs::write(folder.join(node), token).expect("the token is written");
    }
    let program = job(folder, &internal, more);
    let slurm = ["--slurm", partitions, "--slurm-job", &program];
    let more = [&["--database", &url, "--internal", &internal, "--most-drift", "100000"], &slurm[..]].concat();
    let configuration = cluster.path("slurm.conf");
    let environment = [("SLURM_CONF", configuration.to_str().expect("UTF-8"))];
    Service::start_among(&data, &PLUGINS, &more, &environment)
}

fn measured(run: &Value) -> bool {
    run["state"] == "running" && run["stages"][2]["state"] == "running"
}

fn over(run: &Value) -> bool {
    run["state"] != "queued" && run["state"] != "running"
}

#[test]
fn a_partition_measures_the_runs_of_its_hardware_class_also_when_the_database_was_away() {
    let (cluster, folder) = (Cluster::start(), tempfile::tempdir().expect("a folder"));
    // The nodes differ by their notes alone: the class of n0 is the usual one.
    let database = Postgres::start();
    let note = "--machine-note \"$SLURMD_NODENAME\"";
    let service = service(&cluster, folder.path(), &database, "first,second", note);
    let guest = Guest::default();
    let mut spec = json!({
        "object_a": "stock:torus-knot@600", "query": "proximity", "passes": 1, "budget_seconds": 0.5,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 50 } }, "algorithms": ["box-tree"],
    });
    let ended = |run: &str| guest.wait(&service, run, "it has ended", over);
    // While a run waits, both partitions get jobs until their nodes have told their class.
    let usual = ended(&guest.submit(&service, &spec));
    let classes = || guest.get(&service, "/status")["classes"].as_array().expect("a list").clone();
    wait("both classes are known", Duration::from_secs(60), || classes().len() == 2);
    let classes: Vec<Value> = classes().iter().map(|class| class["hardware_class"].clone()).collect();
    spec["hardware_class"] = classes[1].clone();
    let other = ended(&guest.submit(&service, &spec));
    let found = [usual, other].map(|run| (run["state"].clone(), run["environment"]["hardware_class"].clone()));
    let done = json!("done");
    assert_eq!(found, [(done.clone(), classes[0].clone()), (done.clone(), classes[1].clone())]);

    // The database away while a run waits for its job, and while a job measures it.
    spec["method"]["sampling"]["count"] = json!(300);
    spec["algorithms"] = json!(["brute-force", "box-tree"]);
    spec["budget_seconds"] = json!(4.0);
    let run = guest.submit(&service, &spec);
    let away = || {
        database.stop();
        std::thread::sleep(Duration::from_secs(4));
        database.start_again();
    };
    away();
    guest.wait(&service, &run, "it is measured", measured);
    away();
    let run = ended(&run);
    println!("attempts at the run whose database was away: {}", run["attempts"]);
    let results = run["results"].as_array().map(Vec::len);
    assert_eq!((&run["state"], results, &run["environment"]["hardware_class"]), (&done, Some(2), &classes[1]), "{run}");
}

#[test]
fn nodes_measure_while_runs_wait_and_a_killed_job_costs_no_run() {
    let (cluster, folder) = (Cluster::start(), tempfile::tempdir().expect("a folder"));
    let database = Postgres::start();
    let service = service(&cluster, folder.path(), &database, "measuring", "");
    let guest = Guest::default();
    let log = || fs::read_to_string(folder.path().join("jobs.log")).unwrap_or_default();
    let spec = json!({
        "object_a": "stock:torus-knot@2000", "query": "proximity", "passes": 2, "budget_seconds": 2.0,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 300 } },
        "algorithms": ["brute-force", "box-tree"],
    });
    let begun = Instant::now();
    let runs: Vec<String> = (0..4).map(|_| guest.submit(&service, &spec)).collect();
    let state = |run: &String| guest.get(&service, &format!("/runs/{run}"));
    wait("a run is measured", Duration::from_secs(60), || runs.iter().any(|run| measured(&state(run))));
    println!("from asking to measuring: {:.1} s", begun.elapsed().as_secs_f64());
    // The job of a node that has a run is killed, as the node's kernel does when memory is short; another one measures the sentinel.
    let at_work = || {
        let machines = guest.get(&service, "/status")["machines"].clone();
        let at_work = machines.as_array().expect("machines").iter().find(|it| it["state"] == "measuring").cloned();
        let node = at_work.expect("a run is measured")["name"].as_str().expect("a name").to_owned();
        let of_node = format!("work --once .* @{}/{node}", folder.path().display());
        output(command("pgrep").args(["-of", &of_node])).trim().to_owned()
    };
    let killed = |pid: &str| kill(Pid::from_raw(pid.parse().expect("one process")), Signal::SIGKILL).expect("it lived");
    killed(&at_work());
    let mut attempts = Vec::new();
    for run in &runs {
        let run = guest.wait(&service, run, "it has ended", over);
        assert_eq!(
            (&run["state"], run["results"].as_array().map(Vec::len)),
            (&json!("done"), Some(2)),
            "{run}\n{}",
            log()
        );
        attempts.push(run["attempts"].as_u64().expect("a number") as usize);
    }
    // The run of the killed job waits again at the latest when the next job of that node asks, and its lost attempt counts.
    let handed_out = runs.iter().map(|run| log().matches(&format!("at work on the run {run}")).count());
    assert!(handed_out.eq(attempts.iter().copied()), "{attempts:?}: {}", log());
    assert_eq!((attempts.iter().sum::<usize>(), attempts.iter().max()), (5, Some(&2)), "{}", log());
    println!("four runs on two nodes, one of them twice: {:.1} s", begun.elapsed().as_secs_f64());
    // Slurm's own process that watches over a job is killed alone: the job goes on, or another one does.
    let last = guest.submit(&service, &spec);
    guest.wait(&service, &last, "it is measured", measured);
    let guardian = output(command("ps").args(["-o", "ppid=", "-p", &at_work()]));
    let name = output(command("ps").args(["-o", "comm=", "-p", guardian.trim()]));
    assert_eq!(name.trim(), "slurmstepd", "{guardian}");
    killed(guardian.trim());
    let last = guest.wait(&service, &last, "it has ended", over);
    assert_eq!(
        (&last["state"], last["results"].as_array().map(Vec::len)),
        (&json!("done"), Some(2)),
        "{last}\n{}",
        log()
    );
    println!("attempts at the run whose slurmstepd was killed: {}", last["attempts"]);
    // No job is left behind when nothing waits.
    let jobs = || {
        let mut squeue = command("squeue");
        squeue.args(["--noheader", "--format=%A"]).env("SLURM_CONF", cluster.path("slurm.conf"));
        let queue = output(&mut squeue);
        queue.lines().count()
    };
    wait("no job is left", Duration::from_secs(40), || jobs() == 0);
}
