//! A measuring machine: it turns the order of a service and the files that the order names into results.

mod advise;
mod errand;
mod replay;
mod sentinel;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ocb_core::mesh::Mesh;
use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use crate::algorithm::{Algorithm, Runner, plugin_files, plugin_hash};
use crate::columns::read_set;
use crate::job::{self, Job, Place, Results, Step};
use crate::machine::Machine;
use crate::measure::{Part, Preliminary, Stop, Task};
use crate::mesh_file::from_bytes;
use crate::model::{Ended, MachineFacts, MeasuredAlgorithm, OrderedAlgorithm, Told, WorkOrder};
use crate::pairing::Pairing;
use crate::{LabError, Result, sha256_hex};

/// This machine, with what is installed on it.
pub struct Worker {
    runner: Runner,
    machine: Machine,
    facts: MachineFacts,
    /// Installed plugin files by hash.
    plugins: HashMap<String, PathBuf>,
}

/// How an attempt ended, with the files of its results.
pub struct Handed {
    /// How.
    pub ended: Ended,
    /// In the order in which [`Ended::Measured`] names them.
    pub files: Vec<Vec<u8>>,
}

/// What an algorithm has found so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Seen {
    /// Its place in the list of algorithms.
    pub place: usize,
    /// Numbers and records.
    pub preliminary: Preliminary,
}

/// What a machine tells while it measures.
pub enum Report {
    /// How far it is.
    Told(Told),
    /// What there is to see.
    Seen(Box<Seen>),
}

/// Hears what a machine tells.
pub type Tell<'a> = &'a mut (dyn FnMut(Report) + Send);

/// Gives the file that an order names.
pub type Fetch<'a> = dyn Fn(&str) -> Result<Vec<u8>> + 'a;

impl Worker {
    /// Looks at this machine, and at the runner and the plugins that are installed.
    ///
    /// # Errors
    /// `Fault` when the runner cannot be read or the machine cannot be looked at.
    pub fn observe(runner: Runner, plugins: &[PathBuf], note: Option<&str>) -> Result<Self> {
        let machine = Machine::observe()?.noted(note);
        let hashed = plugin_files(plugins).into_iter().filter_map(|file| Some((plugin_hash(&file).ok()?, file)));
        let plugins: HashMap<String, PathBuf> = hashed.collect();
        let mut hashes: Vec<String> = plugins.keys().cloned().collect();
        hashes.sort();
        let facts = MachineFacts {
            version: env!("CARGO_PKG_VERSION").into(),
            runner_sha256: plugin_hash(&runner.program)?,
            plugins: hashes,
            hardware_class: machine.hardware_class.clone(),
            cpu: machine.cpu.clone(),
            kernel: machine.kernel.clone(),
            microcode: machine.microcode.clone(),
            governor: governor(machine.measuring_cpu()),
            profile: runner.profile.as_str().into(),
            partition: std::env::var("SLURM_JOB_PARTITION").ok(),
        };
        Ok(Self { runner, machine, facts, plugins })
    }

    /// What it says of itself.
    pub fn facts(&self) -> &MachineFacts {
        &self.facts
    }

    /// Measures what is ordered; `None` when it was stopped. Blocks.
    ///
    /// # Errors
    /// `Fault` when a file cannot be had or is not the ordered one, or this machine cannot measure.
    pub fn measure(
        &self,
        order: &WorkOrder,
        stop: &Stop,
        fetch: &Fetch<'_>,
        tell: &mut dyn FnMut(Report),
    ) -> Result<Option<Handed>> {
        let spec = &order.spec;
        let pairing = pairing(order, fetch)?;
        let bytes = fetch("set")?;
        let set = read_set(&checked("configuration set", &order.set.sha256, sha256_hex(&bytes), bytes)?)?;
        let brought = temporary_folder()?;
        let algorithms: Vec<Arc<Algorithm>> =
            order.algorithms.iter().map(|it| self.algorithm(it, &brought, fetch)).collect::<Result<_>>()?;
        let reference = order.reference.as_ref().map(|it| self.algorithm(it, &brought, fetch)).transpose()?;
        let part = Part::of(spec, &set);
        let watched = order.look.is_some();
        let task = Task::of(spec, (&pairing, &set, part), &algorithms, reference.as_ref());
        let task = Task { seed: order.draw.seed, watched, ..task };
        let job = Job { task, look: order.look, set: &order.set, run: &order.run, draw: order.draw.clone() };
        let place = Place { runner: &self.runner, machine: &self.machine, stop };
        let found: Result<Option<Results>> = job::measure(job, &place, &mut |step| {
            tell(report(step));
            Ok(())
        });
        Ok(found?.map(handed))
    }

    /// The algorithm with its file: the installed one, or the one that the order brings.
    fn algorithm(&self, ordered: &OrderedAlgorithm, brought: &TempDir, fetch: &Fetch<'_>) -> Result<Arc<Algorithm>> {
        let hash = &ordered.info.plugin_sha256;
        let file = match self.plugins.get(hash) {
            Some(installed) => installed.clone(),
            None => write_plugin(brought.path(), hash, fetch)?,
        };
        Ok(self.with_file(ordered, file))
    }

    fn with_file(&self, ordered: &OrderedAlgorithm, file: PathBuf) -> Arc<Algorithm> {
        let OrderedAlgorithm { info, id_in_plugin, settings, threads } = ordered.clone();
        let trusted = self.runner.trusts(&file);
        Arc::new(Algorithm { info, id_in_plugin, settings, threads, file, trusted })
    }
}

/// The frequency governor of a CPU; "none" where the kernel has none, as in most virtual machines.
fn governor(cpu: usize) -> String {
    let file = format!("/sys/devices/system/cpu/cpu{cpu}/cpufreq/scaling_governor");
    std::fs::read_to_string(file).map_or("none".into(), |text| text.trim().to_owned())
}

fn pairing(order: &WorkOrder, fetch: &Fetch<'_>) -> Result<Pairing> {
    let a = mesh("a", &order.mesh_a, fetch)?;
    let b = order.mesh_b.as_ref().map(|sha256| mesh("b", sha256, fetch)).transpose()?;
    Ok(Pairing::new(a, b))
}

fn mesh(name: &str, sha256: &str, fetch: &Fetch<'_>) -> Result<Arc<Mesh>> {
    let mesh = from_bytes(&fetch(name)?)?;
    let found = mesh.sha256();
    Ok(Arc::new(checked("mesh", sha256, found, mesh)?))
}

fn temporary_folder() -> Result<TempDir> {
    tempfile::tempdir().map_err(|e| LabError::fault("Making a temporary folder failed", e))
}

fn write_plugin(folder: &Path, sha256: &str, fetch: &Fetch<'_>) -> Result<PathBuf> {
    let bytes = fetch(&format!("plugin-{sha256}"))?;
    let bytes = checked("plugin", sha256, sha256_hex(&bytes), bytes)?;
    let file = folder.join(format!("{sha256}.so"));
    std::fs::write(&file, bytes).map_err(|e| LabError::fault("Writing a plugin file failed", e))?;
    Ok(file)
}

/// What arrived, if it is what was ordered.
fn checked<T>(what: &str, ordered: &str, found: String, arrived: T) -> Result<T> {
    if ordered == found {
        return Ok(arrived);
    }
    Err(LabError::Fault(format!("The {what} that the service sent is not the ordered one: {found}, not {ordered}.")))
}

fn report(step: Step) -> Report {
    match step {
        Step::Waiting(waiting) => Report::Told(Told::Waiting { waiting }),
        Step::Progress { place, done, total, worked } => {
            Report::Told(Told::Progress { place, done, total, worked_us: worked.as_micros() as u64 })
        }
        Step::Preliminary(place, seen) => Report::Seen(Box::new(Seen { place, preliminary: *seen })),
    }
}

fn handed(results: Results) -> Handed {
    let Results { algorithms, environment, preview } = results;
    let mut files = Vec::new();
    let mut measured = Vec::new();
    for found in algorithms {
        measured.push(MeasuredAlgorithm {
            records: found.records.is_some(),
            triangle_tests: found.triangle_tests.is_some(),
            result: found.result,
            plugin_sha256: found.plugin_sha256,
            seconds_per_query: found.seconds_per_query,
        });
        files.extend([found.records, found.triangle_tests].into_iter().flatten());
    }
    let (environment, preview) = (environment.map(Box::new), preview.map(Box::new));
    Handed { ended: Ended::Measured { algorithms: measured, environment, preview }, files }
}
