//! The advisor at work: a program in the jail, because it calls libraries of others (parry, meshopt in C++) on visitors' meshes.
//!
//! Each object's levels are made in a process of their own, and the advice in another one. What they send back is read as
//! hostile input (`ocb_advice::work`); how they may end badly is one sentence.

mod asked;
mod shelf;

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use ocb_advice::work::{Object, Order, Parts, Reply, Rung, STEPS, Scene, Simpler, Task};
use ocb_advice::{Advice, Certificate, Question, Watch};
use ocb_core::mesh::Mesh;
use ocb_sandbox::text::one_line;
use ocb_sandbox::work::{Seen, Work};
use ocb_sandbox::{Ending, Outcome, Policy};

pub use asked::Found;
use shelf::Shelf;

use crate::machine::{Machine, MeasuringRight};
use crate::reduce::Simplified;
use crate::{LabError, Result};

/// The program's name, beside the runner.
pub const PROGRAM: &str = "ocb-advisor";

/// Where certificates are kept below the data folder.
pub const SHELF: &str = "certificates";
/// Between two looks at it.
const LOOK_EVERY: Duration = Duration::from_millis(20);
/// The longest that one process may work, without its wait for the right to measure.
const LONGEST: Duration = Duration::from_secs(3600);
/// The most memory it may use, and half of the machine's at most.
const MEMORY: u64 = 8 << 30;
/// The longest reply.
const ROOM: usize = 1 << 30;
/// Levels in one at most: each has at most 80 % of the triangles of the one before.
const MOST_LEVELS: usize = 100;
/// Ways in which an object is cut into parts, and parts, at most.
const MOST_CUTS: usize = 8;
const MOST_PARTS: usize = 256;
/// The longest text in one.
const TEXT: usize = 500;

/// How to start the program.
#[derive(Clone, Debug)]
pub struct Advisor {
    program: PathBuf,
    policy: Policy,
    threads: usize,
    shelf: Shelf,
    /// Wait for the machine's right to measure before times are taken.
    wait: bool,
}

/// A question about two objects; B may be the same as A.
#[derive(Clone, Debug)]
pub struct Request {
    /// Their names.
    pub names: [String; 2],
    /// The objects.
    pub meshes: [Arc<Mesh>; 2],
    /// The question, in the objects' own lengths.
    pub question: Question,
    /// Relative distances of the configurations.
    pub distances: Vec<f64>,
    /// Configurations to choose by, and others to check by.
    pub counts: [u32; 2],
    /// Of the configurations.
    pub seed: u64,
}

/// The advice, and of both objects the levels that it speaks of: the finest first, which is the object.
#[derive(Clone, Debug)]
pub struct Advised {
    /// The advice.
    pub advice: Advice,
    /// The levels of A and of B.
    pub ladders: [Vec<Level>; 2],
}

/// A level of an object.
#[derive(Clone, Debug)]
pub struct Level {
    /// Its mesh.
    pub mesh: Arc<Mesh>,
    /// Its certificate; the object itself has none.
    pub certificate: Option<Certificate>,
}

impl Advisor {
    /// Starts this program on this machine, and keeps certificates in a folder.
    pub fn new(program: &Path, machine: &Machine, shelf: &Path) -> Self {
        let threads = machine.allowed.len().max(1);
        let policy = Policy {
            memory_bytes: (machine.memory_bytes / 2).clamp(1 << 30, MEMORY),
            trial_seconds: LONGEST.as_secs_f64(),
            threads,
            ..Policy::default()
        };
        Self { program: program.to_owned(), policy, threads, shelf: Shelf::folder(shelf), wait: false }
    }

    /// Its times are taken only while this process has the machine's right to measure.
    pub fn waiting_for_the_right(self) -> Self {
        Self { wait: true, ..self }
    }

    /// Makes advice; `None` when it was stopped. Call it from a thread that lives as long as the work.
    ///
    /// # Errors
    /// `Invalid` when there are no such configurations, `Ended` when the program came to a bad end, `Fault` when it cannot be
    /// started.
    pub fn advise(&self, request: &Request, watch: &dyn Watch) -> Result<Option<Advised>> {
        let [a, b] = &request.meshes;
        let Some(of_a) = self.ladder(&request.names[0], a, watch)? else { return Ok(None) };
        let same = Arc::ptr_eq(a, b);
        let of_b = match same {
            true => Some(of_a.clone()),
            false => self.ladder(&request.names[1], b, watch)?,
        };
        let Some(of_b) = of_b else { return Ok(None) };
        let scene = Scene {
            a: object(&of_a),
            b: (!same).then(|| object(&of_b)),
            question: request.question,
            distances: request.distances.clone(),
            counts: request.counts,
            seed: request.seed,
        };
        let Some(reply) = self.run(Task::Advise(Box::new(scene)), "", watch)? else { return Ok(None) };
        let mut advice = match reply {
            Reply::Advice(advice) => *advice,
            Reply::NeverThatClose => {
                return Err(LabError::Invalid("B never comes that close to A; choose other distances.".to_owned()));
            }
            Reply::Impossible(why) => {
                let why = one_line(&why, TEXT);
                return Err(LabError::Invalid(format!("These configurations are not possible: {why}.")));
            }
            Reply::Ladder(_) | Reply::Simpler(_) => return Err(nonsense("it sent something else than advice")),
        };
        let triangles = [&of_a, &of_b].map(|levels| sizes(levels));
        let vertices = [a, b].map(|mesh| mesh.positions().len());
        advice.check(request.question, [&triangles[0], &triangles[1]], vertices).map_err(|why| nonsense(&why))?;
        clean(&mut advice);
        Ok(Some(Advised { advice, ladders: [of_a, of_b] }))
    }

    /// An object and its levels.
    fn ladder(&self, name: &str, object: &Arc<Mesh>, watch: &dyn Watch) -> Result<Option<Vec<Level>>> {
        let hash = object.sha256();
        let task = Task::Ladder { object: Parts::of(object), known: self.shelf.get(&hash) };
        let rungs = match self.run(task, name, watch)? {
            Some(Reply::Ladder(rungs)) => rungs,
            Some(_) => return Err(nonsense("it sent something else than levels")),
            None => return Ok(None),
        };
        let mut levels = vec![Level { mesh: object.clone(), certificate: None }];
        for rung in rungs {
            let before = levels.last().map_or(0, |level| level.mesh.triangles().len());
            let (mesh, certificate) = rung.read(&hash, before).map_err(|why| nonsense(&why))?;
            levels.push(Level { mesh, certificate: Some(certificate) });
        }
        let known: Vec<Certificate> = levels.iter().filter_map(|level| level.certificate.clone()).collect();
        self.shelf.put(&hash, &known);
        Ok(Some(levels))
    }

    /// What may stand for an object with this name, without certificates; `None` when it was stopped.
    ///
    /// # Errors
    /// As for [`Advisor::advise`].
    pub fn simplify(&self, name: &str, object: &Mesh, watch: &dyn Watch) -> Result<Option<Simplified>> {
        let Simpler { levels, hull, parts } = match self.run(Task::Simplify(Parts::of(object)), name, watch)? {
            Some(Reply::Simpler(simpler)) => simpler,
            Some(_) => return Err(nonsense("it sent something else than bodies")),
            None => return Ok(None),
        };
        let mesh = |parts: Parts| parts.mesh().map(Arc::new).map_err(|e| nonsense(&e.to_string()));
        let levels = levels.into_iter().take(MOST_LEVELS).map(mesh).collect::<Result<_>>()?;
        let cut = |parts: Vec<Parts>| parts.into_iter().take(MOST_PARTS).map(mesh).collect();
        let parts = parts.into_iter().take(MOST_CUTS).map(cut).collect::<Result<_>>()?;
        Ok(Some(Simplified { levels, hull: hull.map(mesh).transpose()?, parts }))
    }

    /// Does one piece of work in a jail; `None` when it was stopped. `name` belongs to the object whose levels are made.
    fn run(&self, task: Task, name: &str, watch: &dyn Watch) -> Result<Option<Reply>> {
        if watch.stopped() {
            return Ok(None);
        }
        let order = serde_json::to_vec(&Order { threads: self.threads, task })
            .map_err(|e| LabError::fault("Writing the advisor's order failed", e))?;
        let mut work = Work::start(&self.program, &self.policy, &order, ROOM).map_err(ended)?;
        drop(order);
        let mut right = None;
        loop {
            match work.look() {
                Ok(Seen::Done) => break,
                Ok(Seen::Working { step, done, total }) => {
                    let what = STEPS.get(usize::from(step)).copied().unwrap_or_default();
                    match what == STEPS[0] {
                        true => watch.step(&format!("{what} of {name}"), done.into(), total.into()),
                        false => watch.step(what, done.into(), total.into()),
                    }
                }
                Ok(Seen::AsksToMeasure) => {
                    if self.wait {
                        right = right_to_measure(&mut work, watch)?;
                    }
                    work.grant();
                }
                Err(outcome) => return Err(ended(work.fail(outcome))),
            }
            if watch.stopped() {
                return Ok(None);
            }
            std::thread::sleep(LOOK_EVERY);
        }
        let bytes = work.finish().map_err(ended)?;
        drop(right);
        serde_json::from_slice(&bytes).map(Some).map_err(|_| nonsense("it sent no reply"))
    }
}

/// Waits until nothing else measures on this machine; nothing when the work was stopped or ended.
fn right_to_measure(work: &mut Work, watch: &dyn Watch) -> Result<Option<MeasuringRight>> {
    let work = RefCell::new(work);
    let waits = || watch.step("waiting for a measurement to end", 0, 0);
    MeasuringRight::wait(|| watch.stopped() || work.borrow_mut().look().is_err(), waits)
}

fn object(levels: &[Level]) -> Object {
    let rung = |level: &Level| Some(Rung { mesh: Parts::of(&level.mesh), certificate: level.certificate.clone()? });
    Object { mesh: Parts::of(&levels[0].mesh), levels: levels.iter().filter_map(rung).collect() }
}

fn sizes(levels: &[Level]) -> Vec<usize> {
    levels.iter().map(|level| level.mesh.triangles().len()).collect()
}

/// The texts in it stand on pages and in terminals.
fn clean(advice: &mut Advice) {
    let texts = advice.points.iter_mut().filter_map(|point| point.algorithm.as_mut());
    let left_out =
        advice.left_out.iter_mut().flat_map(|left_out| left_out.what.iter_mut().chain([&mut left_out.reason]));
    texts.chain(left_out).for_each(|text| *text = one_line(text, TEXT));
}

/// What came back is nothing that the program would send by itself.
fn nonsense(what: &str) -> LabError {
    tracing::error!("the advisor's reply is not used: {what}");
    LabError::Ended("The advisor failed: its reply makes no sense.".to_owned())
}

/// How the program ended, as a fact without a cause that is not known.
fn ended(ending: Ending) -> LabError {
    let Ending { outcome, stderr, .. } = ending;
    if let Outcome::SandboxFault { step, reason } = &outcome {
        return LabError::Fault(format!("The advisor cannot be started (step {step}): {reason}."));
    }
    tracing::error!(?outcome, stderr, "the advisor failed");
    let how = match outcome {
        Outcome::TimedOut { limit_seconds, .. } => format!("it worked for longer than {limit_seconds} s"),
        Outcome::OutOfMemory { limit_bytes, .. } => format!("it needed more than {} MiB of memory", limit_bytes >> 20),
        Outcome::Signaled { signal, .. } => format!("it crashed with signal {signal}"),
        Outcome::SyscallDenied { call, .. } => format!("it made the forbidden system call {}", call.name),
        _ => "its process ended too early".to_owned(),
    };
    LabError::Ended(format!("The advisor failed: {how}."))
}
