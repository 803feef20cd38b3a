//! `ocb doctor`: what this machine has for a jail, what it lacks and how to get it.

use std::process::ExitCode;

use ocb_service::doctor::{Diagnosis, State, examine};

use crate::args::Store;
use crate::failure::{OUR_FAULT, Result};
use crate::{open, output};

/// Looks at the machine; a failure exit when foreign plugins could not run under the chosen profile.
pub fn doctor(store: &Store, json: bool) -> Result<ExitCode> {
    let diagnosis = examine(&open::runner(store));
    if json {
        output::print_json(&diagnosis)?;
    } else {
        output::print(&report(&diagnosis))?;
    }
    let profile = store.profile();
    if diagnosis.allows(profile) {
        return Ok(ExitCode::SUCCESS);
    }
    eprintln!("ocb: Third-party plugins cannot run on this machine under the profile '{}'.", profile.as_str());
    Ok(ExitCode::from(OUR_FAULT))
}

/// One line per facility, with its effect and the way to get it under what is not there.
fn report(diagnosis: &Diagnosis) -> String {
    let mut lines = Vec::new();
    for facility in &diagnosis.facilities {
        let mark = match facility.state {
            State::Good => "good   ",
            State::Weak => "weak   ",
            State::Missing => "MISSING",
        };
        let effect = facility.effect;
        let get = facility.get.map_or_else(String::new, |get| format!("; to get it: {get}"));
        lines.push(format!("{mark}  {}: {} - {effect}{get}", facility.name, facility.found));
    }
    let yes = |may| if may { "yes" } else { "no" };
    lines.push(format!("third-party plugins with --profile production: {}", yes(diagnosis.production)));
    lines.push(format!("third-party plugins with --profile dev (results unranked): {}", yes(diagnosis.dev)));
    lines.push(format!("plugins shipped with ocb: {}", yes(diagnosis.own_plugins)));
    lines.join("\n")
}
