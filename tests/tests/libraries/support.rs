//! Plugins, objects, configurations, and jailed answers to them.

use std::path::PathBuf;
use std::sync::Arc;

use ocb_core::configuration::Configuration;
use ocb_core::mesh::{Mesh, obj};
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_sandbox::{Launcher, Objects, Policy, Profile, Session, Trial};
use ocb_tests::place::{built, shared};

/// The libraries whose wrappers are built here.
pub const LIBRARIES: [&str; 6] = ["bullet", "cgal", "coal", "embree", "fcl", "ode"];

/// The plugin around a library.
pub fn library(name: &str) -> PathBuf {
    let path = built("ocb-runner").with_file_name(format!("libocb_{name}.so"));
    assert!(path.exists(), "{} is not built: run `tests/setup/tools.sh test` and `make plugins-cpp`", path.display());
    path
}

/// An algorithm with settings, e.g. `coal` with `gjk_tolerance` 1e-6.
#[derive(Clone, Debug)]
pub struct Algorithm {
    pub id: &'static str,
    pub settings: Vec<(String, f64)>,
}

impl Algorithm {
    pub fn plain(id: &'static str) -> Self {
        Self { id, settings: Vec::new() }
    }

    pub fn with(id: &'static str, name: &str, value: f64) -> Self {
        Self { id, settings: vec![(name.into(), value)] }
    }

    /// As the command line asks for it.
    pub fn name(&self) -> String {
        self.settings.iter().fold(self.id.to_owned(), |name, (knob, value)| format!("{name}:{knob}={value}"))
    }

    /// A jail with the algorithm and these objects; the second is the first again when absent.
    pub fn start(&self, mesh_a: &Mesh, mesh_b: Option<&Mesh>) -> Session {
        let name = self.id.replace('-', "_");
        let plugin = if LIBRARIES.contains(&self.id) { library(self.id) } else { built(&format!("libocb_{name}.so")) };
        let policy = Policy { trusted: true, profile: Profile::Dev, rough_clock: true, ..Policy::default() };
        let launcher = Launcher::new(built("ocb-runner"), policy);
        let (algorithm, parameters) = (self.id, self.settings.as_slice());
        let semantics = Semantics::Surface;
        let trial = Trial { plugin: &plugin, algorithm, objects: Objects::Pair(mesh_a, mesh_b), parameters, semantics };
        launcher.start(&trial).unwrap_or_else(|end| panic!("{}: {end} {}", self.name(), end.stderr))
    }
}

/// First contact: do they meet?
pub fn hit(session: &mut Session, configuration: &Configuration) -> bool {
    match session.query(Query::CollisionFirst, configuration).expect("an answer").answer {
        Answer::Collision { hit, .. } => hit,
        other => panic!("{other:?}"),
    }
}

/// How far apart?
pub fn distance(session: &mut Session, configuration: &Configuration) -> f64 {
    match session.query(Query::Proximity, configuration).expect("an answer").answer {
        Answer::Distance { distance, .. } => distance,
        other => panic!("{other:?}"),
    }
}

/// An object of the test data.
pub fn mesh(name: &str) -> Arc<Mesh> {
    let bytes = std::fs::read(shared(&format!("meshes/{name}.obj"))).expect("readable");
    Arc::new(obj::read(&bytes).expect("an object").mesh.to_f32_representable().expect("fits into f32"))
}

/// Every `stride`-th configuration of a set like `bunny65k.W1`, with its index.
pub fn configurations(set: &str, stride: usize) -> Vec<(usize, Configuration)> {
    let poses = numbers(&format!("configurations/{set}.f64"));
    let pose = |m: &[f64]| Pose::from_row_major(m.try_into().expect("16 numbers")).expect("a pose");
    let all = poses.chunks_exact(16).map(|m| Configuration { pose_a: Pose::identity(), pose_b: pose(m) });
    all.enumerate().step_by(stride).collect()
}

/// A file of little-endian doubles.
pub fn numbers(name: &str) -> Vec<f64> {
    let bytes = std::fs::read(shared(name)).expect("readable");
    bytes.chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().expect("8 bytes"))).collect()
}
