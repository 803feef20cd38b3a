//! `ocb cite`: how a run or a plugin on a service is cited.

use std::process::ExitCode;

use ocb_service::model::Citation;

use crate::args::{CiteArgs, CiteAs, Cited};
use crate::failure::Result;
use crate::output;

/// Asks the service and prints the text.
pub async fn cite(args: &CiteArgs, json: bool) -> Result<ExitCode> {
    let resource = match args.what {
        Cited::Run => "runs",
        Cited::Plugin => "plugins",
    };
    let citation: Citation = args.service.service().get(&format!("/api/v1/{resource}/{}/citation", args.id)).await?;
    if json {
        output::print_json(&citation)?;
    } else {
        let text = match args.format {
            CiteAs::Bibtex => &citation.bibtex,
            CiteAs::Cff => &citation.cff,
            CiteAs::Link => &citation.link,
        };
        output::print(text.trim_end())?;
    }
    Ok(ExitCode::SUCCESS)
}
