//! What the service and its measuring machines tell each other at `/internal/v1`.

use ocb_advice::{Advice, Paper};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::{
    AlgorithmInfo, AlgorithmResult, CheckLine, Draw, Environment, Errand, PluginReport, Preview, RunSpec, SetInfo,
    Stability, WorkloadResult,
};

/// A machine that waits asks again every 15 seconds.
const SILENT_US: i64 = 60_000_000;

/// What a measuring machine says of itself whenever it asks for work.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MachineFacts {
    /// Version of its `ocb`.
    pub version: String,
    /// SHA-256 of its `ocb-runner`.
    pub runner_sha256: String,
    /// SHA-256 of its installed plugin files.
    pub plugins: Vec<String>,
    /// Hash over what makes times comparable.
    pub hardware_class: String,
    /// CPU model.
    pub cpu: String,
    /// Kernel release.
    pub kernel: String,
    /// Microcode of the CPU.
    pub microcode: String,
    /// Frequency governor of the measuring CPU.
    pub governor: String,
    /// How much of a jail foreign plugins need: `production` or `dev`.
    pub profile: String,
    /// The partition of its Slurm cluster, if it measures as a job of one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub partition: Option<String>,
}

impl MachineFacts {
    /// What of these has changed since it said `before`, if that changes its times.
    pub fn changed_since(&self, before: &Self) -> Option<&'static str> {
        [
            ("hardware class", &self.hardware_class, &before.hardware_class),
            ("kernel", &self.kernel, &before.kernel),
            ("microcode", &self.microcode, &before.microcode),
            ("frequency governor", &self.governor, &before.governor),
        ]
        .into_iter()
        .find_map(|(what, now, before)| (now != before).then_some(what))
    }
}

/// A machine that the operator allowed to measure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MachineInfo {
    /// Its name.
    pub name: String,
    /// What it said of itself last; absent before its first contact.
    pub facts: Option<MachineFacts>,
    /// When it was allowed to measure.
    pub created_us: i64,
    /// When it asked for work last.
    pub seen_us: Option<i64>,
    /// When its token was revoked.
    pub revoked_us: Option<i64>,
    /// The run, plugin, stability run, workload or advice that it works on.
    pub run: Option<String>,
    /// Why it gets no run.
    pub trouble: Option<String>,
    /// Its last sentinel divided by the median of its hardware class; absent before there are enough of them.
    pub drift: Option<f64>,
}

/// What the sentinel took on a machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "sentinel", rename_all = "snake_case")]
pub enum Sentinel {
    /// It was measured.
    Measured {
        /// Nanoseconds of its median query.
        median_ns: f64,
    },
    /// It could not be measured.
    Failed {
        /// Why.
        message: String,
    },
}

/// What a machine has to do next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NextWork {
    /// A run.
    Run(Box<WorkOrder>),
    /// Something else.
    Errand(Box<Errand>),
    /// The sentinel, with this algorithm; then it asks again.
    Sentinel(Box<OrderedAlgorithm>),
    /// To ask again.
    Nothing,
}

/// A measuring machine, as everybody sees it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct MachineStatus {
    /// Its name.
    pub name: String,
    /// What it does.
    pub state: MachineState,
    /// When it asked for a run last.
    pub seen_us: i64,
    /// Its hardware class.
    pub hardware_class: String,
}

/// A hardware class on which runs are measured, and what waits for its machines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct ClassStatus {
    /// Hash over what makes times comparable.
    pub hardware_class: String,
    /// CPU model.
    pub cpu: String,
    /// Machines of this class.
    pub machines: u32,
    /// Runs of this class that wait.
    pub queued: u32,
    /// Seconds that they are expected to take, one after the other.
    pub expected_seconds: f64,
}

/// What a measuring machine does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum MachineState {
    /// It has a run.
    Measuring,
    /// It asks for runs.
    Waiting,
    /// It has no run and has not asked for one in the last minute.
    Silent,
    /// It asks and gets none: it has failed, or differs from what it was.
    Refused,
}

impl MachineInfo {
    /// As everybody sees it at this time; nothing before its first contact, and when its token is revoked.
    pub fn status(&self, now_us: i64) -> Option<MachineStatus> {
        let seen_us = self.seen_us.filter(|_| self.revoked_us.is_none())?;
        let hardware_class = self.facts.as_ref()?.hardware_class.clone();
        let state = match &self.run {
            Some(_) => MachineState::Measuring,
            None if self.trouble.is_some() => MachineState::Refused,
            None if now_us - seen_us < SILENT_US => MachineState::Waiting,
            None => MachineState::Silent,
        };
        Some(MachineStatus { name: self.name.clone(), state, seen_us, hardware_class })
    }
}

/// A run for a measuring machine: everything that determines it. Objects, set and submitted plugins are fetched by name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorkOrder {
    /// Id of the attempt; it opens the files of this order alone.
    pub attempt: String,
    /// Id of the run.
    pub run: String,
    /// What was asked for.
    pub spec: RunSpec,
    /// SHA-256 of the mesh of object A.
    pub mesh_a: String,
    /// SHA-256 of the mesh of object B, where there is a second object.
    pub mesh_b: Option<String>,
    /// The configuration set.
    pub set: SetInfo,
    /// The seed. The secret that it follows from stays at the service.
    pub draw: Draw,
    /// The algorithms, in the order of the request.
    pub algorithms: Vec<OrderedAlgorithm>,
    /// What all of them are compared with.
    pub reference: Option<OrderedAlgorithm>,
    /// Somebody may watch the run: the seed of the processes that look at its algorithms before the rounds.
    pub look: Option<u64>,
    /// The run is stopped after so many seconds.
    pub most_seconds: Option<f64>,
}

/// An algorithm with its settings, without its file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderedAlgorithm {
    /// What it says of itself; the hash in it names the plugin file.
    pub info: AlgorithmInfo,
    /// The id that the plugin knows.
    pub id_in_plugin: String,
    /// Values of parameters that are not the default ones.
    pub settings: Vec<(String, f64)>,
    /// CPUs that it may use.
    pub threads: usize,
}

/// A step of the measuring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "step", rename_all = "snake_case")]
pub enum Told {
    /// It waits for another process that measures on the machine, or no longer.
    Waiting {
        /// Whether it waits.
        waiting: bool,
    },
    /// An algorithm has answered so many of its expected queries, after so much work.
    Progress {
        /// Place in the list of algorithms; behind the last one, that of a reference that was not asked for.
        place: usize,
        /// Queries answered.
        done: u64,
        /// Queries expected; 0 while that is not known.
        total: u64,
        /// Time at work, microseconds.
        worked_us: u64,
    },
    /// The report of a check has another line.
    Line {
        /// Counts the lines from one.
        number: u32,
        /// The line.
        line: Box<CheckLine>,
    },
    /// A plugin that is checked loads in the jail.
    Loads,
    /// How far a replay is.
    Replaying {
        /// Queries that are done.
        done: u64,
        /// What it does besides asking pair by pair, in a sentence.
        doing: Option<String>,
    },
    /// How far advice is.
    Step {
        /// What is being done.
        what: String,
        /// Steps of it that are done.
        done: u64,
        /// All of them.
        total: u64,
    },
}

/// A sign of life of an attempt.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Beat {
    /// What happened since the last one.
    pub steps: Vec<Told>,
}

/// The answer to a beat or to results.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoOn {
    /// False when the attempt has ended at the service: it was cancelled, or another machine has it.
    pub current: bool,
}

/// How a machine ended an attempt. Files follow in the order of the algorithms: records, then tests per triangle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "ended", rename_all = "snake_case")]
pub enum Ended {
    /// Everything was measured, as far as it could be.
    Measured {
        /// Of each algorithm, in the order of the request.
        algorithms: Vec<MeasuredAlgorithm>,
        /// The machine; absent when nothing was measured.
        environment: Option<Box<Environment>>,
        /// What the results are a preview of.
        preview: Option<Box<Preview>>,
    },
    /// A plugin was checked.
    Checked {
        /// The whole report.
        report: Box<PluginReport>,
    },
    /// A part of a stability run was tried.
    Tried {
        /// What it and the parts before have found.
        found: Box<Stability>,
        /// Seconds of work.
        seconds: f64,
    },
    /// A recording was replayed. Files follow: the queries, and the reduced scene if there is one.
    Replayed {
        /// The result.
        result: Box<WorkloadResult>,
    },
    /// Advice was made. The reduced meshes follow, those of A first.
    Advised {
        /// The advice.
        advice: Box<Advice>,
        /// Of A and of B, the certificates of the reduced meshes.
        papers: [Vec<Paper>; 2],
    },
    /// What was asked for cannot be done, on whatever machine.
    Impossible {
        /// Why.
        message: String,
    },
    /// Its time limit is over.
    TooLong,
    /// The machine stops working, and the job waits again.
    PutBack,
    /// Something went wrong on the machine that is not the fault of a plugin.
    Failed {
        /// What.
        message: String,
    },
}

/// The result of one algorithm without its files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredAlgorithm {
    /// Its numbers.
    pub result: AlgorithmResult,
    /// SHA-256 of the plugin file that was measured.
    pub plugin_sha256: String,
    /// Wall seconds of one query with everything around it.
    pub seconds_per_query: Option<f64>,
    /// A file with its records follows.
    pub records: bool,
    /// A file with its tests per triangle follows.
    pub triangle_tests: bool,
}

#[test]
fn a_machine_is_silent_after_a_minute_without_a_run() {
    let facts = MachineFacts {
        version: "1".into(),
        runner_sha256: String::new(),
        plugins: Vec::new(),
        hardware_class: "class".into(),
        cpu: String::new(),
        kernel: String::new(),
        microcode: String::new(),
        governor: String::new(),
        profile: "production".into(),
        partition: None,
    };
    let info = |run: Option<&str>, seen_us, revoked_us| MachineInfo {
        name: "alpha".into(),
        facts: Some(facts.clone()),
        created_us: 0,
        seen_us,
        revoked_us,
        run: run.map(str::to_owned),
        trouble: None,
        drift: None,
    };
    let state = |info: MachineInfo| info.status(100_000_000).map(|status| status.state);
    assert_eq!(state(info(None, Some(50_000_000), None)), Some(MachineState::Waiting));
    assert_eq!(state(info(None, Some(30_000_000), None)), Some(MachineState::Silent));
    assert_eq!(state(info(Some("r"), Some(30_000_000), None)), Some(MachineState::Measuring));
    let failing = MachineInfo { trouble: Some("why".into()), ..info(None, Some(50_000_000), None) };
    assert_eq!(state(failing), Some(MachineState::Refused));
    assert_eq!((state(info(None, None, None)), state(info(Some("r"), Some(99_000_000), Some(1)))), (None, None));
}
