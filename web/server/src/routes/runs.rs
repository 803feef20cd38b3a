//! Runs: asking, looking, cancelling, refining.

use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json as Answer};
use ocb_service::model::{Estimate, ExampleInfo, NewVisibility, Page, RunInfo, RunSpec};
use ocb_service::{EngineError, Visitor};

use crate::App;
use crate::address::Address;
use crate::extract::{Json, Path, Query};
use crate::guest::{Guest, Person};
use crate::limits::ASK_RUN;
use crate::list;
use crate::problem::Result;
use crate::request_key::{IdempotencyKey, RequestKey};

/// A spec for the document: a knot against itself, a tenth of its size apart.
fn example() -> serde_json::Value {
    serde_json::json!({
        "object_a": "stock:torus-knot@8000",
        "query": "proximity",
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 1000 } },
        "separation": { "kind": "relative", "distance": 0.1 },
        "algorithms": ["ocb-fast", "box-tree"],
    })
}

/// Number of configurations and expected time of a run that is not asked for yet.
#[utoipa::path(post, path = "/estimates", tag = "runs", request_body(content = RunSpec, example = json!(example())),
    responses(
        (status = 200, body = Estimate),
        (status = 400, description = "Not JSON"),
        (status = 404, description = "No such object"),
        (status = 422, description = "The spec cannot be run"),
    ))]
pub(crate) async fn estimate_run(
    State(app): State<App>,
    Guest(guest): Guest,
    Json(spec): Json<RunSpec>,
) -> Result<Answer<Estimate>> {
    Ok(Answer(app.engine.estimate_for(&spec, &guest).await?))
}

/// Asks for a run. With an `Idempotency-Key` the same request, sent again because its answer was lost, gives the same run.
#[utoipa::path(post, path = "/runs", tag = "runs", request_body(content = RunSpec, example = json!(example())),
    params(IdempotencyKey),
    responses(
        (status = 200, description = "Already requested with this key", body = RunInfo),
        (status = 201, description = "Queued; its address is in `Location`", body = RunInfo),
        (status = 400, description = "Not JSON"),
        (status = 404, description = "No such object"),
        (status = 422, description = "The spec cannot be run, or exceeds the owner's time limit"),
        (status = 429, description = "Too many runs are queued or running; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn start_run(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    key: RequestKey,
    Json(spec): Json<RunSpec>,
) -> Result<Response> {
    app.count(ASK_RUN, &address).await?;
    let visitor = Visitor { owner: guest, address: Some(address) };
    let (run, new) = app.engine.submit_for(spec, &visitor, key.as_deref()).await?;
    let location = format!("/api/v1/runs/{}", run.id);
    let status = if new { StatusCode::CREATED } else { StatusCode::OK };
    Ok((status, [(header::LOCATION, location)], Answer(run)).into_response())
}

/// The visitor's runs, newest first. A part holds fewer than asked for where the object of a run was hidden from them.
#[utoipa::path(get, path = "/runs", tag = "runs", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<RunInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_runs(
    State(app): State<App>,
    Guest(guest): Guest,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/runs", &page, app.engine.runs(&guest, &page).await?))
}

/// One run.
#[utoipa::path(get, path = "/runs/{id}", tag = "runs",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, body = RunInfo),
        (status = 404, description = "No such run"),
    ))]
pub(crate) async fn show_run(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Answer<RunInfo>> {
    Ok(Answer(app.engine.run(&id, Some(&guest)).await?))
}

/// Cancels a queued or running run; a finished one stays as it is. Curators may cancel any run, in a browser session.
#[utoipa::path(post, path = "/runs/{id}/cancel", tag = "runs",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "The updated run", body = RunInfo),
        (status = 403, description = "The run belongs to someone else"),
        (status = 404, description = "No such run"),
    ))]
pub(crate) async fn cancel_run(
    State(app): State<App>,
    Guest(guest): Guest,
    person: Option<Extension<Person>>,
    Path(id): Path<String>,
) -> Result<Answer<RunInfo>> {
    match (app.engine.cancel(&id, Some(&guest)).await, person) {
        (Err(EngineError::Forbidden(_)), Some(Extension(Person(account)))) => {
            Ok(Answer(app.engine.cancel_of_others(&id, &account).await?))
        }
        (cancelled, _) => Ok(Answer(cancelled?)),
    }
}

/// Queues a run that has ended as a preview for all of its configurations.
///
/// Its numbers stay until those of the whole are there.
#[utoipa::path(post, path = "/runs/{id}/refine", tag = "runs",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "The updated run", body = RunInfo),
        (status = 403, description = "The run belongs to someone else"),
        (status = 404, description = "No such run"),
        (status = 409, description = "Not a preview, or not ended"),
        (status = 422, description = "It can no longer be run"),
    ))]
pub(crate) async fn refine_run(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Answer<RunInfo>> {
    Ok(Answer(app.engine.refine(&id, Some(&guest)).await?))
}

/// Decides who sees a run; only who asked for it may, and no more than see its objects. A public one is on everybody's board.
#[utoipa::path(put, path = "/runs/{id}/visibility", tag = "runs", request_body = NewVisibility,
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "The updated run", body = RunInfo),
        (status = 403, description = "The run belongs to someone else, or a guest tries to publish"),
        (status = 404, description = "No such run"),
        (status = 409, description = "An object or plugin of the run is less visible"),
    ))]
pub(crate) async fn change_run_visibility(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
    Json(asked): Json<NewVisibility>,
) -> Result<Answer<RunInfo>> {
    Ok(Answer(app.engine.change_run_visibility(&id, asked.visibility, &guest).await?))
}

/// The examples of the start page, each with its run on this machine where there is one. A service measures them by itself while it
/// is idle.
#[utoipa::path(get, path = "/examples", tag = "runs", responses((status = 200, body = Vec<ExampleInfo>)))]
pub(crate) async fn list_examples(State(app): State<App>) -> Result<Answer<Vec<ExampleInfo>>> {
    Ok(Answer(app.engine.examples().await?))
}

/// The finished run that the start page shows; null until the first one is finished.
///
/// No 404: nothing has gone wrong then, and a browser would note every look of a waiting page as an error.
#[utoipa::path(get, path = "/featured", tag = "runs", responses((status = 200, body = Option<RunInfo>)))]
pub(crate) async fn featured_run(State(app): State<App>) -> Result<Answer<Option<RunInfo>>> {
    Ok(Answer(app.engine.featured().await?))
}
