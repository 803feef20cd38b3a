//! Every route on one page.

mod algorithms;
mod heatmaps;
mod objects;
mod records;
mod runs;
mod service;
mod stability;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::middleware;
use utoipa::OpenApi;
use utoipa_axum::router::{OpenApiRouter, UtoipaMethodRouterExt};
use utoipa_axum::routes;

use crate::{App, events, layers, pages, upload};

#[derive(OpenApi)]
#[openapi(
    info(
        title = "OpenCollBench",
        description = "Benchmarks of collision detection: objects, runs, progress and heatmaps. Times are microseconds since \
            the Unix epoch, durations say their unit in their name. Every error is a `Problem` (RFC 9457) with one sentence \
            in `detail`. The cookie `ocb_guest`, set on first contact, owns what a visitor makes; whoever knows the id of a \
            run may look at it.",
        license(name = "MIT OR Apache-2.0")
    ),
    tags(
        (name = "objects", description = "Meshes to measure on"),
        (name = "algorithms", description = "What the plugins offer"),
        (name = "runs", description = "Asking, following, cancelling"),
        (name = "results", description = "Numbers and files of a run"),
        (name = "service", description = "The service itself"),
    )
)]
struct Document;

const PREFIX: &str = "/api/v1";

fn api() -> OpenApiRouter<App> {
    let uploads = routes!(objects::list_objects, objects::add_object);
    let routes = OpenApiRouter::new()
        .routes(uploads.layer(DefaultBodyLimit::disable()).layer(middleware::from_fn(upload::refuse_gently)))
        .routes(routes!(objects::show_object))
        .routes(routes!(objects::object_mesh))
        .routes(routes!(algorithms::list_algorithms))
        .routes(routes!(runs::estimate_run))
        .routes(routes!(runs::list_runs, runs::start_run))
        .routes(routes!(runs::show_run))
        .routes(routes!(runs::cancel_run))
        .routes(routes!(events::follow_run))
        .routes(routes!(heatmaps::show_heatmap))
        .routes(routes!(heatmaps::show_vertex))
        .routes(routes!(heatmaps::heatmap_glb))
        .routes(routes!(heatmaps::heatmap_ply))
        .routes(routes!(records::show_ecdf))
        .routes(routes!(records::records_parquet))
        .routes(routes!(records::records_csv))
        .routes(routes!(records::configurations_parquet))
        .routes(routes!(runs::featured_run))
        .routes(routes!(stability::show_stability))
        .routes(routes!(service::show_status))
        .routes(routes!(service::show_document));
    OpenApiRouter::with_openapi(Document::openapi()).nest(PREFIX, routes)
}

/// The OpenAPI document of this server.
pub fn document() -> utoipa::openapi::OpenApi {
    api().into_openapi()
}

/// The whole service: API, progress stream and pages.
pub fn router(app: App) -> Router {
    let (router, _) = api().split_for_parts();
    layers::wrap(router.fallback(pages::serve).method_not_allowed_fallback(service::wrong_method)).with_state(app)
}
