//! Heatmaps of the objects of a replayed recording: values for the pages, files for other programs.

use axum::Json as Answer;
use axum::extract::State;
use axum::response::Response;
use ocb_service::model::{ObjectHeatmap, ObjectHeatmapRequest};
use ocb_service::workload::HeatmapFormat;
use serde::Deserialize;
use utoipa::{IntoParams, IntoResponses};

use crate::App;
use crate::download::download;
use crate::extract::{Path, Query};
use crate::problem::Result;

use super::heatmaps::Colouring;

/// Which object of which replay.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub(crate) struct Place {
    /// Id of the workload
    id: String,
    /// Its place in the scene, from 0
    object: u32,
}

/// Why there is no heatmap.
#[derive(IntoResponses)]
#[expect(dead_code, reason = "only described")]
enum NoHeatmap {
    /// Unknown measure, order or colormap
    #[response(status = 400)]
    Unknown,
    /// The visitor has no such workload, or it has not been replayed to its end
    #[response(status = 404)]
    NotThere,
    /// No such object or algorithm, or the replay is of a version that did not keep where objects are closest
    #[response(status = 422)]
    Impossible,
}

/// Values on the vertices of an object, from all queries that it takes part in.
#[utoipa::path(get, path = "/workloads/{id}/objects/{object}/heatmap", tag = "runs",
    params(Place, ObjectHeatmapRequest),
    responses((status = 200, body = ObjectHeatmap), NoHeatmap))]
pub(crate) async fn workload_heatmap(
    State(app): State<App>,
    Path(Place { id, object }): Path<Place>,
    Query(request): Query<ObjectHeatmapRequest>,
) -> Result<Answer<ObjectHeatmap>> {
    let _slot = app.drawing.acquire().await;
    Ok(Answer(app.engine.workload_heatmap(&id, object, request).await?))
}

/// The heatmap as glTF binary: `COLOR_0` (linear) for viewers, `_VALUE` (f32) for programs, `extras.ocb` says what it is.
#[utoipa::path(get, path = "/workloads/{id}/objects/{object}/heatmap.glb", tag = "runs",
    params(Place, ObjectHeatmapRequest, Colouring),
    responses((status = 200, description = "The coloured mesh", body = [u8], content_type = "model/gltf-binary"), NoHeatmap))]
pub(crate) async fn workload_heatmap_glb(
    State(app): State<App>,
    Path(place): Path<Place>,
    Query(request): Query<ObjectHeatmapRequest>,
    Query(colouring): Query<Colouring>,
) -> Result<Response> {
    file(&app, place, request, colouring, HeatmapFormat::Glb).await
}

/// The heatmap as PLY: `red green blue` (sRGB) and `quality` (the value).
#[utoipa::path(get, path = "/workloads/{id}/objects/{object}/heatmap.ply", tag = "runs",
    params(Place, ObjectHeatmapRequest, Colouring),
    responses((status = 200, description = "The coloured mesh", body = [u8], content_type = "application/octet-stream"), NoHeatmap))]
pub(crate) async fn workload_heatmap_ply(
    State(app): State<App>,
    Path(place): Path<Place>,
    Query(request): Query<ObjectHeatmapRequest>,
    Query(colouring): Query<Colouring>,
) -> Result<Response> {
    file(&app, place, request, colouring, HeatmapFormat::Ply).await
}

/// The heatmap as a table: vertex, value, and the queries that went in.
#[utoipa::path(get, path = "/workloads/{id}/objects/{object}/heatmap.csv", tag = "runs",
    params(Place, ObjectHeatmapRequest),
    responses((status = 200, description = "One line per vertex", body = [u8], content_type = "text/csv"), NoHeatmap))]
pub(crate) async fn workload_heatmap_csv(
    State(app): State<App>,
    Path(place): Path<Place>,
    Query(request): Query<ObjectHeatmapRequest>,
) -> Result<Response> {
    file(&app, place, request, Colouring::default(), HeatmapFormat::Csv).await
}

async fn file(
    app: &App,
    Place { id, object }: Place,
    request: ObjectHeatmapRequest,
    colouring: Colouring,
    format: HeatmapFormat,
) -> Result<Response> {
    let (media_type, end) = match format {
        HeatmapFormat::Glb => ("model/gltf-binary", "glb"),
        HeatmapFormat::Ply => ("application/octet-stream", "ply"),
        HeatmapFormat::Csv => ("text/csv; charset=utf-8", "csv"),
    };
    let _slot = app.drawing.acquire().await;
    let name = format!("workload-{id}-object-{object}-{}.{end}", request.algorithm);
    let colours = (colouring.colormap, colouring.scale);
    let bytes = app.engine.workload_heatmap_file(&id, object, request, colours, format).await?;
    Ok(download(media_type, &name, bytes))
}
