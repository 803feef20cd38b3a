//! Other methods on the same plot: what people use instead of the exact search, each with one or two settings of its knob.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use ocb_advice::{Kind, LeftOut, Question, Watch};
use ocb_core::configuration::Placed;
use ocb_core::mesh::Mesh;
use ocb_core::numbers::Numbers;
use ocb_methods::convex_parts::ConvexParts;
use ocb_methods::inner_spheres::InnerSpheres;
use ocb_methods::parry::{double, single};
use ocb_methods::voxmap_pointshell::VoxmapPointshell;
use rayon::prelude::*;

use crate::method::{Ask, Method, ask, load};
use crate::question::Told;

/// The usual setting of each knob beside a coarser or a finer one; all of them are built in seconds.
const DEPTHS: [u32; 2] = [5, 7];
const SPHERES: [usize; 2] = [512, 4096];
const VOXELS: [f64; 2] = [0.01, 0.005];
/// Objects of more triangles than this are not cut into parts: it takes minutes, and gigabytes for the points of the hulls.
const MOST_TO_CUT: usize = 500_000;

/// Nobody waits longer than this for the answers of one method; its times take three times as long again.
const LONGEST: Duration = Duration::from_secs(4);
/// Of a method that would need longer for all configurations, the answers to so many at least are a point.
const ENOUGH: usize = 20;

/// A method for both objects, and what it told of every configuration that it was asked about.
pub(crate) struct StandIn {
    pub(crate) kind: Kind,
    pub(crate) algorithm: String,
    /// Of both objects.
    pub(crate) elements: usize,
    pub(crate) ask: Ask,
    pub(crate) told: Vec<Option<Told>>,
}

/// Why there is none.
enum Without {
    Stopped,
    Because(String),
}

/// What all of them are made from.
struct Workshop<'a> {
    meshes: [&'a Arc<Mesh>; 2],
    question: Question,
    sample: &'a [Placed],
    watch: &'a dyn Watch,
    /// Steps that are done, of all.
    done: AtomicU64,
    total: u64,
}

/// Elements, how to ask, and the answers.
type Made = Result<(usize, Ask, Vec<Option<Told>>), Without>;

/// How to make one.
struct Recipe {
    kind: Kind,
    algorithm: String,
    make: Box<dyn Fn(&Workshop<'_>) -> Made + Send + Sync>,
}

/// All that can be made, asked about every configuration, and what cannot; `None` when it was stopped.
pub(crate) fn stand_ins(
    meshes: [&Arc<Mesh>; 2],
    question: Question,
    sample: &[Placed],
    watch: &dyn Watch,
) -> Option<(Vec<StandIn>, Vec<LeftOut>)> {
    let recipes = recipes(question);
    let total = (recipes.len() * (2 + sample.len())) as u64;
    let workshop = Workshop { meshes, question, sample, watch, done: AtomicU64::new(0), total };
    // A library that panics costs its own point.
    let make = |recipe: &Recipe| {
        catch_unwind(AssertUnwindSafe(|| (recipe.make)(&workshop)))
            .unwrap_or_else(|_| Err(Without::Because("its library breaks down on these objects".to_owned())))
    };
    let made: Vec<Made> = recipes.par_iter().map(make).collect();
    let (mut stand_ins, mut left_out) = (Vec::new(), Vec::new());
    for (Recipe { kind, algorithm, .. }, made) in recipes.into_iter().zip(made) {
        match made {
            Ok((elements, ask, told)) => stand_ins.push(StandIn { kind, algorithm, elements, ask, told }),
            Err(Without::Because(reason)) => leave_out(&mut left_out, algorithm, reason),
            Err(Without::Stopped) => return None,
        }
    }
    Some((stand_ins, left_out))
}

/// Notes what is missing, once for each reason.
pub(crate) fn leave_out(left_out: &mut Vec<LeftOut>, what: String, reason: String) {
    match left_out.iter_mut().find(|known| known.reason == reason) {
        Some(known) => known.what.push(what),
        None => left_out.push(LeftOut { what: vec![what], reason }),
    }
}

fn recipes(question: Question) -> Vec<Recipe> {
    let mut all = Vec::new();
    for depth in DEPTHS {
        let make = move || ConvexParts::with_depth(depth);
        all.push(recipe(Kind::ConvexParts, format!("convex-parts:depth={depth}"), MOST_TO_CUT, make));
    }
    for spheres in SPHERES {
        let make = move || InnerSpheres::with_spheres(spheres);
        all.push(recipe(Kind::InnerSpheres, format!("inner-spheres:spheres={spheres}"), usize::MAX, make));
    }
    for voxel in VOXELS {
        let make = move || VoxmapPointshell::with_voxel(voxel).beyond(question.reach());
        all.push(recipe(Kind::Voxels, format!("voxmap-pointshell:voxel={voxel}"), usize::MAX, make));
    }
    all.push(recipe(Kind::DoublePrecision, "parry".to_owned(), usize::MAX, || double::Parry));
    all.push(recipe(Kind::SinglePrecision, "parry-f32".to_owned(), usize::MAX, || single::Parry));
    all
}

/// Objects of at most so many triangles get what `method` makes of them.
fn recipe<M: Method>(
    kind: Kind,
    algorithm: String,
    most: usize,
    method: impl Fn() -> M + Send + Sync + 'static,
) -> Recipe {
    Recipe { kind, algorithm, make: Box::new(move |workshop| workshop.make(method(), most)) }
}

impl Workshop<'_> {
    fn make<M: Method>(&self, mut method: M, most: usize) -> Made {
        let [a, b] = self.meshes;
        let a = self.load(&mut method, a, "A", most)?;
        let b = match Arc::ptr_eq(self.meshes[0], b) {
            true => a.clone(),
            false => self.load(&mut method, b, "B", most)?,
        };
        let elements = M::elements(&a) + M::elements(&b);
        let mut ask = ask(method, [a, b], self.question);
        let started = Instant::now();
        // In a drawn order, so that those who end early have been asked about all distances.
        let mut order: Vec<usize> = (0..self.sample.len()).collect();
        Numbers::new(0).shuffle(&mut order);
        let mut told = vec![None; self.sample.len()];
        for (before, &i) in order.iter().enumerate() {
            self.step()?;
            if started.elapsed() > LONGEST {
                if before >= ENOUGH {
                    break;
                }
                let why = format!("it needs more than {} s for {ENOUGH} answers", LONGEST.as_secs());
                return Err(Without::Because(why));
            }
            told[i] = Some(ask(&self.sample[i].configuration).map_err(Without::Because)?);
        }
        Ok((elements, ask, told))
    }

    fn load<M: Method>(&self, method: &mut M, mesh: &Mesh, name: &str, most: usize) -> Result<Arc<M::Object>, Without> {
        self.step()?;
        let triangles = mesh.triangles().len();
        if triangles > most {
            return Err(Without::Because(format!(
                "{name} has {triangles} triangles, and {most} are the most that it takes"
            )));
        }
        load(method, mesh).map_err(|why| Without::Because(format!("{name}: {why}")))
    }

    /// One step more, if nobody stops the work.
    fn step(&self) -> Result<(), Without> {
        self.watch.step("other methods", self.done.fetch_add(1, Ordering::Relaxed) + 1, self.total);
        if self.watch.stopped() { Err(Without::Stopped) } else { Ok(()) }
    }
}
