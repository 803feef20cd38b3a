//! Jobs in a cluster of the daemons that large installations use.

mod cluster;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use cluster::{Cluster, LIMIT, NODES, wait_for};
use ocb_slurm::{Job, Nodes, Settled, Slurm, State};

/// A job that takes a waiting run, measures it for two seconds, and ends at once when none waits: runs are files in a folder.
const MEASURE: &str = r#"cd "$1/waiting"
# Another job may have taken the same one.
until run=$(ls | head -n 1) && mv "$run" "../taken-by-$SLURM_JOB_ID"; do
    [ -n "$run" ] || exit 0
done
echo "start $SLURMD_NODENAME" >> ../log
sleep 2
echo "end $SLURMD_NODENAME" >> ../log
"#;

fn count(jobs: &[Job], state: State) -> usize {
    jobs.iter().filter(|job| job.state == state).count()
}

/// Running and pending jobs; `None` while one of them starts or ends.
fn running_and_pending(slurm: &Slurm) -> Option<(usize, usize)> {
    let jobs = slurm.jobs().expect("the jobs");
    let (running, pending) = (count(&jobs, State::Running), count(&jobs, State::Pending));
    (running + pending == jobs.len()).then_some((running, pending))
}

#[track_caller]
fn wait_for_jobs(slurm: &Slurm, running: usize, pending: usize) {
    wait_for(&format!("{running} running and {pending} pending jobs"), || {
        (running_and_pending(slurm)? == (running, pending)).then_some(())
    });
}

/// The lines that the jobs wrote; fails if two were on one node at a time.
fn log(path: &Path) -> Vec<String> {
    let lines: Vec<String> = fs::read_to_string(path).unwrap_or_default().lines().map(str::to_owned).collect();
    let mut busy = BTreeSet::new();
    for line in &lines {
        let (what, node) = line.split_once(' ').expect("two words");
        let alone = if what == "start" { busy.insert(node) } else { busy.remove(node) };
        assert!(alone, "two jobs on {node} at a time: {lines:?}");
    }
    lines
}

/// Jobs that measure runs from this many files.
fn measuring(cluster: &Cluster, runs: usize) -> Slurm {
    let folder = cluster.path("runs");
    fs::create_dir_all(folder.join("waiting")).expect("a folder");
    (0..runs).for_each(|run| fs::write(folder.join(format!("waiting/{run}")), "").expect("a file"));
    let script = cluster.path("measure it's $(name)");
    fs::write(&script, MEASURE).expect("a file");
    cluster.slurm("ocb-measuring", &["sh", script.to_str().expect("UTF-8"), folder.to_str().expect("UTF-8")])
}

fn waiting(cluster: &Cluster) -> usize {
    fs::read_dir(cluster.path("runs/waiting")).expect("a folder").count()
}

#[test]
fn each_node_measures_one_run_at_a_time_until_none_waits() {
    let cluster = Cluster::start();
    let slurm = measuring(&cluster, 5);
    // It does not count the jobs of another name.
    let other = cluster.slurm("ocb-other", &["true"]);
    let began = Instant::now();
    let first = slurm.settle(5).expect("a step");
    assert_eq!((first.jobs, first.nodes), (vec![], Nodes { free: NODES, working: 0 }));
    assert_eq!(first.submitted.len(), NODES + 1);
    wait_for_jobs(&slurm, NODES, 1);
    println!("two jobs ran after {:.1} s", began.elapsed().as_secs_f64());
    assert_eq!(other.jobs().expect("the jobs"), []);
    wait_for("two jobs that have begun", || (log(&cluster.path("runs/log")).len() == NODES).then_some(()));
    let nodes: BTreeSet<_> = log(&cluster.path("runs/log")).into_iter().collect();
    assert_eq!(nodes, BTreeSet::from(["start n0", "start n1"].map(str::to_owned)));

    // Another step changes nothing.
    let Settled { submitted, cancelled, nodes, .. } = slurm.settle(waiting(&cluster)).expect("a step");
    assert_eq!((submitted, cancelled, nodes), (vec![], vec![], Nodes { free: 0, working: NODES }));

    // The rest of the runs, as the service does it.
    wait_for("end of the runs", || {
        let Settled { jobs, .. } = slurm.settle(waiting(&cluster)).expect("a step");
        assert!(count(&jobs, State::Pending) <= NODES + 1, "{jobs:?}");
        (jobs.is_empty() && waiting(&cluster) == 0).then_some(())
    });
    let lines = log(&cluster.path("runs/log"));
    let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
    lines.iter().for_each(|line| *numbers.entry(&line[..3]).or_default() += 1);
    assert_eq!(numbers, BTreeMap::from([("end", 5), ("sta", 5)]), "{lines:?}");
    println!("five runs of 2 s on two nodes took {:.1} s", began.elapsed().as_secs_f64());
}

#[test]
fn a_pending_job_without_a_run_is_cancelled_and_running_jobs_end_by_themselves() {
    let cluster = Cluster::start();
    let slurm = measuring(&cluster, 5);
    slurm.settle(5).expect("a step");
    wait_for("two jobs that have begun", || (log(&cluster.path("runs/log")).len() == NODES).then_some(()));
    // Their visitors cancelled the others.
    for run in fs::read_dir(cluster.path("runs/waiting")).expect("a folder") {
        fs::remove_file(run.expect("a file").path()).expect("no job took it");
    }
    let Settled { submitted, cancelled, .. } = slurm.settle(0).expect("a step");
    assert_eq!((submitted.len(), cancelled.len()), (0, 1));
    // A job that Slurm does not know and jobs that run are no errors and are not touched.
    let running = slurm.jobs().expect("the jobs");
    let ids: Vec<u64> = running.iter().map(|job| job.id).chain([cancelled[0], 4_000_000]).collect();
    slurm.cancel_pending(&ids).expect("nothing to do");
    wait_for_jobs(&slurm, NODES, 0);
    wait_for_jobs(&slurm, 0, 0);
    assert_eq!(log(&cluster.path("runs/log")).len(), 2 * NODES, "both came to their ends");
}

#[test]
fn jobs_that_a_killed_slurmctld_forgot_are_submitted_again() {
    let mut cluster = Cluster::start();
    let slurm = cluster.slurm("ocb-long", &["sleep", "60"]);
    let submitted = slurm.settle(5).expect("a step").submitted;
    assert_eq!(submitted.len(), NODES + 1);
    cluster.kill_controller();
    let began = Instant::now();
    let error = slurm.settle(5).expect_err("there is no slurmctld").to_string();
    assert_eq!(error, "squeue failed: Unable to contact slurm controller (connect failure).");
    println!("without slurmctld a step fails after {:.1} s", began.elapsed().as_secs_f64());

    let began = Instant::now();
    cluster.start_controller();
    let known = wait_for("slurmctld that answers", || slurm.jobs().ok()).len();
    println!("{known} of {} jobs are known after {:.1} s", submitted.len(), began.elapsed().as_secs_f64());
    assert!(known < submitted.len(), "slurmctld forgot nothing: the test shows nothing");
    wait_for("right number of jobs", || {
        let settled = slurm.settle(5).expect("a step");
        let done = settled.submitted.is_empty() && settled.cancelled.is_empty();
        (done && running_and_pending(&slurm)? == (NODES, 1)).then_some(())
    });
    println!("all jobs are there again after {:.1} s", began.elapsed().as_secs_f64());
    let Settled { submitted, cancelled, .. } = slurm.settle(5).expect("a step");
    assert_eq!((submitted, cancelled), (vec![], vec![]));
}

#[test]
fn a_node_that_died_is_not_counted_until_it_is_back() {
    let mut cluster = Cluster::start();
    let slurm = cluster.slurm("ocb-long", &["sleep", "60"]);
    slurm.settle(5).expect("a step");
    wait_for_jobs(&slurm, NODES, 1);
    cluster.kill_node(1);
    let began = Instant::now();
    let step = |jobs: (usize, usize), nodes: Nodes| {
        wait_for(&format!("{jobs:?} jobs on {nodes:?}"), || {
            let settled = slurm.settle(5).expect("a step");
            assert!(count(&settled.jobs, State::Pending) <= NODES, "{settled:?}");
            (running_and_pending(&slurm)? == jobs && settled.nodes == nodes).then_some(())
        });
        println!("{jobs:?} jobs on {nodes:?} after {:.1} s", began.elapsed().as_secs_f64());
    };
    step((1, 1), Nodes { free: 0, working: 1 });
    let until = Instant::now() + Duration::from_secs(1);
    while Instant::now() < until {
        let settled = slurm.settle(5).expect("a step");
        assert_eq!((settled.submitted, settled.cancelled, settled.nodes.usable()), (vec![], vec![], 1));
    }
    cluster.start_node(1);
    step((NODES, 1), Nodes { free: 0, working: NODES });
    assert!(began.elapsed() < 2 * LIMIT);
}

#[test]
fn a_job_gets_no_environment_of_the_service() {
    let cluster = Cluster::start();
    let file = cluster.path("environment");
    // Written as a whole before it has its name.
    let write = r#"env > "$1.part" && mv "$1.part" "$1""#;
    let slurm = cluster.slurm("ocb-environment", &["sh", "-c", write, "sh", file.to_str().expect("UTF-8")]);
    slurm.submit().expect("a job");
    let environment = wait_for("environment", || fs::read_to_string(&file).ok());
    assert!(environment.contains("SLURM_JOB_NAME=ocb-environment\n"), "{environment}");
    // Cargo gives it to this test.
    assert!(std::env::var_os("CARGO_MANIFEST_DIR").is_some());
    assert!(!environment.contains("CARGO_MANIFEST_DIR") && !environment.contains("HOME="), "{environment}");
}

#[test]
fn what_slurm_refuses_is_one_sentence() {
    let cluster = Cluster::start();
    let absent = Slurm::new("absent", "ocb-none", &["true".to_owned()]).expect("good names");
    let absent = absent.configured_by(cluster.path("slurm.conf"));
    assert_eq!(absent.settle(1).unwrap_err().to_string(), "Slurm knows no nodes of the partition absent.");
    assert_eq!(absent.submit().unwrap_err().to_string(), "sbatch failed: invalid partition specified: absent.");
}
