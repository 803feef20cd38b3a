//! `ocb serve`: pages and API until somebody stops it.

use std::net::SocketAddr;
use std::process::ExitCode;

use ocb_server::{Aside, Names, Network, Proxies};
use serde_json::json;
use tokio::net::TcpListener;
use tokio::signal::unix::{SignalKind, signal};

use crate::args::{ServeArgs, Store};
use crate::failure::{Failure, Result};
use crate::open;
use crate::output;

/// Serves until SIGINT or SIGTERM; a run under way goes on at the next start.
pub async fn serve(store: &Store, args: &ServeArgs, json: bool) -> Result<ExitCode> {
    // The address first: nothing is opened, queued or measured for a service that cannot listen.
    let listener = bind(args.address, "--address").await?;
    let metrics = match args.metrics {
        Some(address) => Some(bind(address, "--metrics").await?),
        None => None,
    };
    let internal = match args.internal {
        Some(address) => Some(bind(address, "--internal").await?),
        None => None,
    };
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
    ocb_server::serve(engine.clone(), network(args), listener, Aside { metrics, internal }, stop).await;
    engine.shutdown().await;
    Ok(ExitCode::SUCCESS)
}

/// Listens; `option` is how another address is chosen.
async fn bind(address: SocketAddr, option: &str) -> Result<TcpListener> {
    ocb_server::bind(address).await.map_err(|e| {
        let reason = match e.kind() {
            std::io::ErrorKind::AddrInUse => "the address is already in use".to_owned(),
            _ => e.to_string(),
        };
        Failure::Input(format!("Cannot listen on {address}: {reason}; choose another with {option}."))
    })
}

/// The host names that were given, and the one that mails lead to.
fn network(args: &ServeArgs) -> Network {
    let public = args.mail.public_url.as_deref().and_then(|url| {
        let (_, rest) = url.split_once("://")?;
        rest.split(['/', ':']).next().map(str::to_owned)
    });
    Network {
        names: Names::new(args.host_name.iter().cloned().chain(public)),
        proxies: Proxies::new(args.trusted_proxies.iter().copied()),
    }
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
