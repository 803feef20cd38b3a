//! Heatmaps: values for the pages, coloured files for other programs.

use axum::Json;
use axum::extract::State;
use axum::response::Response;
use ocb_core::colormap::{Colormap, Scale};
use ocb_service::model::{Heatmap, HeatmapRequest, VertexValue};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::App;
use crate::download::download;
use crate::extract::{Path, Query};
use crate::problem::{Problem, Result};

/// How values become colours in a file.
#[derive(Default, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct Colouring {
    /// Colormap.
    #[serde(default)]
    #[param(inline)]
    pub(super) colormap: Colormap,
    /// Scale.
    #[serde(default)]
    #[param(inline)]
    pub(super) scale: Scale,
}

/// Values on the vertices of one object of the run.
#[utoipa::path(get, path = "/runs/{id}/heatmap", tag = "results",
    params(("id" = String, Path, description = "Run id"), HeatmapRequest),
    responses(
        (status = 200, body = Heatmap),
        (status = 404, description = "No such run, or no such values in it"),
        (status = 400, description = "Unknown measure, statistic, ..."),
        (status = 422, description = "No such values: errors of a run without distance queries, another object, ..."),
    ))]
pub(crate) async fn show_heatmap(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(request): Query<HeatmapRequest>,
) -> Result<Json<Heatmap>> {
    Ok(Json(app.engine.heatmap(&id, &request).await?))
}

/// The value at one vertex, as the heatmap has it.
#[utoipa::path(get, path = "/runs/{id}/vertices/{vertex}", tag = "results",
    params(
        ("id" = String, Path, description = "Run id"),
        ("vertex" = u32, Path, description = "Vertex, from 0"),
        HeatmapRequest,
    ),
    responses(
        (status = 200, body = VertexValue),
        (status = 404, description = "No such run, values or vertex"),
        (status = 400, description = "Unknown measure, statistic, ..."),
        (status = 422, description = "No such values: errors of a run without distance queries, another object, ..."),
    ))]
pub(crate) async fn show_vertex(
    State(app): State<App>,
    Path((id, vertex)): Path<(String, u32)>,
    Query(request): Query<HeatmapRequest>,
) -> Result<Json<VertexValue>> {
    let heatmap = app.engine.heatmap(&id, &request).await?;
    let value = heatmap.vertex(vertex).map(Json);
    value.ok_or_else(|| {
        let vertices = heatmap.values.len();
        Problem::not_found(format!("There is no vertex {vertex}; the object has {vertices}, counted from 0."))
    })
}

/// The heatmap as glTF binary: `COLOR_0` (linear) for viewers, `_VALUE` (f32) for programs, `extras.ocb` says what it is.
#[utoipa::path(get, path = "/runs/{id}/heatmap.glb", tag = "results",
    params(("id" = String, Path, description = "Run id"), HeatmapRequest, Colouring),
    responses(
        (status = 200, description = "The coloured mesh", body = [u8], content_type = "model/gltf-binary"),
        (status = 404, description = "No such run, or no such values in it"),
        (status = 400, description = "Unknown measure, colormap, ..."),
        (status = 422, description = "No such values: errors of a run without distance queries, another object, ..."),
    ))]
pub(crate) async fn heatmap_glb(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(request): Query<HeatmapRequest>,
    Query(colouring): Query<Colouring>,
) -> Result<Response> {
    let bytes = app.engine.heatmap_glb(&id, &request, colouring.colormap, colouring.scale).await?;
    Ok(download("model/gltf-binary", &format!("{id}-{}.glb", request.algorithm), bytes))
}

/// The heatmap as PLY: `red green blue` (sRGB) and `quality` (the value).
#[utoipa::path(get, path = "/runs/{id}/heatmap.ply", tag = "results",
    params(("id" = String, Path, description = "Run id"), HeatmapRequest, Colouring),
    responses(
        (status = 200, description = "The coloured mesh", body = [u8], content_type = "application/octet-stream"),
        (status = 404, description = "No such run, or no such values in it"),
        (status = 400, description = "Unknown measure, colormap, ..."),
        (status = 422, description = "No such values: errors of a run without distance queries, another object, ..."),
    ))]
pub(crate) async fn heatmap_ply(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(request): Query<HeatmapRequest>,
    Query(colouring): Query<Colouring>,
) -> Result<Response> {
    let bytes = app.engine.heatmap_ply(&id, &request, colouring.colormap, colouring.scale).await?;
    Ok(download("application/octet-stream", &format!("{id}-{}.ply", request.algorithm), bytes))
}
