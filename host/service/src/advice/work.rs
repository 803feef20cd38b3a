//! Advice about levels of detail: worked on one at a time, kept in the store, taken up again after a restart.
//!
//! Such work is no run: nothing foreign is started and nothing is ranked. Its times are taken while this process holds the
//! machine's right to measure, so nothing is measured beside them; the rest of the work is kept off a run's CPU as all
//! threads of this process are.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ocb_advisor::{
    Advice, CONFIGURATIONS, HELD_OUT, Level, Paper, Question, Scene, Shelf, Watch, advise, ladder, sample,
    usual_distances,
};
use ocb_core::mesh::Mesh;
use ocb_core::sampling::SamplingError;
use tokio::sync::{Notify, Semaphore};

use crate::machine::MeasuringRight;
use crate::model::{AdviceInfo, Asked, State};
use crate::{EngineError, Result};

/// The requests that wait or are at work, by id.
#[derive(Debug)]
pub struct Advices {
    jobs: Mutex<HashMap<String, Arc<Job>>>,
    /// Whose turn it is, first come, first served.
    pub turn: Semaphore,
}

impl Default for Advices {
    fn default() -> Self {
        Self { jobs: Mutex::default(), turn: Semaphore::new(1) }
    }
}

/// One request under way.
#[derive(Debug)]
pub struct Job {
    stop: AtomicBool,
    /// Rung when it is stopped, for one that waits.
    changed: Notify,
    info: Mutex<AdviceInfo>,
    /// Whose it is: an account, the guests of an address.
    turn: String,
}

/// What came out: the advice and, of A and of B, what can be taken away: reduced meshes with their certificates.
pub type Found = (Advice, [Vec<(Paper, Arc<Mesh>)>; 2]);

impl Advices {
    /// A request that waits from now on.
    pub fn add(&self, info: AdviceInfo, turn: String) -> Arc<Job> {
        let id = info.id.clone();
        let job = Arc::new(Job { stop: AtomicBool::new(false), changed: Notify::new(), info: Mutex::new(info), turn });
        locked(&self.jobs).insert(id, job.clone());
        job
    }

    /// How many there are, and how many of these are whose.
    pub fn count(&self, turn: &str) -> [usize; 2] {
        let jobs = locked(&self.jobs);
        [jobs.len(), jobs.values().filter(|job| job.turn == turn).count()]
    }

    /// Nothing waits or is at work.
    pub fn is_empty(&self) -> bool {
        locked(&self.jobs).is_empty()
    }

    /// One of them.
    pub fn find(&self, id: &str) -> Option<Arc<Job>> {
        locked(&self.jobs).get(id).cloned()
    }

    /// It has ended.
    pub fn remove(&self, id: &str) {
        locked(&self.jobs).remove(id);
    }

    /// Ends all of them soon.
    pub fn stop_all(&self) {
        locked(&self.jobs).values().for_each(|job| job.stop());
    }
}

impl Job {
    /// How far it is.
    pub fn info(&self) -> AdviceInfo {
        locked(&self.info).clone()
    }

    /// Ends it soon.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
        self.changed.notify_one();
    }

    /// Returns when it was stopped.
    pub async fn ended(&self) {
        self.changed.notified().await;
    }

    /// `None` when it was stopped.
    pub fn work(&self, names: &[String; 2], [a, b]: &[Arc<Mesh>; 2], shelf: &Shelf) -> Result<Option<Found>> {
        if self.stopped() {
            return Ok(None);
        }
        locked(&self.info).state = State::Running;
        let Some(of_a) = ladder(&names[0], a, shelf, self) else { return Ok(None) };
        let of_b = match Arc::ptr_eq(a, b) {
            true => Some(of_a.clone()),
            false => ladder(&names[1], b, shelf, self),
        };
        let Some(of_b) = of_b else { return Ok(None) };
        let side = a.longest_side();
        let question = match locked(&self.info).spec.question {
            Asked::Distance { tolerance } => Question::Distance { tolerance: tolerance * side },
            Asked::Clearance { clearance } => Question::Clearance { clearance: clearance * side },
        };
        let distances = usual_distances(question, side);
        let shapes = [of_a[0].lod.shape(), of_b[0].lod.shape()];
        let placed = |count, seed, what| match sample(shapes, &distances, count, seed, what, self) {
            Ok(placed) => Ok(Some(placed)),
            Err(SamplingError::Stopped) => Ok(None),
            Err(e) => Err(EngineError::Invalid(format!("These configurations are not possible: {e}."))),
        };
        let Some(chosen_by) = placed(CONFIGURATIONS, 0, "configurations")? else { return Ok(None) };
        let Some(held_out) = placed(HELD_OUT, 1, "held-out configurations")? else { return Ok(None) };
        if chosen_by.is_empty() {
            return Err(EngineError::Invalid("B never comes that close to A; choose another distance.".to_owned()));
        }
        let Some(_right) = self.right_to_measure()? else { return Ok(None) };
        let ladders = [of_a.as_slice(), of_b.as_slice()];
        let scene = Scene { ladders, question, distances: &distances, sample: &chosen_by, held_out: &held_out };
        let papers = |advice: &Advice| [0, 1].map(|side| papers_of(side, &names[side], ladders[side], advice));
        Ok(advise(&scene, self).map(|advice| {
            let papers = papers(&advice);
            (advice, papers)
        }))
    }

    /// Waits until nobody measures on this machine; `None` when stopped.
    fn right_to_measure(&self) -> Result<Option<MeasuringRight>> {
        let waits = || self.step("waiting for a measurement to end", 0, 0);
        Ok(MeasuringRight::wait(|| self.stopped(), waits)?)
    }
}

impl Watch for Job {
    fn step(&self, what: &str, done: u64, total: u64) {
        // Nobody who works waits for somebody who looks.
        if let Ok(mut info) = self.info.try_lock() {
            if info.step != what {
                what.clone_into(&mut info.step);
            }
            (info.done, info.total) = (done, total);
        }
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

fn papers_of(side: usize, name: &str, levels: &[Level], advice: &Advice) -> Vec<(Paper, Arc<Mesh>)> {
    let level = |stage: &[usize; 2]| {
        let level = &levels[stage[side]];
        let file = format!("{}-{}.obj", ["a", "b"][side], level.mesh.triangles().len());
        Some((
            Paper { object_file: name.to_owned(), file, certificate: level.certificate.clone()? },
            level.mesh.clone(),
        ))
    };
    advice.stages.iter().filter_map(level).collect()
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
