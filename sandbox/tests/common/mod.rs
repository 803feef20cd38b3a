//! Compiles fixtures (`build.rs`), runs them, and judges what they answer.
#![allow(dead_code, unused_imports, reason = "each test file uses its part")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::{Configuration, Placed};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::record::Verdict;
use ocb_core::validation::{Precision, Terms, judge};
use ocb_sandbox::{Ending, Launcher, Objects, Outcome, Policy, Profile, Question, Session, Trial};

mod build;
mod others;

pub use build::{cc, fixture, honest};
pub use others::Others;

/// Short limits, so that a test ends.
pub fn policy() -> Policy {
    Policy {
        memory_bytes: 128 << 20,
        load_seconds: 3.0,
        build_seconds: 3.0,
        query_seconds: 2.0,
        trial_seconds: 60.0,
        // The fixtures are foreign, and an ordinary user's machine runs these tests as well.
        profile: Profile::Dev,
        ..Policy::default()
    }
}

/// The runner of this build: cargo puts it beside the folder of the test programs.
pub fn runner() -> PathBuf {
    let told = std::env::var_os("CARGO_BIN_EXE_ocb-runner").map(PathBuf::from);
    told.unwrap_or_else(|| std::env::current_exe().unwrap().parent().unwrap().with_file_name("ocb-runner"))
}

pub fn launcher() -> Launcher {
    launcher_with(policy())
}

pub fn launcher_with(policy: Policy) -> Launcher {
    Launcher::new(runner(), policy)
}

/// Two triangles.
pub fn mesh() -> Mesh {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]];
    Mesh::new(corners.iter().map(|c| Point3::from(*c)).collect(), vec![[0, 1, 2], [2, 1, 3]]).unwrap()
}

/// B moved along x.
pub fn apart(x: f64) -> Configuration {
    let pose_b = Pose { linear: Matrix3::identity(), translation: Vector3::new(x, 0.0, 0.0) };
    Configuration { pose_a: Pose::identity(), pose_b }
}

/// The same with B turned upright, so that its triangles cross those of A where the two meet at all.
pub fn upright(x: f64) -> Configuration {
    let linear = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    Configuration { pose_b: Pose { linear, translation: Vector3::new(x, 0.25, -0.25) }, ..apart(x) }
}

/// Do the objects of a pair collide?
pub fn first_contact(configuration: Configuration) -> Question {
    Question { query: Query::CollisionFirst, objects: [0, 1], configuration }
}

pub fn start(launcher: &Launcher, plugin: &Path) -> Result<Session, Ending> {
    let mesh = mesh();
    launcher.start(&Trial::new(plugin, "fixture", &mesh, None))
}

/// A scene of four objects.
pub fn start_scene(launcher: &Launcher, plugin: &Path) -> Result<Session, Ending> {
    let mesh = mesh();
    launcher.start(&Trial::of(plugin, "fixture", Objects::Scene(&[&mesh; 4])))
}

/// Starts the fixture, asks one question and ends it.
pub fn one_question(defines: &[&str], query: Query) -> Ending {
    match start(&launcher(), &fixture(defines)) {
        Ok(mut session) => {
            let _ = session.query(query, &apart(0.5));
            session.finish()
        }
        Err(ending) => ending,
    }
}

/// What an answer is worth, by the oracle.
pub fn judged(query: Query, configuration: &Configuration, answer: &Answer) -> Verdict {
    let shape = Shape::new(Arc::new(mesh()));
    let pair = Pair::new(&shape, &shape);
    let truth = pair.truth(configuration);
    let placed = Placed { configuration: *configuration, truth, rounded: None, root_index: 0, wanted: None };
    let terms = Terms { query, semantics: Semantics::Surface, precision: Precision::Double };
    judge(&pair, &placed, terms, answer).verdict
}

/// The outcome of one collision query.
pub fn outcome(defines: &[&str]) -> Outcome {
    one_question(defines, Query::CollisionFirst).outcome
}

/// Does this process get memory groups for its jails?
pub fn grouped() -> bool {
    static GROUPED: std::sync::OnceLock<bool> = std::sync::OnceLock::new();
    *GROUPED.get_or_init(|| {
        let layers = start(&launcher(), &fixture(&[])).unwrap().layers();
        layers.iter().any(|layer| layer.starts_with("memory group"))
    })
}

/// Is the process there and not a zombie?
pub fn alive(pid: i32) -> bool {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let state = stat.rsplit(") ").next().and_then(|rest| rest.chars().next());
    !matches!(state, None | Some('Z'))
}

/// Control groups that a supervisor made and that are still there.
pub fn groups_of(supervisor: u32) -> Vec<PathBuf> {
    let mut found = Vec::new();
    find(Path::new("/sys/fs/cgroup"), &format!("ocb-jail-{supervisor}-"), 6, &mut found);
    found
}

fn find(folder: &Path, prefix: &str, depth: u32, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if !entry.file_type().is_ok_and(|t| t.is_dir()) {
            continue;
        }
        if entry.file_name().to_string_lossy().starts_with(prefix) {
            found.push(entry.path());
        } else if depth > 0 {
            find(&entry.path(), prefix, depth - 1, found);
        }
    }
}
