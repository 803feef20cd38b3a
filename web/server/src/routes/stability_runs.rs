//! Stability runs that visitors start.

use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json as Answer};
use ocb_service::model::{Page, StabilityRunInfo, StabilitySpec};
use ocb_service::{EngineError, Visitor};

use crate::App;
use crate::address::Address;
use crate::extract::{Json, Path, Query};
use crate::guest::{Curator, Guest, Person};
use crate::limits::START_STABILITY;
use crate::list;
use crate::problem::Result;
use crate::request_key::{IdempotencyKey, RequestKey};

/// Queues a stability run of an algorithm.
#[utoipa::path(post, path = "/stability-runs", tag = "runs", request_body = StabilitySpec, params(IdempotencyKey),
    responses(
        (status = 200, description = "Already requested with this key", body = StabilityRunInfo),
        (status = 201, description = "Queued; its address is in `Location`", body = StabilityRunInfo),
        (status = 400, description = "Not JSON"),
        (status = 422, description = "No such algorithm, family or relation"),
        (status = 429, description = "Too many runs are queued; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn start_stability(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    key: RequestKey,
    Json(spec): Json<StabilitySpec>,
) -> Result<Response> {
    app.count(START_STABILITY, &address).await?;
    let visitor = Visitor { owner: guest, address: Some(address) };
    let (info, new) = app.engine.start_stability(spec, &visitor, key.as_deref()).await?;
    let location = format!("/api/v1/stability-runs/{}", info.id);
    let status = if new { StatusCode::CREATED } else { StatusCode::OK };
    Ok((status, [(header::LOCATION, location)], Answer(info)).into_response())
}

/// The visitor's stability runs, newest first, without results.
#[utoipa::path(get, path = "/stability-runs", tag = "runs", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<StabilityRunInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_stability_runs(
    State(app): State<App>,
    Guest(guest): Guest,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/stability-runs", &page, app.engine.stability_runs(&guest, &page).await?))
}

/// How far it is, with what it found so far.
#[utoipa::path(get, path = "/stability-runs/{id}", tag = "runs",
    params(("id" = String, Path, description = "Id of the stability run")),
    responses(
        (status = 200, body = StabilityRunInfo),
        (status = 404, description = "The visitor has no such run"),
    ))]
pub(crate) async fn show_stability_run(
    State(app): State<App>,
    Path(id): Path<String>,
) -> Result<Answer<StabilityRunInfo>> {
    Ok(Answer(app.engine.stability_run(&id).await?))
}

/// Ends it and keeps what it found; what has ended stays as it is. Curators may end any stability run, in a browser session; the
/// answer is then without its result.
#[utoipa::path(post, path = "/stability-runs/{id}/cancel", tag = "runs",
    params(("id" = String, Path, description = "Id of the stability run")),
    responses(
        (status = 200, description = "The updated run", body = StabilityRunInfo),
        (status = 404, description = "The visitor has no such run"),
    ))]
pub(crate) async fn cancel_stability(
    State(app): State<App>,
    Guest(guest): Guest,
    person: Option<Extension<Person>>,
    Path(id): Path<String>,
) -> Result<Answer<StabilityRunInfo>> {
    match (app.engine.cancel_stability(&id, Some(&guest)).await, person) {
        (Err(EngineError::Forbidden(_)), Some(Extension(Person(account)))) => {
            Ok(Answer(app.engine.cancel_stability_of_others(&id, &account).await?))
        }
        (cancelled, _) => Ok(Answer(cancelled?)),
    }
}

/// All stability runs that have not ended, the oldest first, without results: for curators.
#[utoipa::path(get, path = "/curation/stability-runs", tag = "curation",
    responses(
        (status = 200, body = Vec<StabilityRunInfo>),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
    ))]
pub(crate) async fn list_open_stability_runs(
    State(app): State<App>,
    Curator(curator): Curator,
) -> Result<Answer<Vec<StabilityRunInfo>>> {
    Ok(Answer(app.engine.open_stability_runs(&curator).await?))
}

/// Takes it away with its result; the table of all algorithms keeps what it has.
#[utoipa::path(delete, path = "/stability-runs/{id}", tag = "data",
    params(("id" = String, Path, description = "Id of the stability run")),
    responses(
        (status = 204, description = "Deleted"),
        (status = 404, description = "The visitor has no such run"),
    ))]
pub(crate) async fn remove_stability(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<StatusCode> {
    app.engine.remove_stability(&id, Some(&guest)).await?;
    Ok(StatusCode::NO_CONTENT)
}
