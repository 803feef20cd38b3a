//! The program's work: an order as JSON, a reply as JSON.

use std::sync::Arc;

use ocb_advice::work::{Object, Order, Parts, Reply, Rung, STEPS, Scene as Asked, Simpler, Task};
use ocb_advice::{Certificate, Watch};
use ocb_core::mesh::Mesh;
use ocb_core::sampling::SamplingError;
use ocb_sandbox::inside::task::Desk;

use crate::advice::{Scene, advise};
use crate::ladder::{Level, ladder, meshes};
use crate::parts::hulls_of_parts;
use crate::proxy::hull;
use crate::scene::sample;

/// Steps go to the supervisor; who wants no more of it ends the process.
struct Told<'a>(&'a Desk<'a>);

impl Watch for Told<'_> {
    fn step(&self, what: &str, done: u64, total: u64) {
        let step = STEPS.iter().position(|step| *step == what).unwrap_or(0);
        self.0.progress(step as u8, done, total);
    }

    fn stopped(&self) -> bool {
        false
    }
}

/// Does what is ordered.
///
/// # Panics
/// If the order is none: it comes from the service alone.
pub fn work(order: &[u8], may_start_threads: bool, desk: &Desk<'_>) -> Vec<u8> {
    let Order { threads, task } = serde_json::from_slice(order).expect("the service sends an order");
    let pool = match may_start_threads {
        true => rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)),
        false => rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread(),
    };
    pool.build_global().expect("the first pool of this process");
    let told = Told(desk);
    let reply = match task {
        Task::Ladder { object, known } => Reply::Ladder(rungs(&whole(object), &known, &told)),
        Task::Simplify(object) => {
            let object = whole(object);
            let all = |meshes: &Vec<Mesh>| meshes.iter().map(Parts::of).collect();
            let (levels, hull) = (all(&meshes(&object)), hull(&object).as_ref().map(Parts::of));
            Reply::Simpler(Simpler { levels, hull, parts: hulls_of_parts(&object).iter().map(all).collect() })
        }
        Task::Advise(scene) => advice(*scene, &told, desk),
    };
    serde_json::to_vec(&reply).expect("plain data is always JSON")
}

fn whole(parts: Parts) -> Arc<Mesh> {
    Arc::new(parts.mesh().expect("the service sends meshes"))
}

fn rungs(object: &Arc<Mesh>, known: &[Certificate], watch: &dyn Watch) -> Vec<Rung> {
    let levels = ladder(object, known, watch).expect("nothing stops it but the end of the process");
    let rung = |level: Level| Some(Rung { mesh: Parts::of(&level.mesh), certificate: level.certificate? });
    levels.into_iter().filter_map(rung).collect()
}

fn advice(asked: Asked, watch: &dyn Watch, desk: &Desk<'_>) -> Reply {
    let Asked { a, b, question, distances, counts, seed } = asked;
    let levels = |Object { mesh, levels }: Object| -> Vec<Level> {
        let known = |rung: Rung| {
            let mesh = rung.mesh.mesh().expect("the service sends meshes");
            Level::known(mesh, rung.certificate).expect("the service sends what fits")
        };
        std::iter::once(Level::whole(whole(mesh))).chain(levels.into_iter().map(known)).collect()
    };
    let of_a = levels(a);
    let of_b = b.map_or_else(|| of_a.clone(), levels);
    let shapes = [of_a[0].lod.shape(), of_b[0].lod.shape()];
    let placed = |count: u32, seed, what| match count {
        0 => Ok(Vec::new()),
        _ => sample(shapes, &distances, count, seed, what, watch),
    };
    let samples = placed(counts[0], seed, STEPS[1])
        .and_then(|chosen_by| Ok((chosen_by, placed(counts[1], seed.wrapping_add(1), STEPS[2])?)));
    let (chosen_by, held_out) = match samples {
        Ok(samples) => samples,
        Err(SamplingError::Stopped) => unreachable!("nothing stops it but the end of the process"),
        Err(e) => return Reply::Impossible(e.to_string()),
    };
    if chosen_by.is_empty() {
        return Reply::NeverThatClose;
    }
    desk.ask_to_measure();
    let ladders = [of_a.as_slice(), of_b.as_slice()];
    let scene = Scene { ladders, question, distances: &distances, sample: &chosen_by, held_out: &held_out };
    Reply::Advice(Box::new(advise(&scene, watch).expect("nothing stops it but the end of the process")))
}
