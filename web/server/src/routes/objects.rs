//! Objects: stock ones and the visitor's own.

use axum::Json;
use axum::extract::{Request, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use ocb_core::export::glb;
use ocb_service::model::{NewVisibility, ObjectInfo, Page};
use ocb_service::{Made, sha256_hex};
use utoipa::ToSchema;

use crate::App;
use crate::address::Address;
use crate::extract::{Json as Body, Path, Query};
use crate::guest::Guest;
use crate::limits::ADD_OBJECT;
use crate::list;
use crate::problem::{Problem, Result};
use crate::request_key::{IdempotencyKey, RequestKey};
use crate::upload::{MAX_BYTES, Upload};

/// Stock objects, in front of the first part and beyond its limit, then the visitor's own and those that others have
/// published, newest first.
#[utoipa::path(get, path = "/objects", tag = "objects", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<ObjectInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_objects(
    State(app): State<App>,
    Guest(guest): Guest,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/objects", &page, app.engine.objects(Some(&guest), &page).await?))
}

/// The form of an upload.
#[derive(ToSchema)]
#[expect(dead_code, reason = "only described; the upload is read as a stream")]
struct UploadForm {
    /// A file in OBJ, STL, PLY, OFF, glTF, GLB or COLLADA, of at most 256 MiB.
    #[schema(value_type = String, format = Binary)]
    file: Vec<u8>,
}

/// Uploads an object in OBJ, STL, PLY, OFF, glTF, GLB or COLLADA. The content decides which format it is, not the name; nodes
/// and instances of a scene are flattened, and no other file is opened. The same mesh uploaded twice is one object. Anyone
/// with its id can see it; only its owner sees it in the list, until the owner changes its visibility.
#[utoipa::path(post, path = "/objects", tag = "objects",
    request_body(content = inline(UploadForm), content_type = "multipart/form-data"), params(IdempotencyKey),
    responses(
        (status = 201, description = "The object", body = ObjectInfo),
        (status = 400, description = "The upload is not well-formed"),
        (status = 413, description = "Larger than 256 MiB"),
        (status = 422, description = "Not a usable object; the message has the place (line or byte), the reason and the remedy"),
        (status = 429, description = "Too many uploads; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn add_object(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    key: RequestKey,
    request: Request,
) -> Result<(StatusCode, Json<ObjectInfo>)> {
    app.count(ADD_OBJECT, &address).await?;
    let Upload { name, file, .. } = {
        let _coming = app.uploads.begin(&address)?;
        Upload::read(request, MAX_BYTES, &app, &address).await?
    };
    let _slot = app.uploads.take(&file).await?;
    let bytes = file.read().await?;
    app.engine.id_of_request(&guest, Made::Object, key.as_deref(), &(&name, sha256_hex(&bytes))).await?;
    let object = app.engine.add_object(&name, bytes, Some(&guest)).await?;
    Ok((StatusCode::CREATED, Json(object)))
}

/// One object: `stock:<name>@<triangles>`, `stock:bunny`, `stock:dragon` or the id of an upload.
#[utoipa::path(get, path = "/objects/{id}", tag = "objects",
    params(("id" = String, Path, description = "Object id")),
    responses(
        (status = 200, body = ObjectInfo),
        (status = 404, description = "No such object"),
    ))]
pub(crate) async fn show_object(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Json<ObjectInfo>> {
    Ok(Json(app.engine.object(&id, Some(&guest)).await?))
}

/// Decides who sees an object; only who added it may. Runs and advice with a private object are private, too.
#[utoipa::path(put, path = "/objects/{id}/visibility", tag = "objects", request_body = NewVisibility,
    params(("id" = String, Path, description = "Object id")),
    responses(
        (status = 200, description = "The updated object", body = ObjectInfo),
        (status = 403, description = "The object belongs to someone else, or a guest tries to publish"),
        (status = 404, description = "No such object"),
    ))]
pub(crate) async fn change_object_visibility(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
    Body(asked): Body<NewVisibility>,
) -> Result<Json<ObjectInfo>> {
    Ok(Json(app.engine.change_object_visibility(&id, asked.visibility, &guest).await?))
}

/// The mesh as glTF binary: positions in f32, triangles in file order, so that triangle and vertex numbers are those of
/// the records and heatmaps. Positions of a small object far from the origin count from the node's translation.
#[utoipa::path(get, path = "/objects/{id}/mesh.glb", tag = "objects",
    params(("id" = String, Path, description = "Object id")),
    responses(
        (status = 200, description = "The mesh", body = [u8], content_type = "model/gltf-binary"),
        (status = 304, description = "Unchanged (If-None-Match)"),
        (status = 404, description = "No such object"),
    ))]
pub(crate) async fn object_mesh(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
    headers: HeaderMap,
) -> Result<Response> {
    let tag = format!("\"{}\"", app.engine.object(&id, Some(&guest)).await?.sha256);
    let cache = [(header::ETAG, tag.clone()), (header::CACHE_CONTROL, "private, no-cache".to_owned())];
    if headers.get(header::IF_NONE_MATCH).is_some_and(|sent| sent.as_bytes() == tag.as_bytes()) {
        return Ok((StatusCode::NOT_MODIFIED, cache).into_response());
    }
    let _slot = app.drawing.acquire().await;
    let mesh = app.engine.mesh(&id).await?;
    let bytes = tokio::task::spawn_blocking(move || glb::geometry(&mesh)).await.map_err(Problem::fault)?;
    Ok((cache, [(header::CONTENT_TYPE, "model/gltf-binary")], bytes).into_response())
}
