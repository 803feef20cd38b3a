//! Recordings that visitors bring, and their replay.

use axum::extract::{Request, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json as Answer};
use ocb_core::export::glb;
use ocb_service::model::{
    Page, PosedGroup, PosedScene, Stretch, StretchResult, WhichGroup, WorkloadInfo, WorkloadSpec,
};
use ocb_service::{EngineError, Visitor};
use utoipa::ToSchema;

use crate::App;
use crate::address::Address;
use crate::download::download;
use crate::extract::{Json, Path, Query};
use crate::guest::{Guest, Person};
use crate::limits::ADD_WORKLOAD;
use crate::list;
use crate::problem::{Problem, Result};
use crate::request_key::{IdempotencyKey, RequestKey};
use crate::upload::{MAX_BYTES, Upload};

/// The form of an upload.
#[derive(ToSchema)]
#[expect(dead_code, reason = "only described; the upload is read as a stream")]
struct WorkloadForm {
    /// How to replay it, as JSON; it comes before the file. Absent: the usual algorithms in both orders.
    spec: Option<WorkloadSpec>,
    /// A recording (.ocbrec) of at most 256 MiB and 2,000,000 queries, or a scene (.ocbscene), of which nothing is replayed.
    #[schema(value_type = String, format = Binary)]
    file: Vec<u8>,
}

/// Uploads a recording and queues its replay: every query is put to every algorithm in the jail, and each answer is judged, also
/// those that the recorded program got.
#[utoipa::path(post, path = "/workloads", tag = "runs",
    request_body(content = inline(WorkloadForm), content_type = "multipart/form-data"), params(IdempotencyKey),
    responses(
        (status = 200, description = "Already requested with this key", body = WorkloadInfo),
        (status = 201, description = "Queued, or done for a scene without queries; its address is in `Location`", body = WorkloadInfo),
        (status = 400, description = "The upload is not well-formed"),
        (status = 409, description = "The visitor has stored too much"),
        (status = 413, description = "Larger than 256 MiB"),
        (status = 422, description = "Not a recording, no such algorithm, or a replay that may take too long"),
        (status = 429, description = "Too many are queued; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn add_workload(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    key: RequestKey,
    request: Request,
) -> Result<Response> {
    app.count(ADD_WORKLOAD, &address).await?;
    let Upload { name, file, spec } = {
        let _coming = app.uploads.begin(&address)?;
        Upload::read(request, MAX_BYTES, &app, &address).await?
    };
    let bad = |e| Problem::new(StatusCode::UNPROCESSABLE_ENTITY, format!("The spec cannot be read: {e}."));
    let spec: WorkloadSpec =
        spec.map_or_else(|| Ok(WorkloadSpec::default()), |text| serde_json::from_slice(&text)).map_err(bad)?;
    let _slot = app.uploads.take(&file).await?;
    let bytes = file.read().await?;
    let visitor = Visitor { owner: guest, address: Some(address) };
    Ok(queued(app.engine.add_workload(&name, bytes, spec, &visitor, key.as_deref()).await?))
}

/// Queues another replay of the same recording.
#[utoipa::path(post, path = "/workloads/{id}/again", tag = "runs", request_body = WorkloadSpec,
    params(("id" = String, Path, description = "Id of the workload"), IdempotencyKey),
    responses(
        (status = 200, description = "Already requested with this key", body = WorkloadInfo),
        (status = 201, description = "Queued; its address is in `Location`", body = WorkloadInfo),
        (status = 404, description = "The visitor has no such workload"),
        (status = 422, description = "No such algorithm, no queries, or a replay that may take too long"),
        (status = 429, description = "Too many are queued; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn replay_again(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    key: RequestKey,
    Path(id): Path<String>,
    Json(spec): Json<WorkloadSpec>,
) -> Result<Response> {
    app.count(ADD_WORKLOAD, &address).await?;
    let visitor = Visitor { owner: guest, address: Some(address) };
    Ok(queued(app.engine.replay_again(&id, spec, &visitor, key.as_deref()).await?))
}

fn queued((info, new): (WorkloadInfo, bool)) -> Response {
    let location = format!("/api/v1/workloads/{}", info.id);
    let status = if new { StatusCode::CREATED } else { StatusCode::OK };
    (status, [(header::LOCATION, location)], Answer(info)).into_response()
}

/// The visitor's workloads, newest first, without results.
#[utoipa::path(get, path = "/workloads", tag = "runs", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<WorkloadInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_workloads(
    State(app): State<App>,
    Guest(guest): Guest,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/workloads", &page, app.engine.workloads(&guest, &page).await?))
}

/// How far it is, with what was found when it is done.
#[utoipa::path(get, path = "/workloads/{id}", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload")),
    responses(
        (status = 200, body = WorkloadInfo),
        (status = 404, description = "The visitor has no such workload"),
    ))]
pub(crate) async fn show_workload(State(app): State<App>, Path(id): Path<String>) -> Result<Answer<WorkloadInfo>> {
    Ok(Answer(app.engine.workload(&id).await?))
}

/// What each algorithm does within a stretch of the recording.
#[utoipa::path(get, path = "/workloads/{id}/stretch", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload"), Stretch),
    responses(
        (status = 200, body = StretchResult),
        (status = 404, description = "The visitor has no such workload, or it has not been replayed to its end"),
    ))]
pub(crate) async fn show_stretch(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(stretch): Query<Stretch>,
) -> Result<Answer<StretchResult>> {
    let _slot = app.drawing.acquire().await;
    Ok(Answer(app.engine.workload_stretch(&id, stretch).await?))
}

/// A group as it stands in space; the first one when none is named.
#[utoipa::path(get, path = "/workloads/{id}/group", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload"), WhichGroup),
    responses(
        (status = 200, body = PosedGroup),
        (status = 404, description = "The visitor has no such workload"),
        (status = 422, description = "The recording has no such group"),
    ))]
pub(crate) async fn show_group(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(which): Query<WhichGroup>,
) -> Result<Answer<PosedGroup>> {
    let _slot = app.drawing.acquire().await;
    Ok(Answer(app.engine.workload_group(&id, which).await?))
}

/// The scene as it stands in space: all objects, the pairs that were asked, and those that it disables.
#[utoipa::path(get, path = "/workloads/{id}/scene", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload")),
    responses(
        (status = 200, body = PosedScene),
        (status = 404, description = "The visitor has no such workload"),
    ))]
pub(crate) async fn show_scene(State(app): State<App>, Path(id): Path<String>) -> Result<Answer<PosedScene>> {
    let _slot = app.drawing.acquire().await;
    Ok(Answer(app.engine.workload_scene(&id).await?))
}

/// An object of the scene as glTF binary, as algorithms get it.
#[utoipa::path(get, path = "/workloads/{id}/objects/{object}/mesh.glb", tag = "runs",
    params(
        ("id" = String, Path, description = "Id of the workload"),
        ("object" = usize, Path, description = "Its place in the scene, from 0"),
    ),
    responses(
        (status = 200, description = "The mesh", body = [u8], content_type = "model/gltf-binary"),
        (status = 404, description = "The visitor has no such workload"),
        (status = 422, description = "The scene has no such object"),
    ))]
pub(crate) async fn workload_mesh(
    State(app): State<App>,
    Path((id, object)): Path<(String, usize)>,
) -> Result<Response> {
    let _slot = app.drawing.acquire().await;
    let mesh = app.engine.workload_mesh(&id, object).await?;
    let bytes = tokio::task::spawn_blocking(move || glb::geometry(&mesh)).await.map_err(Problem::fault)?;
    Ok(([(header::CONTENT_TYPE, "model/gltf-binary")], bytes).into_response())
}

/// Every replayed query: its objects, time and verdict, one row per algorithm and order.
#[utoipa::path(get, path = "/workloads/{id}/queries.parquet", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload")),
    responses(
        (status = 200, description = "The table", body = [u8], content_type = "application/vnd.apache.parquet"),
        (status = 404, description = "The visitor has no such workload, or it has not been replayed to its end"),
    ))]
pub(crate) async fn workload_queries(State(app): State<App>, Path(id): Path<String>) -> Result<Response> {
    let table = app.engine.workload_queries(&id).await?;
    Ok(download("application/vnd.apache.parquet", &format!("workload-{id}.parquet"), table))
}

/// The recording as it was uploaded.
#[utoipa::path(get, path = "/workloads/{id}/recording.ocbrec", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload")),
    responses(
        (status = 200, description = "The recording", body = [u8], content_type = "application/zip"),
        (status = 404, description = "The visitor has no such workload"),
    ))]
pub(crate) async fn workload_recording(State(app): State<App>, Path(id): Path<String>) -> Result<Response> {
    let (bytes, name) = app.engine.workload_recording(&id).await?;
    Ok(download("application/zip", &name, bytes))
}

/// The same queries about the reduced scene, where one was asked for.
#[utoipa::path(get, path = "/workloads/{id}/reduced.ocbrec", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload")),
    responses(
        (status = 200, description = "The recording", body = [u8], content_type = "application/zip"),
        (status = 404, description = "The visitor has no such workload, it has not ended, or no reduced scene was asked for"),
    ))]
pub(crate) async fn reduced_recording(State(app): State<App>, Path(id): Path<String>) -> Result<Response> {
    let (bytes, name) = app.engine.reduced_recording(&id).await?;
    Ok(download("application/zip", &name, bytes))
}

/// Ends it; what has ended stays as it is. Curators may end any, in a browser session; they do not see it.
#[utoipa::path(post, path = "/workloads/{id}/cancel", tag = "runs",
    params(("id" = String, Path, description = "Id of the workload")),
    responses(
        (status = 200, description = "The updated workload", body = WorkloadInfo),
        (status = 204, description = "Ended by a curator"),
        (status = 404, description = "The visitor has no such workload"),
    ))]
pub(crate) async fn cancel_workload(
    State(app): State<App>,
    Guest(guest): Guest,
    person: Option<Extension<Person>>,
    Path(id): Path<String>,
) -> Result<Response> {
    match (app.engine.cancel_workload(&id, Some(&guest)).await, person) {
        (Err(EngineError::Forbidden(_)), Some(Extension(Person(account)))) => {
            app.engine.cancel_workload_of_others(&id, &account).await?;
            Ok(StatusCode::NO_CONTENT.into_response())
        }
        (cancelled, _) => Ok(Answer(cancelled?).into_response()),
    }
}

/// Takes it away with its recording.
#[utoipa::path(delete, path = "/workloads/{id}", tag = "data",
    params(("id" = String, Path, description = "Id of the workload")),
    responses(
        (status = 204, description = "Deleted"),
        (status = 404, description = "The visitor has no such workload"),
    ))]
pub(crate) async fn remove_workload(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<StatusCode> {
    app.engine.remove_workload(&id, Some(&guest)).await?;
    Ok(StatusCode::NO_CONTENT)
}
