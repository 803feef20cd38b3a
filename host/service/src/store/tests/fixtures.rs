//! Rows to store, all fields set.

use ocb_core::configuration::Class;
use ocb_core::mesh::{FileFormat, LengthUnit};
use ocb_core::query::Query;

use super::super::*;
use super::rows::*;
use crate::attempts::Attempt;
use crate::attempts::worker::Worker;
use crate::model::{
    AdviceInfo, Agreement, AlgorithmResult, ClassCount, Estimated, ObjectInfo, OutcomeInfo, OutcomeName, RecordingInfo,
    Rounding, RoundingEffect, RunSpec, SetInfo, State, Timeline, Visibility, WorkloadResult, WorkloadSpec,
};
use crate::runs::accept::{Handed, RunEnd};
use crate::runs::log::fresh_stages;
use crate::runs::share::OfClass;
use crate::workloads::sql::WorkloadRow;

pub(crate) fn object(id: &str) -> ObjectInfo {
    ObjectInfo {
        id: id.into(),
        name: "ünïcode 'quoted'".into(),
        triangles: 12,
        vertices: 8,
        bounds: [-0.1, 0.0, 1.0 / 3.0, 1.0, 2.0, 3.0],
        sha256: format!("mesh of {id}"),
        terms: String::new(),
        stock: false,
        closed: true,
        format: Some(FileFormat::Collada),
        unit: Some(LengthUnit { name: "inch".into(), metres: 0.0254 }),
        rounding: Some(Rounding { moves: 1e-9, collapsed: 1, flattens: false }),
        warnings: vec!["one".into()],
        created_us: now_us(),
        visibility: Visibility::Unlisted,
        mine: false,
    }
}

pub(crate) fn spec() -> RunSpec {
    serde_json::from_value(serde_json::json!({
        "object_a": "stock:box@500", "query": "proximity", "algorithms": ["a", "b"], "separation": { "kind": "relative", "distance": 0.1 },
        "method": {"kind": "sphere", "sampling": {"kind": "count", "count": 5}},
    }))
    .unwrap()
}

pub(crate) fn workload(id: &str, owner: &str, sha256: &str) -> WorkloadRow {
    let recording = RecordingInfo {
        file: "r.ocbrec".into(),
        sha256: sha256.into(),
        bytes: 40,
        program: "p".into(),
        libraries: vec!["fcl 0.7.0".into()],
        objects: 2,
        queries: 9,
        seen: 10,
    };
    WorkloadRow {
        id: id.into(),
        owner: Some(owner.into()),
        turn: owner.into(),
        state: State::Queued,
        attempts: 0,
        message: None,
        spec: WorkloadSpec::default(),
        recording,
        done: 0,
        created_us: 1,
        finished_us: None,
    }
}

pub(crate) fn workload_result() -> WorkloadResult {
    serde_json::from_value(serde_json::json!({
        "program": "p", "libraries": [], "objects": [{ "name": "a", "triangles": 12, "bound": 0.1 }], "seen": 10, "queries": 9,
        "left_out": [{ "reason": "sampled", "count": 1 }], "groups": 3, "hits": 4,
        "recorded": { "claims": [{ "claim": "right", "count": 9 }], "largest_error": 0.0, "false_answers": [], "seconds": 0.1 },
        "tracks": [{ "track": "recorded", "algorithms": [] }], "timeline": Timeline::default(), "passes": 1, "seed": 5,
    }))
    .unwrap()
}

pub(crate) fn run(id: &str, owner: Option<&str>, priority: i64, created_us: i64) -> RunRow {
    RunRow {
        id: id.into(),
        owner: owner.map(str::to_owned),
        featured: false,
        private: false,
        visibility: Visibility::Unlisted,
        priority,
        turn: owner.unwrap_or_default().to_owned(),
        address: None,
        granted_seconds: 120.0,
        suite: None,
        campaign: None,
        rerun_of: None,
        state: State::Queued,
        attempts: 0,
        message: None,
        spec: spec(),
        object_a_name: "box".into(),
        object_b_name: "box".into(),
        set: None,
        set_blob: None,
        environment: None,
        preview: None,
        secret: Some("s".into()),
        expected_seconds: 1.5,
        created_us,
        finished_us: None,
    }
}

pub(crate) fn set_info() -> SetInfo {
    SetInfo {
        sha256: "s".into(),
        configurations: 4,
        missed_rays: 1,
        longest_side: 0.5,
        classes: vec![ClassCount { class: Class::Clear, count: 4 }],
        coverage_a: 0.1,
        coverage_b: 0.2,
        exact: 1,
        further_roots: 0,
        evenness_a: 0.3,
        evenness_b: 0.4,
        spacing: None,
        box_side: Some(1.5),
        oracle: Some(4),
        rounding: Some(RoundingEffect { other_answers: 1, largest_change: 1e-9 }),
    }
}

pub(crate) fn advice_info(id: &str) -> AdviceInfo {
    serde_json::from_value(serde_json::json!({
        "id": id, "spec": {"object_a": "stock:box@500", "question": {"kind": "distance", "tolerance": 0.01}},
        "names": ["box", "box"], "state": "queued", "step": "", "done": 0, "total": 0, "message": null, "advice": null,
    }))
    .unwrap()
}

pub(crate) fn result(algorithm: &str, n: u32) -> StoredResult {
    StoredResult {
        result: AlgorithmResult {
            algorithm: algorithm.into(),
            name: algorithm.to_uppercase(),
            builds: Vec::new(),
            outcome: OutcomeInfo { name: OutcomeName::Completed, signal: None, message: "All.".into(), ours: false },
            n,
            of: 5,
            budget_limited: n < 5,
            time: None,
            ratio: Some(Estimated { value: 1.0, lo: 0.5, hi: 2.0 }),
            class: None,
            rank: Some(1),
            unranked: None,
            controls: None,
            timing: None,
            verdicts: Vec::new(),
            rounded: true,
            wrong: 0,
            by_unit: Vec::new(),
            depends_on_unit: None,
            grazing: Agreement::default(),
            resolution: None,
            contacts: None,
            bv_tests_mean: Some(1.25),
            primitive_tests_mean: None,
            build_ms: None,
            load_ms: None,
            memory_bytes: Some(u64::from(u32::MAX) + 1),
            preliminary: false,
            place_so_far: None,
        },
        records: None,
        triangle_tests: None,
        plugin_sha256: "p".into(),
        seconds_per_query: Some(1e-6),
    }
}

/// The worker of this machine.
pub(crate) fn worker(machine: &str) -> Worker {
    Worker { machine: machine.into(), class: "class".into() }
}

/// The class of that worker, which is the usual one.
pub(crate) fn usual() -> OfClass {
    OfClass { class: "class".into(), usual: "class".into() }
}

/// Begins the next run.
pub(crate) async fn begin(store: &Store, machine: &str) -> Option<Attempt> {
    store.begin_run(&worker(machine)).await.unwrap()
}

/// Ends a run.
pub(crate) async fn end(store: &Store, attempt: &Attempt, state: State, handed: Option<&Handed>) -> bool {
    store.accept_run(attempt, RunEnd { state, message: None, handed }).await.unwrap()
}

/// What an attempt hands in: both algorithms of [`spec`] are measured.
pub(crate) fn handed() -> Handed {
    Handed {
        results: vec![(0, result("a", 5)), (1, result("b", 5))],
        triangles: 100,
        query: Query::Proximity,
        environment: None,
        preview: None,
        failed: None,
    }
}

pub(crate) async fn add(store: &Store, run: RunRow) {
    assert!(store.add_run(&run, &fresh_stages(&run.spec.algorithms), None).await.unwrap());
}
