//! Compiles a fixture and runs it.
#![allow(dead_code, reason = "each test file uses its part")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_core::query::{Query, Semantics};
use ocb_sandbox::{Ending, Launcher, Outcome, Policy, Profile, Session, Trial};

/// A fixture with these faults, compiled once per test program into a folder beside it.
pub fn fixture(defines: &[&str]) -> PathBuf {
    static COMPILED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
    let mut compiled = COMPILED.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let name = defines.join("+").to_lowercase().replace(['=', '"', ' '], "-");
    let folder = std::env::current_exe().unwrap().with_extension("fixtures");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(format!("fixture{name}.so"));
    if !compiled.contains(&file) {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let include = root.join("../plugin-api/include");
        let source = root.join("tests/fixtures/fixture.c");
        let defines: Vec<String> = defines.iter().map(|d| format!("-D{d}")).collect();
        let mut words = vec!["-std=gnu11", "-O1", "-fPIC", "-shared", "-fvisibility=hidden", "-w"];
        words.extend(["-I", include.to_str().unwrap()]);
        words.extend(defines.iter().map(String::as_str));
        words.extend([source.to_str().unwrap(), "-lm", "-o", file.to_str().unwrap()]);
        let throws = root.join("tests/fixtures/attacks/exceptions.cpp");
        if defines.iter().any(|d| ["-DATTACK=throw_out", "-DATTACK=catch_inside"].contains(&d.as_str())) {
            words.extend(["-std=gnu++17", throws.to_str().unwrap(), "-lstdc++"]);
        }
        cc(&words);
        compiled.push(file.clone());
    }
    file
}

/// Runs the C compiler.
#[expect(clippy::disallowed_methods, reason = "the tests compile their fixtures")]
pub fn cc(words: &[&str]) {
    let done = Command::new("cc").args(words).output().expect("a C compiler named cc");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}

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

pub fn start(launcher: &Launcher, plugin: &Path) -> Result<Session, Ending> {
    let mesh = mesh();
    launcher.start(&Trial {
        plugin,
        algorithm: "fixture",
        mesh_a: &mesh,
        mesh_b: None,
        parameters: &[],
        semantics: Semantics::Surface,
    })
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
