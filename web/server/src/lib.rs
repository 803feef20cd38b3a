//! HTTP for pages and programs: the routes of `/api/v1`, the progress stream and the built pages.
//!
//! Everything that is known comes from one [`Engine`]; its values ([`ocb_service::model`]) are the JSON of this API. The
//! server sends numbers, never colours (except in the downloads that are pictures of a heatmap).

mod address;
mod connections;
mod document;
mod download;
mod events;
mod extract;
mod guest;
mod internal;
mod layers;
mod limits;
mod list;
mod metrics;
mod origin;
mod pace;
mod pages;
mod privacy;
mod problem;
mod request_key;
mod routes;
mod upload;

use std::future::Future;
use std::io;
use std::net::SocketAddr;
use std::time::Duration;

use ocb_service::Engine;
use tokio::net::TcpListener;
use tokio::sync::watch;

pub use address::{Proxies, ProxyNetwork};
pub use origin::Names;
pub use problem::Problem;
pub use routes::{document, router};

/// How long open requests may take to end after the service was asked to stop.
const GRACE: Duration = Duration::from_secs(10);

/// How requests reach this service.
#[derive(Clone, Debug, Default)]
pub struct Network {
    /// Its host names.
    pub names: Names,
    /// The proxies that it may be behind.
    pub proxies: Proxies,
}

/// What every handler may use.
#[derive(Clone)]
pub struct App {
    engine: Engine,
    uploads: std::sync::Arc<upload::UploadSlots>,
    /// Held while a plugin is taken: what room its account has is looked at first, and must be there still when it is added.
    submitting: std::sync::Arc<tokio::sync::Mutex<()>>,
    archives: std::sync::Arc<download::Archives>,
    /// Held while the viewer's copy of a mesh is built.
    drawing: std::sync::Arc<tokio::sync::Semaphore>,
    limits: std::sync::Arc<limits::Limits>,
    meters: std::sync::Arc<metrics::Meters>,
    network: Network,
    /// True from the moment the service is asked to stop: progress streams end, so that their connections can.
    stopping: watch::Receiver<bool>,
}

impl App {
    /// The engine behind HTTP; `stopping` ends the progress streams.
    pub fn new(engine: Engine, network: Network, stopping: watch::Receiver<bool>) -> Self {
        Self {
            engine,
            uploads: std::sync::Arc::default(),
            submitting: std::sync::Arc::default(),
            archives: std::sync::Arc::default(),
            drawing: std::sync::Arc::new(tokio::sync::Semaphore::new(2)),
            limits: std::sync::Arc::default(),
            meters: std::sync::Arc::default(),
            network,
            stopping,
        }
    }
}

/// Binds the address; the listener tells which port it got when the port asked for was 0.
///
/// # Errors
/// When the address is in use or not ours.
pub async fn bind(address: SocketAddr) -> io::Result<TcpListener> {
    TcpListener::bind(address).await
}

/// Listeners of their own for others than visitors.
#[derive(Debug, Default)]
pub struct Aside {
    /// Figures for the operator.
    pub metrics: Option<TcpListener>,
    /// Work for measuring machines.
    pub internal: Option<TcpListener>,
}

/// Serves until `shutdown` is ready, then ends open requests; the engine stays open.
pub async fn serve(
    engine: Engine,
    network: Network,
    listener: TcpListener,
    aside: Aside,
    shutdown: impl Future<Output = ()> + Send + 'static,
) {
    let (stop, stopping) = watch::channel(false);
    let app = App::new(engine, network, stopping.clone());
    if let Some(listener) = aside.metrics {
        tokio::spawn(connections::serve(listener, metrics::router(app.clone()), stopping.clone()));
    }
    if let Some(listener) = aside.internal {
        tokio::spawn(connections::serve(listener, internal::router(app.clone()), stopping.clone()));
    }
    let serving = connections::serve(listener, router(app), stopping);
    let ended = async {
        shutdown.await;
        let _ = stop.send(true);
        tokio::time::sleep(GRACE).await;
    };
    tokio::select! {
        () = serving => {}
        () = ended => {}
    }
}
