//! `ocb cite`: how a run or a plugin on a service is cited.

use std::process::ExitCode;

use ocb_engine::model::Citation;
use reqwest::Client;

use crate::args::{CiteArgs, CiteAs, Cited};
use crate::failure::Result;
use crate::output;
use crate::service::answer;

/// Asks the service and prints the text.
pub async fn cite(args: &CiteArgs, json: bool) -> Result<ExitCode> {
    let resource = match args.what {
        Cited::Run => "runs",
        Cited::Plugin => "plugins",
    };
    let address = args.service.address(&format!("/api/v1/{resource}/{}/citation", args.id));
    let mut request = Client::new().get(&address);
    if let Some(token) = &args.service.token {
        request = request.bearer_auth(token);
    }
    let citation: Citation = answer(&address, request.send().await).await?;
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
