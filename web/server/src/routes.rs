//! Every route on one page.

mod account;
mod advice;
mod algorithms;
mod campaigns;
mod charts;
mod choices;
mod citations;
mod configurations;
mod heatmaps;
mod invitations;
mod mails;
mod notices;
mod objects;
mod owned;
mod people;
mod plugins;
mod records;
mod runs;
mod selecting;
mod service;
mod stability;
mod stability_runs;
mod suite;
mod workload_heatmaps;
mod workloads;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::middleware;
use axum::routing::get;
use utoipa::OpenApi;
use utoipa_axum::router::{OpenApiRouter, UtoipaMethodRouterExt};
use utoipa_axum::routes;

use crate::{App, events, layers, pages, upload};

#[derive(OpenApi)]
#[openapi(
    info(
        title = "OpenCollBench",
        description = "Benchmarks of collision detection: objects, runs, progress and heatmaps. Times are \
            microseconds since the Unix epoch; the name of a duration contains its unit. Every error is a `Problem` \
            (RFC 9457) with one sentence in `detail`. Long lists are returned in pages, newest first; the header \
            `Link` (RFC 8288) has the address of the next page, and new entries do not shift it. The cookie \
            `ocb_guest`, set on first contact, identifies a visitor, who owns what they create; anyone who knows the \
            id of an object or a run can see it, unless its owner has made it private. An account, identified by the \
            cookie `ocb_session` or by a token in `Authorization: Bearer`, owns what is created with it and may \
            publish.",
        license(name = "MIT OR Apache-2.0")
    ),
    components(schemas(crate::Problem, ocb_service::model::Accuracy, ocb_service::model::ChartKind)),
    tags(
        (name = "objects", description = "Meshes to measure"),
        (name = "configurations", description = "Saved configurations, to measure on them again"),
        (name = "algorithms", description = "Algorithms and their parameters"),
        (name = "runs", description = "Requesting, following and cancelling runs"),
        (name = "results", description = "Numbers and files of a run"),
        (name = "account", description = "Accounts: optional, needed for publishing"),
        (name = "plugins", description = "Submitted plugins"),
        (name = "curation", description = "Curation and roles"),
        (name = "advice", description = "How much of a model a query needs"),
        (name = "data", description = "Owned items: retention, export and deletion"),
        (name = "service", description = "The service itself"),
    )
)]
struct Document;

const PREFIX: &str = "/api/v1";

fn api() -> OpenApiRouter<App> {
    let uploads = routes!(objects::list_objects, objects::add_object);
    let plugins = routes!(plugins::list_plugins, plugins::submit_plugin);
    let routes = OpenApiRouter::new()
        .routes(
            uploads
                .layer(DefaultBodyLimit::max(upload::MAX_BODY_BYTES as usize))
                .layer(middleware::from_fn(upload::refuse_gently)),
        )
        .routes(
            routes!(configurations::list_configurations, configurations::add_configurations)
                .layer(DefaultBodyLimit::max(upload::MAX_BODY_BYTES as usize))
                .layer(middleware::from_fn(upload::refuse_gently)),
        )
        .routes(
            routes!(workloads::list_workloads, workloads::add_workload)
                .layer(DefaultBodyLimit::max(upload::MAX_BODY_BYTES as usize))
                .layer(middleware::from_fn(upload::refuse_gently)),
        )
        .routes(routes!(workloads::show_workload, workloads::remove_workload))
        .routes(routes!(workloads::replay_again))
        .routes(routes!(workloads::cancel_workload))
        .routes(routes!(workloads::show_stretch))
        .routes(routes!(workloads::show_group))
        .routes(routes!(workloads::show_scene))
        .routes(routes!(workloads::workload_mesh))
        .routes(routes!(workload_heatmaps::workload_heatmap))
        .routes(routes!(workload_heatmaps::workload_heatmap_glb))
        .routes(routes!(workload_heatmaps::workload_heatmap_ply))
        .routes(routes!(workload_heatmaps::workload_heatmap_csv))
        .routes(routes!(workloads::workload_queries))
        .routes(routes!(workloads::workload_recording))
        .routes(routes!(workloads::reduced_recording))
        .routes(routes!(configurations::remove_configurations))
        .routes(routes!(configurations::deletion_preview_of_configurations))
        .routes(routes!(configurations::configurations_file))
        .routes(routes!(configurations::save_configurations_of_run))
        .routes(routes!(objects::show_object, owned::remove_object))
        .routes(routes!(owned::deletion_preview_of_object))
        .routes(routes!(objects::object_mesh))
        .routes(routes!(objects::change_object_visibility))
        .routes(routes!(algorithms::list_algorithms))
        .routes(routes!(runs::estimate_run))
        .routes(routes!(runs::list_runs, runs::start_run))
        .routes(routes!(runs::show_run, owned::remove_run))
        .routes(routes!(owned::deletion_preview_of_run))
        .routes(routes!(owned::show_data, owned::delete_all))
        .routes(routes!(owned::keep_longer))
        .routes(routes!(owned::export_data))
        .routes(routes!(runs::cancel_run))
        .routes(routes!(runs::refine_run))
        .routes(routes!(runs::change_run_visibility))
        .routes(routes!(events::follow_run))
        .routes(routes!(heatmaps::show_heatmap))
        .routes(routes!(heatmaps::show_vertex))
        .routes(routes!(heatmaps::heatmap_glb))
        .routes(routes!(heatmaps::heatmap_ply))
        .routes(routes!(records::show_ecdf))
        .routes(routes!(records::records_parquet))
        .routes(routes!(records::records_csv))
        .routes(routes!(records::triangle_tests_parquet))
        .routes(routes!(records::configurations_parquet))
        .routes(routes!(records::repro_zip))
        .routes(routes!(citations::cite_run))
        .routes(routes!(charts::show_board))
        .routes(routes!(charts::show_board_csv))
        .routes(routes!(charts::show_chart))
        .routes(routes!(charts::chart_as_csv))
        .routes(routes!(charts::chart_as_parquet))
        .routes(routes!(selecting::show_selection))
        .routes(routes!(selecting::selection_arrow))
        .routes(routes!(selecting::list_worst))
        .routes(routes!(selecting::show_meeting))
        .routes(routes!(selecting::columns_arrow))
        .routes(routes!(selecting::witnesses_arrow))
        .routes(routes!(runs::featured_run))
        .routes(routes!(runs::list_examples))
        .routes(routes!(account::show_account, account::make_account, account::delete_account))
        .routes(routes!(account::show_deletion_preview))
        .routes(routes!(account::log_in))
        .routes(routes!(account::log_out))
        .routes(routes!(account::log_out_everywhere))
        .routes(routes!(account::change_password))
        .routes(routes!(account::ask_to_develop))
        .routes(routes!(account::register_key, account::forget_key))
        .routes(routes!(account::list_tokens, account::make_token))
        .routes(routes!(account::end_token))
        .routes(routes!(choices::show_choices, choices::choose))
        .routes(routes!(choices::give_address, choices::forget_address))
        .routes(routes!(choices::confirm_address))
        .routes(routes!(mails::turn_mails_off))
        .routes(routes!(notices::list_notices))
        .routes(routes!(notices::read_notice))
        .routes(routes!(notices::remove_notice))
        .routes(
            plugins
                .layer(DefaultBodyLimit::max(upload::MAX_BODY_BYTES as usize))
                .layer(middleware::from_fn(upload::refuse_gently)),
        )
        .routes(routes!(plugins::show_plugin))
        .routes(routes!(plugins::follow_plugin))
        .routes(routes!(citations::cite_plugin))
        .routes(routes!(plugins::decide))
        .routes(routes!(plugins::list_curation))
        .routes(routes!(people::list_accounts))
        .routes(routes!(people::change_role))
        .routes(routes!(invitations::invite, invitations::list_invitations))
        .routes(routes!(invitations::revoke_invitation))
        .routes(routes!(invitations::accept_invitation))
        .routes(routes!(stability::show_stability))
        .routes(routes!(stability_runs::start_stability, stability_runs::list_stability_runs))
        .routes(routes!(stability_runs::show_stability_run, stability_runs::remove_stability))
        .routes(routes!(stability_runs::cancel_stability))
        .routes(routes!(stability_runs::list_open_stability_runs))
        .routes(routes!(suite::show_suite))
        .routes(routes!(campaigns::create_campaign, campaigns::list_campaigns))
        .routes(routes!(campaigns::preview_campaign))
        .routes(routes!(campaigns::show_campaign))
        .routes(routes!(campaigns::cancel_campaign))
        .routes(routes!(advice::ask_advice))
        .routes(routes!(advice::show_advice))
        .routes(routes!(advice::cancel_advice))
        .routes(routes!(advice::reduced_obj))
        .routes(routes!(advice::reduced_certificate))
        .routes(routes!(service::show_status))
        .routes(routes!(service::show_document));
    OpenApiRouter::with_openapi(Document::openapi()).nest(PREFIX, routes)
}

/// The OpenAPI document of this server.
pub fn document() -> utoipa::openapi::OpenApi {
    crate::document::completed(api().into_openapi())
}

/// The whole service: API, progress stream and pages.
pub fn router(app: App) -> Router {
    let (router, _) = api().split_for_parts();
    // The link in a mail: a page with a button for people, and for mail programs what the button does.
    let router = router.route("/mails/off/{secret}", get(pages::serve).post(mails::turn_mails_off));
    let router = router.fallback(pages::serve).method_not_allowed_fallback(service::wrong_method);
    layers::wrap(router, &app).with_state(app)
}
