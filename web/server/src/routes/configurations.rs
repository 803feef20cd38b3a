//! Saved configurations: from a file of the visitor or of a run, to measure on them again.

use axum::Json;
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::response::Response;
use ocb_service::MAX_CONFIGURATION_BYTES;
use ocb_service::model::{OwnedItems, Page, SavedConfigurations};
use utoipa::ToSchema;

use crate::App;
use crate::address::Address;
use crate::download::download;
use crate::extract::{Path, Query};
use crate::guest::Guest;
use crate::limits::SAVE_CONFIGURATIONS;
use crate::list;
use crate::problem::Result;
use crate::upload::Upload;

/// The visitor's saved configurations, newest first.
#[utoipa::path(get, path = "/configurations", tag = "configurations", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<SavedConfigurations>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_configurations(
    State(app): State<App>,
    Guest(guest): Guest,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/configurations", &page, app.engine.saved_configurations(&guest, &page).await?))
}

/// The form of an upload.
#[derive(ToSchema)]
#[expect(dead_code, reason = "only described; the upload is read as a stream")]
struct ConfigurationsForm {
    /// JSON, CSV or raw f64 matrices, of at most 64 MiB.
    #[schema(value_type = String, format = Binary)]
    file: Vec<u8>,
}

/// Saves the configurations of a file: one per row, the pose of B relative to A as 12 or 16 numbers of a row-major 4x4 matrix, or
/// both poses, as JSON, CSV or raw little-endian f64. The method `file` with their `sha256` measures on them. The same file sent
/// twice is one. Only its owner sees it in the list; anyone who knows the `sha256` can measure on it.
#[utoipa::path(post, path = "/configurations", tag = "configurations",
    request_body(content = inline(ConfigurationsForm), content_type = "multipart/form-data"),
    responses(
        (status = 201, description = "The saved configurations", body = SavedConfigurations),
        (status = 400, description = "The upload is not well-formed"),
        (status = 409, description = "The visitor has stored too much"),
        (status = 413, description = "Larger than 64 MiB"),
        (status = 422, description = "Not a usable file; the message has the row, the reason and the remedy"),
        (status = 429, description = "Too many uploads; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn add_configurations(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    request: Request,
) -> Result<(StatusCode, Json<SavedConfigurations>)> {
    app.count(SAVE_CONFIGURATIONS, &address).await?;
    let Upload { name, file, .. } = {
        let _coming = app.uploads.begin(&address)?;
        Upload::read(request, MAX_CONFIGURATION_BYTES, &app, &address).await?
    };
    let _slot = app.uploads.take(&file).await?;
    let saved = app.engine.save_configurations(&name, file.read().await?, &guest).await?;
    Ok((StatusCode::CREATED, Json(saved)))
}

/// Saves the configurations that a run was measured on, for another run.
#[utoipa::path(post, path = "/runs/{id}/save-configurations", tag = "configurations",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 201, description = "The saved configurations", body = SavedConfigurations),
        (status = 404, description = "No such run, or no configurations yet"),
        (status = 409, description = "The visitor has stored too much"),
        (status = 429, description = "Too often; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn save_configurations_of_run(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    Path(id): Path<String>,
) -> Result<(StatusCode, Json<SavedConfigurations>)> {
    app.count(SAVE_CONFIGURATIONS, &address).await?;
    Ok((StatusCode::CREATED, Json(app.engine.save_configurations_of(&id, &guest).await?)))
}

/// Saved configurations as the file that was sent, or as Parquet when they are of a run.
#[utoipa::path(get, path = "/configurations/{id}/file", tag = "configurations",
    params(("id" = String, Path, description = "Id of the saved configurations")),
    responses(
        (status = 200, description = "The file", body = [u8], content_type = "application/octet-stream"),
        (status = 404, description = "The visitor has no such configurations"),
    ))]
pub(crate) async fn configurations_file(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Response> {
    let (saved, bytes) = app.engine.saved_file(&id, &guest).await?;
    Ok(download("application/octet-stream", &saved.name, bytes))
}

/// What deleting saved configurations deletes: they alone.
#[utoipa::path(get, path = "/configurations/{id}/deletion-preview", tag = "configurations",
    params(("id" = String, Path, description = "Id of the saved configurations")),
    responses(
        (status = 200, description = "What DELETE deletes", body = OwnedItems),
        (status = 404, description = "The visitor has no such configurations"),
    ))]
pub(crate) async fn deletion_preview_of_configurations(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.deletion_preview_of_saved(&id, &guest).await?))
}

/// Deletes saved configurations; runs that were measured on them stay.
#[utoipa::path(delete, path = "/configurations/{id}", tag = "configurations",
    params(("id" = String, Path, description = "Id of the saved configurations")),
    responses(
        (status = 200, description = "What was deleted", body = OwnedItems),
        (status = 404, description = "The visitor has no such configurations"),
    ))]
pub(crate) async fn remove_configurations(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.remove_saved(&id, &guest).await?))
}
