//! `ocb serve`: pages and API until somebody stops it.

use std::process::ExitCode;

use ocb_server::Names;
use serde_json::json;
use tokio::signal::unix::{SignalKind, signal};

use crate::args::{ServeArgs, Store};
use crate::failure::{Failure, Result};
use crate::open;
use crate::output;

/// Serves until SIGINT or SIGTERM; a run under way goes on at the next start.
pub async fn serve(store: &Store, args: &ServeArgs, json: bool) -> Result<ExitCode> {
    // The address first: nothing is opened, queued or measured for a service that cannot listen.
    let listener = ocb_server::bind(args.address).await.map_err(|e| {
        let reason = match e.kind() {
            std::io::ErrorKind::AddrInUse => "the address is already in use".to_owned(),
            _ => e.to_string(),
        };
        Failure::Input(format!("Cannot listen on {}: {reason}; choose another with --address.", args.address))
    })?;
    let address = listener.local_addr().map_err(|e| Failure::Fault(format!("cannot read the address: {e}.")))?;
    let stop = stop_signal()?;
    let url = format!("http://{address}");
    let engine = open::open_to_serve(store, args, &url).await?;
    if json {
        // On one line, which arrives whole; whoever started us may then stop reading without ending the service.
        match output::print(&json!({ "url": url }).to_string()) {
            Ok(()) | Err(Failure::ReaderGone) => {}
            Err(failure) => return Err(failure),
        }
    } else {
        eprintln!("OpenCollBench is running at {url}; press Ctrl-C to stop it.");
    }
    ocb_server::serve(engine.clone(), names(args), listener, stop).await;
    engine.shutdown().await;
    Ok(ExitCode::SUCCESS)
}

/// Those that were given, and where mails lead to.
fn names(args: &ServeArgs) -> Names {
    let public = args.mail.public_url.as_deref().and_then(|url| {
        let (_, rest) = url.split_once("://")?;
        rest.split(['/', ':']).next().map(str::to_owned)
    });
    Names::new(args.host_name.iter().cloned().chain(public))
}

/// Ready when the process is asked to stop.
pub fn stop_signal() -> Result<impl Future<Output = ()> + Send + 'static> {
    let listen = |kind| signal(kind).map_err(|e| Failure::Fault(format!("cannot listen for signals: {e}.")));
    let mut interrupt = listen(SignalKind::interrupt())?;
    let mut terminate = listen(SignalKind::terminate())?;
    Ok(async move {
        tokio::select! {
            _ = interrupt.recv() => {}
            _ = terminate.recv() => {}
        }
    })
}
