//! Advice: how much of the models a question needs, what that saves, and what is known of its errors.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use ocb_advice::{Advice, HeldOut, LevelFacts, Levels, Question, Share, Watch};
use ocb_core::configuration::Placed;
use ocb_core::lod::LodPair;
use rayon::prelude::*;

use crate::choice::{Ladders, fastest, smallest};
use crate::detail::detail;
use crate::ladder::Level;
use crate::points::{Plot, points};
use crate::question::Told;
use crate::timing::ratio;

/// Medians of so many times are told.
const PASSES: usize = 3;

/// What advice is made from.
pub struct Scene<'a> {
    /// Both objects' levels, finest first.
    pub ladders: [&'a [Level]; 2],
    /// What is asked.
    pub question: Question,
    /// Relative distances of the configurations.
    pub distances: &'a [f64],
    /// Configurations to choose by.
    pub sample: &'a [Placed],
    /// Other ones to check by.
    pub held_out: &'a [Placed],
}

/// Makes advice; `None` when it was stopped. Neither sample may be empty.
pub fn advise(scene: &Scene, watch: &dyn Watch) -> Option<Advice> {
    let started = Instant::now();
    let Scene { question, sample, .. } = *scene;
    let ladders = Ladders { a: scene.ladders[0], b: scene.ladders[1] };
    let stages = match question {
        Question::Distance { .. } => vec![smallest(&ladders, question, sample, watch)?],
        Question::Clearance { .. } => fastest(&ladders, question, sample, watch)?,
    };
    let stages: Vec<Levels> = stages.into_iter().filter(|levels| *levels != [0, 0]).collect();
    let Plot { points, left_out, times } = points(&ladders, question, &stages, sample, PASSES, watch)?;
    let first = ladders.pair(stages.first().copied().unwrap_or_default());
    let half = |width: f64| Some(width / 2.0).filter(|_| matches!(question, Question::Distance { .. }));
    let guaranteed_error = points.iter().find(|p| p.advised).and_then(|p| p.guaranteed_error);
    Some(Advice {
        question,
        distances: scene.distances.to_vec(),
        configurations: sample.len() as u32,
        longest_side: ladders.a[0].mesh.longest_side(),
        levels_a: facts(ladders.a),
        levels_b: facts(ladders.b),
        triangles_before: ladders.pair([0, 0]).triangles() as u32,
        triangles_after: first.triangles() as u32,
        faster: ratio(&times.distance, &times.advised),
        faster_than_same_question: ratio(&times.same_question, &times.advised),
        guaranteed_error,
        guaranteed_anywhere: half(first.most_width()),
        held_out: hold(&ladders, question, &stages, scene.held_out, watch)?,
        points,
        left_out,
        detail: detail(&ladders, question, sample, watch)?,
        stages,
        seconds: started.elapsed().as_secs_f64(),
    })
}

fn facts(levels: &[Level]) -> Vec<LevelFacts> {
    let one = |level: &Level| {
        let [thickness, deviation] = level.certificate.as_ref().map_or([0.0; 2], |c| c.worst());
        LevelFacts { triangles: level.mesh.triangles().len() as u32, thickness, deviation }
    };
    levels.iter().map(one).collect()
}

/// Asks the advice about configurations whose truth is known.
fn hold(
    ladders: &Ladders,
    question: Question,
    stages: &[Levels],
    held_out: &[Placed],
    watch: &dyn Watch,
) -> Option<HeldOut> {
    let hybrid = ladders.hybrid(stages);
    let done = AtomicU64::new(0);
    let one = |placed: &Placed| -> Option<Held> {
        let truth = &placed.truth;
        let lies = |stage: &LodPair| {
            let found = stage.distance(&placed.configuration, 0.0);
            found.lo > truth.distance_hi || found.hi < truth.distance_lo
        };
        let (told, fell_back) = hybrid.answer(question, &placed.configuration);
        let (wrong, off) = match (told, question) {
            (Told::Distance(found), Question::Distance { tolerance }) => {
                let off = (found.middle() - truth.distance_lo).abs().max((found.middle() - truth.distance_hi).abs());
                (off > tolerance * (1.0 + 1e-9) + (truth.distance_hi - truth.distance_lo), Some(off))
            }
            (Told::Clear(true), Question::Clearance { clearance }) => (truth.distance_hi <= clearance, None),
            (Told::Clear(false), Question::Clearance { clearance }) => (truth.distance_lo > clearance, None),
            _ => unreachable!("an answer is of its question's kind"),
        };
        watch.step("checking", done.fetch_add(1, Ordering::Relaxed) + 1, held_out.len() as u64);
        let violated = hybrid.stages.iter().any(lies);
        (!watch.stopped()).then_some(Held { violated, wrong, fell_back: fell_back && !stages.is_empty(), off })
    };
    let all: Vec<Held> = held_out.par_iter().map(one).collect::<Option<_>>()?;
    let share = |of: fn(&Held) -> bool| Share::of(all.iter().filter(|held| of(held)).count() as u32, all.len() as u32);
    Some(HeldOut {
        violations: share(|held| held.violated),
        wrong: share(|held| held.wrong),
        falls_back: share(|held| held.fell_back),
        observed_error: all.iter().filter_map(|held| held.off).reduce(f64::max),
    })
}

/// What became of one held-out configuration.
struct Held {
    violated: bool,
    wrong: bool,
    fell_back: bool,
    off: Option<f64>,
}
