//! `ocb advise --verify`: does a certificate hold?

use std::path::Path;
use std::process::ExitCode;

use ocb_advice::{Doubt, Paper};
use ocb_core::mesh::{MAX_BYTES, obj};
use serde_json::json;

use super::work;
use crate::args::Store;
use crate::failure::{Failure, INTERRUPTED, NOT_ALL_WELL, Result};
use crate::open::read_bounded;
use crate::{output, truth};

/// Checks a certificate against the object that it names, or that stands there now.
pub async fn verify(store: &Store, file: &Path, object: Option<&str>, json: bool) -> Result<ExitCode> {
    let bad = |e: &dyn std::fmt::Display| Failure::Input(format!("{} is not a certificate: {e}.", file.display()));
    let paper: Paper = serde_json::from_slice(&read_bounded(file, MAX_BYTES)?).map_err(|e| bad(&e))?;
    let reduced = file.with_file_name(&paper.file);
    let read = obj::read(&read_bounded(&reduced, MAX_BYTES)?);
    let reduced = read.map_err(|e| Failure::Input(format!("{} cannot be used: {e}.", reduced.display())))?.mesh;
    let object = truth::object(store, object.unwrap_or(&paper.object_file)).await?;
    let triangles = reduced.triangles().len();
    let certificate = paper.certificate;
    let worst = certificate.worst();
    let checked = work::watch(move |watch| certificate.check(&object, &reduced, watch)).await?;
    let doubt = match &checked {
        Ok(()) => None,
        Err(Doubt::Stopped) => {
            eprintln!("ocb: Stopped before the certificate was fully checked.");
            return Ok(ExitCode::from(INTERRUPTED));
        }
        Err(doubt) => Some(doubt.to_string()),
    };
    if json {
        output::print_json(&json!({ "holds": doubt.is_none(), "doubt": doubt, "triangles": triangles }))?;
    } else {
        output::print(&match &doubt {
            Some(doubt) => format!("The certificate does not hold: {doubt}."),
            None => format!(
                "The certificate holds: every point of the object is within {:.3e} of these {triangles} triangles, and \
                 every point of them within {:.3e} of the object.",
                worst[0], worst[1]
            ),
        })?;
    }
    Ok(if doubt.is_none() { ExitCode::SUCCESS } else { ExitCode::from(NOT_ALL_WELL) })
}
