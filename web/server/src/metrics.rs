//! Figures for Prometheus, at an address of their own: they are for the operator, not for visitors.

use std::time::Instant;

use axum::Router;
use axum::extract::{MatchedPath, Request, State};
use axum::http::{Method, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use ocb_service::figures::Figures;
use prometheus_client::encoding::EncodeLabelSet;
use prometheus_client::encoding::text::{encode_eof, encode_registry};
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::{Histogram, exponential_buckets};
use prometheus_client::registry::{Registry, Unit};

use crate::{App, Problem};

/// The OpenMetrics text format.
const OPEN_METRICS: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

#[derive(Clone, Debug, Hash, PartialEq, Eq, EncodeLabelSet)]
struct Answered {
    method: &'static str,
    /// The route, not the path: ids are in paths, and there are too many of them.
    route: String,
    status: u16,
}

#[derive(Clone, Debug, Hash, PartialEq, Eq, EncodeLabelSet)]
struct InState {
    state: String,
}

#[derive(Clone, Debug, Hash, PartialEq, Eq, EncodeLabelSet)]
struct Program {
    version: String,
    hardware_class: String,
}

/// Counters since the start of the service.
pub(crate) struct Meters {
    registry: Registry,
    answered: Family<Answered, Counter>,
    seconds: Histogram,
}

impl Default for Meters {
    fn default() -> Self {
        let mut registry = Registry::with_prefix("ocb");
        let answered = Family::default();
        registry.register("http_requests", "Answered requests", answered.clone());
        // A millisecond to half a minute.
        let seconds = Histogram::new(exponential_buckets(0.001, 2.0, 16));
        let help = "Time until an answer began";
        registry.register_with_unit("http_request", help, Unit::Seconds, seconds.clone());
        Self { registry, answered, seconds }
    }
}

/// Counts requests and how long they took.
pub(crate) async fn count(State(app): State<App>, request: Request, next: Next) -> Response {
    let route = request.extensions().get::<MatchedPath>().map_or("page", MatchedPath::as_str).to_owned();
    let (method, begun) = (name_of(request.method()), Instant::now());
    let response = next.run(request).await;
    app.meters.seconds.observe(begun.elapsed().as_secs_f64());
    app.meters.answered.get_or_create(&Answered { method, route, status: response.status().as_u16() }).inc();
    response
}

/// Visitors may invent methods, and each would be kept for ever.
fn name_of(method: &Method) -> &'static str {
    const KNOWN: [&str; 7] = ["GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"];
    KNOWN.into_iter().find(|known| *known == method.as_str()).unwrap_or("other")
}

/// The only route of its address.
pub(crate) fn router(app: App) -> Router {
    Router::new().route("/metrics", get(show)).with_state(app)
}

async fn show(State(app): State<App>) -> Result<Response, Problem> {
    let figures = app.engine.figures().await?;
    let mut text = String::new();
    encode_registry(&mut text, &app.meters.registry)
        .and_then(|()| encode_registry(&mut text, &registry_of(figures)))
        .and_then(|()| encode_eof(&mut text))
        .map_err(Problem::fault)?;
    Ok(([(header::CONTENT_TYPE, OPEN_METRICS)], text).into_response())
}

fn registry_of(figures: Figures) -> Registry {
    let mut registry = Registry::with_prefix("ocb");
    let program = Family::<Program, Gauge>::default();
    let Figures { status, runs, plugins, blob_bytes } = figures;
    program.get_or_create(&Program { version: status.version, hardware_class: status.hardware_class }).set(1);
    registry.register("program", "Version and hardware class of this service", program);
    for (name, help, counts) in [("runs", "Runs by state", runs), ("plugins", "Submitted plugins by state", plugins)] {
        let family = Family::<InState, Gauge>::default();
        for (state, count) in counts {
            family.get_or_create(&InState { state }).set(count as i64);
        }
        registry.register(name, help, family);
    }
    let seconds = [
        ("queue_oldest", "Time that the oldest waiting run has waited", status.oldest_seconds),
        ("queue_expected", "Time that the waiting runs are expected to take", status.expected_seconds),
    ];
    for (name, help, value) in seconds {
        let gauge = Gauge::<f64, std::sync::atomic::AtomicU64>::default();
        gauge.set(value);
        registry.register_with_unit(name, help, Unit::Seconds, gauge);
    }
    let gauge = |value: u64| {
        let gauge = Gauge::<i64>::default();
        gauge.set(value as i64);
        gauge
    };
    registry.register_with_unit("stored", "Size of all blobs", Unit::Bytes, gauge(blob_bytes));
    registry.register("algorithms", "Algorithms that are offered", gauge(status.algorithms.into()));
    registry.register("problems", "What keeps something from being offered", gauge(status.problems.len() as u64));
    registry
}
