//! `ocb advise`: how much of the models a question needs.

mod files;
pub mod lengths;
mod text;
mod verify;
pub mod work;

use std::process::ExitCode;

use ocb_advice::{HeldOut, usual_distances};
use ocb_service::advising::{Advisor, Request, SHELF};
use ocb_service::truth::Machine;

use crate::args::{AdviseArgs, Store};
use crate::failure::{Failure, INTERRUPTED, Result};
use crate::{open, output, truth};

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
    let advisor = Advisor::new(&open::advisor(store), &Machine::observe()?, &open::data(store)?.join(SHELF));
    let counts = [args.configurations, args.held_out];
    let names = [named_a.clone(), named_b.clone()];
    let request = Request { names, meshes: [a, b], question, distances, counts, seed: args.seed };
    let Some(advised) = work::watch(move |watch| advisor.advise(&request, watch)).await?? else {
        eprintln!("ocb: Stopped; nothing was written.");
        return Ok(ExitCode::from(INTERRUPTED));
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
