//! Stability runs that a service carries out for its account.

use std::time::Duration;

use ocb_service::model::{StabilityRunInfo, StabilityTable, State};
use serde_json::{Value, json};

use super::Found;
use crate::args::StabilityArgs;
use crate::failure::Result;
use crate::run::state_name;
use crate::serve;
use crate::service::Service;

/// How often the service is asked how far it is.
const TICK: Duration = Duration::from_millis(500);
const RUNS: &str = "/api/v1/stability-runs";

/// Has the algorithms tried there, one after the other; nothing when interrupted, and then the run there is cancelled.
pub async fn stability(service: &Service<'_>, args: &StabilityArgs) -> Result<Option<Found>> {
    let stop = serve::stop_signal()?;
    tokio::pin!(stop);
    let mut table: StabilityTable = service.get("/api/v1/stability").await?;
    table.methods.clear();
    let mut whole = true;
    for algorithm in &args.algorithms {
        let mut spec = json!({ "algorithm": algorithm, "parts": args.family });
        if let Some(seeds) = args.seeds {
            spec["seeds"] = json!(seeds);
        }
        let run: StabilityRunInfo = service.post(RUNS, &spec).await?;
        let path = format!("{RUNS}/{}", run.id);
        eprintln!("{algorithm}: {}", service.address(&format!("/stability/{}", run.id)));
        let run = tokio::select! {
            run = follow(service, &path, run) => run?,
            () = &mut stop => {
                let run: StabilityRunInfo = service.post(&format!("{path}/cancel"), &Value::Null).await?;
                eprintln!("ocb: Stopped; the stability run {} is {}.", run.id, state_name(run.state));
                return Ok(None);
            }
        };
        if run.state != State::Done {
            whole = false;
            let message = run.message.as_deref().unwrap_or("it did not finish.");
            eprintln!("ocb: The stability run {} is {}: {message}", run.id, state_name(run.state));
        }
        table.methods.extend(run.result);
    }
    Ok(Some(Found { table, whole }))
}

/// Says where the run stands until it has ended.
async fn follow(service: &Service<'_>, path: &str, mut run: StabilityRunInfo) -> Result<StabilityRunInfo> {
    let mut said = String::new();
    while matches!(run.state, State::Queued | State::Running) {
        let words = words(&run);
        if words != said {
            eprintln!("{}: {words}", run.spec.algorithm);
            said = words;
        }
        tokio::time::sleep(TICK).await;
        run = service.get(path).await?;
    }
    Ok(run)
}

fn words(run: &StabilityRunInfo) -> String {
    match (run.state, &run.step) {
        (State::Queued, _) if run.runs_ahead == 1 => "waiting, 1 stability run ahead".to_owned(),
        (State::Queued, _) => format!("waiting, {} stability runs ahead", run.runs_ahead),
        (_, Some(step)) => format!("{step} ({} of {} done)", run.done, run.total),
        (_, None) => format!("{} of {} done", run.done, run.total),
    }
}
