//! `ocb advise`: how much of the models a question needs.

mod files;
mod lengths;
mod text;
mod verify;
mod work;

use std::process::ExitCode;

use ocb_advisor::{Advice, HeldOut, Level, Scene, Shelf, advise as make, ladder, sample, usual_distances};
use ocb_core::mesh::Mesh;
use ocb_core::sampling::SamplingError;
use std::sync::Arc;

use crate::args::{AdviseArgs, Store};
use crate::failure::{Failure, INTERRUPTED, Result};
use crate::{open, output, truth};

/// Where certificates are kept below the data folder.
const SHELF: &str = "certificates";

/// What the work gives.
struct Advised {
    advice: Advice,
    ladders: [Vec<Level>; 2],
}

/// Advises, prints the card, writes the files; or checks a certificate.
pub async fn advise(store: &Store, args: &AdviseArgs, json: bool) -> Result<ExitCode> {
    if let Some(certificate) = &args.verify {
        return verify::verify(store, certificate, args.a.as_deref(), json).await;
    }
    let Some(named_a) = &args.a else { return Err(Failure::Input("Name an object.".to_owned())) };
    let named_b = args.b.as_ref().unwrap_or(named_a);
    let wanted = lengths::Wanted::read(args)?;
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| Failure::file("create", folder, &e))?;
    }
    let a = truth::object(store, named_a).await?;
    let b = if named_b == named_a { a.clone() } else { truth::object(store, named_b).await? };
    let question = wanted.question(a.longest_side());
    let distances = match args.distance.as_slice() {
        [] => usual_distances(question, a.longest_side()),
        given => given.to_vec(),
    };
    let shelf = Shelf::folder(&open::data(store)?.join(SHELF));
    let names = [named_a.clone(), named_b.clone()];
    let (count, held_out, seed) = (args.configurations, args.held_out, args.seed);
    let done = work::watch(move |watch| {
        let ladders = ladders(&names, [&a, &b], &shelf, watch)?;
        let shapes = [0, 1].map(|side: usize| ladders[side][0].lod.shape());
        let chosen_by = sample(shapes, &distances, count, seed, "configurations", watch)?;
        let fresh = match held_out {
            0 => Vec::new(),
            n => sample(shapes, &distances, n, seed.wrapping_add(1), "held-out configurations", watch)?,
        };
        if chosen_by.is_empty() {
            return Err(Stop::Empty);
        }
        let both = [ladders[0].as_slice(), ladders[1].as_slice()];
        let scene = Scene { ladders: both, question, distances: &distances, sample: &chosen_by, held_out: &fresh };
        let advice = make(&scene, watch).ok_or(Stop::Interrupted)?;
        Ok(Advised { advice, ladders })
    });
    let advised = match done.await? {
        Ok(advised) => advised,
        Err(Stop::Interrupted) => {
            eprintln!("ocb: Stopped; nothing was written.");
            return Ok(ExitCode::from(INTERRUPTED));
        }
        Err(Stop::Empty) => return Err(Failure::Input("B never reaches these distances; choose others.".to_owned())),
        Err(Stop::Sampling(e)) => return Err(Failure::Input(format!("These configurations are not possible: {e}."))),
    };
    let written = match &args.out {
        Some(folder) => files::write(folder, [named_a, named_b], &advised)?,
        None => Vec::new(),
    };
    if json {
        output::print_json(&advised.advice)?
    } else {
        output::print(&text::card(&advised.advice, &written))?
    }
    let HeldOut { violations, wrong, .. } = advised.advice.held_out;
    if violations.seen + wrong.seen > 0 {
        return Err(Failure::Fault(format!(
            "{} certified intervals and {} answers contradict the oracle; please report it with both objects.",
            violations.seen, wrong.seen
        )));
    }
    Ok(ExitCode::SUCCESS)
}

/// Why there is no advice.
enum Stop {
    Interrupted,
    Empty,
    Sampling(SamplingError),
}

impl From<SamplingError> for Stop {
    fn from(error: SamplingError) -> Self {
        match error {
            SamplingError::Stopped => Self::Interrupted,
            other => Self::Sampling(other),
        }
    }
}

fn ladders(
    names: &[String; 2],
    [a, b]: [&Arc<Mesh>; 2],
    shelf: &Shelf,
    watch: &work::Progress,
) -> std::result::Result<[Vec<Level>; 2], Stop> {
    let of_a = ladder(&names[0], a, shelf, watch).ok_or(Stop::Interrupted)?;
    let of_b = match Arc::ptr_eq(a, b) {
        true => of_a.clone(),
        false => ladder(&names[1], b, shelf, watch).ok_or(Stop::Interrupted)?,
    };
    Ok([of_a, of_b])
}
